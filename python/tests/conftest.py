"""Common beginnings of several tests."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from saltus.systems import Forcing, System, Unit, parameters, states


@pytest.fixture(scope="session")
def rust_samples() -> dict[str, NDArray[np.float64]]:
    """Samples of systems written with the engine's builder, 60 periods each."""
    text = (Path(__file__).parent / "data" / "samples.txt").read_text()
    out = {}
    for line in text.splitlines():
        name, *bits = line.split()
        out[name] = np.array([int(one, 16) for one in bits], dtype=np.uint64).view(np.float64)
    return out


@pytest.fixture(scope="session")
def duffing() -> System:
    """x'' + 0.2 x' + x + x^3 = f cos(omega t)."""
    x, v = states("x", "v")
    f, omega = parameters("f", "omega")
    forcing = Forcing(omega)
    return System([x, v], [v, f * forcing.cos - 0.2 * v - x - x**3], forcing=forcing)


@pytest.fixture(scope="session")
def ball() -> System:
    """A ball under gravity 1 with restitution e on a table at -A cos t."""
    y, v = states("y", "v")
    a, e = parameters("A", "e")
    table, unit = Forcing(1.0), Unit("flight")
    rebound = -e * v + (1.0 + e) * a * table.sin
    bounce = unit.transition("flight", "flight", falling=y + a * table.cos, reset={v: rebound})
    return System([y, v], [v, -1.0], forcing=table, transitions=[bounce])
