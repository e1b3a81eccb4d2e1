"""Results: arrays, tables, figures, a document, and the folder that the program writes."""

from __future__ import annotations

import base64
import html
import json
import os
import tempfile
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray

from saltus import _native
from saltus._parts import Drawing, Drawn, Figure, Named, Table, Variable, read_csv, shown_size
from saltus._plot import classes
from saltus.study import Study

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.animation import FuncAnimation
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike

__all__ = ["Result", "load"]


class Result(Mapping[str, NDArray[Any]]):
    """Answer of a question.

    As a mapping it holds the arrays by name: ``result["z"]``, with the axes and units that
    ``result.variables["z"]`` tells; `repr` lists them all. In a notebook it shows its summary and its
    figures. It can be pickled, which takes as long as :meth:`save`, and copied.

    Attributes
    ----------
    command : str
        The command that was asked.
    study : Study
        The study it was asked about, every default written out.

    Examples
    --------
    >>> import saltus
    >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    >>> motion = saltus.simulate(study, periods=50)
    >>> motion["z"].shape, motion.variables["z"].dims
    ((50, 1), ('period', 'jumper'))
    >>> motion.summary.splitlines()[0]
    'status      completed'
    >>> sorted(motion.tables), sorted(motion.figures)
    (['energy', 'history', 'section', 'switches'], ['history', 'portrait'])
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
        """Give the works that this result rests on.

        Returns
        -------
        str
            BibTeX, each entry below what the work was used for.

        Examples
        --------
        >>> import saltus
        >>> saltus.frequencies(saltus.Study.paper()).cite().count("@") > 1
        True
        """
        return self._answer.cite()

    @property
    def shortfall(self) -> str | None:
        """Reason why a part of the answer is missing, as where a motion ended early; else None."""
        return self._answer.shortfall()

    @cached_property
    def variables(self) -> Mapping[str, Variable]:
        """The arrays with their axes, units and meanings."""
        return Named("array", {variable.name: variable for variable in self._dataset[1]})

    @property
    def attrs(self) -> Mapping[str, Any]:
        """Title, source with version, the resolved study and its hash."""
        return self._dataset[0]

    @cached_property
    def tables(self) -> Mapping[str, Table]:
        """The tables, by the names of their files without ``.csv``."""
        tables = {_stem(name): Table(*table) for name, table in self._parts[0].items()}
        read = self._files(".csv")
        return Named("table", tables | {name: Table(*read_csv(text.decode())) for name, text in read})

    @cached_property
    def figures(self) -> Mapping[str, Figure]:
        """The figures, by the names of their files without ending."""
        drawings: dict[str, Drawing] = dict(self._parts[1])
        pages, pixels = dict(self._files(".pdf")), dict(self._files(".png"))
        for name, svg in self._files(".svg"):
            drawings[name] = Drawn(svg, pages[name], pixels[name])
        about = f"{self.attrs.get('title', self.command)} ({self.command})"
        figures = {name: Figure(name, one, f"{about}: {name}") for name, one in drawings.items()}
        return Named("figure", figures)

    def words(self, name: str) -> NDArray[np.object_]:
        """Give an array whose whole numbers stand for words as these words.

        Parameters
        ----------
        name : str
            The array, such as "label" of a sweep, "status" of a map, "phase" of a motion.

        Returns
        -------
        ndarray of str, dtype object
            Of the shape of the array.

        Raises
        ------
        UnknownNameError
            If there is no such array.

        Examples
        --------
        >>> import saltus
        >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
        >>> saltus.simulate(study, periods=2).words("phase").ravel().tolist()
        ['contact', 'contact']
        """
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
        """Give all arrays with their axes, units and meanings.

        Returns
        -------
        xarray.Dataset
            The one that the program writes as NetCDF, with all its attributes.

        Raises
        ------
        ImportError
            If there is no xarray: ``pip install 'saltus[xarray]'``.

        Examples
        --------
        >>> import saltus
        >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
        >>> data = saltus.sweep(study, values=[0.3, 0.5], transient=50, record=4).to_xarray()
        >>> data.z.sel(direction="up", jumper=0).dims
        ('jumper_damping_ratio', 'sample')
        >>> heights = data.z * data.eta
        """
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
        """Give a table as a data frame.

        Parameters
        ----------
        table : str, optional
            Its name in ``tables``; by default the first.

        Returns
        -------
        pandas.DataFrame

        Raises
        ------
        ValueError
            If there are no tables.
        UnknownNameError
            If there is no such table.
        ImportError
            If there is no pandas: ``pip install 'saltus[xarray]'``.

        Examples
        --------
        >>> import saltus
        >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
        >>> result = saltus.sweep(study, values=[0.3, 0.5], transient=100, record=4)
        >>> result.to_pandas("rows")[["direction", "value", "label", "period"]].head(2)
          direction  value     label  period
        0        up    0.3  periodic       2
        1        up    0.5  periodic       1
        """
        if not self.tables:
            raise ValueError(f"{self.command} has no tables; its arrays are in to_xarray()")
        return self.tables[next(iter(self.tables)) if table is None else table].to_pandas()

    def plot(
        self, ax: Axes | None = None, what: str | None = None, *, jumper: int = 0, **kwargs: Any
    ) -> list[Artist]:
        """Draw the answer in axes of matplotlib.

        ========== =====================================================================
        command    `what`, the first by default
        ========== =====================================================================
        simulate   "portrait" (phase portrait), "history" (heights), "force" (of the
                   feet), "acceleration" (of the floor)
        orbit      "multipliers" (Floquet), and all those of simulate
        sweep      "bifurcation", "exponents"
        map        "map" (periods and kinds), or an array over the plane by its name
        basins     "basins", "map", or an array over the plane by its name
        continue   "branches", "curves"
        lyapunov   "exponents", "convergence"
        attractors "attractors" (their sections), "shares" (of the initial conditions)
        ========== =====================================================================

        A period has the same colour in all plots.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to draw; by default a new figure.
        what : str, optional
            Which plot.
        jumper : int
            Whose motion, counted from 0.
        **kwargs
            For the points, lines or cells, such as ``markersize=1`` or ``cmap="magma"``. For
            "bifurcation" also ``direction="up"``, which leaves out the others.

        Returns
        -------
        list of matplotlib.artist.Artist
            Points, lines or cells, one or several for each entry of the legend.

        Raises
        ------
        ImportError
            If there is no matplotlib: ``pip install 'saltus[plot]'``.
        UnknownNameError
            If there is no such plot; the message tells those there are.
        ValueError
            If there is nothing to plot, as of frequencies.

        Examples
        --------
        >>> import matplotlib
        >>> matplotlib.use("agg")
        >>> import saltus
        >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
        >>> result = saltus.sweep(study, values=[0.3, 0.4, 0.5], transient=100, record=4)
        >>> [line.get_label() for line in result.plot()]
        ['Period 1', 'Period 2']
        """
        from saltus._plot import plot

        return plot(self, ax, what, jumper, kwargs)

    def surface(
        self,
        x: ArrayLike | None = None,
        y: ArrayLike | None = None,
        t: ArrayLike | None = None,
        *,
        absolute: bool = False,
    ) -> NDArray[np.float64]:
        """Give the deflection of the plate w(x, y, t) (m) of simulate or orbit.

        Parameters
        ----------
        x, y : array_like, shapes (nx,) and (ny,), optional
            Positions along length and width (m); by default 57 each over the whole plate.
        t : array_like, optional
            Times (s) of the history, any number of axes; by default all of them.
        absolute : bool
            Height with the motion of the base; by default the deflection relative to it.

        Returns
        -------
        ndarray of float, shape (*shape of t, ny, nx)
            Sum of the plate's terms with the amplitudes ``history_w``, which are those of the
            integrator's own solution: nothing is interpolated.

        Raises
        ------
        ValueError
            If a place is beside the plate, a time is none of the history, or the result has no history.

        Examples
        --------
        >>> import saltus
        >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
        >>> motion = saltus.simulate(study, periods=1, times=[0.0, 0.1, 0.2])
        >>> motion.surface([3.5, 7.0, 10.5], [5.0], t=0.1).shape
        (1, 3)
        >>> motion.surface().shape
        (3, 57, 57)
        """
        from saltus._motion import surface

        return surface(self, x, y, t, absolute)

    def animate(
        self,
        view: Literal["section", "surface"] = "section",
        *,
        jumper: int = 0,
        periods: int = 2,
        frames: int = 120,
        slower: float = 4.0,
    ) -> FuncAnimation:
        """Make a film of plate, base and people, from the history of simulate or orbit.

        In a notebook ``IPython.display.HTML(film.to_jshtml())`` shows it, elsewhere
        ``film.save("jump.gif")`` keeps it. Keep a reference to it as long as it plays.

        Parameters
        ----------
        view : {"section", "surface"}
            Section of the plate along its length through one person, or all of it in space.
        jumper : int
            The person that the section goes through, counted from 0.
        periods : int
            Forcing periods, the last ones of the history.
        frames : int
            Pictures at most: as many as the history has times.
        slower : float
            Times that it takes longer than the motion itself.

        Returns
        -------
        matplotlib.animation.FuncAnimation
            Legs are drawn 0.25 m long without load: those of the model have no length of their own.

        Raises
        ------
        ImportError
            If there is no matplotlib: ``pip install 'saltus[plot]'``.
        ValueError
            If the result has no history, or an argument is out of range.

        Examples
        --------
        >>> import matplotlib
        >>> matplotlib.use("agg")
        >>> import saltus
        >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
        >>> film = saltus.simulate(study, periods=12).animate(frames=3)
        >>> "<script" in film.to_jshtml()
        True
        """
        from saltus._motion import animate

        return animate(self, view, jumper, periods, frames, slower)

    def save(self, out: str | os.PathLike[str]) -> Path:
        """Write the folder that the program writes: the same bytes, whole or not at all.

        Parameters
        ----------
        out : path
            The folder, which may be absent, empty, or an earlier result.

        Returns
        -------
        Path
            The folder, for :func:`saltus.load` and :func:`saltus.rerun`.

        Raises
        ------
        ResultError
            If the folder holds files of others, or cannot be written.

        Examples
        --------
        >>> import saltus, tempfile
        >>> saved = saltus.frequencies(saltus.Study.paper()).save(tempfile.mkdtemp())
        >>> sorted(path.name for path in saved.iterdir())
        ['frequencies.json', 'frequencies.nc', 'saltus-result.json', 'study.toml']
        """
        out = Path(out)
        self._answer.save(out)
        return out

    def __copy__(self) -> Result:
        """Give a result with arrays of its own."""
        return Result(self._answer)

    def __deepcopy__(self, memo: object) -> Result:
        """Give a result with arrays of its own."""
        return Result(self._answer)

    def __reduce__(self) -> tuple[Any, tuple[dict[str, bytes]]]:
        """Pickle as the bytes of the folder that `save` writes."""
        with tempfile.TemporaryDirectory() as folder:
            saved = self.save(Path(folder) / "result")
            files = [path for path in saved.rglob("*") if path.is_file()]
            return _restored, (
                {path.relative_to(saved).as_posix(): path.read_bytes() for path in files},
            )

    @cached_property
    def _parts(self) -> _native._Parts:
        return self._answer.parts()

    def _files(self, ending: str) -> Iterator[tuple[str, bytes]]:
        """Files of a result that was read, by their names without this ending."""
        for name, content in self._parts[3].items():
            if name.endswith(ending):
                yield name.removesuffix(ending), content

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
        return "\n".join([*lines, *self._told_arrays()])

    def _told_arrays(self) -> Iterator[str]:
        """A line for each array: name, axes, meaning and unit."""
        for variable in self.variables.values():
            axes = ", ".join(
                f"{dim}: {length}"
                for dim, length in zip(variable.dims, variable.values.shape, strict=True)
            )
            about = variable.attrs.get("long_name", "")
            units = variable.attrs.get("units", "")
            what = f"{about} ({units})" if units else about
            yield f"    {variable.name:<20} ({axes})  {what}"

    def _verdict(self) -> str:
        """The answer in one line."""
        match self.command:
            case "simulate":
                return str(self.attrs["status_text"]).capitalize()
            case "orbit":
                return f"Period {self['period']}, {self.attrs['stability']}"
            case "lyapunov":
                return str(self.attrs["nature"]).capitalize()
            case "sweep" | "map":
                kinds = self.words("label" if self.command == "sweep" else "status")
                found = classes(kinds, self["period"])
                return ", ".join(f"{name} {here.mean():.1%}" for name, _, here in found)
            case "basins" | "attractors":
                number = len(self["attractor_number" if self.command == "basins" else "attractor"])
                return f"{number} attractor{'s' * (number != 1)}"
            case "continue":
                return (
                    f"{len(self['branch_number'])} branches, {len(self['special_label'])} special points"
                )
            case _:
                return str(self.attrs.get("title", self.command))

    def _repr_html_(self) -> str:
        """Show the verdict, the answer in words, then all figures, then the arrays."""
        parts = [f"<p><b>{html.escape(self._verdict())}</b></p><pre>{html.escape(self.summary)}</pre>"]
        for figure in self.figures.values():
            png = figure.png()
            source = f"data:image/png;base64,{base64.b64encode(png).decode()}"
            style = f"max-width: 100%; width: {shown_size(png)[0]}px"
            parts.append(f'<img alt="{html.escape(figure.about)}" style="{style}" src="{source}">')
        arrays = html.escape("\n".join(self._told_arrays()))
        parts.append(
            f"<details><summary>Arrays of {self.command}</summary><pre>{arrays}</pre></details>"
        )
        return "\n".join(parts)


def load(result: str | os.PathLike[str]) -> Result:
    """Read a result from the folder that it was written to.

    It is the same as the call gave: arrays, tables, figures and words, to the bit. Figures have the
    pixels that they were written with.

    Parameters
    ----------
    result : path
        Folder that ``out`` or :meth:`Result.save` named, or ``--out`` of the program; or a file in it.

    Returns
    -------
    Result

    Raises
    ------
    ResultError
        If there is no result, a file of it is missing or was altered, or another version wrote what
        this one cannot read.
    StudyError
        If the folder holds a study alone.

    Examples
    --------
    >>> import saltus, tempfile
    >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    >>> folder = tempfile.mkdtemp()
    >>> first = saltus.simulate(study, periods=3, out=folder)
    >>> again = saltus.load(folder)
    >>> bool((again["z"] == first["z"]).all())
    True
    """
    return Result(_native.read(Path(result)))


def _restored(files: Mapping[str, bytes]) -> Result:
    """Make the result of a pickle."""
    with tempfile.TemporaryDirectory() as folder:
        for name, content in files.items():
            path = Path(folder) / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(content)
        return load(folder)


def _stem(name: str) -> str:
    return name.removesuffix(".csv")


def _values(values: Any, shape: list[int]) -> NDArray[Any]:
    """Values as an array: texts come as a list."""
    if isinstance(values, np.ndarray):
        return values
    return np.array(values, dtype=object).reshape(shape)
