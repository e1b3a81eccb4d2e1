"""A system written as formulas gives the bits of the same system written in Rust."""

from __future__ import annotations

import platform

import numpy as np
import pytest

from saltus.systems import (
    Forcing,
    System,
    Taylor,
    Unit,
    integrate,
    state_array,
    states,
)

Samples = dict[str, np.ndarray]

pytestmark = pytest.mark.skipif(
    platform.machine() not in ("x86_64", "AMD64"), reason="the bits were kept on x86-64"
)
BASELINE = Taylor(instructions="baseline")


def assert_same(system: System, start: list[float], expected: np.ndarray, **values: float) -> None:
    run = integrate(system, start, 60, parameters=values, method=BASELINE)
    assert (run.samples.ravel().view(np.uint64) == expected.view(np.uint64)).all()


def test_uedas_oscillator(rust_samples: Samples) -> None:
    x, v = states("x", "v")
    forcing = Forcing(1.0)
    system = System([x, v], [v, 7.5 * forcing.cos - 0.05 * v - x**3], forcing=forcing)
    assert_same(system, [2.5, 0.0], rust_samples["ueda"])


def test_a_ball_on_a_table(rust_samples: Samples, ball: System) -> None:
    assert_same(ball, [3.0, 0.0], rust_samples["ball"], A=1.2, e=0.8)


def test_a_bilinear_spring(rust_samples: Samples) -> None:
    x, v = states("x", "v")
    forcing, side = Forcing(1.3), Unit("soft", "stiff")
    stiff = side.choose(soft=0.0, stiff=-9.0) * x
    system = System(
        [x, v],
        [v, forcing.cos - 0.1 * v - x + stiff],
        forcing=forcing,
        transitions=[
            side.transition("soft", "stiff", rising=x),
            side.transition("stiff", "soft", falling=x),
        ],
    )
    assert_same(system, [0.5, 0.0], rust_samples["bilinear"])


def test_a_chain_of_masses_as_arrays(rust_samples: Samples) -> None:
    q, u = state_array("q", 3), state_array("u", 3)
    forcing = Forcing(0.7)
    elongation = np.array([[1, 0, 0], [-1, 1, 0], [0, -1, 1], [0, 0, -1]]) @ q
    force = elongation + elongation**3
    drive = np.array([2.0, 0.0, 0.0]) * forcing.cos
    rates = force[1:] - force[:-1] - 0.05 * u + drive
    system = System([q, u], [u, rates], forcing=forcing)
    start = [0.1, 0.0, -0.2, 0.0, 0.0, 0.0]
    assert_same(system, start, rust_samples["chain"])
