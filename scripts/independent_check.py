#!/usr/bin/env python3
"""The paper's case once more, by other means: the numbers in crates/saltus/tests/main/independent.rs.

Shares nothing with saltus but the equations of docs/model.md: tensors by Gauss quadrature of the
strains in NumPy instead of closed forms, SciPy's DOP853 with events instead of Taylor series.
Condensed model, contact law "reaction-force", plate at rest, z/eta = 3, z'/(eta omega_h) = 2.

    pip install numpy scipy
    python3 scripts/independent_check.py
"""

from itertools import permutations

import numpy as np
from scipy.integrate import solve_ivp

a, b, h = 14.0, 10.0, 0.1
young, density, nu, zeta_p = 27e9, 2500.0, 0.2, 0.02
mass, stiffness, gravity, amplitude = 76.64, 18600.0, 9.81, 0.013
U = [(2, 1), (2, 3), (4, 1), (4, 3), (6, 1), (8, 1)]
V = [(1, 2), (1, 4), (1, 6), (1, 8), (3, 2), (3, 4)]
W = [(1, 1), (1, 3), (3, 1), (3, 3)]

nodes, weights = np.polynomial.legendre.leggauss(60)
X, Y = (nodes + 1) * a / 2, (nodes + 1) * b / 2
AREA = np.outer(weights * a / 2, weights * b / 2)


def integral(field):
    return (field * AREA).sum()


def sine(m, length, t, derivative):
    k = m * np.pi / length
    return k * np.cos(k * t) if derivative else np.sin(k * t)


def term(mode, dx, dy):
    return np.outer(sine(mode[0], a, X, dx), sine(mode[1], b, Y, dy))


extension = young * h / (1 - nu**2)
zero = np.zeros_like(AREA)
# Membrane strains (e_x, e_y, gamma) of each in-plane term, and of each pair of transverse terms.
linear = [(term(m, 1, 0), zero, term(m, 0, 1)) for m in U]
linear += [(zero, term(m, 0, 1), term(m, 1, 0)) for m in V]
slopes = [(term(m, 1, 0), term(m, 0, 1)) for m in W]


def quadratic(j, k):
    (xj, yj), (xk, yk) = slopes[j], slopes[k]
    return xj * xk / 2, yj * yk / 2, (xj * yk + xk * yj) / 2


def energy(s, t):
    """Bilinear form of twice the membrane energy."""
    density_ = s[0] * t[0] + s[1] * t[1] + nu * (s[0] * t[1] + s[1] * t[0])
    return extension * integral(density_ + (1 - nu) / 2 * s[2] * t[2])


n, p = len(W), len(linear)
pairs = [[quadratic(j, k) for k in range(n)] for j in range(n)]
K = np.array([[energy(s, t) for t in linear] for s in linear])
B = np.array([[[energy(s, pairs[j][k]) for k in range(n)] for j in range(n)] for s in linear])
Q = np.array(
    [[[[energy(pairs[j][k], pairs[i][m]) / 2 for m in range(n)] for i in range(n)] for k in range(n)] for j in range(n)]
)
flexible = np.einsum("ijk,ilm->jklm", B, np.linalg.solve(K, B.reshape(p, -1)).reshape(p, n, n))
Q = Q - flexible / 2
Q = sum(np.transpose(Q, order) for order in permutations(range(4))) / 24

bending = extension * h**2 / 12
modal = density * h * a * b / 4
omegas = np.array([np.pi**2 * ((m / a) ** 2 + (k / b) ** 2) * np.sqrt(bending / (density * h)) for m, k in W])
damping = 2 * zeta_p * omegas[0]
load = np.array([16 * modal / (np.pi**2 * m * k) for m, k in W])
psi = np.array([np.sin(m * np.pi / 2) * np.sin(k * np.pi / 2) for m, k in W])

legs = np.append(psi, -1.0)
masses = np.append(np.full(n, modal), mass)
coupled = np.diag(np.append(modal * omegas**2, 0.0)) + stiffness * np.outer(legs, legs)
occupied = np.sqrt(np.linalg.eigvalsh(coupled / np.sqrt(np.outer(masses, masses))))
eta, omega_h = gravity * mass / stiffness, np.sqrt(stiffness / mass)


def section(zeta, ratio, periods):
    """z/eta and z'/(eta omega_h) after the given number of periods."""
    omega = ratio * occupied[1]
    period = 2 * np.pi / omega
    damper = 2 * zeta * np.sqrt(stiffness * mass)

    def force(t, s):
        gap = psi @ s[:n] + amplitude * np.cos(omega * t) - s[2 * n]
        rate = psi @ s[n : 2 * n] - amplitude * omega * np.sin(omega * t) - s[2 * n + 1]
        return stiffness * gap + damper * rate

    def field(contact):
        def rates(t, s):
            r, dr = s[:n], s[n : 2 * n]
            f = force(t, s) if contact else 0.0
            base = amplitude * (omega**2 * np.cos(omega * t) + damping * omega * np.sin(omega * t))
            elastic = modal * omegas**2 * r + 4 * np.einsum("jklm,k,l,m->j", Q, r, r, r)
            ddr = (load * base - elastic - psi * f) / modal - damping * dr
            return np.concatenate([dr, ddr, [s[2 * n + 1], f / mass - gravity]])

        return rates

    s = np.zeros(2 * n + 2)
    s[2 * n :] = 3 * eta, 2 * eta * omega_h
    t, contact = 0.0, force(0.0, s) > 0
    for k in range(periods):
        while t < (k + 1) * period:
            def event(time, state):
                return force(time, state)

            event.terminal, event.direction = True, -1 if contact else 1
            run = solve_ivp(
                field(contact), (t, (k + 1) * period), s, method="DOP853", rtol=1e-12, atol=1e-14, events=event
            )
            t, s = run.t[-1], run.y[:, -1]
            contact = not contact if run.status == 1 else contact
    return s[2 * n] / eta, s[2 * n + 1] / (eta * omega_h), *(s[:n] / h)


print("occupied frequencies (Hz):", occupied / (2 * np.pi))
for zeta, ratio in [(0.45, 0.9), (0.28, 1.0)]:
    values = ", ".join(f"{value:.12f}" for value in section(zeta, ratio, 20))
    print(f"zeta_h {zeta}, Omega {ratio}: {values}")
