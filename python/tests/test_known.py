"""Systems of the literature as formulas: each has an answer that somebody else knows."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from saltus.systems import Forcing, System, Unit, find_orbit, integrate, parameters, states

#: NumPy's types do not know that its functions take formulas.
numpy: Any = np


def buck_converter() -> System:
    """The voltage-controlled buck converter; one period of its ramp is one period of the forcing."""
    resistance, inductance, capacitance, period = 22.0, 20e-3, 47e-6, 400e-6
    gain, reference, low, high = 8.4, 11.3, 3.8, 8.2
    voltage, current, ramp = states("voltage", "current", "ramp")
    (supply,) = parameters("supply")
    clock, half = Forcing(2.0 * np.pi / period), Unit("first", "second")
    begins_anew = [
        half.transition("first", "second", falling=clock.sin),
        half.transition("second", "first", rising=clock.sin, reset={ramp: low}),
    ]
    conducts = gain * (voltage - reference) < ramp
    rates = [
        -voltage / (resistance * capacitance) + current / capacitance,
        -voltage / inductance + numpy.where(conducts, supply / inductance, 0.0),
        (high - low) / period,
    ]
    return System([voltage, current, ramp], rates, forcing=clock, transitions=begins_anew)


def test_a_buck_converter_doubles_its_period_where_it_is_known_to() -> None:
    # 24.516 V: di Bernardo, Garofalo, Glielmo & Vasca, IEEE Trans. Circuits Syst. I 45 (1998) 133
    converter = buck_converter()
    start = integrate(converter, [12.0, 0.6, 3.8], 400, parameters={"supply": 24.0}).end

    def smallest(supply: float) -> float:
        orbit = find_orbit(converter, start, parameters={"supply": supply})
        # the clock sets the ramp
        assert np.abs(orbit.multipliers).min() < 1e-9
        return float(orbit.multipliers.real.min()) + 1.0

    ends = [24.5, 24.53]
    values = [smallest(supply) for supply in ends]
    for _ in range(4):
        ends.append(ends[-1] - values[-1] * (ends[-1] - ends[-2]) / (values[-1] - values[-2]))
        values.append(smallest(ends[-1]))
    assert ends[-1] == pytest.approx(24.516, abs=1e-3)


@pytest.mark.parametrize(("static", "kinetic", "belt"), [(1.0, 0.5, 0.4), (0.8, 0.2, 1.0)])
def test_a_block_on_a_belt_sticks_and_slips_for_as_long_as_its_formula_says(
    static: float, kinetic: float, belt: float
) -> None:
    # x'' = -x + friction on a belt of this speed: it slips at x = static, swings about x = kinetic, and
    # sticks again where it is as fast as the belt, at 2 kinetic - static
    x, v = states("x", "v")
    contact = Unit("stick", "slip")
    rates = [
        contact.choose(stick=belt, slip=v),
        contact.choose(stick=0.0, slip=kinetic - x),
    ]
    transitions = [
        contact.transition("stick", "slip", rising=x - static, reset={v: belt}),
        contact.transition("slip", "stick", rising=v - belt, reset={v: belt}),
    ]
    block = System([x, v], rates, interval=1.0, transitions=transitions)
    run = integrate(block, [0.0, belt], 60)
    assert run.completed, run.reason
    begins = run.switches.time[run.switches.target == 1]
    sticks = run.switches.time[run.switches.target == 0]
    drop = static - kinetic
    slip = 2.0 * np.pi - 2.0 * np.arctan2(drop, belt)
    assert sticks[:5] - begins[:5] == pytest.approx(np.full(5, slip), abs=1e-9)
    assert np.diff(begins) == pytest.approx(np.full(len(begins) - 1, slip + 2.0 * drop / belt), abs=1e-9)


def test_a_pendulum_that_meets_a_wall_keeps_its_time() -> None:
    # an elastic wall at the bottom halves the period of the swing, 4 K(sin(angle/2)); mpmath's K
    import mpmath

    angle, speed = states("angle", "speed")
    wall = Unit("swing")
    hit = wall.transition("swing", "swing", falling=angle, reset={speed: -speed})
    pendulum = System([angle, speed], [speed, -numpy.sin(angle)], interval=1.0, transitions=[hit])
    for highest in (0.5, 1.5, 3.0):
        run = integrate(pendulum, [highest, 0.0], 60)
        quarter = float(mpmath.ellipk(np.sin(0.5 * highest) ** 2))
        exact = quarter * (1.0 + 2.0 * np.arange(len(run.switches)))
        assert len(exact) > 5
        assert run.switches.time == pytest.approx(exact, abs=1e-7)


def test_stribeck_friction_loses_its_equilibrium_where_the_slope_of_its_force_vanishes() -> None:
    # x'' = -x - 2 zeta x' + N mu(belt - x'): at rest the damping is 2 zeta + N mu'(belt)
    x, v = states("x", "v")
    (belt,) = parameters("belt")
    slip = belt - v
    mu = (0.3 + 0.2 * numpy.exp(-abs(slip))) * numpy.tanh(20.0 * slip)
    block = System([x, v], [v, -x - 0.08 * v + mu], interval=2.0 * np.pi)
    # 0.08 = 0.2 exp(-belt) at ln 2.5, where the tangent hyperbolic is 1 to 1e-15
    critical = np.log(2.5)
    for speed, grows in ((critical + 0.1, False), (critical - 0.1, True)):
        rest = 0.3 + 0.2 * np.exp(-speed)
        run = integrate(block, [rest + 1e-3, 0.0], 60, parameters={"belt": speed})
        away = np.hypot(run.samples[:, 0] - rest, run.samples[:, 1])
        assert bool(away[-1] > away[0]) is grows
