"""The questions: each takes a study, whose tables say what is asked, and gives a result."""

from __future__ import annotations

import dataclasses
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from saltus import _native
from saltus._arguments import whole
from saltus._progress import Progress, watched
from saltus._results import Result
from saltus._tables import Axis, Basins, Map
from saltus.study import Study, StudyLike, as_study

if TYPE_CHECKING:
    from saltus._tables import Numbers, Rows

__all__ = [
    "attractors",
    "basins",
    "continue_",
    "frequencies",
    "lyapunov",
    "map",
    "orbit",
    "reproduce",
    "simulate",
    "sweep",
]

Path_ = str | os.PathLike[str]


def frequencies(study: StudyLike, *, out: Path_ | None = None) -> Result:
    """Natural frequencies (Hz): empty plate, in its plane, with the people on it.

    Parameters
    ----------
    study : Study or path
    out : path, optional
        Folder to write as the program does with ``--out``.

    Returns
    -------
    Result
        With ``plate``, ``occupied``, ``in_plane``, ``free``, ``body`` and ``base``.
    """
    return _ask({"command": "frequencies"}, study, out)


def simulate(
    study: StudyLike,
    *,
    periods: int | None = None,
    out: Path_ | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Integrate the motion from ``study.start`` and look at it once per forcing period.

    Parameters
    ----------
    study : Study or path
    periods : int, optional
        Forcing periods, in place of ``study.simulate.periods``.
    out : path, optional
        Folder to write as the program does with ``--out``.
    threads : int, optional
        Threads; as many as there are cores by default. Results do not depend on it.
    progress : bool or callable, optional
        None: a bar where somebody looks; a callable gets what is done, how many, and of how many.

    Returns
    -------
    Result
        ``shortfall`` says why a run ended early, if it did.
    """
    study = as_study(study)
    if periods is not None:
        study = study.set({"simulate.periods": whole("periods", periods, 1)})
    return _ask({"command": "simulate"}, study, out, threads, progress)


def sweep(
    study: StudyLike,
    *,
    values: Numbers | None = None,
    starts: Rows | None = None,
    out: Path_ | None = None,
    resume: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Long-term motion while the parameter of ``study.sweep`` changes.

    Parameters
    ----------
    study : Study or path
    values : array_like, shape (n,), optional
        Values of the parameter, rising or falling, in place of those of the study.
    starts : array_like, shape (m, 2), optional
        First states z/eta, z'/(eta omega_h) from each of which every value begins anew, in place of
        ``study.sweep.starts``.
    out, threads, progress
        As in :func:`simulate`.
    resume : bool
        Go on with what an interrupted call with the same `out` has left (anew from `starts` only).

    Returns
    -------
    Result
        With ``z`` and ``v`` of shape (passes, n, jumpers, samples).
    """
    study = as_study(study)
    if values is not None or starts is not None:
        table = _needed(study, "sweep")
        if values is not None:
            table = dataclasses.replace(table, values=values, from_=None, to=None, count=None)
        if starts is not None:
            table = dataclasses.replace(table, starts=starts, direction="restarts")
        study = study.replace(sweep=table)
    return _ask({"command": "sweep"}, study, out, threads, progress, resume=resume)


def map(  # noqa: A001 (the word of the program)
    study: StudyLike,
    *,
    x: Numbers | None = None,
    y: Numbers | None = None,
    out: Path_ | None = None,
    resume: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Long-term motion at each point of the plane of two parameters in ``study.map``.

    Parameters
    ----------
    study : Study or path
    x, y : array_like, shapes (nx,) and (ny,), optional
        Values of the parameters, rising or falling, in place of those of the study.
    out, threads, progress
        As in :func:`simulate`.
    resume : bool
        Go on with what an interrupted call with the same `out` has left.

    Returns
    -------
    Result
        With ``period``, ``status``, ``contact_ratio`` and others of shape (ny, nx).
    """
    study = as_study(study)
    if x is not None or y is not None:
        table: Map = _needed(study, "map")
        study = study.replace(map=dataclasses.replace(table, x=_axis(table.x, x), y=_axis(table.y, y)))
    return _ask({"command": "map"}, study, out, threads, progress, resume=resume)


def basins(
    study: StudyLike,
    *,
    z: Numbers | None = None,
    v: Numbers | None = None,
    match: bool = False,
    out: Path_ | None = None,
    resume: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Find the long-term motion that each first state leads to.

    Parameters
    ----------
    study : Study or path
    z, v : array_like, shapes (nz,) and (nv,), optional
        First heights z/eta and velocities z'/(eta omega_h), rising or falling; all pairs of them are
        run. In place of the axes of ``study.basins``, which need not be there if both are given.
    match : bool
        Number the attractors as along the sweep of ``study.attractors``.
    out, threads, progress, resume
        As in :func:`map`.

    Returns
    -------
    Result
        With ``attractor``, ``period``, ``status`` and others over the plane.
    """
    study = as_study(study)
    if z is not None or v is not None:
        table = study.basins
        if table is None and z is not None and v is not None:
            new = Basins(x=Axis(parameter="start.z", values=z), y=Axis(parameter="start.v", values=v))
            study = study.replace(basins=new)
        else:
            table = _needed(study, "basins")
            given = {"start.z": z, "start.v": v}
            x, y = (_axis(axis, given[axis.parameter]) for axis in (table.x, table.y))
            study = study.replace(basins=dataclasses.replace(table, x=x, y=y))
    request = {"command": "basins", "match": bool(match)}
    return _ask(request, study, out, threads, progress, resume=resume)


def orbit(
    study: StudyLike,
    *,
    out: Path_ | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Find the periodic orbit near the long-term motion, stable or not, with its multipliers.

    Parameters are as in :func:`simulate`.

    Raises
    ------
    ComputationError
        If there is none that Newton's method finds.
    """
    return _ask({"command": "orbit"}, study, out, threads, progress)


def continue_(
    study: StudyLike,
    *,
    origin: Path_ | None = None,
    at: str | None = None,
    out: Path_ | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Branches of periodic orbits over the parameter of ``study.continue_``, with their bifurcations.

    Parameters
    ----------
    study : Study or path
    origin, at : path and str, optional
        Begin at the special point labelled `at` (such as ``"PD1"``) of an earlier result in the
        folder `origin` instead of at ``study.start``. Both or none.
    out, threads, progress
        As in :func:`simulate`.
    """
    if (origin is None) != (at is None):
        raise ValueError("origin and at belong together: give both or none")
    request: dict[str, Any] = {"command": "continue"}
    if origin is not None:
        request["origin"] = {"from": os.fspath(origin), "at": at}
    return _ask(request, study, out, threads, progress)


def lyapunov(
    study: StudyLike,
    *,
    out: Path_ | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Lyapunov exponents of the long-term motion (1/forcing period), with standard errors.

    Parameters are as in :func:`simulate`.
    """
    return _ask({"command": "lyapunov"}, study, out, threads, progress)


def attractors(
    study: StudyLike,
    *,
    out: Path_ | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """All coexisting long-term motions, their basins, and hysteresis while a parameter changes.

    Parameters are as in :func:`simulate`.
    """
    return _ask({"command": "attractors"}, study, out, threads, progress)


def reproduce(
    out: Path_ | None = None,
    *,
    quick: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Compute every figure and statement of Dias & Del Prado.

    Parameters
    ----------
    out : path, optional
        Folder for the page ``index.html``, figures and data.
    quick : bool
        Fewer parameter values and periods: a look in seconds.
    threads, progress
        As in :func:`simulate`.
    """
    request = {"command": "reproduce", "quick": bool(quick)}
    return _ask(request, Study.paper(), out, threads, progress)


def _ask(
    request: dict[str, Any],
    study: StudyLike,
    out: Path_ | None = None,
    threads: int | None = None,
    progress: Progress = None,
    *,
    resume: bool = False,
) -> Result:
    if resume and out is None:
        raise ValueError("resume needs out: what is finished is kept beside that folder")
    study = as_study(study)
    with watched(progress) as told:
        answer = _native.ask(
            json.dumps(request),
            study._resolved[0],
            out=None if out is None else Path(out),
            resume=resume,
            threads=0 if threads is None else whole("threads", threads, 1, 1024),
            progress=told,
        )
    return Result(answer)


def _needed(study: Study, name: str) -> Any:
    table = getattr(study, name)
    if table is None:
        raise _native_error(f"the study has no table {name}, which says what changes", name)
    return table


def _native_error(message: str, key: str) -> Exception:
    from saltus._errors import StudyError

    help_ = f"study.replace({key}=...) adds one"
    return StudyError(f"{message} ({help_})", key, help_)


def _axis(axis: Axis, values: Numbers | None) -> Axis:
    if values is None:
        return axis
    return dataclasses.replace(axis, values=values, from_=None, to=None, count=None)
