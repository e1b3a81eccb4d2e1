"""People who jump on a vibrating plate: what their motion can do in the long run.

A study (`Study`) says which plate, people and base, and what is asked; a function for each
question gives a `Result` with NumPy arrays, tables and figures; `load` reads one from its folder.
``saltus.systems`` takes systems of one's own, ``saltus.dask`` spreads long work over many machines.

Examples
--------
>>> import saltus
>>> study = saltus.Study.paper().set({"plate.inertia": "condensed"})
>>> motion = saltus.simulate(study, periods=50)
>>> motion["z"].shape
(50, 1)
>>> lines = motion.plot()  # doctest: +SKIP
"""

from saltus import _interpreter as _interpreter  # isort: skip (before the native module)
from saltus._commands import (
    attractors,
    basins,
    continue_,
    frequencies,
    lyapunov,
    orbit,
    reproduce,
    simulate,
    sweep,
)
from saltus._commands import map as map  # noqa: A004 (the word of the program)
from saltus._errors import (
    ComputationError,
    DefinitionError,
    FormulaError,
    InternalError,
    ResultError,
    SaltusError,
    StudyError,
    UnknownNameError,
)
from saltus._kept import Rerun, cite, rerun
from saltus._native import __version__
from saltus._parts import Figure, Table, Variable
from saltus._results import Result, load
from saltus._tables import (
    Attractors,
    Axis,
    Base,
    Basins,
    Contact,
    Continue,
    Gravity,
    Jumper,
    Lyapunov,
    Map,
    ModeLists,
    Orbit,
    Plate,
    Second,
    Simulate,
    Solver,
    Start,
    Sweep,
)
from saltus.study import Study

# `map` is left out: it would take the place of Python's own where all names are imported
__all__ = [
    "Attractors",
    "Axis",
    "Base",
    "Basins",
    "ComputationError",
    "Contact",
    "Continue",
    "DefinitionError",
    "Figure",
    "FormulaError",
    "Gravity",
    "InternalError",
    "Jumper",
    "Lyapunov",
    "Map",
    "ModeLists",
    "Orbit",
    "Plate",
    "Rerun",
    "Result",
    "ResultError",
    "SaltusError",
    "Second",
    "Simulate",
    "Solver",
    "Start",
    "Study",
    "StudyError",
    "Sweep",
    "Table",
    "UnknownNameError",
    "Variable",
    "__version__",
    "attractors",
    "basins",
    "cite",
    "continue_",
    "frequencies",
    "load",
    "lyapunov",
    "orbit",
    "reproduce",
    "rerun",
    "simulate",
    "sweep",
]
