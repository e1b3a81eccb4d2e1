"""Plots: what each kind shows, in axes of one's own."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import pytest

import saltus
from saltus import Axis, Result, Study, UnknownNameError, _native
from saltus._plot import typeset

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("agg")

import matplotlib.pyplot as plt  # noqa: E402 (behind the choice of a backend)
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.colors import to_hex  # noqa: E402


@pytest.fixture(scope="module")
def study() -> Study:
    return Study.paper().set({"plate.inertia": "condensed", "jumper.damping_ratio": 0.25})


@pytest.fixture
def axes() -> Any:
    figure, ax = plt.subplots()
    yield ax
    figure.canvas.draw()
    plt.close("all")


@pytest.fixture(scope="module")
def diagram(study: Study) -> Result:
    return saltus.sweep(study, values=[0.15, 0.3, 0.5], transient=100, record=6, exponents=1)


@pytest.fixture(scope="module")
def motion(study: Study) -> Result:
    return saltus.simulate(study, periods=50, transient=40, history=4)


def drawn(result: Result, *given: Any, **named: Any) -> list[Any]:
    """The artists, each of its own kind."""
    return list(result.plot(*given, **named))


def labels(ax: Axes) -> list[str]:
    legend = ax.get_legend()
    return [] if legend is None else [text.get_text() for text in legend.get_texts()]


def test_a_bifurcation_diagram_has_a_colour_for_each_period(diagram: Result, axes: Axes) -> None:
    dots = drawn(diagram, axes, markersize=1)
    assert labels(axes) == ["Period 1", "Period 2", "Chaotic"]
    one, two, chaos = dots
    assert to_hex(one.get_color()) == _native.colour("periodic", 1)
    assert to_hex(two.get_color()) == _native.colour("periodic", 2)
    assert two.get_markersize() == 1
    x, z = chaos.get_data()
    assert set(x) == {0.15}
    assert sorted(z) == sorted(diagram["z"][:, 0, 0, :].ravel())
    assert axes.get_xlabel() == r"Damping ratio $\zeta_{h}$"
    assert axes.get_ylabel() == r"Height $z/\eta$"


def test_a_direction_can_be_drawn_alone(diagram: Result, axes: Axes) -> None:
    found = drawn(diagram, axes, direction="down")
    assert sum(len(dots.get_xdata()) for dots in found) == diagram["z"][0].size
    with pytest.raises(UnknownNameError, match="no direction 'sideways'; there are: up, down"):
        diagram.plot(axes, direction="sideways")


def test_exponents_of_a_sweep(diagram: Result, axes: Axes) -> None:
    lines = diagram.plot(axes, "exponents")
    assert [line.get_label() for line in lines] == ["up, exponent 1", "down, exponent 1"]


def test_a_portrait_leaves_no_gap_between_contact_and_flight(motion: Result, axes: Axes) -> None:
    contact, flight, points = drawn(motion, axes)
    assert labels(axes) == ["Contact", "Flight", r"At $\cos\Omega t = 1$"]
    shown = [np.isfinite(line.get_ydata()) for line in (contact, flight)]
    assert (shown[0] | shown[1]).all()
    assert (shown[0] & shown[1]).sum() == len(
        motion["switch_time"][motion["switch_time"] > motion["history_time"][0]]
    )
    # those of the last four periods, which the line covers, with the point that it begins at
    assert len(points.get_xdata()) == 5


@pytest.mark.parametrize(
    ("what", "first", "label"),
    [
        ("history", "Body", "Height (m)"),
        ("force", "Force of the feet", "Force over body weight"),
        ("acceleration", "Absolute", r"Acceleration of the floor (m/s$^2$)"),
    ],
)
def test_histories_shade_the_flights(
    what: str, first: str, label: str, motion: Result, axes: Axes
) -> None:
    motion.plot(axes, what)
    assert labels(axes)[0] == first
    assert labels(axes)[-1] == "Flight"
    assert (axes.get_xlabel(), axes.get_ylabel()) == (r"Time $t$ (s)", label)


def test_cells_have_discrete_colours(study: Study, axes: Axes) -> None:
    damping = Axis(parameter="jumper.damping_ratio", values=[0.15, 0.3, 0.5])
    plane = saltus.map(study, x=damping, y=[0.9, 1.0], transient=100)
    (mesh,) = drawn(plane, axes)
    colours = [to_hex(colour) for colour in mesh.cmap.colors]
    assert colours[:2] == [_native.colour("periodic", 1), _native.colour("periodic", 2)]
    assert labels(axes)[:2] == ["Period 1", "Period 2"]
    codes = mesh.get_array().reshape(2, 3)
    assert ((codes == 1) == (plane["period"] == 2)).all()
    assert axes.get_ylabel() == r"Frequency ratio $\Omega /\omega $"
    plane.plot(axes, "contact_ratio", cmap="magma")
    with pytest.raises(UnknownNameError, match="no plot 'contact'; did you mean 'contact_ratio'"):
        plane.plot(axes, "contact")


def test_basins_have_the_colour_of_their_attractor(study: Study, axes: Axes) -> None:
    basins = saltus.basins(study, z=np.linspace(-2.0, 6.0, 9), v=np.linspace(-4.0, 4.0, 9))
    basins.plot(axes)
    assert [label[:12] for label in labels(axes)] == ["1: period 2,", "2: period 2,"]


def test_multipliers_and_the_way_of_an_orbit(study: Study, axes: Axes) -> None:
    orbit = saltus.orbit(study)
    (inside,) = drawn(orbit, axes)
    assert len(inside.get_xdata()) == 10
    assert labels(axes) == ["Inside"]
    *_, points = drawn(orbit, axes, "portrait")
    assert len(points.get_xdata()) == 2


def test_branches_are_dashed_where_they_are_unstable(axes: Axes) -> None:
    study = Study.paper().set(
        {
            "plate.inertia": "condensed",
            "base.frequency_ratio": 0.9,
            "jumper.damping_ratio": 0.2,
            "continue.second.curves": ["PD1"],
        }
    )
    result = saltus.continue_(study, from_=0.17, to=0.22, doublings=1, cloud=0)
    result.plot(axes)
    assert labels(axes)[:3] == ["Period 1", "Period 1, unstable", "Period 2"]
    assert [text.get_text() for text in axes.texts] == ["PD1"]
    (curve,) = result.plot(plt.subplots()[1], "curves")
    assert curve.get_label() == "PD1"


def test_exponents_have_their_intervals(study: Study, axes: Axes) -> None:
    found = saltus.lyapunov(study, exponents=2, periods=40)
    found.plot(axes)
    lines = found.plot(plt.subplots()[1], "convergence")
    assert len(lines) == 2


def test_attractors_along_a_parameter_or_at_one_value(study: Study, axes: Axes) -> None:
    found = saltus.attractors(study, starts=8, values=[0.25, 0.26])
    assert next(dots.get_label() for dots in found.plot(axes)) == "Attractor 1"
    found.plot(plt.subplots()[1], "shares")
    table = saltus.Attractors(z=(-2.0, 6.0), v=(-4.0, 4.0), starts=8)
    one = saltus.attractors(study.replace(attractors=table))
    one.plot(plt.subplots()[1])
    one.plot(plt.subplots()[1], "shares")


def test_a_new_figure_is_made_without_axes(motion: Result) -> None:
    before = plt.get_fignums()
    motion.plot()
    assert len(plt.get_fignums()) == len(before) + 1
    plt.close("all")


def test_what_cannot_be_plotted_is_told(motion: Result, axes: Axes, monkeypatch: Any) -> None:
    with pytest.raises(
        ValueError, match="frequencies has nothing to plot: its numbers are in its arrays"
    ):
        saltus.frequencies(Study.paper()).plot(axes)
    with pytest.raises(UnknownNameError, match="no plot 'portriat'; did you mean 'portrait'"):
        motion.plot(axes, "portriat")
    with pytest.raises(ValueError, match="jumper is 1: 0 to 0 would do"):
        motion.plot(axes, jumper=1)
    monkeypatch.setitem(sys.modules, "matplotlib.pyplot", None)
    with pytest.raises(ImportError, match=r"pip install 'saltus\[plot\]'"):
        motion.plot()


def test_labels_are_typeset() -> None:
    assert typeset("Body mass m_h") == "Body mass $m_{h}$"
    assert typeset("Poisson's ratio ν") == r"Poisson's ratio $\nu $"  # noqa: RUF001
    assert typeset("Base frequency Ω/2π") == r"Base frequency $\Omega /2\pi $"
    for text in ("Plate length a", "Initial velocity z'(0)/(η ω_h)"):
        plt.figure().text(0.0, 0.0, typeset(text))
        plt.gcf().canvas.draw()
    plt.close("all")
