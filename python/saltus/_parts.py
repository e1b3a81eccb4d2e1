"""Parts of results: arrays with their meaning, tables and figures; tables are read from files too."""

from __future__ import annotations

import csv
import io
import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from saltus import _native
from saltus._errors import unknown

if TYPE_CHECKING:
    import pandas

__all__ = ["Drawing", "Drawn", "Figure", "Named", "Table", "Variable", "read_csv", "shown_size"]

#: Pixels of a PNG per unit of the SVG, as the program writes it.
SCALE = 2.0

Item = TypeVar("Item")


@dataclass(frozen=True, eq=False)
class Variable:
    """An array with the names of its axes and its meaning.

    Examples
    --------
    >>> import saltus
    >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    >>> z = saltus.simulate(study, periods=2).variables["z"]
    >>> z.dims, z.values.shape, z.attrs["long_name"]
    (('period', 'jumper'), (2, 1), 'Height over eta = g/omega_h^2')
    """

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
    """Columns of equal length, as in the CSV file of the same name.

    Attributes
    ----------
    notes : dict of str to str
        Meanings of the columns, with units.

    Examples
    --------
    >>> import saltus
    >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    >>> table = saltus.simulate(study, periods=2).tables["section"]
    >>> list(table)[:3]
    ['period', 'time_s', 'z']
    >>> table.notes["z"]
    'Height over eta = g/omega_h^2 (-)'
    """

    def __init__(self, notes: Mapping[str, str], columns: Mapping[str, Any]) -> None:
        self.notes = dict(notes)
        self._columns = {name: _column(values) for name, values in columns.items()}

    def __getitem__(self, name: str) -> NDArray[Any]:
        """Return a column, of shape (rows,)."""
        try:
            return self._columns[name]
        except KeyError:
            raise unknown("column", name, self) from None

    def __iter__(self) -> Iterator[str]:
        """Go through the names of the columns."""
        return iter(self._columns)

    def __len__(self) -> int:
        """Return the number of columns."""
        return len(self._columns)

    def to_pandas(self) -> pandas.DataFrame:
        """Return the table as a data frame.

        Returns
        -------
        pandas.DataFrame
            With the notes on the columns as its ``attrs``.

        Raises
        ------
        ImportError
            If there is no pandas: ``pip install 'saltus[xarray]'``.

        Examples
        --------
        >>> import saltus
        >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
        >>> motion = saltus.simulate(study, periods=2)
        >>> len(motion.tables["section"].to_pandas())
        2
        """
        import pandas

        frame = pandas.DataFrame(self._columns)
        frame.attrs.update(self.notes)
        return frame

    def __repr__(self) -> str:
        """Return the size and the names of the columns."""
        rows = len(next(iter(self._columns.values()), ()))
        return f"<saltus.Table, {rows} rows: {', '.join(self)}>"


class Drawing(Protocol):
    """A figure as the native module draws it, or as it was drawn before."""

    def styled(self, width: str | None, font_size: str, titles: bool) -> Drawing:
        """Return the same of another look."""

    def svg(self) -> str:
        """As SVG."""

    def pdf(self) -> bytes:
        """As PDF."""

    def png(self, scale: float) -> bytes:
        """As PNG, with so many pixels per unit of the SVG."""


class Drawn:
    """A figure out of the files that it was written to."""

    def __init__(self, svg: bytes, pdf: bytes, png: bytes) -> None:
        self._svg, self._pdf, self._png = svg, pdf, png

    def styled(self, width: str | None, font_size: str, titles: bool) -> Drawing:
        """It was drawn with its look."""
        raise ValueError(
            "a figure that was loaded keeps its look: ask the question again, as by "
            "saltus.rerun, or plot its arrays"
        )

    def svg(self) -> str:
        """As it was written."""
        return self._svg.decode()

    def pdf(self) -> bytes:
        """As it was written."""
        return self._pdf

    def png(self, scale: float) -> bytes:
        """As it was written, which was with one scale."""
        if scale != SCALE:
            raise ValueError(
                f"scale is {scale}: a figure that was loaded has its pixels already, at the scale "
                f"{SCALE:g}; its svg has none, and plot() draws it anew"
            )
        return self._png


class Figure:
    """A figure, drawn when somebody looks at it.

    Attributes
    ----------
    name : str
        Name of its files without ending.
    about : str
        What it shows, for those who cannot see it.

    Examples
    --------
    >>> import saltus
    >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    >>> figure = saltus.simulate(study, periods=3).figures["portrait"]
    >>> figure
    <saltus.Figure portrait>
    >>> figure.svg.startswith("<svg")
    True
    """

    def __init__(self, name: str, drawing: Drawing, about: str = "") -> None:
        self.name = name
        self.about = about
        self._drawing = drawing

    @property
    def svg(self) -> str:
        """The figure as SVG."""
        return self._drawing.svg()

    @property
    def pdf(self) -> bytes:
        """The figure as PDF."""
        return self._drawing.pdf()

    def png(self, scale: float = SCALE) -> bytes:
        """Return the figure as PNG.

        Parameters
        ----------
        scale : float
            Pixels per unit of the SVG, 0.1 to 20.

        Returns
        -------
        bytes
            Content of a PNG file.

        Raises
        ------
        ValueError
            If the scale is out of range, or another than 2 for a figure that was loaded.

        Examples
        --------
        >>> import saltus
        >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
        >>> figure = saltus.simulate(study, periods=3).figures["portrait"]
        >>> figure.png(scale=0.5)[1:4]
        b'PNG'
        """
        if not 0.1 <= scale <= 20.0:
            raise ValueError(f"scale is {scale}: 0.1 to 20 would do")
        return self._drawing.png(scale)

    def save(
        self,
        path: str | os.PathLike[str],
        scale: float = SCALE,
        *,
        width: str | None = None,
        font_size: str = "8pt",
        titles: bool = True,
    ) -> None:
        """Write the figure to a file, whole or not at all.

        Parameters
        ----------
        path : path
            A name that ends in ``.svg``, ``.pdf`` or ``.png``.
        scale : float
            Pixels of a PNG per unit of the SVG; one of a given width has 600 to an inch.
        width : str, optional
            Width in print, such as ``"85mm"`` (a column) or ``"170mm"`` (a page).
        font_size : str
            Size of the labels in print, where a width is given.
        titles : bool
            Whether titles stand in the figure; a journal has them in the caption.

        Raises
        ------
        ValueError
            If the name has another ending, a length is none, or another look is asked of a
            figure that was loaded.
        ResultError
            If the file cannot be written.

        Examples
        --------
        >>> import tempfile
        >>> import saltus
        >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
        >>> figure = saltus.simulate(study, periods=3).figures["portrait"]
        >>> figure.save(f"{tempfile.mkdtemp()}/portrait.svg")
        >>> figure.save(f"{tempfile.mkdtemp()}/portrait.pdf", width="85mm", titles=False)
        """
        if width is not None or not titles or font_size != "8pt":
            styled = Figure(self.name, self._drawing.styled(width, font_size, titles), self.about)
            styled.save(path, scale)
            return
        path = Path(path)
        match path.suffix.lower():
            case ".svg":
                content = self.svg.encode()
            case ".pdf":
                content = self.pdf
            case ".png":
                content = self.png(scale)
            case other:
                raise ValueError(f"path ends in {other!r}: .svg, .pdf or .png is needed")
        _native.write(path, content)

    def _repr_mimebundle_(
        self, include: object = None, exclude: object = None
    ) -> tuple[dict[str, Any], dict[str, Any]]:
        """Show it as large as its SVG, with the pixels of a fine screen."""
        png = self.png()
        width, height = shown_size(png)
        shown = {"width": width, "height": height, "alt": self.about or self.name}
        return {"text/plain": repr(self), "image/png": png}, {"image/png": shown}

    def __repr__(self) -> str:
        """Return the name."""
        return f"<saltus.Figure {self.name}>"


class Named(dict[str, Item]):
    """Parts of a result by their names; a name that is not there is told with those that come near."""

    def __init__(self, what: str, items: Mapping[str, Item]) -> None:
        super().__init__(items)
        self._what = what

    def __missing__(self, name: object) -> Item:
        """Raise the error of a name that is not there."""
        raise unknown(self._what, name, self)


def read_csv(text: str) -> tuple[dict[str, str], dict[str, Any]]:
    """Notes and columns of a table that saltus wrote."""
    lines = list(io.StringIO(text, newline=""))
    begin = next(place for place, line in enumerate(lines) if not line.startswith("# "))
    # the first line says what the table is
    told = [line[2:].rstrip("\n").partition(": ") for line in lines[1:begin]]
    notes = {title: note for title, _, note in told}
    header, *rows = csv.reader(lines[begin:])
    columns = zip(*rows, strict=True) if rows else [()] * len(header)
    return notes, {
        title: _cells(cells, notes[title]) for title, cells in zip(header, columns, strict=True)
    }


def _cells(cells: Iterable[str], note: str) -> Any:
    """The cells of a column in the type that they were written from.

    Numbers have a point or an exponent, whole ones neither; an empty cell is a number that is not known
    or no text. Of a column that is empty all through its unit tells which.
    """
    cells = list(cells)
    known = [cell for cell in cells if cell]
    if not known:
        return np.full(len(cells), np.nan) if note.endswith(")") else [None] * len(cells)
    if set(known) <= {"true", "false"}:
        return [cell == "true" for cell in cells]
    for number in (int, float):
        try:
            numbers = [number(cell) for cell in known]
        except ValueError:
            continue
        if len(known) == len(cells):
            return np.array(numbers, np.int64 if number is int else np.float64)
        return np.array([float(cell) if cell else np.nan for cell in cells])
    return [cell or None for cell in cells]


def shown_size(png: bytes) -> tuple[int, int]:
    """Width and height at which a PNG is shown, those of its SVG."""
    width, height = (int.from_bytes(png[at : at + 4], "big") for at in (16, 20))
    return round(width / SCALE), round(height / SCALE)


def _column(values: Any) -> NDArray[Any]:
    return values if isinstance(values, np.ndarray) else np.array(values, dtype=object)
