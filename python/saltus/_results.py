"""Results: arrays, tables, figures, a document, and the folder that the program writes."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from saltus import _native
from saltus.study import Study

if TYPE_CHECKING:
    import pandas
    import xarray

__all__ = ["Figure", "Result", "Table", "Variable"]

#: Pixels of a PNG per unit of the SVG, as the program writes it.
SCALE = 2.0


@dataclass(frozen=True, eq=False)
class Variable:
    """An array with the names of its axes and its meaning."""

    name: str
    dims: tuple[str, ...]
    values: NDArray[Any]
    """Shape: the lengths of `dims`."""
    attrs: Mapping[str, Any]
    """``long_name``, ``units`` (as UDUNITS spells them) and others."""
    meanings: Mapping[int, str]
    """The words that the whole numbers of `values` stand for, if they do."""
    fill: int | None
    """The whole number that stands for "no value", if there is one."""
    coordinate: bool
    """Whether it holds the places of the others along a dimension."""

    @property
    def words(self) -> NDArray[np.object_]:
        """The words that whole numbers stand for, or the values as words."""
        word = (lambda code: self.meanings.get(int(code), "")) if self.meanings else str
        words = [word(value) for value in self.values.ravel()]
        return np.array(words, dtype=object).reshape(self.values.shape)


class Table(Mapping[str, NDArray[Any]]):
    """Columns of equal length, as in the CSV file of the same name."""

    def __init__(self, notes: Mapping[str, str], columns: Mapping[str, Any]) -> None:
        self.notes = dict(notes)
        """Meanings of the columns, with units."""
        self._columns = {name: _column(values) for name, values in columns.items()}

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return a column, of shape (rows,)."""
        return self._columns[name]

    def __iter__(self) -> Iterator[str]:
        """Go through the names of the columns."""
        return iter(self._columns)

    def __len__(self) -> int:
        """Return the number of columns."""
        return len(self._columns)

    def to_pandas(self) -> pandas.DataFrame:
        """Return the table as a data frame; its ``attrs`` are the notes."""
        import pandas

        frame = pandas.DataFrame(self._columns)
        frame.attrs.update(self.notes)
        return frame

    def __repr__(self) -> str:
        """Return the size and the names of the columns."""
        rows = len(next(iter(self._columns.values()), ()))
        return f"<saltus.Table, {rows} rows: {', '.join(self)}>"


class Figure:
    """A figure, drawn when somebody looks at it."""

    def __init__(self, name: str, native: _native.Figure) -> None:
        self.name = name
        self._native = native

    @property
    def svg(self) -> str:
        """The figure as SVG."""
        return self._native.svg()

    def png(self, scale: float = SCALE) -> bytes:
        """Return the figure as PNG, with `scale` pixels per unit of the SVG."""
        if not 0.1 <= scale <= 20.0:
            raise ValueError(f"scale is {scale}: 0.1 to 20 would do")
        return self._native.png(scale)

    def save(self, path: str | os.PathLike[str], scale: float = SCALE) -> None:
        """Write the figure to a file that ends in ``.svg`` or ``.png``, whole or not at all."""
        path = Path(path)
        match path.suffix.lower():
            case ".svg":
                content = self.svg.encode()
            case ".png":
                content = self.png(scale)
            case other:
                raise ValueError(f"path ends in {other!r}: .svg or .png is needed")
        _native.write(path, content)

    def _repr_mimebundle_(
        self, include: object = None, exclude: object = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Show it as large as its SVG, with the pixels of a fine screen."""
        png = self.png()
        width, height = (int.from_bytes(png[at : at + 4], "big") / SCALE for at in (16, 20))
        size = {"width": round(width), "height": round(height)}
        return {"text/plain": repr(self), "image/png": png}, {"image/png": size}

    def __repr__(self) -> str:
        """Return the name."""
        return f"<saltus.Figure {self.name}>"


class Result(Mapping[str, NDArray[Any]]):
    """Answer of a question.

    As a mapping it holds the arrays by name: ``result["z"]``, with the axes and units that
    ``result.variables["z"]`` tells. In a notebook it shows its summary and its first figure.

    Attributes
    ----------
    command : str
        The command that was asked.
    study : Study
        The study it was asked about, every default written out.
    """

    def __init__(self, answer: _native.Answer) -> None:
        self._answer = answer
        self.command = answer.command
        self.study = Study.parse(answer.study[1])

    @property
    def summary(self) -> str:
        """The answer in words."""
        return self._answer.summary().rstrip()

    @cached_property
    def report(self) -> dict[str, Any]:
        """The JSON document that the program writes; ``saltus help COMMAND`` explains each key."""
        report: dict[str, Any] = json.loads(self._answer.document())
        return report

    def cite(self) -> str:
        """Return the works that this result rests on as BibTeX, each below what it was used for."""
        return self._answer.cite()

    @property
    def shortfall(self) -> str | None:
        """Reason why a part of the answer is missing, as where a motion ended early; else None."""
        return self._answer.shortfall()

    @cached_property
    def variables(self) -> Mapping[str, Variable]:
        """The arrays with their axes, units and meanings."""
        return {variable.name: variable for variable in self._dataset[1]}

    @property
    def attrs(self) -> Mapping[str, Any]:
        """Title, source with version, the resolved study and its hash."""
        return self._dataset[0]

    @cached_property
    def tables(self) -> Mapping[str, Table]:
        """The tables, by the names of their files without ``.csv``."""
        return {_stem(name): Table(*table) for name, table in self._parts[0].items()}

    @cached_property
    def figures(self) -> Mapping[str, Figure]:
        """The figures, by the names of their files without ending."""
        return {name: Figure(name, figure) for name, figure in self._parts[1].items()}

    def words(self, name: str) -> NDArray[np.object_]:
        """Return an array whose whole numbers stand for words as these words."""
        return self.variables[name].words

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return the array of that name."""
        return self.variables[name].values

    def __iter__(self) -> Iterator[str]:
        """Go through the names of the arrays."""
        return iter(self.variables)

    def __len__(self) -> int:
        """Return the number of arrays."""
        return len(self.variables)

    def to_xarray(self) -> xarray.Dataset:
        """Return the dataset that the program writes as NetCDF, with all its attributes."""
        import xarray

        def array(variable: Variable) -> xarray.Variable:
            attrs = dict(variable.attrs)
            if variable.values.dtype == bool:
                attrs |= {"flag_values": np.array([0, 1], np.uint8), "flag_meanings": "false true"}
            if variable.meanings:
                attrs["flag_values"] = np.array(list(variable.meanings), variable.values.dtype)
                meanings = variable.meanings.values()
                attrs["flag_meanings"] = " ".join(word.replace(" ", "_") for word in meanings)
            if variable.fill is None:
                return xarray.Variable(variable.dims, variable.values, attrs)
            values = np.where(variable.values == variable.fill, np.nan, variable.values)
            encoding = {"dtype": variable.values.dtype, "_FillValue": variable.fill}
            return xarray.Variable(variable.dims, values, attrs, encoding)

        attrs = dict(self.attrs)
        # this attribute of a file names the further coordinates among its arrays
        more = attrs.pop("coordinates", "").split()
        return xarray.Dataset(
            {name: array(variable) for name, variable in self.variables.items()}, attrs=attrs
        ).set_coords(more)

    def to_pandas(self, table: str | None = None) -> pandas.DataFrame:
        """Return a table as a data frame; without a name the first."""
        if not self.tables:
            raise ValueError(f"{self.command} has no tables; its arrays are in to_xarray()")
        name = next(iter(self.tables)) if table is None else table
        if name not in self.tables:
            raise KeyError(f"no table {name!r}; there are: {', '.join(self.tables)}")
        return self.tables[name].to_pandas()

    def save(self, out: str | os.PathLike[str]) -> Path:
        """Write the folder that the program writes: the same bytes, whole or not at all."""
        out = Path(out)
        self._answer.save(out)
        return out

    @cached_property
    def _parts(self) -> _native._Parts:
        return self._answer.parts()

    @cached_property
    def _dataset(self) -> tuple[Mapping[str, Any], list[Variable]]:
        for attrs, variables in self._parts[2].values():
            return attrs, [
                Variable(
                    name,
                    tuple(dims),
                    _values(values, shape),
                    about,
                    dict(meanings),
                    fill,
                    coordinate,
                )
                for name, dims, shape, values, about, meanings, fill, coordinate in variables
            ]
        return {}, []

    def __repr__(self) -> str:
        """Return the summary, and the arrays with their axes."""
        lines = [f"<saltus.Result of {self.command}>", self.summary, "Arrays:"]
        for variable in self.variables.values():
            axes = ", ".join(
                f"{dim}: {length}"
                for dim, length in zip(variable.dims, variable.values.shape, strict=True)
            )
            about = variable.attrs.get("long_name", "")
            units = variable.attrs.get("units", "")
            what = f"{about} ({units})" if units else about
            lines.append(f"    {variable.name:<20} ({axes})  {what}")
        return "\n".join(lines)

    def _repr_mimebundle_(
        self, include: object = None, exclude: object = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        text = {"text/plain": repr(self)}
        for figure in self.figures.values():
            shown, size = figure._repr_mimebundle_()
            return shown | text, size
        return text, {}


def _stem(name: str) -> str:
    return name.removesuffix(".csv")


def _column(values: Any) -> NDArray[Any]:
    return values if isinstance(values, np.ndarray) else np.array(values, dtype=object)


def _values(values: Any, shape: list[int]) -> NDArray[Any]:
    """Values as an array: texts come as a list."""
    if isinstance(values, np.ndarray):
        return values
    return np.array(values, dtype=object).reshape(shape)
