"""Forced piecewise-smooth systems of one's own.

Write the rates of the states as formulas, with NumPy's arrays where there are many of them; say which
guards end a mode and what is reset then; and integrate many members at once, with exactly located
switches.

Examples
--------
Duffing's oscillator, and its stroboscopic section from two starts:

>>> from saltus.systems import Forcing, System, integrate, states
>>> x, v = states("x", "v")
>>> forcing = Forcing(1.0)
>>> rates = [v, 7.5 * forcing.cos - 0.05 * v - x**3]
>>> ueda = System(states=[x, v], rates=rates, forcing=forcing)
>>> run = integrate(ueda, [[2.5, 0.0], [2.6, 0.0]], periods=100)
>>> run.samples.shape
(2, 100, 2)
"""

from saltus.systems._expression import (
    Expression,
    parameter_array,
    parameters,
    state_array,
    states,
)
from saltus.systems._integrate import (
    RungeKutta4,
    Switches,
    Taylor,
    Trajectories,
    integrate,
)
from saltus.systems._lyapunov import Exponents, lyapunov
from saltus.systems._orbit import Orbit, find_orbit
from saltus.systems._switching import Forcing, Transition, Unit
from saltus.systems._system import System

__all__ = [
    "Exponents",
    "Expression",
    "Forcing",
    "Orbit",
    "RungeKutta4",
    "Switches",
    "System",
    "Taylor",
    "Trajectories",
    "Transition",
    "Unit",
    "find_orbit",
    "integrate",
    "lyapunov",
    "parameter_array",
    "parameters",
    "state_array",
    "states",
]
