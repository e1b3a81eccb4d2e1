"""The questions: each takes a study, whose tables say what is asked, and gives a result.

The keywords that are keys of a table of the study are written by scripts/python-tables: between
the comment in a signature and `out`, and the same in the docstring.
"""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from saltus import _native
from saltus._arguments import whole
from saltus._progress import Progress, watched
from saltus._results import Result
from saltus._tables import Axis
from saltus.study import Study, StudyLike, as_study

if TYPE_CHECKING:
    from collections.abc import Mapping

    from saltus._tables import Numbers, Rows, Second

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

#: An initial condition: height z/eta and velocity z'/(eta omega_h) of every jumper.
State = tuple[float, float]


def frequencies(study: StudyLike, *, out: Path_ | None = None) -> Result:
    """Natural frequencies (Hz): empty plate, in its plane, with the people on it.

    Parameters
    ----------
    study : Study or path
        What it is about.
    out : path, optional
        Folder to write as the program does with ``--out``.

    Returns
    -------
    Result
        Frequencies (Hz), the lowest first: ``plate`` of the empty plate, ``occupied`` with the people
        standing on it, ``in_plane`` of its in-plane modes; ``free`` of each body on rigid ground,
        ``body`` of the occupied mode in which the first body moves most, ``base`` of the base motion.

    Raises
    ------
    StudyError
        If the study cannot be.
    ResultError
        If `out` cannot be written.

    Examples
    --------
    >>> import saltus
    >>> result = saltus.frequencies(saltus.Study.paper())
    >>> result["plate"].round(3)
    array([ 2.297,  8.505, 14.464, 20.672])
    >>> round(float(result["body"]), 3)
    2.537
    """
    return _ask({"command": "frequencies"}, study, out)


def simulate(
    study: StudyLike,
    *,
    start: State | None = None,
    # keys of study.simulate
    periods: int | None = None,
    transient: int | None = None,
    history: int | None = None,
    samples_per_period: int | None = None,
    times: Numbers | None = None,
    out: Path_ | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Integrate one motion, with its section once per forcing period and its history in time.

    Keywords that are keys of ``study.simulate`` take the place of those of the study.

    Parameters
    ----------
    study : Study or path
        What it is about.
    start : (float, float), optional
        Initial height z/eta and velocity z'/(eta omega_h) of every jumper, in place of ``study.start``.
        The plate begins at rest.
    periods : int, optional
        Forcing periods integrated (-, a whole number), such as 100. Range: 1 to 1e7. Default: 100.
    transient : int, optional
        Of these, first periods left out of figures (-, a whole number), such as 0. Range: 0 to 1e7.
        Default: 0.
    history : int, optional
        Last periods that the time history covers (-, a whole number), such as 20; at most those
        that are not left out. Range: 1 to 100000. Default: 20.
    samples_per_period : int, optional
        Points of the time history in each period, at equal times (-, a whole number), such as 400.
        Range: 1 to 1e6. Default: 400.
    times : array_like, shape (n,), optional
        Times of the time history since the start (s), ascending, such as [0.0, 0.05, 0.1]; instead
        of `history` and `samples_per_period`. Range: 0 to 1e13.
    out : path, optional
        Folder to write as the program does with ``--out``; :func:`saltus.load` reads it again.
    threads : int, optional
        Threads; as many as there are cores by default. Results do not depend on it.
    progress : bool or callable, optional
        None: a bar where somebody looks; True or False: always or never. A callable gets the name of
        the work, how much is done, and of how much (None if that is not known).

    Returns
    -------
    Result
        Once per forcing period, at cos(Omega t) = 1: ``z`` (heights over eta) and ``v`` (velocities
        over eta omega_h) of shape (periods, jumpers), ``phase`` (contact or flight), ``w`` (amplitudes
        of the plate over its thickness) of shape (periods, terms). Along the time ``history_time`` (s):
        the same as ``history_z`` and so on, the force of the feet over body weight ``history_prf``, the
        height of the floor under the feet ``history_floor`` (m) and its acceleration (m/s²), absolute as
        ``history_floor_acceleration`` and relative to the base as
        ``history_floor_acceleration_relative``. ``switch_time`` (s) has the take-offs and touch-downs.
        ``eta`` (m) makes heights of ``z``. If the run ended early, ``shortfall`` says why.

    Raises
    ------
    StudyError
        If a key is out of its range; the message names it.
    ResultError
        If `out` cannot be written.

    See Also
    --------
    Result.surface : the plate's shape over x and y.
    Result.animate : the motion as a film.

    Examples
    --------
    Fifty periods from rest on the floor, and where the person is at their ends (m):

    >>> import saltus
    >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    >>> motion = saltus.simulate(study, start=(-1.0, 0.0), periods=50, transient=40)
    >>> heights = motion["z"] * motion["eta"]
    >>> heights.shape
    (50, 1)

    The acceleration of the floor at times of one's own:

    >>> motion = saltus.simulate(study, periods=2, times=[0.0, 0.1, 0.2])
    >>> motion["history_floor_acceleration"].shape
    (3, 1)
    """
    return _ask({"command": "simulate"}, _changed(study, "simulate", locals()), out, threads, progress)


def sweep(
    study: StudyLike,
    *,
    start: State | None = None,
    # keys of study.sweep
    parameter: str | None = None,
    from_: float | None = None,
    to: float | None = None,
    count: int | None = None,
    direction: Literal["up", "down", "both", "restarts"] | None = None,
    transient: int | None = None,
    record: int | None = None,
    exponents: int | None = None,
    exponent_periods: int | None = None,
    starts: Rows | None = None,
    values: Numbers | None = None,
    out: Path_ | None = None,
    resume: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Bifurcation diagram: long-term motion while one parameter changes.

    Keywords that are keys of ``study.sweep`` take the place of those of the study.

    Parameters
    ----------
    study : Study or path
        What it is about.
    start : (float, float), optional
        Height z/eta and velocity z'/(eta omega_h) of every jumper at the first value, in place of
        ``study.start``.
    parameter : str, optional
        The key that changes (a word), such as "jumper.damping_ratio" for every jumper,
        "jumper.0.mass" for one, or "base.frequency_ratio".
    from_ : float, optional
        First value (in the unit of the parameter), such as 0.1. Range: -1e13 to 1e13.
    to : float, optional
        Last value (in the unit of the parameter), such as 0.5. Range: -1e13 to 1e13.
    count : int, optional
        Number of values, both ends included (-, a whole number), such as 401. Range: 2 to 1e7.
    direction : {"up", "down", "both", "restarts"}, optional
        How the state is carried on (a word): "up", "down", "both" or "restarts". Default: "up".
        "up": From `from` to `to`, the last state of each value starting the next.
        "down": From `to` to `from`, the last state of each value starting the next.
        "both": One sweep each way.
        "restarts": Every value anew from each of `starts`.
    transient : int, optional
        Forcing periods left out at each value (-, a whole number), such as 300. Range: 0 to 1e7.
        Default: 300.
    record : int, optional
        Forcing periods recorded at each value (-, a whole number), such as 100. Range: 1 to 1e7.
        Default: 100.
    exponents : int, optional
        How many of the largest Lyapunov exponents to follow at each value, once the motion has its
        label (-, a whole number), such as 2; 0: only where the label of the motion needs one.
        Range: 0 to 100000. Default: 0.
    exponent_periods : int, optional
        Forcing periods over which they are followed (-, a whole number), such as 400. Range: 1 to
        1e7. Default: 400.
    starts : array_like, shape (n, 2), optional
        Initial conditions [z/η, z'/(η ω_h)] of every jumper for "restarts" (-), such as [[3.0,
        2.0], [-1.0, 0.0]].
    values : array_like, shape (n,), optional
        The values one by one (in the unit of the parameter), ascending or descending, such as [0.1,
        0.15, 0.3]; instead of `from`, `to` and `count`. Range: -1e13 to 1e13.
    out, threads, progress
        As in :func:`simulate`.
    resume : bool
        Go on with what an interrupted call with the same `out` has left (for direction "restarts").

    Returns
    -------
    Result
        ``z`` (heights over eta) and ``v`` (velocities over eta omega_h) at cos(Omega t) = 1, of shape
        (direction, value, jumper, sample); the coordinate ``direction`` says "up" or "down", and the
        values are called after their key, as ``jumper_damping_ratio``. Over direction and value:
        ``label`` (the kind of the motion; ``result.words("label")`` spells it), ``period`` (in forcing
        periods, 0 if it has none), ``confidence``, ``exponent`` (Lyapunov exponents per forcing period).
        ``contact_ratio`` has each jumper too. ``eta`` (m) makes heights of ``z``.

    Raises
    ------
    StudyError
        If a key is missing or out of its range; the message names it.
    ComputationError
        If no value was run to its end.
    ResultError
        If `out` cannot be written, or holds what an interrupted call left and `resume` is False.

    See Also
    --------
    Result.plot : the diagram, in axes of one's own.

    Examples
    --------
    Change the parameter, the range and the transient, and read the result:

    >>> import saltus
    >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    >>> result = saltus.sweep(
    ...     study,
    ...     parameter="jumper.damping_ratio",
    ...     from_=0.3,
    ...     to=0.5,
    ...     count=3,
    ...     direction="up",
    ...     transient=200,
    ...     record=4,
    ... )
    >>> result["jumper_damping_ratio"]
    array([0.3, 0.4, 0.5])
    >>> result["z"].shape
    (1, 3, 1, 4)
    >>> result["period"]
    array([[2, 2, 1]], dtype=int32)
    >>> result.words("label")[0, 2]
    'periodic'

    Heights in metres, and the same as a table or with names of its axes:

    >>> heights = result["z"] * result["eta"][:, :, None]
    >>> frame = result.to_pandas("rows")
    >>> up = result.to_xarray().sel(direction="up", jumper=0).z
    """
    if starts is not None and direction is None:
        direction = "restarts"
    study = _changed(study, "sweep", locals())
    return _ask({"command": "sweep"}, study, out, threads, progress, resume=resume)


def map(  # noqa: A001 (the word of the program)
    study: StudyLike,
    *,
    x: Axis | Numbers | None = None,
    y: Axis | Numbers | None = None,
    start: State | None = None,
    # keys of study.map
    transient: int | None = None,
    record: int | None = None,
    exponent: int | None = None,
    out: Path_ | None = None,
    resume: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Long-term motion at each point of the plane of two parameters.

    Keywords that are keys of ``study.map`` take the place of those of the study.

    Parameters
    ----------
    study : Study or path
        What it is about.
    x, y : Axis or array_like, optional
        Parameter and values along the axis, as ``Axis(parameter="jumper.mass", from_=50.0, to=90.0,
        count=41)``; or the values alone, rising or falling, of the study's own parameter.
    start : (float, float), optional
        Initial height z/eta and velocity z'/(eta omega_h) of every jumper, in place of ``study.start``.
    transient : int, optional
        Forcing periods left out at each pixel, at most (-, a whole number), such as 400; fewer are
        run once the motion has surely settled. Range: 0 to 1e7. Default: 400.
    record : int, optional
        Forcing periods recorded where the motion has not surely settled before (-, a whole number),
        such as 64. Range: 1 to 100000. Default: 64.
    exponent : int, optional
        Forcing periods, at most, over which the largest Lyapunov exponent is followed where the
        motion has no period (-, a whole number), such as 2000; chaos is then run on for a quarter
        of that, to see whether it lasts. 0: it is not asked whether that is chaos or a torus.
        Range: 0 to 1e7. Default: 2000.
    out, threads, progress
        As in :func:`simulate`.
    resume : bool
        Go on with what an interrupted call with the same `out` has left.

    Returns
    -------
    Result
        Of shape (y, x): ``period`` (in forcing periods, 0 if it has none), ``status`` (what became of
        the motion; ``result.words("status")`` spells it), ``contact_ratio``, ``peak_reaction`` (over
        body weight), ``peak_acceleration`` (m/s², of the floor under the first jumper), ``exponent``
        (per forcing period). With several jumpers ``contact_ratio_0`` and so on. The values along the
        axes are called after their keys, as ``jumper_damping_ratio``.

    Raises
    ------
    StudyError
        If a key is missing or out of its range; the message names it.
    ResultError
        If `out` cannot be written, or holds what an interrupted call left and `resume` is False.

    Examples
    --------
    >>> import saltus
    >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    >>> mass = saltus.Axis(parameter="jumper.mass", from_=60.0, to=90.0, count=3)
    >>> result = saltus.map(study, x=mass, y=[0.9, 1.1], transient=100, exponent=0)
    >>> result["contact_ratio"].shape
    (2, 3)
    >>> result["jumper_mass"]
    array([60., 75., 90.])
    """
    study = _changed(study, "map", locals())
    return _ask({"command": "map"}, study, out, threads, progress, resume=resume)


def basins(
    study: StudyLike,
    *,
    x: Axis | Numbers | None = None,
    y: Axis | Numbers | None = None,
    z: Numbers | None = None,
    v: Numbers | None = None,
    match: bool = False,
    # keys of study.basins
    transient: int | None = None,
    record: int | None = None,
    exponent: int | None = None,
    out: Path_ | None = None,
    resume: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Basins of attraction: the long-term motion that each initial condition leads to.

    Keywords that are keys of ``study.basins`` take the place of those of the study.

    Parameters
    ----------
    study : Study or path
        What it is about.
    x, y : Axis or array_like, optional
        The axes, of the parameters "start.z" and "start.v", as in :func:`map`.
    z, v : array_like, shapes (nz,) and (nv,), optional
        Initial heights z/eta and velocities z'/(eta omega_h), rising or falling; all pairs of them are
        run. In place of the axes of ``study.basins``, which need not be there if both are given.
    match : bool
        Number the attractors as along the sweep of ``study.attractors``.
    transient : int, optional
        Forcing periods left out at each pixel, at most (-, a whole number), such as 400; fewer are
        run once the motion has surely settled. Range: 0 to 1e7. Default: 400.
    record : int, optional
        Forcing periods recorded where the motion has not surely settled before (-, a whole number),
        such as 64. Range: 1 to 100000. Default: 64.
    exponent : int, optional
        Forcing periods, at most, over which the largest Lyapunov exponent is followed where the
        motion has no period (-, a whole number), such as 2000; chaos is then run on for a quarter
        of that, to see whether it lasts. 0: it is not asked whether that is chaos or a torus.
        Range: 0 to 1e7. Default: 2000.
    out, threads, progress, resume
        As in :func:`map`.

    Returns
    -------
    Result
        Of shape (y, x): ``attractor`` (its number, 0 for none), ``period``, ``status`` and others as
        :func:`map` gives them. Over the number of the attractor: ``attractor_kind``,
        ``attractor_period``, ``attractor_share`` (of the plane), ``attractor_z`` and ``attractor_v``
        (its section).

    Raises
    ------
    StudyError
        If a key is missing or out of its range; the message names it.
    ResultError
        If `out` cannot be written, or holds what an interrupted call left and `resume` is False.

    Examples
    --------
    >>> import saltus
    >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    >>> result = saltus.basins(study, z=[-1.0, 1.0, 3.0], v=[0.0, 2.0], exponent=0)
    >>> result["attractor"]
    array([[1, 1, 1],
           [1, 1, 1]], dtype=uint16)
    >>> result["attractor_share"]
    array([1.])
    """
    study = as_study(study)
    given = {"start.z": z, "start.v": v}
    if study.basins is not None:
        x = given[study.basins.x.parameter] if x is None else x
        y = given[study.basins.y.parameter] if y is None else y
    elif z is not None and v is not None:
        x, y = (Axis(parameter=name, values=values) for name, values in (("start.z", z), ("start.v", v)))
    study = _changed(study, "basins", locals())
    request = {"command": "basins", "match": bool(match)}
    return _ask(request, study, out, threads, progress, resume=resume)


def orbit(
    study: StudyLike,
    *,
    start: State | None = None,
    # keys of study.orbit
    period: int | None = None,
    transient: int | None = None,
    segments: int | None = None,
    out: Path_ | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Find the periodic orbit near the long-term motion, stable or not, with its Floquet multipliers.

    Keywords that are keys of ``study.orbit`` take the place of those of the study.

    Parameters
    ----------
    study : Study or path
        What it is about.
    start : (float, float), optional
        Height z/eta and velocity z'/(eta omega_h) of every jumper from which it is sought, in place of
        ``study.start``.
    period : int, optional
        Forcing periods after which the orbit closes (-, a whole number), such as 2; 0: those of the
        long-term motion. Range: 0 to 64. Default: 0.
    transient : int, optional
        Forcing periods run before Newton's method begins (-, a whole number), such as 200; 0: it
        begins at the initial condition. Range: 0 to 1e7. Default: 200.
    segments : int, optional
        Pieces whose ends Newton's method joins (-, a whole number), at most one per period; 0: one
        per period. Range: 0 to 64. Default: 0.
    out, threads, progress
        As in :func:`simulate`.

    Returns
    -------
    Result
        ``z``, ``v``, ``phase`` and ``w`` at its points, as in :func:`simulate`, and its way once around
        as ``history_z`` and so on; ``multiplier_real`` and ``multiplier_imaginary`` of shape
        (multipliers,), by falling modulus; ``period`` (in forcing periods), ``contact_ratio``,
        ``peak_reaction`` (over body weight); ``attrs["stability"]`` and ``attrs["sequence"]``.

    Raises
    ------
    StudyError
        If a key is out of its range; the message names it.
    ComputationError
        If there is none that Newton's method finds.
    ResultError
        If `out` cannot be written.

    Examples
    --------
    >>> import saltus
    >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    >>> result = saltus.orbit(study, period=2)
    >>> result.attrs["stability"]
    'stable'
    >>> bool(result["multiplier_modulus"][0] < 1.0)
    True
    """
    return _ask({"command": "orbit"}, _changed(study, "orbit", locals()), out, threads, progress)


def continue_(
    study: StudyLike,
    *,
    start: State | None = None,
    origin: Path_ | None = None,
    at: str | None = None,
    # keys of study.continue_
    parameter: str | None = None,
    from_: float | None = None,
    to: float | None = None,
    period: int | None = None,
    transient: int | None = None,
    step: float | None = None,
    points: int | None = None,
    doublings: int | None = None,
    cloud: int | None = None,
    second: Second | None = None,
    out: Path_ | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Continuation: branches of periodic orbits over a parameter, with their bifurcations.

    Keywords that are keys of ``study.continue_`` take the place of those of the study.

    Parameters
    ----------
    study : Study or path
        What it is about. The first orbit is sought at its own value of the parameter.
    start : (float, float), optional
        As in :func:`orbit`.
    origin, at : path and str, optional
        Begin at the special point labelled `at` (such as ``"PD1"``) of an earlier result in the
        folder `origin` instead of at ``study.start``. Both or none.
    parameter : str, optional
        The key that changes (a word), such as "jumper.damping_ratio" or "base.frequency_ratio". The
        first orbit is sought at the study's own value of it, which lies between `from` and `to`.
    from_ : float, optional
        One end of the range (in the unit of the parameter), such as 0.1. Range: -1e13 to 1e13.
    to : float, optional
        The other end of the range (in the unit of the parameter), such as 0.5. Range: -1e13 to
        1e13.
    period : int, optional
        Forcing periods after which the first orbit closes (-, a whole number), such as 2; 0: those
        of the long-term motion. Range: 0 to 64. Default: 0.
    transient : int, optional
        Forcing periods run before the first orbit is sought (-, a whole number), such as 200; 0:
        the search begins at the initial condition. Range: 0 to 1e7. Default: 200.
    step : float, optional
        Largest step along a branch, as a part of the range (-), such as 0.02. Range: 1e-6 to 1.
        Default: 0.02.
    points : int, optional
        Points at which a branch is given up (-, a whole number), such as 2000. Range: 2 to 1e6.
        Default: 2000.
    doublings : int, optional
        Period doublings that are followed, each from the branch before, to the doubled orbits (-, a
        whole number), such as 4; 0: none. Range: 0 to 16. Default: 4.
    cloud : int, optional
        Values of the parameter at which the long-term motion is run, as a cloud behind the branches
        of the figure (-, a whole number), such as 200; 0: none. Range: 0 to 100000. Default: 200.
    second : Second, optional
        A second parameter: special points of the branches become curves over both.
    out, threads, progress
        As in :func:`simulate`.

    Returns
    -------
    Result
        Over the points of all branches, one after the other: the parameter (called after its key, as
        ``jumper_damping_ratio``), ``branch``, ``period``, ``stable``, ``multiplier_real`` and
        ``multiplier_imaginary`` (all multipliers of each point), ``z`` and ``v`` (at each place of the
        orbit). ``special_label``, ``special_name`` and the value of the parameter there are those of
        the special points; ``tables["special_points"]`` lists them.

    Raises
    ------
    StudyError
        If a key is missing or out of its range; the message names it.
    ComputationError
        If there is no first orbit.
    ValueError
        If only one of `origin` and `at` is given.
    ResultError
        If `out` cannot be written, or `origin` not read.

    Examples
    --------
    A period doubling between damping ratios of 0.15 and 0.25, without the curve of these:

    >>> import saltus
    >>> study = saltus.Study.paper().set(
    ...     {"plate.inertia": "condensed", "base.frequency_ratio": 0.9, "jumper.damping_ratio": 0.2}
    ... )
    >>> study = study.set({"continue.second.curves": ["none"]})
    >>> result = saltus.continue_(study, from_=0.18, to=0.22, doublings=0, cloud=0)
    >>> result["special_label"].tolist()
    ['PD1']
    >>> result["special_jumper_damping_ratio"].round(5)
    array([0.18929])
    """
    if (origin is None) != (at is None):
        raise ValueError("origin and at belong together: give both or none")
    request: dict[str, Any] = {"command": "continue"}
    if origin is not None:
        request["origin"] = {"from": os.fspath(origin), "at": at}
    return _ask(request, _changed(study, "continue", locals()), out, threads, progress)


def lyapunov(
    study: StudyLike,
    *,
    start: State | None = None,
    # keys of study.lyapunov
    exponents: int | None = None,
    transient: int | None = None,
    periods: int | None = None,
    replicas: int | None = None,
    out: Path_ | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """Lyapunov exponents of the long-term motion, with standard errors.

    Keywords that are keys of ``study.lyapunov`` take the place of those of the study.

    Parameters
    ----------
    study : Study or path
        What it is about.
    start : (float, float), optional
        Initial height z/eta and velocity z'/(eta omega_h) of every jumper, in place of ``study.start``.
    exponents : int, optional
        How many exponents, the largest first (-, a whole number), such as 2; 0: all, one per state.
        Range: 0 to 100000. Default: 0.
    transient : int, optional
        Forcing periods left out before each replica is measured (-, a whole number), such as 400.
        Range: 0 to 1e7. Default: 400.
    periods : int, optional
        Forcing periods measured in each replica (-, a whole number), such as 2000. Range: 1 to 1e7.
        Default: 2000.
    replicas : int, optional
        Independent pieces of the same attractor that are run side by side (-, a whole number), such
        as 8; their scatter says how sure the exponents are. Range: 1 to 10000. Default: 8.
    out, threads, progress
        As in :func:`simulate`.

    Returns
    -------
    Result
        Of shape (exponents,), the largest first: ``exponent`` (per forcing period), its standard error
        ``exponent_error``, the ends ``exponent_low`` and ``exponent_high`` of its interval of 95 %, and
        ``exponent_per_second`` (1/s). ``attrs["nature"]`` says what the motion is. If the run ended
        early, ``shortfall`` says why.

    Raises
    ------
    StudyError
        If a key is out of its range; the message names it.
    ResultError
        If `out` cannot be written.

    Examples
    --------
    >>> import saltus
    >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    >>> result = saltus.lyapunov(study, exponents=1, periods=50)
    >>> result.attrs["nature"]
    'periodic'
    >>> result["exponent"].round(4)
    array([-0.1234])
    """
    return _ask({"command": "lyapunov"}, _changed(study, "lyapunov", locals()), out, threads, progress)


def attractors(
    study: StudyLike,
    *,
    # keys of study.attractors
    z: tuple[float, float] | Numbers | None = None,
    v: tuple[float, float] | Numbers | None = None,
    plate: float | None = None,
    starts: int | None = None,
    transient: int | None = None,
    record: int | None = None,
    parameter: str | None = None,
    from_: float | None = None,
    to: float | None = None,
    count: int | None = None,
    values: Numbers | None = None,
    out: Path_ | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Result:
    """All coexisting attractors, their shares of a box of initial conditions, and hysteresis.

    Keywords that are keys of ``study.attractors`` take the place of those of the study.

    Parameters
    ----------
    study : Study or path
        What it is about.
    z : (float, float), optional
        Lowest and highest initial height z/η of every jumper (-), such as [-2.0, 6.0]. Range: -1e6
        to 1e6. Default: [-2.0, 6.0].
    v : (float, float), optional
        Lowest and highest initial velocity z'/(η ω_h) of every jumper (-), such as [-4.0, 4.0].
        Range: -1e6 to 1e6. Default: [-4.0, 4.0].
    plate : float, optional
        Largest first amplitude |w_j|/h of each transverse term of the plate (-), such as 0.1; 0: it
        starts at rest. Range: 0 to 1000. Default: 0.0.
    starts : int, optional
        Number of initial conditions (-, a whole number), such as 128. Range: 1 to 1e7. Default:
        128.
    transient : int, optional
        Forcing periods left out from each initial condition, at most (-, a whole number), such as
        400; fewer are run once the motion has surely settled. Range: 0 to 1e7. Default: 400.
    record : int, optional
        Forcing periods recorded where the motion has not surely settled before (-, a whole number),
        such as 64. Range: 1 to 100000. Default: 64.
    parameter : str, optional
        The key that changes (a word), such as "jumper.damping_ratio" or "base.frequency_ratio".
    from_ : float, optional
        First value (in the unit of the parameter), such as 0.1. Range: -1e13 to 1e13.
    to : float, optional
        Last value (in the unit of the parameter), such as 0.5. Range: -1e13 to 1e13.
    count : int, optional
        Number of values, both ends included (-, a whole number), such as 41. Range: 2 to 10000.
    values : array_like, shape (n,), optional
        The values one by one (in the unit of the parameter), ascending or descending, such as [0.1,
        0.15, 0.3]; instead of `from`, `to` and `count`. Range: -1e13 to 1e13.
    out, threads, progress
        As in :func:`simulate`.

    Returns
    -------
    Result
        Of shape (value, attractor), the values called after their key: ``kind``, ``period``, ``share``
        of the initial conditions with the ends ``share_low`` and ``share_high`` of its interval of 95 %,
        ``multiplier`` or ``exponent``, ``peak_acceleration`` (m/s²). ``z`` and ``v`` are the sections of
        all attractors met, one after the other; ``tables["loops"]`` has the loops of hysteresis.

    Raises
    ------
    StudyError
        If a key is missing or out of its range; the message names it.
    ResultError
        If `out` cannot be written.

    Examples
    --------
    >>> import saltus
    >>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    >>> result = saltus.attractors(study, starts=4, values=[0.47, 0.5])
    >>> result["share"]
    array([[1.],
           [1.]])
    """
    return _ask(
        {"command": "attractors"}, _changed(study, "attractors", locals()), out, threads, progress
    )


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
        Fewer parameter values and periods: a look in a minute.
    threads, progress
        As in :func:`simulate`.

    Returns
    -------
    Result
        With the clouds of their Figure 2 as arrays, all figures, and tables of facts and transitions.

    Raises
    ------
    ResultError
        If `out` cannot be written.

    Examples
    --------
    >>> import saltus
    >>> result = saltus.reproduce("results", quick=True)  # doctest: +SKIP
    """
    request = {"command": "reproduce", "quick": bool(quick)}
    return _ask(request, Study.paper(), out, threads, progress)


def _changed(study: StudyLike, table: str, arguments: Mapping[str, Any]) -> Study:
    """The study with those `arguments` that are keys of `table`, and with their initial condition."""
    study = as_study(study)
    start = arguments.get("start")
    if start is not None:
        z, v = start
        study = study.set({"start.z": z, "start.v": v})
    return study._with(table, arguments)


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
