"""Functions in formulas: values against mpmath, orbits against known answers, switches by a sign."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any

import mpmath
import numpy as np
import pytest

from saltus import DefinitionError, FormulaError
from saltus.systems import Forcing, System, Unit, find_orbit, integrate, parameters, states

if TYPE_CHECKING:
    from collections.abc import Callable

#: NumPy's types do not know that its functions take formulas.
numpy: Any = np

#: Each function, mpmath's of the same, and where it is asked.
FUNCTIONS: list[tuple[str, Callable[[Any], Any], Callable[[Any], Any], tuple[float, float]]] = [
    ("exp", numpy.exp, mpmath.exp, (-40.0, 40.0)),
    ("log", numpy.log, mpmath.log, (1e-12, 1e6)),
    ("sin", numpy.sin, mpmath.sin, (-60.0, 60.0)),
    ("cos", numpy.cos, mpmath.cos, (-60.0, 60.0)),
    ("tan", numpy.tan, mpmath.tan, (-1.5, 1.5)),
    ("sinh", numpy.sinh, mpmath.sinh, (-20.0, 20.0)),
    ("cosh", numpy.cosh, mpmath.cosh, (-20.0, 20.0)),
    ("tanh", numpy.tanh, mpmath.tanh, (-12.0, 12.0)),
    ("arcsin", numpy.arcsin, mpmath.asin, (-0.999, 0.999)),
    ("arctan", numpy.arctan, mpmath.atan, (-1e3, 1e3)),
    ("sqrt", numpy.sqrt, mpmath.sqrt, (1e-12, 1e6)),
    ("power", lambda x: x**1.7, lambda x: x ** mpmath.mpf(1.7), (1e-6, 1e3)),
    ("inverse", lambda x: 1.0 / x, lambda x: 1 / x, (0.01, 1e3)),
    ("inverse cube", lambda x: x**-3, lambda x: x**-3, (0.01, 1e3)),
]
NAMES = [name for name, *_ in FUNCTIONS]


@pytest.mark.parametrize(("name", "ours", "theirs", "range_"), FUNCTIONS, ids=NAMES)
def test_values_are_those_of_mpmath(
    name: str, ours: Any, theirs: Any, range_: tuple[float, float]
) -> None:
    # x stays, and y is the integral of F(x) over one unit of time: the value itself
    x, y = states("x", "y")
    system = System([x, y], [0.0, ours(x)], interval=1.0)
    low, high = range_
    at = np.geomspace(low, high, 301) if low > 0.0 else np.linspace(low, high, 301)
    run = integrate(system, np.stack([at, 0.0 * at], axis=1), periods=1)
    assert run.completed.all(), run.reason
    exact = np.array([float(theirs(mpmath.mpf(float(one)))) for one in at])
    assert np.abs(run.end[:, 1] / np.where(exact == 0.0, 1.0, exact) - (exact != 0.0)).max() < 3e-16 * 2


@pytest.mark.parametrize(("name", "ours", "theirs", "range_"), FUNCTIONS, ids=NAMES)
def test_series_are_those_of_mpmath(
    name: str, ours: Any, theirs: Any, range_: tuple[float, float]
) -> None:
    # x runs on from 0.3, and z is the integral of F, which mpmath finds by quadrature
    x, z = states("x", "z")
    system = System([x, z], [1.0, ours(x)], interval=0.1)
    start = 0.3
    run = integrate(system, [start, 0.0], periods=4)
    exact = [mpmath.quad(theirs, [start, start + 0.1 * n]) for n in range(1, 5)]
    assert run.samples[:, 1] == pytest.approx(np.array(exact, dtype=float), rel=1e-10)


def test_a_forced_pendulum_has_its_known_orbit() -> None:
    # A = 1.07, omega = 2/3, c = 0.5: unstable, and the stable one of twice the period that it has left
    angle, speed = states("angle", "speed")
    (push,) = parameters("push")
    forcing = Forcing(2.0 / 3.0)
    rates = [speed, -numpy.sin(angle) - 0.5 * speed + push * forcing.cos]
    pendulum = System([angle, speed], rates, forcing=forcing)
    orbit = find_orbit(pendulum, [0.5, 1.9], period=1, parameters={"push": 1.07})
    assert orbit.multipliers.real == pytest.approx([-1.12962897, -0.00795243], abs=5e-9)
    # Liouville: the product of the multipliers is exp(-c T), which knows nothing of the sine
    assert orbit.multipliers.prod().real == pytest.approx(np.exp(-0.5 * 3.0 * np.pi), rel=1e-9)
    # the doubling that gave it its twin: stable at a weaker push
    weaker = find_orbit(pendulum, orbit.states[0], period=1, parameters={"push": 1.06})
    assert -1.0 < weaker.multipliers.real.min() < -0.7
    run = integrate(pendulum, [0.0, 0.0], 400, parameters={"push": 1.07})
    assert run.samples[-1] == pytest.approx(run.samples[-3], abs=1e-8)
    assert abs(run.samples[-1, 0] - run.samples[-2, 0]) > 0.1


def test_a_tank_empties_when_torricelli_says() -> None:
    # h' = -sqrt(h) from 1: empty after 2, and the fill goes on from there
    (level,) = states("level")
    tank = Unit("draining", "empty")
    rate = tank.choose(draining=-numpy.sqrt(level), empty=0.0)
    # the level itself has a double zero when it is empty: its root has a simple one
    empties = tank.transition("draining", "empty", falling=numpy.sqrt(level) - 1e-7)
    run = integrate(System([level], [rate], interval=0.5, transitions=[empties]), [1.0], periods=6)
    assert run.completed
    assert run.switches.time == pytest.approx([2.0], abs=1e-6)
    assert run.samples[:3, 0] == pytest.approx((1.0 - 0.25 * np.arange(1, 4)) ** 2, abs=1e-9)


def test_a_hertzian_ball_bounces_as_often_as_its_beta_function_says() -> None:
    # gravity 1 and a spring x^1.5 of stiffness k under a ball that falls from 1
    x, v = states("x", "v")
    (k,) = parameters("k")
    spring = numpy.where(x < 0.0, k * (-x) ** 1.5, 0.0)
    ball = System([x, v], [v, spring - 1.0], interval=1.0)
    run = integrate(ball, [1.0, 0.0], periods=6, parameters={"k": 1e4})
    energy = 0.5 * run.end[1] ** 2 + run.end[0] + 0.4 * 1e4 * max(-run.end[0], 0.0) ** 2.5
    assert run.completed
    assert energy == pytest.approx(1.0, abs=1e-8)
    first, second = run.switches.time[:2]
    assert first == pytest.approx(np.sqrt(2.0), abs=1e-9)
    # from the energy: down to the depth d, where the speed is 0; x = u^2 - d keeps the integrand smooth
    depth = mpmath.findroot(lambda d: 0.4 * 1e4 * d**2.5 - 1 - d, 0.03)
    half = mpmath.quad(
        lambda u: 2 * u / mpmath.sqrt(2 + 2 * (depth - u**2) - 0.8 * 1e4 * (depth - u**2) ** 2.5),
        [0, mpmath.sqrt(depth)],
        method="gauss-legendre",
    )
    assert second - first == pytest.approx(2.0 * float(half.real), rel=1e-7)


def test_what_depends_on_a_sign_is_the_same_as_a_unit_by_hand() -> None:
    x, v = states("x", "v")
    forcing = Forcing(1.3)
    side = Unit("below", "above")
    switches = [
        side.transition("below", "above", rising=x),
        side.transition("above", "below", falling=x),
    ]
    by_hand = side.choose(below=-1.0, above=1.0)
    push = 0.8 * forcing.cos - 0.2 * v
    one = System([x, v], [v, push - by_hand * x * x], forcing=forcing, transitions=switches)
    other = System([x, v], [v, push - abs(x) * x], forcing=forcing)
    starts = np.array([[0.5, 0.2], [-0.4, 1.0], [1e-3, -2.0]])
    modes = (starts[:, :1] > 0.0).astype(int)
    first = integrate(one, starts, 20, modes=modes)
    # whatever the mode is said to be
    second = integrate(other, starts, 20, modes=1 - modes)
    assert second.samples == pytest.approx(first.samples, abs=1e-9)
    assert len(second.switches) == len(first.switches) > 20


def test_what_depends_on_a_sign_means_what_numpy_means() -> None:
    a, b = states("a", "b")
    formulas: dict[str, tuple[Any, Callable[[Any, Any], Any]]] = {
        "abs": (abs(a - b), lambda a, b: abs(a - b)),
        "sign": (numpy.sign(a), lambda a, b: np.sign(a)),
        "maximum": (numpy.maximum(a, 2.0 * b), lambda a, b: np.maximum(a, 2.0 * b)),
        "minimum": (numpy.minimum(0.5, b), lambda a, b: np.minimum(0.5, b)),
        "clip": (numpy.clip(a, -0.5, 0.7), lambda a, b: np.clip(a, -0.5, 0.7)),
        "heaviside": (numpy.heaviside(b, 0.5), lambda a, b: np.heaviside(b, 0.5)),
        "both": (
            numpy.where((a > 0.0) & (b <= a), a, b**2),
            lambda a, b: np.where((a > 0.0) & (b <= a), a, b**2),
        ),
        "either": (
            numpy.where((a < 0.0) | ~(b < 0.3), 1.0, a),
            lambda a, b: np.where((a < 0.0) | ~(b < 0.3), 1.0, a),
        ),
        "within": (
            abs(abs(a) - abs(b)),
            lambda a, b: abs(abs(a) - abs(b)),
        ),
    }
    outs = states(*formulas)
    rates = [0.0, 0.0, *(formula for formula, _ in formulas.values())]
    system = System([a, b, *outs], rates, interval=1.0)
    starts = np.array(list(itertools.product((-1.1, -0.2, 0.4, 0.9), repeat=2)))
    run = integrate(system, np.hstack([starts, np.zeros((16, len(outs)))]), 1)
    for number, (_, expected) in enumerate(formulas.values()):
        wanted = np.array([expected(first, second) for first, second in starts])
        assert run.end[:, 2 + number] == pytest.approx(wanted, abs=1e-14)


def test_formulas_in_arrays_switch_entry_by_entry() -> None:
    from saltus.systems import state_array

    q = state_array("q", 3)
    rates = numpy.where(q > 0.0, -q, numpy.array([1.0, 2.0, 3.0]))
    run = integrate(System(q, rates, interval=1.0), [1.0, -4.0, -5.0], 1)
    assert run.end == pytest.approx([np.exp(-1.0), -2.0, -2.0], abs=1e-9)
    assert abs(q)[0].changes
    assert numpy.maximum(q, 0.0).shape == (3,)


def test_a_formula_of_one_mode_is_not_asked_in_others() -> None:
    # the root of a negative number stands in the other mode
    (x,) = states("x")
    system = System([x], [numpy.where(x > 1.0, -numpy.sqrt(x - 1.0) - 1.0, -1.0)], interval=1.0)
    run = integrate(system, [2.0], 3)
    assert run.completed, run.reason


@pytest.mark.parametrize(
    ("formula", "reason"),
    [
        (lambda x: numpy.log(x), "the logarithm of"),
        (lambda x: 1.0 / x, "a division by"),
        (lambda x: numpy.sqrt(x), "a root or power of"),
        (lambda x: x**-0.5, "a root or power of"),
        (lambda x: numpy.arcsin(2.0 - 0.5 * x), "root or power"),
    ],
)
def test_out_of_its_domain_a_member_ends_alone_and_says_by_what(formula: Any, reason: str) -> None:
    x, y = states("x", "y")
    system = System([x, y], [-1.0, formula(x)], interval=2.0)
    run = integrate(system, [[1.0, 0.0], [4.5, 0.0]], 1)
    assert list(run.status) == ["out-of-domain", "completed"]
    assert reason in run.reason[0]
    assert np.isfinite(run.end[0]).all()


@pytest.mark.parametrize(
    ("formula", "instead"),
    [
        (lambda x: numpy.floor(x), "reset"),
        (lambda x: x % 2.0, "reset"),
        (lambda x: x == 1.0, "numpy.where"),
        (lambda x: numpy.arcsinh(x), r"write log\(u \+ sqrt"),
        (lambda x: numpy.log10(x), r"write log\(u\)/log\(10\)"),
        (lambda x: bool(x > 0.0), "numpy.where"),
        (lambda x: max(x, 0.0), "numpy.maximum"),
        (lambda x: numpy.sinc(x), r"sin\(pi"),
    ],
)
def test_what_is_no_formula_is_refused_with_what_to_write(formula: Any, instead: str) -> None:
    with pytest.raises(FormulaError, match=instead):
        formula(states("x")[0])


def test_harmonics_of_a_forcing_have_their_frequency_and_phase() -> None:
    forcing = Forcing(2.0)
    (phase,) = parameters("phase")
    x, y, z = states("x", "y", "z")
    rates = [forcing.harmonic(5, phase=0.4), forcing.harmonic(3, phase=phase), forcing.harmonic(64)]
    system = System([x, y, z], rates, forcing=forcing)
    run = integrate(system, [0.0, 0.0, 0.0], 1, parameters={"phase": -1.2}, samples_per_period=7)
    t = run.time
    assert run.samples[:, 0] == pytest.approx((np.sin(10.0 * t + 0.4) - np.sin(0.4)) / 10.0, abs=1e-9)
    assert run.samples[:, 1] == pytest.approx((np.sin(6.0 * t - 1.2) - np.sin(-1.2)) / 6.0, abs=1e-9)
    assert run.samples[:, 2] == pytest.approx(np.sin(128.0 * t) / 128.0, abs=1e-9)
    assert forcing.harmonic(0).tag == 1.0
    with pytest.raises(ValueError, match="multiple"):
        forcing.harmonic(-1)
    with pytest.raises(DefinitionError, match="must not change with time"):
        forcing.harmonic(1, phase=x)
