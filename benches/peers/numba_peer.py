"""Numba: RK4 on a fixed grid with bisection, the algorithm of diffsol/src/rk4.rs in plain loops."""

from __future__ import annotations

import time
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from model import PAIRS, Array, Problem

FIRST = np.array([j for j, _ in PAIRS])
SECOND = np.array([k for _, k in PAIRS])
HALVINGS = 40
PARTS = 8


@njit
def force_of(c, x, cos, sin):
    """F if the leg is in force."""
    n, half = len(c.psi), len(x) // 2
    gap = c.amplitude * cos - x[half - 1]
    rate = -c.amplitude * sin - x[2 * half - 1]
    for j in range(n):
        gap += c.psi[j] * x[j]
        rate += c.psi[j] * x[half + j]
    return c.stiffness * gap + c.damper * rate


@njit
def force_rate(c, x, dx, cos, sin):
    n, half = len(c.psi), len(x) // 2
    rate = -c.amplitude * sin - dx[half - 1]
    second = -c.amplitude * cos - dx[2 * half - 1]
    for j in range(n):
        rate += c.psi[j] * dx[j]
        second += c.psi[j] * dx[half + j]
    return c.stiffness * rate + c.damper * second


@njit
def rates(c, floor, x, cos, sin, squares, tension, dx):
    n, p, half = len(c.psi), c.coupling.shape[0], len(x) // 2
    pairs = len(squares)
    for i in range(pairs):
        squares[i] = x[c.first[i]] * x[c.second[i]]
    for i in range(pairs):
        total = 0.0
        for k in range(pairs):
            total += c.quartic[i, k] * squares[k]
        for k in range(p):
            total += c.tension[i, k] * x[n + k]
        tension[i] = total
    force = force_of(c, x, cos, sin) if floor else 0.0
    drive = cos + c.damping * sin
    for j in range(n):
        rate = x[half + j]
        dx[j] = rate
        dx[half + j] = (
            c.load[j] * drive - c.bending[j] * x[j] - c.damping * rate - c.mass_ratio * c.psi[j] * force
        )
    for i in range(pairs):
        j, k = c.first[i], c.second[i]
        dx[half + j] -= tension[i] * x[k]
        if j != k:
            dx[half + k] -= tension[i] * x[j]
    for i in range(p):
        total = 0.0
        for k in range(p):
            total += c.membrane[i, k] * x[n + k]
        for k in range(pairs):
            total += c.coupling[i, k] * squares[k]
        rate = x[half + n + i]
        dx[n + i] = rate
        dx[half + n + i] = -total - c.damping * rate
    dx[half - 1] = x[2 * half - 1]
    dx[2 * half - 1] = force - c.gravity


@njit
def step(c, floor, x, drive, h, work, out):
    """One RK4 step from `x` to `out`; `drive` has cos and sin at its start, middle and end."""
    k1, k2, k3, k4, y, squares, tension = work
    states = len(x)
    rates(c, floor, x, drive[0, 0], drive[0, 1], squares, tension, k1)
    for i in range(states):
        y[i] = x[i] + 0.5 * h * k1[i]
    rates(c, floor, y, drive[1, 0], drive[1, 1], squares, tension, k2)
    for i in range(states):
        y[i] = x[i] + 0.5 * h * k2[i]
    rates(c, floor, y, drive[1, 0], drive[1, 1], squares, tension, k3)
    for i in range(states):
        y[i] = x[i] + h * k3[i]
    rates(c, floor, y, drive[2, 0], drive[2, 1], squares, tension, k4)
    for i in range(states):
        out[i] = x[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i])


@njit
def locate(floor, f0, d0, f1, d1):
    """Where in 0..1 the cubic through F and h F' at both ends changes sign."""
    curve, twist = 3.0 * (f1 - f0) - 2.0 * d0 - d1, d0 + d1 - 2.0 * (f1 - f0)
    low, high = 0.0, 1.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if (f0 + middle * (d0 + middle * (curve + middle * twist)) > 0.0) == floor:
            low = middle
        else:
            high = middle
    return high


@njit
def set_drive(drive, t, h):
    for i in range(3):
        drive[i, 0], drive[i, 1] = np.cos(t + 0.5 * i * h), np.sin(t + 0.5 * i * h)


@njit
def switch(c, floor, x, end, t, h, drive, work):
    """The rest of a step that ends in the wrong phase, in parts; returns the phase at its end."""
    k1, squares, tension = work[0], work[5], work[6]
    for _ in range(PARTS):
        set_drive(drive, t, h)
        rates(c, floor, x, drive[0, 0], drive[0, 1], squares, tension, k1)
        f0 = force_of(c, x, drive[0, 0], drive[0, 1])
        d0 = h * force_rate(c, x, k1, drive[0, 0], drive[0, 1])
        rates(c, floor, end, drive[2, 0], drive[2, 1], squares, tension, k1)
        f1 = force_of(c, end, drive[2, 0], drive[2, 1])
        d1 = h * force_rate(c, end, k1, drive[2, 0], drive[2, 1])
        part = h * locate(floor, f0, d0, f1, d1)
        set_drive(drive, t, part)
        step(c, floor, x, drive, part, work, end)
        x[:] = end
        floor = not floor
        t, h = t + part, h - part
        set_drive(drive, t, h)
        step(c, floor, x, drive, h, work, end)
        if (force_of(c, end, drive[2, 0], drive[2, 1]) > 0.0) == floor:
            break
    x[:] = end
    return floor


@njit
def run(c, x, steps, periods, keep, samples):
    """Runs `periods` periods; row i of `samples` is the state after period `periods - keep + i`."""
    states = len(x)
    vectors = np.empty((6, states))
    k1, k2, k3, k4, y, end = vectors[0], vectors[1], vectors[2], vectors[3], vectors[4], vectors[5]
    work = (k1, k2, k3, k4, y, np.empty(len(c.first)), np.empty(len(c.first)))
    h = 2.0 * np.pi / steps
    table = np.empty((2 * steps + 1, 2))
    for i in range(2 * steps + 1):
        table[i, 0], table[i, 1] = np.cos(0.5 * i * h), np.sin(0.5 * i * h)
    scratch = np.empty((3, 2))
    floor = force_of(c, x, 1.0, 0.0) > 0.0
    for period in range(periods):
        if period >= periods - keep:
            samples[period - periods + keep] = x
        for i in range(steps):
            drive = table[2 * i : 2 * i + 3]
            step(c, floor, x, drive, h, work, end)
            if (force_of(c, end, drive[2, 0], drive[2, 1]) > 0.0) == floor:
                x, end = end, x
            else:
                floor = switch(c, floor, x, end, i * h, h, scratch, work)
    samples[keep] = x


class Coefficients(NamedTuple):
    """What the compiled functions read; `damper` is for one zeta."""

    bending: Array
    damping: float
    load: Array
    psi: Array
    mass_ratio: float
    quartic: Array
    tension: Array
    coupling: Array
    membrane: Array
    stiffness: float
    damper: float
    gravity: float
    amplitude: float
    first: NDArray[np.int64]
    second: NDArray[np.int64]


@dataclass
class Numba:
    """`setting`: steps in one period of the body on rigid ground."""

    problem: Problem
    setting: float
    compile_seconds: float = 0.0

    def __post_init__(self) -> None:
        begun = time.perf_counter()
        self.run(0.3, 2, 1)
        self.compile_seconds = time.perf_counter() - begun

    def run(self, zeta: float, periods: int, keep: int) -> Array:
        """States after the last `keep` periods and at their start, one row each."""
        problem, pairs = self.problem, len(PAIRS)
        p = problem.in_plane
        coefficients = Coefficients(
            bending=np.array(problem.bending),
            damping=problem.damping,
            load=np.array(problem.load),
            psi=np.array(problem.psi),
            mass_ratio=problem.mass_ratio,
            quartic=np.array(problem.quartic),
            tension=np.array(problem.tension).reshape(pairs, p),
            coupling=np.array(problem.coupling).reshape(p, pairs),
            membrane=np.array(problem.membrane).reshape(p, p),
            stiffness=problem.stiffness,
            damper=2 * zeta * problem.damper,
            gravity=problem.gravity,
            amplitude=problem.amplitude,
            first=FIRST,
            second=SECOND,
        )
        samples = np.empty((keep + 1, 2 * problem.freedoms))
        steps = round(self.setting * problem.damper)
        run(coefficients, problem.initial_state(), steps, periods, keep, samples)
        return samples

    def end(self, zeta: float, periods: int) -> Array:
        """State after so many periods."""
        return self.run(zeta, periods, 0)[-1]
