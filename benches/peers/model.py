"""The paper's case as numbers for every program of the comparison.

Coefficients by Gauss quadrature of the strains, sharing nothing with saltus but the equations of
docs/model.md. Lengths in plate thicknesses h, time tau = Omega t, contact law "reaction-force":

    R'' = -bending R - damping R' - T R + load (cos tau + damping sin tau) - mass_ratio psi F
    P'' = -membrane P - coupling s - damping P'             (full model only)
    Z'' = F - gravity
    F   = max(0, stiffness d + 2 zeta damper d'),   d = psi R + amplitude cos tau - Z

with s the ten products R_j R_k (j <= k) and T_jk = quartic s + tension P.
"""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from functools import cache
from itertools import permutations
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

LENGTH, WIDTH, THICKNESS = 14.0, 10.0, 0.1
YOUNG, DENSITY, POISSON, PLATE_DAMPING = 27e9, 2500.0, 0.2, 0.02
MASS, STIFFNESS, GRAVITY, BASE_AMPLITUDE = 76.64, 18600.0, 9.81, 0.013
U = [(2, 1), (2, 3), (4, 1), (4, 3), (6, 1), (8, 1)]
V = [(1, 2), (1, 4), (1, 6), (1, 8), (3, 2), (3, 4)]
W = [(1, 1), (1, 3), (3, 1), (3, 3)]

PAIRS = [(j, k) for k in range(len(W)) for j in range(k + 1)]


@dataclass(frozen=True)
class Problem:
    """All coefficients at one frequency ratio; zeta enters only where F is computed."""

    bending: list[float]
    damping: float
    load: list[float]
    psi: list[float]
    mass_ratio: float
    quartic: list[list[float]]  # pairs x pairs
    tension: list[list[float]]  # pairs x in-plane, empty rows in the condensed model
    coupling: list[list[float]]  # in-plane x pairs
    membrane: list[list[float]]  # in-plane x in-plane
    stiffness: float
    damper: float
    gravity: float
    amplitude: float
    start: tuple[float, float]  # Z, Z'
    unit_z: float  # eta / h, the unit of z in the error norm

    @property
    def transverse(self) -> int:
        return len(self.bending)

    @property
    def in_plane(self) -> int:
        return len(self.coupling)

    @property
    def freedoms(self) -> int:
        return self.transverse + self.in_plane + 1

    def initial_state(self) -> Array:
        """R, P, Z, then their rates: plate at rest, body at `start`."""
        state = np.zeros(2 * self.freedoms)
        state[self.freedoms - 1], state[-1] = self.start
        return state

    def norm(self, difference: Array) -> float:
        """Largest of r/h, r'/(h Omega), z/eta, z'/(eta Omega)."""
        n, r = self.freedoms, self.transverse
        plate = np.concatenate([difference[:r], difference[n : n + r]])
        body = np.array([difference[n - 1], difference[-1]]) / self.unit_z
        return float(np.max(np.abs(np.concatenate([plate, body]))))


def sine(m: int, length: float, t: Array, derivative: bool) -> Array:
    k = m * np.pi / length
    return k * np.cos(k * t) if derivative else np.sin(k * t)


@cache
def plate() -> tuple[Array, Array, Array]:
    """K, B and the raw Q of the elastic energy, in SI units."""
    nodes, weights = np.polynomial.legendre.leggauss(60)
    x, y = (nodes + 1) * LENGTH / 2, (nodes + 1) * WIDTH / 2
    area = np.outer(weights * LENGTH / 2, weights * WIDTH / 2)
    extension = YOUNG * THICKNESS / (1 - POISSON**2)

    def term(mode: tuple[int, int], dx: bool, dy: bool) -> Array:
        return np.outer(sine(mode[0], LENGTH, x, dx), sine(mode[1], WIDTH, y, dy))

    def energy(s: tuple[Array, ...], t: tuple[Array, ...]) -> float:
        """Bilinear form of twice the membrane energy, of two strain fields (e_x, e_y, gamma)."""
        density = s[0] * t[0] + s[1] * t[1] + POISSON * (s[0] * t[1] + s[1] * t[0])
        return float(extension * ((density + (1 - POISSON) / 2 * s[2] * t[2]) * area).sum())

    zero = np.zeros_like(area)
    linear = [(term(m, True, False), zero, term(m, False, True)) for m in U]
    linear += [(zero, term(m, False, True), term(m, True, False)) for m in V]
    slopes = [(term(m, True, False), term(m, False, True)) for m in W]

    def quadratic(j: int, k: int) -> tuple[Array, Array, Array]:
        (xj, yj), (xk, yk) = slopes[j], slopes[k]
        return xj * xk / 2, yj * yk / 2, (xj * yk + xk * yj) / 2

    n = range(len(W))
    pairs = [[quadratic(j, k) for k in n] for j in n]
    membrane = np.array([[energy(s, t) for t in linear] for s in linear])
    coupling = np.array([[[energy(s, pairs[j][k]) for k in n] for j in n] for s in linear])
    quartic = np.array(
        [[[[energy(pairs[j][k], pairs[i][m]) / 2 for m in n] for i in n] for k in n] for j in n]
    )
    return membrane, coupling, quartic


def problem(inertia: str, ratio: float) -> Problem:
    """`inertia` is "condensed" or "full"; `ratio` is Omega over the occupied body frequency."""
    membrane, coupling, quartic = plate()
    p, n = len(membrane), len(W)
    if inertia == "condensed":
        flexible = np.linalg.solve(membrane, coupling.reshape(p, -1)).reshape(p, n, n)
        quartic = quartic - np.einsum("ijk,ilm->jklm", coupling, flexible) / 2
        p = 0
    quartic = sum(np.transpose(quartic, order) for order in permutations(range(4))) / 24

    rigidity = YOUNG * THICKNESS**3 / (12 * (1 - POISSON**2))
    modal = DENSITY * THICKNESS * LENGTH * WIDTH / 4
    omegas = np.array([np.pi**2 * ((m / LENGTH) ** 2 + (k / WIDTH) ** 2) for m, k in W])
    omegas *= np.sqrt(rigidity / (DENSITY * THICKNESS))
    psi = np.array([np.sin(m * np.pi / 2) * np.sin(k * np.pi / 2) for m, k in W])

    legs, masses = np.append(psi, -1.0), np.append(np.full(n, modal), MASS)
    coupled = np.diag(np.append(modal * omegas**2, 0.0)) + STIFFNESS * np.outer(legs, legs)
    occupied = np.sqrt(np.linalg.eigvalsh(coupled / np.sqrt(np.outer(masses, masses))))
    omega = ratio * occupied[1]
    omega_h, eta = np.sqrt(STIFFNESS / MASS), GRAVITY * MASS / STIFFNESS

    per_mass = 1 / (modal * omega**2)
    orders = np.array([1.0 if j == k else 2.0 for j, k in PAIRS])
    rows = np.array([[quartic[j, k, i, m] for i, m in PAIRS] for j, k in PAIRS])
    mixed = np.array([[coupling[i, j, k] for j, k in PAIRS] for i in range(p)]).reshape(p, len(PAIRS))
    amplitude = BASE_AMPLITUDE / THICKNESS

    def clean(matrix: Array) -> list[list[float]]:
        """Entries that are zero but for rounding made zero."""
        scale = np.abs(matrix).max(initial=0.0)
        return np.where(np.abs(matrix) > 1e-13 * scale, matrix, 0.0).tolist()

    return Problem(
        bending=(omegas**2 / omega**2).tolist(),
        damping=float(2 * PLATE_DAMPING * omegas[0] / omega),
        load=[float(16 / (np.pi**2 * m * k) * amplitude) for m, k in W],
        psi=psi.tolist(),
        mass_ratio=MASS / modal,
        quartic=clean(4 * rows * orders * THICKNESS**2 * per_mass),
        tension=clean(2 * mixed.T * THICKNESS * per_mass),
        coupling=clean(mixed * orders * THICKNESS * per_mass),
        membrane=clean(membrane[:p, :p] * per_mass),
        stiffness=float((omega_h / omega) ** 2),
        damper=float(omega_h / omega),
        gravity=float(GRAVITY / (THICKNESS * omega**2)),
        amplitude=amplitude,
        start=(float(3 * eta / THICKNESS), float(2 * eta * omega_h / (THICKNESS * omega))),
        unit_z=float(eta / THICKNESS),
    )


def write(path: Path, problem: Problem, **more: object) -> None:
    """The problem as JSON, with more keys beside it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(asdict(problem) | more, indent=1))
