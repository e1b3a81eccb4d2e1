"""The tables of the study file, key by key, in SI units.

A key that is left out is None here and has the default that its description gives. A
key that is a word of Python has an underscore after it: `from_` is `from`.

Written by scripts/python-tables from `saltus schema`: a change here is lost.
"""

# ruff: noqa: RUF001
# Symbols are Greek letters, and nothing else is meant.

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, Literal, TypeAlias

import numpy.typing as npt

__all__ = [
    "TABLES",
    "Attractors",
    "Axis",
    "Base",
    "Basins",
    "Contact",
    "Continue",
    "Gravity",
    "Jumper",
    "Lyapunov",
    "Map",
    "ModeLists",
    "Numbers",
    "Orbit",
    "Plate",
    "Rows",
    "Second",
    "Simulate",
    "Solver",
    "Start",
    "Sweep",
]

Numbers: TypeAlias = Sequence[float] | npt.NDArray[Any]
"""A list of numbers."""

Rows: TypeAlias = Sequence[Sequence[float]] | npt.NDArray[Any]
"""A list of pairs of numbers."""


@dataclass(frozen=True, kw_only=True)
class ModeLists:
    """The terms of the displacement fields, one by one."""

    u: Rows
    """Terms of the in-plane displacement along x: half-wave numbers (-), such as [[2, 1],
    [4, 1]]. Range: 0 or more.
    """

    v: Rows
    """Terms of the in-plane displacement along y: half-wave numbers (-), such as [[1, 2],
    [1, 4]]. Range: 0 or more.
    """

    w: Rows
    """Terms of the transverse displacement: half-wave numbers (-), such as [[1, 1], [3, 1]].
    Range: 0 or more.
    """


@dataclass(frozen=True, kw_only=True)
class Plate:
    """A simply supported rectangular plate, its edges held in their plane."""

    length: float
    """Length a along x (m), such as 14.0. Range: 0.001 to 10000."""

    width: float
    """Width b along y (m), such as 10.0. Range: 0.001 to 10000."""

    thickness: float
    """Thickness h (m), such as 0.10. Range: 1e-6 to 100."""

    youngs_modulus: float
    """Young's modulus E (Pa), such as 27e9. Range: 1 to 1e13."""

    density: float
    """Mass density ρ (kg/m³), such as 2500.0. Range: 0.001 to 1e6."""

    poisson_ratio: float
    """Poisson's ratio ν (-), such as 0.2. Range: between -1 and 0.5."""

    damping_ratio: float
    """Damping ratio ζ_p of the first mode (-), such as 0.02; damping is mass-proportional, c
    = 2 ζ_p ω₁₁. Range: 0 to 10.
    """

    modes: str | ModeLists
    """Terms of the displacement fields (half-wave numbers, -): "paper" (the 16 terms of Dias
    & Del Prado), a complete set such as "3x3", or lists such as { u = [[2, 1]], v = [[1,
    2]], w = [[1, 1]] }.
    """

    basis: Literal["fixed", "shear-free"] | None = None
    """Shape of the in-plane terms (a word): "fixed" or "shear-free". Default: "fixed".

    "fixed": u and v both sin-sin: every in-plane displacement vanishes on every edge (the
    paper).

    "shear-free": u sin-cos, v cos-sin: normal displacement and shear vanish on the edges
    (Levy; Chu & Herrmann).
    """

    inertia: Literal["full", "slow-manifold", "condensed"] | None = None
    """Whether in-plane motion keeps its inertia (a word): "full", "slow-manifold" or
    "condensed". Default: "full".

    "full": They move with their own inertia (the paper); slower to integrate.

    "slow-manifold": They follow the transverse motion as fast oscillators do, with two
    terms of their inertia: in the paper's case within 2e-9 h of "full" after 20 periods
    and some 25 times faster; at most 9 w terms.

    "condensed": They follow the transverse motion statically, so that only transverse
    amplitudes and people remain: in the paper's case within 7e-4 h of "full" after 20
    periods and some 100 times faster.
    """


@dataclass(frozen=True, kw_only=True)
class Jumper:
    """A person with one vertical degree of freedom at a point of the plate."""

    x: float
    """Position x_I along the plate's length (m), such as 7.0; inside the plate. Range: 0 to
    10000.
    """

    y: float
    """Position y_I along the plate's width (m), such as 5.0; inside the plate. Range: 0 to
    10000.
    """

    mass: float
    """Body mass m_h (kg), such as 76.64. Range: 1e-6 to 1e7."""

    stiffness: float
    """Leg stiffness k_h (N/m), such as 18600.0. Range: 1e-6 to 1e12."""

    damping_ratio: float
    """Leg damping ratio ζ_h (-), such as 0.3; the damper is c_h = 2 ζ_h √(k_h m_h). Range: 0
    to 10.
    """


@dataclass(frozen=True, kw_only=True)
class Contact:
    """When feet leave the floor and come back."""

    law: Literal["reaction-force", "gap", "relaxing-leg"] | None = None
    """Contact law (a word): "reaction-force" (the paper), "gap" or "relaxing-leg". Default:
    "reaction-force".

    "reaction-force": Contact while the force of the leg is positive, both ways (the
    paper).

    "gap": In flight the leg has its natural length; touch-down when the gap closes.

    "relaxing-leg": In flight the compression of a massless leg relaxes; needs a damping
    ratio above 0.
    """


@dataclass(frozen=True, kw_only=True)
class Base:
    """The motion of the plate's edges, A_b cos(Ω t).

    Give frequency_ratio or frequency, not both.
    """

    amplitude: float
    """Amplitude A_b (m), such as 0.013. Range: 0 to 1000."""

    frequency_ratio: float | None = None
    """Ω as a multiple of the frequency named by `reference` (-), such as 1.0; or give
    `frequency` instead. Range: 1e-6 to 10000.
    """

    reference: Literal["occupied", "free", "plate"] | None = None
    """The frequency that `frequency_ratio` multiplies (a word): "occupied", "free" or
    "plate". Default: "occupied".

    "occupied": The body's frequency on the flexible plate: agrees best with the paper.

    "free": The body's frequency on rigid ground.

    "plate": The first frequency of the empty plate.
    """

    frequency: float | None = None
    """Frequency Ω/2π (Hz), such as 2.5; instead of `frequency_ratio`. Range: 1e-6 to 1e6."""


@dataclass(frozen=True, kw_only=True)
class Gravity:
    """Gravity."""

    acceleration: float | None = None
    """Acceleration of gravity g (m/s²), such as 9.81. Range: 1e-6 to 10000. Default: 9.81."""


@dataclass(frozen=True, kw_only=True)
class Solver:
    """How the motion is integrated."""

    method: Literal["taylor", "rk4"] | None = None
    """Method (a word): "taylor" or "rk4". Default: "taylor".

    "taylor": Taylor series of high order with steps chosen from `tolerance`.

    "rk4": The classical fourth-order Runge-Kutta method with fixed steps (the paper).
    """

    tolerance: float | None = None
    """Error allowed per step by "taylor", in plate thicknesses (-), such as 1e-10; relative
    to the largest state once that exceeds one. Range: 1e-15 to 0.001. Default: 1e-10.
    """

    steps_per_period: int | None = None
    """Steps per forcing period of "rk4" (-, a whole number), such as 2000. Range: 4 to 1e7.
    Default: 2000.
    """

    max_switches: int | None = None
    """Take-offs and touch-downs allowed per forcing period and jumper (-, a whole number),
    such as 100; more is reported as chattering. Range: 1 to 1e6. Default: 100.
    """


@dataclass(frozen=True, kw_only=True)
class Start:
    """The initial condition of every jumper; the plate starts at rest."""

    z: float | None = None
    """Initial height z/η (-), upwards from the floor at rest, such as 3.0; η = g/ω_h² (m).
    Range: -1e6 to 1e6. Default: 3.0.
    """

    v: float | None = None
    """Initial velocity z'/(η ω_h) (-), upwards, such as 2.0. Range: -1e6 to 1e6. Default:
    2.0.
    """


@dataclass(frozen=True, kw_only=True)
class Simulate:
    """What `saltus simulate` runs: the motion from the initial condition on."""

    periods: int | None = None
    """Forcing periods integrated (-, a whole number), such as 100. Range: 1 to 1e7. Default:
    100.
    """

    transient: int | None = None
    """Of these, first periods left out of figures (-, a whole number), such as 0. Range: 0
    to 1e7. Default: 0.
    """

    history: int | None = None
    """Last periods that the time history covers (-, a whole number), such as 20; at most
    those that are not left out. Range: 1 to 100000. Default: 20.
    """

    samples_per_period: int | None = None
    """Points of the time history in each period, at equal times (-, a whole number), such as
    400. Range: 1 to 1e6. Default: 400.
    """

    times: Numbers | None = None
    """Times of the time history since the start (s), ascending, such as [0.0, 0.05, 0.1];
    instead of `history` and `samples_per_period`. Range: 0 to 1e13.
    """


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """What `saltus sweep` runs: the long-term motion at each value of a parameter."""

    parameter: str
    """The key that changes (a word), such as "jumper.damping_ratio" for every jumper,
    "jumper.0.mass" for one, or "base.frequency_ratio".
    """

    from_: float | None = None
    """First value (in the unit of the parameter), such as 0.1. Range: -1e13 to 1e13."""

    to: float | None = None
    """Last value (in the unit of the parameter), such as 0.5. Range: -1e13 to 1e13."""

    count: int | None = None
    """Number of values, both ends included (-, a whole number), such as 401. Range: 2 to
    1e7.
    """

    direction: Literal["up", "down", "both", "restarts"] | None = None
    """How the state is carried on (a word): "up", "down", "both" or "restarts". Default:
    "up".

    "up": From `from` to `to`, the last state of each value starting the next.

    "down": From `to` to `from`, the last state of each value starting the next.

    "both": One sweep each way.

    "restarts": Every value anew from each of `starts`.
    """

    transient: int | None = None
    """Forcing periods left out at each value (-, a whole number), such as 300. Range: 0 to
    1e7. Default: 300.
    """

    record: int | None = None
    """Forcing periods recorded at each value (-, a whole number), such as 100. Range: 1 to
    1e7. Default: 100.
    """

    exponents: int | None = None
    """How many of the largest Lyapunov exponents to follow at each value, once the motion
    has its label (-, a whole number), such as 2; 0: only where the label of the motion
    needs one. Range: 0 to 100000. Default: 0.
    """

    exponent_periods: int | None = None
    """Forcing periods over which they are followed (-, a whole number), such as 400. Range:
    1 to 1e7. Default: 400.
    """

    starts: Rows | None = None
    """Initial conditions [z/η, z'/(η ω_h)] of every jumper for "restarts" (-), such as
    [[3.0, 2.0], [-1.0, 0.0]].
    """

    values: Numbers | None = None
    """The values one by one (in the unit of the parameter), ascending or descending, such as
    [0.1, 0.15, 0.3]; instead of `from`, `to` and `count`. Range: -1e13 to 1e13.
    """


@dataclass(frozen=True, kw_only=True)
class Axis:
    """One axis of a plane: a key of the study and the values it takes."""

    parameter: str
    """The key that changes (a word), such as "jumper.damping_ratio" or
    "base.frequency_ratio"; for the table basins "start.z" or "start.v".
    """

    from_: float | None = None
    """First value (in the unit of the parameter), such as 0.1. Range: -1e13 to 1e13."""

    to: float | None = None
    """Last value (in the unit of the parameter), such as 0.5. Range: -1e13 to 1e13."""

    count: int | None = None
    """Number of values, both ends included (-, a whole number), such as 64. Range: 2 to
    10000.
    """

    values: Numbers | None = None
    """The values one by one (in the unit of the parameter), ascending or descending, such as
    [0.1, 0.15, 0.3]; instead of `from`, `to` and `count`. Range: -1e13 to 1e13.
    """


@dataclass(frozen=True, kw_only=True)
class Map:
    """What `saltus map` runs: the long-term motion over a plane of two parameters."""

    transient: int | None = None
    """Forcing periods left out at each pixel, at most (-, a whole number), such as 400;
    fewer are run once the motion has surely settled. Range: 0 to 1e7. Default: 400.
    """

    record: int | None = None
    """Forcing periods recorded where the motion has not surely settled before (-, a whole
    number), such as 64. Range: 1 to 100000. Default: 64.
    """

    exponent: int | None = None
    """Forcing periods, at most, over which the largest Lyapunov exponent is followed where
    the motion has no period (-, a whole number), such as 2000; chaos is then run on for a
    quarter of that, to see whether it lasts. 0: it is not asked whether that is chaos or
    a torus. Range: 0 to 1e7. Default: 2000.
    """

    x: Axis
    """The parameter along x, left to right."""

    y: Axis
    """The parameter along y, bottom to top."""


@dataclass(frozen=True, kw_only=True)
class Basins:
    """What `saltus basins` runs: where the initial conditions of a plane of them lead."""

    transient: int | None = None
    """Forcing periods left out at each pixel, at most (-, a whole number), such as 400;
    fewer are run once the motion has surely settled. Range: 0 to 1e7. Default: 400.
    """

    record: int | None = None
    """Forcing periods recorded where the motion has not surely settled before (-, a whole
    number), such as 64. Range: 1 to 100000. Default: 64.
    """

    exponent: int | None = None
    """Forcing periods, at most, over which the largest Lyapunov exponent is followed where
    the motion has no period (-, a whole number), such as 2000; chaos is then run on for a
    quarter of that, to see whether it lasts. 0: it is not asked whether that is chaos or
    a torus. Range: 0 to 1e7. Default: 2000.
    """

    x: Axis
    """The part of the initial condition along x, left to right: "start.z" or "start.v"."""

    y: Axis
    """The part of the initial condition along y, bottom to top: the other one."""


@dataclass(frozen=True, kw_only=True)
class Orbit:
    """What `saltus orbit` seeks: a periodic orbit, stable or not."""

    period: int | None = None
    """Forcing periods after which the orbit closes (-, a whole number), such as 2; 0: those
    of the long-term motion. Range: 0 to 64. Default: 0.
    """

    transient: int | None = None
    """Forcing periods run before Newton's method begins (-, a whole number), such as 200; 0:
    it begins at the initial condition. Range: 0 to 1e7. Default: 200.
    """

    segments: int | None = None
    """Pieces whose ends Newton's method joins (-, a whole number), at most one per period;
    0: one per period. Range: 0 to 64. Default: 0.
    """


@dataclass(frozen=True, kw_only=True)
class Lyapunov:
    """What `saltus lyapunov` runs: how fast neighbours of the long-term motion part."""

    exponents: int | None = None
    """How many exponents, the largest first (-, a whole number), such as 2; 0: all, one per
    state. Range: 0 to 100000. Default: 0.
    """

    transient: int | None = None
    """Forcing periods left out before each replica is measured (-, a whole number), such as
    400. Range: 0 to 1e7. Default: 400.
    """

    periods: int | None = None
    """Forcing periods measured in each replica (-, a whole number), such as 2000. Range: 1
    to 1e7. Default: 2000.
    """

    replicas: int | None = None
    """Independent pieces of the same attractor that are run side by side (-, a whole
    number), such as 8; their scatter says how sure the exponents are. Range: 1 to 10000.
    Default: 8.
    """


@dataclass(frozen=True, kw_only=True)
class Second:
    """A second parameter: special points of the branches become curves over both."""

    parameter: str
    """The other key that changes (a word), such as "base.frequency_ratio". Curves begin at
    the study's own value of it, which lies between `from` and `to`.
    """

    from_: float
    """One end of its range (in the unit of the parameter), such as 0.85. Range: -1e13 to
    1e13.
    """

    to: float
    """The other end of its range (in the unit of the parameter), such as 1.15. Range: -1e13
    to 1e13.
    """

    curves: Sequence[str] | None = None
    """The special points to follow (words): labels such as ["PD1"], kinds such as ["PD"], or
    [] for every one found. Default: [].
    """


@dataclass(frozen=True, kw_only=True)
class Continue:
    """What `saltus continue` runs: branches of periodic orbits over a parameter."""

    parameter: str
    """The key that changes (a word), such as "jumper.damping_ratio" or
    "base.frequency_ratio". The first orbit is sought at the study's own value of it,
    which lies between `from` and `to`.
    """

    from_: float
    """One end of the range (in the unit of the parameter), such as 0.1. Range: -1e13 to
    1e13.
    """

    to: float
    """The other end of the range (in the unit of the parameter), such as 0.5. Range: -1e13
    to 1e13.
    """

    period: int | None = None
    """Forcing periods after which the first orbit closes (-, a whole number), such as 2; 0:
    those of the long-term motion. Range: 0 to 64. Default: 0.
    """

    transient: int | None = None
    """Forcing periods run before the first orbit is sought (-, a whole number), such as 200;
    0: the search begins at the initial condition. Range: 0 to 1e7. Default: 200.
    """

    step: float | None = None
    """Largest step along a branch, as a part of the range (-), such as 0.02. Range: 1e-6 to
    1. Default: 0.02.
    """

    points: int | None = None
    """Points at which a branch is given up (-, a whole number), such as 2000. Range: 2 to
    1e6. Default: 2000.
    """

    doublings: int | None = None
    """Period doublings that are followed, each from the branch before, to the doubled orbits
    (-, a whole number), such as 4; 0: none. Range: 0 to 16. Default: 4.
    """

    cloud: int | None = None
    """Values of the parameter at which the long-term motion is run, as a cloud behind the
    branches of the figure (-, a whole number), such as 200; 0: none. Range: 0 to 100000.
    Default: 200.
    """

    second: Second | None = None
    """A second parameter: special points of the branches become curves over both."""


@dataclass(frozen=True, kw_only=True)
class Attractors:
    """What `saltus attractors` runs: every motion that many initial conditions lead to.

    At the study's own parameters or at each value of one: give parameter with from, to
    and count, or with values, or none of them.
    """

    z: tuple[float, float] | Numbers | None = None
    """Lowest and highest initial height z/η of every jumper (-), such as [-2.0, 6.0]. Range:
    -1e6 to 1e6. Default: [-2.0, 6.0].
    """

    v: tuple[float, float] | Numbers | None = None
    """Lowest and highest initial velocity z'/(η ω_h) of every jumper (-), such as [-4.0,
    4.0]. Range: -1e6 to 1e6. Default: [-4.0, 4.0].
    """

    plate: float | None = None
    """Largest first amplitude |w_j|/h of each transverse term of the plate (-), such as 0.1;
    0: it starts at rest. Range: 0 to 1000. Default: 0.0.
    """

    starts: int | None = None
    """Number of initial conditions (-, a whole number), such as 128. Range: 1 to 1e7.
    Default: 128.
    """

    transient: int | None = None
    """Forcing periods left out from each initial condition, at most (-, a whole number),
    such as 400; fewer are run once the motion has surely settled. Range: 0 to 1e7.
    Default: 400.
    """

    record: int | None = None
    """Forcing periods recorded where the motion has not surely settled before (-, a whole
    number), such as 64. Range: 1 to 100000. Default: 64.
    """

    parameter: str | None = None
    """The key that changes (a word), such as "jumper.damping_ratio" or
    "base.frequency_ratio".
    """

    from_: float | None = None
    """First value (in the unit of the parameter), such as 0.1. Range: -1e13 to 1e13."""

    to: float | None = None
    """Last value (in the unit of the parameter), such as 0.5. Range: -1e13 to 1e13."""

    count: int | None = None
    """Number of values, both ends included (-, a whole number), such as 41. Range: 2 to
    10000.
    """

    values: Numbers | None = None
    """The values one by one (in the unit of the parameter), ascending or descending, such as
    [0.1, 0.15, 0.3]; instead of `from`, `to` and `count`. Range: -1e13 to 1e13.
    """


TABLES: Final[Mapping[str, type]] = {
    "plate": Plate,
    "plate.modes": ModeLists,
    "jumper": Jumper,
    "contact": Contact,
    "base": Base,
    "gravity": Gravity,
    "solver": Solver,
    "start": Start,
    "simulate": Simulate,
    "sweep": Sweep,
    "map": Map,
    "map.x": Axis,
    "map.y": Axis,
    "basins": Basins,
    "basins.x": Axis,
    "basins.y": Axis,
    "orbit": Orbit,
    "lyapunov": Lyapunov,
    "continue": Continue,
    "continue.second": Second,
    "attractors": Attractors,
}
"""The class of each table, by its name in the study file."""
