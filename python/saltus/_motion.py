"""Plate and people at times of a motion: the shape of the plate, and a film of both."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from saltus._arguments import reals, whole
from saltus._plot import NO_HISTORY, pyplot, typeset

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from numpy.typing import ArrayLike, NDArray

    from saltus._results import Result

__all__ = ["animate", "surface"]

#: Points along the longer side of the plate, for the eye.
POINTS = 57
#: Length of the leg that a film shows (m), feet to body: the model's legs have none.
LEG = 0.25
#: Parts of the forcing period that a time may be off.
SAME = 1e-9


def surface(
    result: Result, x: ArrayLike | None, y: ArrayLike | None, t: ArrayLike | None, absolute: bool
) -> NDArray[np.float64]:
    """Give w(x, y, t); see `Result.surface`."""
    _needed(result, "surface")
    along, across = (
        _axis(name, given, side) for name, given, side in zip("xy", (x, y), _sides(result), strict=True)
    )
    at = np.arange(len(result["history_time"])) if t is None else _places(result, reals("t", t))
    w = result["history_w"][at] * result.study.plate.thickness
    shape_x, shape_y = (
        np.sin(np.pi * np.multiply.outer(half_waves, points) / side)
        for half_waves, points, side in zip(
            (result["m"], result["n"]), (along, across), _sides(result), strict=True
        )
    )
    shape: NDArray[np.float64] = np.einsum("...j,jy,jx->...yx", w, shape_y, shape_x)
    return shape + result["history_base"][at][..., None, None] if absolute else shape


def animate(
    result: Result, view: str, jumper: int, periods: int, frames: int, slower: float
) -> FuncAnimation:
    """Give a film; see `Result.animate`."""
    _needed(result, "animate")
    if view not in ("section", "surface"):
        raise ValueError(f"view is {view!r}: 'section' or 'surface' would do")
    people = len(result["jumper"])
    if view == "section" and not 0 <= jumper < people:
        raise ValueError(f"jumper is {jumper}: 0 to {people - 1} would do")
    time, period = result["history_time"], float(result["forcing_period"])
    span = whole("periods", periods, 1) * period
    # equal times of the history that come nearest to those of the frames
    wanted = time[-1] - span + span * (np.arange(whole("frames", frames, 2)) + 1) / frames
    at = np.unique(
        np.searchsorted(time, wanted[wanted >= time[0] - SAME * period]).clip(0, len(time) - 1)
    )
    figure = pyplot().figure(layout="constrained")
    draw = (_section if view == "section" else _surface)(figure, result, jumper, at)
    from matplotlib.animation import FuncAnimation

    interval = 1000.0 * slower * (time[at[-1]] - time[at[0]]) / max(1, len(at) - 1)
    film = FuncAnimation(figure, draw, frames=len(at), interval=interval)
    # a notebook shows the film and not its first picture beside it
    pyplot().close(figure)
    return film


def _section(figure: Any, result: Result, jumper: int, at: NDArray[np.int64]) -> Any:
    """Plate along x through one person, and those who stand on that line."""
    ax = figure.subplots()
    place = result.study.jumper[jumper]
    along = _axis("x", None, _sides(result)[0])
    plate = surface(result, along, [place.y], result["history_time"][at], absolute=True)[:, 0, :]
    on = [i for i, person in enumerate(result.study.jumper) if person.y == place.y]
    where = [result.study.jumper[i].x for i in on]
    body, feet = (part[:, on] for part in _people(result, at))
    base = ax.axhline(0.0, color="0.8", lw=0.8)
    (line,) = ax.plot(along, plate[0], color="#0072b2", lw=2.0)
    edges = ax.plot(along[[0, -1]], plate[0, [0, -1]], "^", color="0.4", ms=8.0)[0]
    legs = [ax.plot([], [], color="#d55e00", lw=1.5)[0] for _ in on]
    (bodies,) = ax.plot([], [], "o", color="#d55e00", ms=12.0)
    low, high = plate.min(), body.max(initial=plate.max())
    margin = 0.08 * (high - low)
    ax.set(
        xlabel=typeset("Position x (m)"), ylabel="Height (m)", ylim=(low - margin, high + 2.0 * margin)
    )
    clock = ax.set_title("")

    def draw(frame: int) -> list[Any]:
        line.set_ydata(plate[frame])
        edges.set_ydata(plate[frame, [0, -1]])
        for leg, x, foot, top in zip(legs, where, feet[frame], body[frame], strict=True):
            leg.set_data([x, x], [foot, top])
        bodies.set_data(where, body[frame])
        clock.set_text(f"$t$ = {result['history_time'][at[frame]]:.3f} s")
        return [base, line, edges, *legs, bodies, clock]

    return draw


def _surface(figure: Any, result: Result, jumper: int, at: NDArray[np.int64]) -> Any:
    """Whole plate in space, with all people."""
    ax = figure.add_subplot(projection="3d")
    along, across = (_axis(name, None, side) for name, side in zip("xy", _sides(result), strict=True))
    plate = surface(result, along, across, result["history_time"][at], absolute=True)
    grid = np.meshgrid(along, across)
    body, feet = _people(result, at)
    low, high = plate.min(), body.max(initial=plate.max())

    def draw(frame: int) -> list[Any]:
        ax.clear()
        shown = [ax.plot_surface(*grid, plate[frame], color="#56b4e9", alpha=0.7)]
        for i, person in enumerate(result.study.jumper):
            leg = [feet[frame, i], body[frame, i]]
            shown += ax.plot([person.x] * 2, [person.y] * 2, leg, color="#d55e00")
            shown += ax.plot(person.x, person.y, leg[1], "o", color="#d55e00", ms=8.0)
        ax.set(xlabel="$x$ (m)", ylabel="$y$ (m)", zlabel="Height (m)", zlim=(low, high))
        ax.set_title(f"$t$ = {result['history_time'][at[frame]]:.3f} s")
        return shown

    return draw


def _people(result: Result, at: NDArray[np.int64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Heights of bodies and feet (m), of shape (times, jumpers).

    A leg is drawn as long as it is without load and shorter by its compression. In the air the feet hang
    at their natural distance below the body.
    """
    z = result["history_z"][at] * result["eta"]
    floor = result["history_floor"][at]
    flying = result.words("history_phase")[at] == "flight"
    return z + LEG, np.where(flying, np.maximum(z, floor), floor)


def _needed(result: Result, what: str) -> None:
    if "history_w" not in result:
        raise ValueError(
            f"{what} is of simulate and orbit, which have a history; {result.command} has none"
        )
    if len(result["history_time"]) == 0:
        raise ValueError(NO_HISTORY)


def _sides(result: Result) -> tuple[float, float]:
    plate = result.study.plate
    return plate.length, plate.width


def _axis(name: str, given: ArrayLike | None, side: float) -> NDArray[np.float64]:
    if given is None:
        return np.linspace(0.0, side, POINTS)
    points = np.atleast_1d(reals(name, given))
    if points.ndim > 1:
        raise ValueError(f"{name} has the shape {points.shape}: one axis is needed")
    wrong = (points < 0.0) | (points > side)
    if wrong.any():
        raise ValueError(f"{name} is {points[wrong][0]}: 0 to {side} m is the plate")
    return points


def _places(result: Result, t: NDArray[np.float64]) -> NDArray[np.int64]:
    """Places of times in the history."""
    time = result["history_time"]
    after = np.searchsorted(time, t).clip(1, max(1, len(time) - 1))
    near = np.where(
        np.abs(time[after - 1] - t) <= np.abs(time[after.clip(0, len(time) - 1)] - t), after - 1, after
    )
    wrong = np.abs(time[near] - t) > SAME * float(result["forcing_period"])
    if wrong.any():
        raise ValueError(
            f"t = {np.atleast_1d(t)[np.atleast_1d(wrong)][0]} s is no time of the history, which has "
            f"{len(time)} from {time[0]} to {time[-1]} s: saltus.simulate(..., times=[...]) takes any"
        )
    return near
