"""heyoka: Taylor series compiled for this machine, switches as terminal events."""

from __future__ import annotations

import time
from dataclasses import dataclass

import heyoka as hy
import numpy as np

from model import PAIRS, Array, Problem


def equations(problem: Problem) -> tuple[list, hy.expression]:
    """The vector field and F; par[0] is 1 on the floor and 0 in flight, par[1] is 2 zeta damper.

    The drive is two more states, cos' = -sin and sin' = cos: a seventh faster than cos(t) and sin(t).
    """
    n, p = problem.transverse, problem.in_plane
    r, dr = hy.make_vars(*[f"r{j}" for j in range(n)]), hy.make_vars(*[f"dr{j}" for j in range(n)])
    q = [hy.expression(f"p{i}") for i in range(p)]
    dq = [hy.expression(f"dp{i}") for i in range(p)]
    z, dz = hy.make_vars("z", "dz")
    cos, sin = hy.make_vars("cos", "sin")

    def combine(terms: list[tuple[float, hy.expression]]) -> hy.expression:
        return hy.sum([weight * node for weight, node in terms if weight != 0.0])

    squares = [r[j] * r[k] for j, k in PAIRS]
    tension = {}
    for row, pair in enumerate(PAIRS):
        terms = list(zip(problem.quartic[row], squares)) + list(zip(problem.tension[row], q))
        tension[pair] = combine(terms)
    gap = combine([*zip(problem.psi, r), (problem.amplitude, cos), (-1.0, z)])
    rate = combine([*zip(problem.psi, dr), (-problem.amplitude, sin), (-1.0, dz)])
    force = problem.stiffness * gap + hy.par[1] * rate
    gated = hy.par[0] * force

    system = list(zip(r, dr)) + list(zip(q, dq)) + [(z, dz)]
    for j in range(n):
        elastic = hy.sum([tension[min(j, k), max(j, k)] * r[k] for k in range(n)])
        linear = [
            (-problem.bending[j], r[j]),
            (-problem.damping, dr[j]),
            (problem.load[j], cos),
            (problem.load[j] * problem.damping, sin),
            (-problem.mass_ratio * problem.psi[j], gated),
        ]
        system.append((dr[j], combine(linear) - elastic))
    for i in range(p):
        terms = [*zip(problem.membrane[i], q), *zip(problem.coupling[i], squares)]
        system.append((dq[i], -combine(terms) - problem.damping * dq[i]))
    system.append((dz, gated - problem.gravity))
    system += [(cos, -sin), (sin, 1.0 * cos)]
    return system, force


@dataclass
class Heyoka:
    """One compiled integrator; `batch` trajectories at a time."""

    problem: Problem
    tolerance: float
    batch: int = 8
    high_accuracy: bool = False
    fast_math: bool = True
    compact_mode: bool = False

    def __post_init__(self) -> None:
        begun = time.perf_counter()
        system, force = equations(self.problem)
        states = 2 * self.problem.freedoms + 2
        options = {
            "tol": self.tolerance,
            "high_accuracy": self.high_accuracy,
            "fast_math": self.fast_math,
            "compact_mode": self.compact_mode,
        }
        if self.batch == 1:

            def flip(ta, sign: int) -> bool:
                ta.pars[0] = 1.0 if sign > 0 else 0.0
                return True

            event = hy.t_event(force, callback=flip)
            self.ta = hy.taylor_adaptive(
                system, np.zeros(states), t_events=[event], pars=[0.0, 0.0], **options
            )
        else:

            def flip_lane(ta, sign: int, lane: int) -> bool:
                ta.pars[0, lane] = 1.0 if sign > 0 else 0.0
                return True

            event = hy.t_event_batch(force, callback=flip_lane)
            self.ta = hy.taylor_adaptive_batch(
                system,
                np.zeros((states, self.batch)),
                t_events=[event],
                pars=np.zeros((2, self.batch)),
                **options,
            )
        self.order = self.ta.order
        self.compile_seconds = time.perf_counter() - begun

    def start(self, zetas: Array) -> None:
        """At rest, body at the start of the work (it starts in flight)."""
        ta, initial = self.ta, np.append(self.problem.initial_state(), [1.0, 0.0])
        if self.batch == 1:
            ta.time, ta.state[:] = 0.0, initial
            ta.pars[:] = 0.0, 2 * zetas[0] * self.problem.damper
        else:
            ta.set_time(0.0)
            ta.state[:] = initial[:, None]
            ta.pars[0], ta.pars[1] = 0.0, 2 * zetas * self.problem.damper
        ta.reset_cooldowns()

    def run(self, zetas: Array, periods: int, keep: int) -> Array:
        """z of the last `keep` stroboscopic samples, one column a trajectory."""
        self.start(zetas)
        first = periods - keep
        if first > 0:
            self.ta.propagate_until(2 * np.pi * first)
        times = 2 * np.pi * np.arange(first, periods + 1)
        grid = times if self.batch == 1 else np.repeat(times[:, None], self.batch, axis=1)
        samples = self.ta.propagate_grid(grid)[-1]
        return samples[1:, self.problem.freedoms - 1].reshape(keep, self.batch)

    def end(self, zeta: float, periods: int) -> Array:
        """State after so many periods."""
        self.start(np.full(self.batch, zeta))
        self.ta.propagate_until(2 * np.pi * periods)
        return self.ta.state.reshape(-1, self.batch)[: 2 * self.problem.freedoms, 0].copy()
