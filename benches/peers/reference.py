"""The end of the accuracy label by two methods that share no code: the truth errors are measured against."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

from heyoka_peer import Heyoka
from model import PAIRS, Array, Problem

ZETA, RATIO, PERIODS = 0.45, 0.9, 20


def taylor(problem: Problem) -> Array:
    """heyoka at a tolerance below rounding, compensated."""
    precise = Heyoka(
        problem,
        1e-18,
        batch=1,
        high_accuracy=True,
        fast_math=False,
        compact_mode=problem.in_plane > 0,
    )
    return precise.end(ZETA, PERIODS)


def runge_kutta(problem: Problem) -> Array:
    """SciPy's DOP853 with events, one phase after the other, from the same coefficients."""
    n, p, half = problem.transverse, problem.in_plane, problem.freedoms
    psi, load = np.array(problem.psi), np.array(problem.load)
    bending = np.array(problem.bending)
    quartic = np.array(problem.quartic)
    tension = np.array(problem.tension).reshape(len(PAIRS), p)
    membrane = np.array(problem.membrane).reshape(p, p)
    coupling = np.array(problem.coupling).reshape(p, len(PAIRS))
    damper = 2 * ZETA * problem.damper
    first, second = (np.array([pair[side] for pair in PAIRS]) for side in (0, 1))
    table = np.zeros((n, n), dtype=int)
    for index, (j, k) in enumerate(PAIRS):
        table[j, k] = table[k, j] = index

    def force(t: float, x: Array) -> float:
        gap = psi @ x[:n] + problem.amplitude * np.cos(t) - x[half - 1]
        rate = psi @ x[half : half + n] - problem.amplitude * np.sin(t) - x[-1]
        return float(problem.stiffness * gap + damper * rate)

    def rates(t: float, x: Array, floor: bool) -> Array:
        r, q = x[:n], x[n : n + p]
        squares = r[first] * r[second]
        pull = (quartic @ squares + tension @ q)[table] @ r
        f = force(t, x) if floor else 0.0
        drive = np.cos(t) + problem.damping * np.sin(t)
        dx = np.empty_like(x)
        dx[:half] = x[half:]
        dx[half:] = -problem.damping * x[half:]
        dx[half : half + n] += load * drive - bending * r - pull - problem.mass_ratio * psi * f
        dx[half + n : half + n + p] -= membrane @ q + coupling @ squares
        dx[-1] = f - problem.gravity
        return dx

    t, end, x = 0.0, 2 * np.pi * PERIODS, problem.initial_state()
    floor = force(t, x) > 0
    while t < end:

        def event(time: float, state: Array, floor: bool) -> float:
            return force(time, state)

        event.terminal, event.direction = True, -1 if floor else 1
        run = solve_ivp(rates, (t, end), x, "DOP853", events=event, args=(floor,), rtol=1e-12, atol=1e-13)
        t, x = float(run.t[-1]), run.y[:, -1]
        floor = floor if run.status == 0 else not floor
    return x
