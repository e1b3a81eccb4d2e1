"""Plots of results in axes of matplotlib, one for each kind of answer."""

from __future__ import annotations

import re
import textwrap
import unicodedata
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from saltus import _native
from saltus._errors import unknown

if TYPE_CHECKING:
    from types import ModuleType

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from saltus._results import Result

__all__ = ["NO_HISTORY", "classes", "plot", "pyplot", "typeset"]

#: Things that only a number tells apart.
CYCLE = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000")
#: Plots of a history, and the refusal where that is empty.
_HISTORIES = ("portrait", "history", "force", "acceleration")
NO_HISTORY = "the history has no times: the run ended before it"

#: Axes, the answer, the jumper, and keywords for the artists.
Drawer: TypeAlias = "Callable[[Axes, Result, int, dict[str, Any]], list[Artist]]"


def pyplot() -> ModuleType:
    """matplotlib.pyplot, which is needed here alone."""
    try:
        import matplotlib.pyplot
    except ImportError:
        raise ImportError(
            "matplotlib is needed to plot and is not there: `pip install matplotlib`, or with "
            "saltus as `pip install 'saltus[plot]'`"
        ) from None
    return matplotlib.pyplot


def plot(
    result: Result,
    ax: Axes | None,
    what: str | None,
    jumper: int,
    kwargs: dict[str, Any],
) -> list[Artist]:
    """Draw `what` of a result; see `Result.plot`."""
    known = _KINDS.get(result.command)
    if not known:
        raise ValueError(
            f"{result.command} has nothing to plot: "
            + ("its figures are in figures" if result.figures else "its numbers are in its arrays")
        )
    layers = _layers(result)
    name = next(iter(known)) if what is None else what
    if name not in known and name not in layers:
        raise unknown("plot", name, [*known, *layers])
    if ax is None:
        ax = pyplot().subplots(layout="constrained")[1]
    if "jumper" in result and not 0 <= jumper < len(result["jumper"]):
        raise ValueError(f"jumper is {jumper}: 0 to {len(result['jumper']) - 1} would do")
    if name in _HISTORIES and len(result["history_time"]) == 0:
        raise ValueError(NO_HISTORY)
    # numbers that are names have no scale
    name = {"period": "map", "status": "map", "attractor": "basins"}.get(name, name)
    if name in known:
        return known[name](ax, result, jumper, kwargs)
    return _layer(ax, result, name, kwargs)


# labels


def typeset(text: str) -> str:
    """A label with its symbols in the letters of mathematics: "mass m_h" becomes "mass $m_{h}$"."""
    return " ".join(f"${_tex(word)}$" if _is_symbol(word) else word for word in text.split(" "))


def _is_symbol(word: str) -> bool:
    return bool(re.search(r"[\u0370-\u03ff_]|^\w$|\(0\)", word)) and not word.isdigit()


def _tex(word: str) -> str:
    def command(found: re.Match[str]) -> str:
        size, letter = unicodedata.name(found[0]).split()[1:4:2]
        return f"\\{letter.lower() if size == 'SMALL' else letter.capitalize()} "

    word = re.sub(r"[\u0391-\u03c9]", command, word)
    return re.sub(r" ?_(\w+)", r"_{\1}", word)


def _label(result: Result, name: str) -> str:
    """Meaning and unit of an array; a pure number has none."""
    about = result.variables[name].attrs
    unit = re.sub(r"(-?\d+)", r"$^{\1}$", str(about.get("units", "1")).replace(" ", "\u00a0"))
    meaning = typeset(str(about.get("long_name", name)))
    return meaning if unit in ("1", "$^{1}$", "") else f"{meaning} ({unit})"


_HEIGHT = r"Height $z/\eta$"
_VELOCITY = r"Velocity $\dot z/(\eta\,\omega_h)$"


# classes of motion


def _class(kind: str, period: int) -> tuple[str, str]:
    """Name and colour of a kind of motion."""
    name = f"Period {period}" if period > 0 else kind.capitalize()
    return name, _native.colour(kind, period)


def classes(kinds: NDArray[Any], periods: NDArray[Any]) -> list[tuple[str, str, NDArray[np.bool_]]]:
    """Name, colour and places of each class that occurs, by rising period and then by name."""
    # a period is that of a periodic motion alone
    numbers = np.where(kinds == "periodic", periods, 0)
    found = sorted(
        {(n == 0, int(n), str(kind)) for kind, n in zip(kinds.flat, numbers.flat, strict=True)}
    )
    return [(*_class(kind, n), (kinds == kind) & (numbers == n)) for _, n, kind in found]


def _legend(ax: Axes, artists: Sequence[Artist], many: int = 6) -> None:
    """Beside the axes where it would cover them."""
    if len(artists) > many:
        ax.legend(handles=artists, loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
    elif artists:
        ax.legend(handles=artists)


#: A cloud of points.
_DOTS = {"linestyle": "none", "marker": ".", "markersize": 3.0, "markeredgewidth": 0.0}


def _given(kwargs: dict[str, Any], **own: Any) -> dict[str, Any]:
    """Keywords of an artist; those of the caller take the place of its own, short or long."""
    from matplotlib.cbook import normalize_kwargs
    from matplotlib.lines import Line2D

    return own | normalize_kwargs(kwargs, Line2D)


def _legend_of_dots(ax: Axes, artists: Sequence[Artist]) -> None:
    """Dots of a cloud are small, those of its legend are not."""
    _legend(ax, artists)
    legend = ax.get_legend()
    for handle in legend.get_lines() if legend is not None else ():
        handle.set_markersize(8.0)


# one function for each plot


def _bifurcation(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    heights = result["z"][:, :, jumper, :]
    only = kwargs.pop("direction", None)
    directions = result["direction"]
    chosen = np.ones(len(directions), bool) if only is None else directions == only
    if not chosen.any():
        raise unknown("direction", only, directions)
    values = result[_parameter(result)]
    artists: list[Artist] = []
    for name, colour, here in classes(result.words("label")[chosen], result["period"][chosen]):
        _, where = np.nonzero(here)
        z = heights[chosen][here]
        x = np.broadcast_to(values[where][:, None], z.shape)
        given = _given(kwargs, **_DOTS, color=colour, label=name)
        artists += ax.plot(x.ravel(), z.ravel(), **given)
    ax.set(xlabel=_label(result, _parameter(result)), ylabel=_HEIGHT)
    _legend_of_dots(ax, artists)
    return artists


def _sweep_exponents(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    values = result[_parameter(result)]
    artists: list[Artist] = []
    for direction, rows in zip(result["direction"], range(len(result["direction"])), strict=True):
        for number in range(result["exponent"].shape[2]):
            colour = CYCLE[len(artists) % len(CYCLE)]
            label = f"{direction}, exponent {number + 1}"
            given = _given(kwargs, marker=".", color=colour, label=label)
            artists += ax.plot(values, result["exponent"][rows, :, number], **given)
    ax.axhline(0.0, color="0.5", lw=0.8)
    ax.set(xlabel=_label(result, _parameter(result)), ylabel=_PER_PERIOD)
    _legend(ax, artists)
    return artists


_PER_PERIOD = r"Lyapunov exponent $\lambda$ per forcing period"


def _parameter(result: Result) -> str:
    return str(result.attrs["parameter"]).replace(".", "_")


def _portrait(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    z, v = result["history_z"][:, jumper], result["history_v"][:, jumper]
    flight = result.words("history_phase")[:, jumper] == "flight"
    artists: list[Artist] = []
    for name, here, colour in (("Contact", ~flight, CYCLE[0]), ("Flight", flight, CYCLE[1])):
        # a line goes on to the first point of the other kind, so that none is left out
        shown = here | np.concatenate([[False], here[:-1]])
        given = _given(kwargs, color=colour, linewidth=1.0, label=name)
        artists += ax.plot(np.where(shown, z, np.nan), np.where(shown, v, np.nan), **given)
    # of a motion the points that the line covers, of an orbit all
    seen = result["time"] >= result["history_time"][0] if "time" in result else slice(None)
    points = result["z"][seen, jumper], result["v"][seen, jumper]
    artists += ax.plot(*points, "o", color="black", ms=4.0, label=r"At $\cos\Omega t = 1$")
    ax.set(xlabel=_HEIGHT, ylabel=_VELOCITY)
    _legend(ax, artists)
    return artists


def _history(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    time = result["history_time"]
    body = result["history_z"][:, jumper] * result["eta"][jumper]
    artists: list[Artist] = []
    for name, height in (("Body", body), ("Floor under the feet", result["history_floor"][:, jumper])):
        artists += ax.plot(time, height, **_given(kwargs, label=name, color=CYCLE[len(artists)]))
    artists += _flights(ax, result, jumper)
    ax.set(ylabel="Height (m)")
    return _in_time(ax, time, artists)


def _force(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    time = result["history_time"]
    given = _given(kwargs, color=CYCLE[0], label="Force of the feet")
    artists: list[Artist] = [*ax.plot(time, result["history_prf"][:, jumper], **given)]
    artists += _flights(ax, result, jumper)
    ax.axhline(1.0, color="0.5", lw=0.8)
    ax.set(ylabel="Force over body weight")
    return _in_time(ax, time, artists)


def _acceleration(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    time = result["history_time"]
    artists: list[Artist] = []
    for name, ending in (("Absolute", ""), ("Relative to the base", "_relative")):
        values = result[f"history_floor_acceleration{ending}"][:, jumper]
        artists += ax.plot(time, values, **_given(kwargs, label=name, color=CYCLE[len(artists)]))
    artists += _flights(ax, result, jumper)
    ax.set(ylabel=r"Acceleration of the floor (m/s$^2$)")
    return _in_time(ax, time, artists)


def _in_time(ax: Axes, time: NDArray[Any], artists: list[Artist]) -> list[Artist]:
    ax.set(xlabel=r"Time $t$ (s)", xlim=(time[0], time[-1]))
    _legend(ax, artists)
    return artists


def _flights(ax: Axes, result: Result, jumper: int) -> list[Artist]:
    """Shades behind the times in the air."""
    flight = result.words("history_phase")[:, jumper] == "flight"
    if not flight.any():
        return []
    shade = ax.fill_between(
        result["history_time"],
        0.0,
        1.0,
        where=flight,
        transform=ax.get_xaxis_transform(),
        color="0.9",
        lw=0.0,
        zorder=0,
        label="Flight",
    )
    return [shade]


def _multipliers(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    re_, im = result["multiplier_real"], result["multiplier_imaginary"]
    around = np.linspace(0.0, 2.0 * np.pi, 361)
    ax.plot(np.cos(around), np.sin(around), color="0.5", lw=0.8)
    artists: list[Artist] = []
    outside = np.hypot(re_, im) > 1.0
    for name, here, colour in (("Inside", ~outside, CYCLE[0]), ("Outside", outside, CYCLE[1])):
        if here.any():
            given = _given(kwargs, linestyle="none", marker="o", color=colour, label=name)
            artists += ax.plot(re_[here], im[here], **given)
    ax.set(xlabel=r"Re $\mu$", ylabel=r"Im $\mu$", aspect="equal")
    _legend(ax, artists)
    return artists


def _branches(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    values = result[_parameter(result)]
    heights, periods, stable = result["z"][:, :, jumper], result["period"], result["stable"]
    artists: list[Artist] = []
    named: dict[str, Artist] = {}
    for branch in np.unique(result["branch"]):
        on = np.flatnonzero(result["branch"] == branch)
        name, colour = _class("periodic", int(periods[on[0]]))
        for run in _runs(stable[on]):
            part = on[run]
            style = "-" if stable[part[0]] else "--"
            told = name if style == "-" else f"{name}, unstable"
            given = _given(kwargs, color=colour, linestyle=style, linewidth=1.2)
            for place in range(int(periods[on[0]])):
                line = ax.plot(values[part], heights[part, place], **given)[0]
                artists.append(line)
                line.set_label("_" if told in named else told)
                named.setdefault(told, line)
    x, y = result[f"special_{_parameter(result)}"], result["special_z"][:, 0, jumper]
    if len(x) > 0:
        artists += ax.plot(x, y, "o", color="black", ms=3.5, mfc="white")
    for where, height, label in zip(x, y, result["special_label"], strict=True):
        note = ax.annotate(str(label), (where, height), xytext=(4, 4), textcoords="offset points")
        artists.append(note)
    ax.set(xlabel=_label(result, _parameter(result)), ylabel=_HEIGHT)
    _legend(
        ax, [named[told] for told in sorted(named, key=lambda told: (len(told.split(",")[0]), told))]
    )
    return artists


def _runs(flags: NDArray[np.bool_]) -> Iterator[slice]:
    """Runs of equal flags, each with the first place of the next, so that lines meet."""
    ends = np.flatnonzero(flags[1:] != flags[:-1]) + 1
    for begin, end in zip([0, *ends], [*ends, len(flags)], strict=True):
        yield slice(begin, end + 1)


def _curves(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    if "curve_number" not in result:
        raise ValueError("there are no curves: continue.second asks for them")
    first, second = (
        str(result.attrs[key]).replace(".", "_") for key in ("parameter", "second_parameter")
    )
    artists: list[Artist] = []
    for place, number in enumerate(np.unique(result["curve_number"])):
        on = result["curve_number"] == number
        label = str(result["curve_label"][on][0])
        given = _given(kwargs, color=CYCLE[place % len(CYCLE)], label=label)
        artists += ax.plot(result[f"curve_{first}"][on], result[f"curve_{second}"][on], **given)
    ax.set(xlabel=_label(result, f"curve_{first}"), ylabel=_label(result, f"curve_{second}"))
    _legend(ax, artists)
    return artists


def _exponents(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    values = result["exponent"]
    reach = np.abs([values - result["exponent_low"], result["exponent_high"] - values])
    given = _given(kwargs, fmt="o", color=CYCLE[0], capsize=3.0)
    bars = ax.errorbar(result["exponent_number"], values, yerr=reach, **given)
    ax.axhline(0.0, color="0.5", lw=0.8)
    ax.set_xticks(result["exponent_number"])
    ax.set(xlabel="Exponent, the largest first", ylabel=_PER_PERIOD)
    return [artist for artist in bars.get_children() if artist is not None]


def _convergence(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    periods = result["periods"]
    artists: list[Artist] = []
    for number in range(result["running_exponent"].shape[1]):
        mean, error = (result[f"running_{what}"][:, number] for what in ("exponent", "error"))
        given = _given(kwargs, color=CYCLE[number % len(CYCLE)], label=f"{number + 1}")
        line = ax.plot(periods, mean, **given)[0]
        known = np.isfinite(error)
        low, high = (mean - error)[known], (mean + error)[known]
        ax.fill_between(periods[known], low, high, color=line.get_color(), alpha=0.2, lw=0.0)
        artists.append(line)
    ax.set(xscale="log", xlabel="Forcing periods of each replica", ylabel=_PER_PERIOD)
    _legend(ax, artists)
    return artists


def _attractors(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    numbers, along = result["motion_attractor"], _along(result, "motion_")
    artists: list[Artist] = []
    for number in result["attractor"]:
        here = numbers == number
        z = result["z"][here, jumper, :]
        x = np.broadcast_to((numbers if along is None else result[along])[here][:, None], z.shape)
        given = _given(kwargs, **_DOTS, color=_of_attractor(number), label=f"Attractor {number}")
        artists += ax.plot(x.ravel(), z.ravel(), **given)
    ax.set(xlabel="Attractor" if along is None else _label(result, along), ylabel=_HEIGHT)
    _legend_of_dots(ax, artists)
    return artists


def _shares(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    along = _along(result, "")
    if along is None:
        reach = np.abs([result["share"] - result["share_low"], result["share_high"] - result["share"]])
        colours = [_of_attractor(number) for number in result["attractor"]]
        bars = ax.bar(result["attractor"], result["share"], yerr=reach, color=colours, **kwargs)
        ax.set(xlabel="Attractor", ylabel="Share of the initial conditions", ylim=(0.0, 1.0))
        return list(bars)
    artists: list[Artist] = []
    for place, number in enumerate(result["attractor"]):
        share = result["share"][:, place]
        given = _given(kwargs, marker=".", color=_of_attractor(number), label=f"Attractor {number}")
        line = ax.plot(result[along], share, **given)[0]
        ends = result["share_low"][:, place], result["share_high"][:, place]
        ax.fill_between(result[along], *ends, color=line.get_color(), alpha=0.2, lw=0.0)
        artists.append(line)
    ax.set(xlabel=_label(result, along), ylabel="Share of the initial conditions", ylim=(0.0, 1.05))
    _legend(ax, artists)
    return artists


def _of_attractor(number: int) -> str:
    palette = _native.palette()
    return palette[(int(number) - 1) % len(palette)]


def _along(result: Result, prefix: str) -> str | None:
    """Name of the values of the parameter, if one changes."""
    key = result.attrs.get("parameter")
    return None if key is None else prefix + str(key).replace(".", "_")


# planes


def _plane(result: Result) -> tuple[str, str]:
    """Names of the axes of a map, x and y."""
    y, x = result.variables["period"].dims
    return x, y


def _layers(result: Result) -> list[str]:
    """Arrays over the whole plane."""
    if result.command not in ("map", "basins"):
        return []
    x, y = _plane(result)
    return [variable.name for variable in result.variables.values() if variable.dims == (y, x)]


def _cells(
    ax: Axes,
    result: Result,
    classes: Sequence[tuple[str, str, NDArray[np.bool_]]],
    kwargs: dict[str, Any],
) -> list[Artist]:
    """Cells of some classes, each with its colour, and their legend."""
    from matplotlib.colors import ListedColormap
    from matplotlib.patches import Patch

    x, y = _plane(result)
    codes = np.zeros((len(result[y]), len(result[x])))
    for code, (_, _, here) in enumerate(classes):
        codes[here] = code
    colours = ListedColormap([colour for _, colour, _ in classes])
    given = _given(kwargs, cmap=colours, vmin=-0.5, vmax=len(classes) - 0.5, shading="nearest")
    mesh = ax.pcolormesh(result[x], result[y], codes, **given)
    ax.set(xlabel=_label(result, x), ylabel=_label(result, y))
    _legend(ax, [Patch(color=colour, label=name) for name, colour, _ in classes], many=0)
    return [mesh]


def _map(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    return _cells(ax, result, classes(result.words("status"), result["period"]), kwargs)


def _basins(ax: Axes, result: Result, jumper: int, kwargs: dict[str, Any]) -> list[Artist]:
    numbers = result["attractor"]
    kinds = [str(kind) for kind in result.words("attractor_kind")]
    motions = list(zip(kinds, result["attractor_period"].tolist(), strict=True))
    classes = []
    for place, colour in enumerate(_native.colours(motions)):
        # one that was met along the sweep of attractors has the number and the colour that it has there
        matched = int(result["attractor_matched"][place])
        name = _class(*motions[place])[0].lower()
        label = f"{matched or place + 1}: {name}, {100 * result['attractor_share'][place]:.1f} %"
        classes.append((label, _of_attractor(matched) if matched else colour, numbers == place + 1))
    if (numbers == 0).any():
        classes.append(("No attractor", _native.colour("undecided", 0), numbers == 0))
    return _cells(ax, result, classes, kwargs)


def _layer(ax: Axes, result: Result, name: str, kwargs: dict[str, Any]) -> list[Artist]:
    x, y = _plane(result)
    mesh = ax.pcolormesh(result[x], result[y], result[name], **_given(kwargs, shading="nearest"))
    ax.figure.colorbar(mesh, ax=ax, label=textwrap.fill(_label(result, name), 44))
    ax.set(xlabel=_label(result, x), ylabel=_label(result, y))
    return [mesh]


#: The plots of each command, the first by default.
_KINDS: dict[str, dict[str, Drawer]] = {
    "simulate": {
        "portrait": _portrait,
        "history": _history,
        "force": _force,
        "acceleration": _acceleration,
    },
    "sweep": {"bifurcation": _bifurcation, "exponents": _sweep_exponents},
    "map": {"map": _map},
    "basins": {"basins": _basins, "map": _map},
    "orbit": {
        "multipliers": _multipliers,
        "portrait": _portrait,
        "history": _history,
        "force": _force,
        "acceleration": _acceleration,
    },
    "continue": {"branches": _branches, "curves": _curves},
    "lyapunov": {"exponents": _exponents, "convergence": _convergence},
    "attractors": {"attractors": _attractors, "shares": _shares},
}
