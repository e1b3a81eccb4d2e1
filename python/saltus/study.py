"""The study: all keys of a study file, as Python objects with the same names and units."""

from __future__ import annotations

import dataclasses
import html
import json
import math
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus import _native
from saltus._tables import (
    TABLES,
    Attractors,
    Base,
    Basins,
    Contact,
    Continue,
    Gravity,
    Jumper,
    Lyapunov,
    Map,
    Orbit,
    Plate,
    Simulate,
    Solver,
    Start,
    Sweep,
)

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

__all__ = ["Study", "StudyLike", "as_study"]


@dataclasses.dataclass(frozen=True, kw_only=True, repr=False)
class Study:
    """A plate, the people on it, the base that shakes it, and the questions about them.

    Tables are checked at once, as the program checks a study file; keys that are left out have the
    default of their description. All of them can then be read: a study in hand is valid, whole and never
    changes.

    Any array-like serves where a list of numbers is needed.

    Raises
    ------
    StudyError
        If a key is wrong: its ``key`` names it, its ``help`` says what would be right.

    Examples
    --------
    >>> import saltus
    >>> study = saltus.Study.paper().set({"jumper.damping_ratio": 0.28})
    >>> study.jumper[0].damping_ratio
    0.28
    """

    plate: Plate
    base: Base
    contact: Contact | None = None
    jumper: Sequence[Jumper] = ()
    gravity: Gravity | None = None
    start: Start | None = None
    solver: Solver | None = None
    simulate: Simulate | None = None
    sweep: Sweep | None = None
    map: Map | None = None
    basins: Basins | None = None
    orbit: Orbit | None = None
    lyapunov: Lyapunov | None = None
    continue_: Continue | None = None
    attractors: Attractors | None = None

    def __post_init__(self) -> None:
        """Check the tables given and fill in the others."""
        self._adopt(_native.resolve(_json(self), []))

    @classmethod
    def paper(cls) -> Study:
        """Give the case of Dias & Del Prado, section 3.

        Returns
        -------
        Study

        Examples
        --------
        >>> import saltus
        >>> saltus.Study.paper().plate.length
        14.0
        """
        return _of(_native.paper())

    @classmethod
    def load(cls, path: str | os.PathLike[str], changes: Mapping[str, object] | None = None) -> Study:
        """Read a study file.

        Parameters
        ----------
        path : path
            The file, in TOML.
        changes : mapping, optional
            As in :meth:`set`.

        Returns
        -------
        Study

        Raises
        ------
        StudyError
            If the file is no study; the message has the line.

        Examples
        --------
        >>> import saltus, tempfile
        >>> path = f"{tempfile.mkdtemp()}/study.toml"
        >>> saltus.Study.paper().save(path)
        >>> saltus.Study.load(path, {"jumper.mass": 80.0}).jumper[0].mass
        80.0
        """
        return _of(_native.load(Path(path), _overrides(changes)))

    @classmethod
    def parse(cls, text: str, changes: Mapping[str, object] | None = None) -> Study:
        """Read the text of a study file.

        Parameters
        ----------
        text : str
            TOML.
        changes : mapping, optional
            As in :meth:`set`.

        Returns
        -------
        Study

        Raises
        ------
        StudyError
            If the text is no study; the message has the line.

        Examples
        --------
        >>> import saltus
        >>> study = saltus.Study.paper()
        >>> saltus.Study.parse(study.to_toml()) == study
        True
        """
        return _of(_native.parse("text", text, _overrides(changes)))

    def set(self, changes: Mapping[str, object]) -> Study:
        """Return the study with other values.

        Parameters
        ----------
        changes : mapping
            Keys as in the study file with a dot between table and key: ``"plate.inertia"``,
            ``"jumper.damping_ratio"`` for everyone, ``"jumper.0.mass"`` for one person.

        Returns
        -------
        Study
            A new one; this one stays as it is.

        Raises
        ------
        StudyError
            If there is no such key or its value cannot be.

        Examples
        --------
        >>> import saltus
        >>> study = saltus.Study.paper().set({"jumper.mass": 80.0, "plate.inertia": "condensed"})
        >>> study.jumper[0].mass, study.plate.inertia
        (80.0, 'condensed')
        """
        return _of(_native.resolve(self._resolved[0], _overrides(changes)))

    def replace(self, **tables: Any) -> Study:
        """Return the study with whole tables in place of its own.

        Parameters
        ----------
        **tables
            Tables by their names, such as ``sweep=Sweep(...)``; None takes one away.

        Returns
        -------
        Study
            A new one; this one stays as it is.

        Raises
        ------
        StudyError
            If the tables do not make a study.

        Examples
        --------
        >>> import saltus
        >>> sweep = saltus.Sweep(parameter="jumper.mass", from_=60.0, to=90.0, count=31)
        >>> saltus.Study.paper().replace(sweep=sweep, map=None).sweep.count
        31
        """
        return dataclasses.replace(self, **tables)

    def to_toml(self) -> str:
        """Return the study as the text of a study file.

        Returns
        -------
        str
            TOML, every default written out.

        Examples
        --------
        >>> import saltus
        >>> saltus.Study.paper().to_toml().startswith("format = 1")
        True
        """
        return self._resolved[1]

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the study file that the program reads, whole or not at all.

        Parameters
        ----------
        path : path
            The file.

        Raises
        ------
        ResultError
            If it cannot be written.

        Examples
        --------
        >>> import saltus, tempfile
        >>> saltus.Study.paper().save(f"{tempfile.mkdtemp()}/study.toml")
        """
        _native.write(Path(path), self.to_toml().encode())

    @property
    def hash(self) -> str:
        """SHA-256 of the resolved study, as results carry it."""
        return self._resolved[2]

    @property
    def warnings(self) -> list[str]:
        """Warnings of values that are legal but probably not meant."""
        return _native.describe(self._resolved[0])[1]

    def __str__(self) -> str:
        """Return the description of the study, line by line."""
        return _native.describe(self._resolved[0])[0].rstrip()

    def __repr__(self) -> str:
        """Return the description, below the beginning of the hash."""
        return f"<saltus.Study {self.hash[:12]}>\n{self}"

    def _repr_html_(self) -> str:
        """Show the description, and the study file when it is opened."""
        file = (
            f"<details><summary>Study file</summary><pre>{html.escape(self.to_toml())}</pre></details>"
        )
        return f"<pre>{html.escape(str(self))}</pre>\n{file}"

    def __reduce__(self) -> tuple[Any, tuple[str]]:
        """Pickle as the text of the study file, which gives the same bits."""
        return Study.parse, (self.to_toml(),)

    def _with(self, table: str, given: Mapping[str, object]) -> Study:
        """The study with those of `given` that are keys of one table and not None."""
        changes: dict[str, Any] = {}
        tree = json.loads(self._resolved[0])
        own = tree.get(table, {})
        for field in dataclasses.fields(TABLES[table]):
            key, value = field.name.rstrip("_"), given.get(field.name)
            if value is None:
                continue
            name = f"{table}.{key}"
            if name in TABLES and not dataclasses.is_dataclass(value):
                # of an axis, its values alone
                changes[key] = _merged(own.get(key, {}), {"values": _plain(name, value)})
            else:
                changes[key] = _plain(name, value)
        if not changes:
            return self
        return _of(_native.resolve(json.dumps(tree | {table: _merged(own, changes)}), []))

    # set in __post_init__; JSON, TOML and hash of the resolved study
    @property
    def _resolved(self) -> tuple[str, str, str]:
        resolved: tuple[str, str, str] = self.__dict__["resolved"]
        return resolved

    def _adopt(self, resolved: tuple[str, str, str]) -> None:
        tree = json.loads(resolved[0])
        for field in dataclasses.fields(self):
            table = field.name.rstrip("_")
            value = _built(table, tree.get(table))
            object.__setattr__(self, field.name, Jumpers(value or ()) if table == "jumper" else value)
        self.__dict__["resolved"] = resolved


class Jumpers(tuple[Jumper, ...]):
    """The people of a study, counted from 0."""

    __slots__ = ()

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Say that a key is that of one person."""
            if not any(field.name == name for field in dataclasses.fields(Jumper)):
                raise AttributeError(f"the people of a study have no {name}")
            if not self:
                raise AttributeError(f"there is no jumper, so there is no {name}")
            raise AttributeError(
                f"jumper is a list of {len(self)}: jumper[0].{name} is that of the first; "
                f'set({{"jumper.{name}": ...}}) changes that of everyone'
            )


StudyLike = Study | str | os.PathLike[str]
"""A study, or the path of a study file."""


def as_study(study: StudyLike) -> Study:
    """Return the study itself, or the one in the file of that path."""
    return study if isinstance(study, Study) else Study.load(study)


def _of(resolved: tuple[str, str, str]) -> Study:
    # checked already, and once is enough
    study = object.__new__(Study)
    study._adopt(resolved)
    return study


def _built(name: str, value: Any) -> Any:
    """Tables as their classes, lists as tuples."""
    if isinstance(value, dict):
        table = TABLES[name]
        return table(
            **{
                field.name: _built(f"{name}.{key}", value[key])
                for field in dataclasses.fields(table)
                if (key := field.name.rstrip("_")) in value
            }
        )
    if isinstance(value, list):
        return tuple(_built(name, item) for item in value)
    return value


def _merged(own: Mapping[str, Any], changes: Mapping[str, Any]) -> dict[str, Any]:
    """A table with other keys.

    Values that are given in one way replace those given in the other; another parameter replaces both.
    """
    even = ("from", "to", "count")
    dropped: set[str] = set()
    if "values" in changes:
        dropped |= set(even)
    elif any(key in changes for key in even):
        dropped.add("values")
    if changes.get("parameter", own.get("parameter")) != own.get("parameter"):
        dropped |= {*even, "values"}
    return {key: value for key, value in own.items() if key not in dropped} | dict(changes)


def _json(study: Study) -> str:
    return json.dumps(_plain("", study), allow_nan=False)


def _plain(key: str, value: Any) -> Any:
    """Tables as dicts without keys that are left out, array-likes as lists."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {
            name: _plain(f"{key}.{name}" if key else name, given)
            for field in dataclasses.fields(value)
            if (given := getattr(value, field.name)) is not None
            for name in (field.name.rstrip("_"),)
        }
    if isinstance(value, (str, bool)):
        return value
    if isinstance(value, int):
        # whole numbers of a study have 64 bits; larger ones are out of range as numbers
        return value if -(2**63) <= value < 2**63 else _plain(key, _real(value))
    if isinstance(value, float):
        # JSON has no NaN and no infinity; as words they are refused with their key
        return value if math.isfinite(value) else str(value)
    if isinstance(value, (list, tuple)) and not _numeric(value):
        return [_plain(f"{key}.{place}", item) for place, item in enumerate(value)]
    array = np.asarray(value)
    if array.dtype.kind not in "biufUS":
        raise TypeError(f"{key} = {value!r}: a number, a word, a table or a list of these is needed")
    return _plain(key, array.tolist())


def _real(value: int) -> float:
    try:
        return float(value)
    except OverflowError:
        return math.inf if value > 0 else -math.inf


def _numeric(value: Sequence[Any]) -> bool:
    """Whether an array takes the items whole; else they are looked at one by one."""
    return bool(value) and all(hasattr(item, "__array__") and np.ndim(item) > 0 for item in value)


def _overrides(changes: Mapping[str, object] | None) -> list[str]:
    return [f"{key}={_toml(key, value)}" for key, value in (changes or {}).items()]


def _toml(key: str, value: object) -> str:
    plain = _plain(key, value)
    # but for tables JSON is TOML; a word for a number that is not finite is none in quotes
    if isinstance(value, (float, np.floating, int)) and isinstance(plain, str):
        return plain
    if isinstance(plain, dict):
        return "{" + ", ".join(f"{name} = {_toml(name, item)}" for name, item in plain.items()) + "}"
    return json.dumps(plain, ensure_ascii=False)
