"""Operations that make no formula, and what to write instead."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from saltus._errors import FormulaError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["is_refused", "no_formula", "refuse_others", "refusing"]

#: Functions that formulas may hold.
_KNOWN = (
    "sqrt, exp, log, sin, cos, tan, sinh, cosh, tanh, arcsin, arccos, arctan, hypot, abs, sign, "
    "maximum, minimum, clip, heaviside and where"
)

#: Functions whose inverse or composition is known, and what to write.
_INSTEAD = {
    "arcsinh": "log(u + sqrt(u**2 + 1))",
    "arccosh": "log(u + sqrt(u**2 - 1))",
    "arctanh": "0.5 * log((1 + u)/(1 - u))",
    "arctan2": "2 * arctan(y/(sqrt(x**2 + y**2) + x))",
    "cbrt": "sign(u) * abs(u)**(1/3)",
    "deg2rad": "u * pi/180",
    "exp2": "exp(u * log(2))",
    "expm1": "exp(u) - 1",
    "log10": "log(u)/log(10)",
    "log1p": "log(1 + u)",
    "log2": "log(u)/log(2)",
    "rad2deg": "u * 180/pi",
    "sinc": "sin(pi * u)/(pi * u)",
}

#: Operations and functions that ask for the sign of something.
_SWITCHING = {
    "copysign",
    "equal",
    "interp",
    "not_equal",
    "piecewise",
    "signbit",
}
#: Operations that ask how often something fits.
_ROUNDING = {
    "around",
    "ceil",
    "divmod",
    "fix",
    "floor",
    "floor_divide",
    "fmod",
    "modf",
    "remainder",
    "rint",
    "round",
    "trunc",
}

_UNIT = (
    "what depends on a sign switches: write numpy.where(u > 0.0, this, that), or sign, abs, maximum or "
    "minimum; with jumps of states, or modes that outlast their guards, a Unit with transitions"
)
_RESET = (
    "what begins anew is reset: unit.transition('on', 'on', rising=u - 1.0, reset={u: u - 1.0}) of "
    "unit = Unit('on') keeps u below 1, and so with other bounds"
)

_SIGNS = {
    "less": "<",
    "less_equal": "<=",
    "equal": "==",
    "not_equal": "!=",
    "greater": ">",
    "greater_equal": ">=",
    "remainder": "%",
    "floor_divide": "//",
    "bitwise_and": "&",
    "bitwise_or": "|",
    "bitwise_xor": "^",
    "left_shift": "<<",
    "right_shift": ">>",
    "matmul": "@",
    "power": "to the power",
}

#: Python's operators that make no formula, by the names that NumPy has for them.
_OPERATORS = {
    "and": "bitwise_and",
    "divmod": "divmod",
    "floordiv": "floor_divide",
    "lshift": "left_shift",
    "matmul": "matmul",
    "mod": "remainder",
    "or": "bitwise_or",
    "rshift": "right_shift",
    "xor": "bitwise_xor",
}
#: Operators that have no mirror image.
_ALONE = {
    "ceil": "ceil",
    "floor": "floor",
    "invert": "invert",
    "round": "round",
    "trunc": "trunc",
}
#: Methods that Python asks of numbers and lists, as they are written. "getitem" is none of them: NumPy
#: would take an expression for a sequence then, and say so where it needs a number.
_VALUES = {
    "bool": "bool({0})",
    "complex": "complex({0})",
    "contains": "{1} in {0}",
    "float": "float({0})",
    "index": "{0} as a whole number",
    "int": "int({0})",
    "iter": "iter({0})",
}


def refuse_others(expression: type) -> type:
    """Give a class of expressions the operators that make no formula; they raise an error."""
    for name, known_as in (_OPERATORS | _ALONE).items():
        setattr(expression, f"__{name}__", refusing(known_as))
    for name, known_as in _OPERATORS.items():
        setattr(expression, f"__r{name}__", _turned(refusing(known_as)))
    for name, written in _VALUES.items():
        setattr(expression, f"__{name}__", _valueless(written))
    return expression


def refusing(name: str) -> Callable[..., Any]:
    """Give a function that refuses any argument, as `no_formula` does."""

    def refuse(*of: Any) -> Any:
        raise no_formula(name, of)

    return refuse


def _turned(refuse: Callable[..., Any]) -> Callable[..., Any]:
    return lambda second, first: refuse(first, second)


def _valueless(written: str) -> Callable[..., Any]:
    def refuse(*of: Any) -> Any:
        raise FormulaError(
            f"{written.format(*map(repr, of))}: {of[0]!r} is a formula, which has no value before the "
            "system runs. Python's own float(), int(), bool(), if, and, or, max() and min() and the "
            "functions of math take numbers alone, and so do arrays of numbers (one of formulas has "
            f"dtype=object); NumPy's {_KNOWN} may be taken"
        )

    return refuse


def is_refused(name: str) -> bool:
    """Whether a function of that name is refused for any argument."""
    return name in _SWITCHING or name in _ROUNDING


def no_formula(name: str, of: Sequence[Any]) -> FormulaError:
    """Give the error of an operation, by NumPy's name of it, that makes no formula of these."""
    what = _call(name, of)
    if not _changes(of):
        return FormulaError(
            f"{what}: formulas hold sums, products, powers, quotients, {_KNOWN}; "
            "compute other values of parameters beforehand, and give them as parameters of their own"
        )
    if name in _SWITCHING:
        instead = _UNIT
    elif name in _ROUNDING:
        instead = _RESET
    elif name in _INSTEAD:
        instead = f"write {_INSTEAD[name]}"
    else:
        instead = "a further state whose rate is known can stand for another function"
    return FormulaError(f"{what}: formulas hold sums, products, powers, quotients, {_KNOWN}; {instead}")


def _changes(of: Any) -> bool:
    """Whether anything among them changes with time."""
    if isinstance(of, np.ndarray):
        return of.dtype == object and _changes(of.ravel().tolist())
    return any(map(_changes, of)) if isinstance(of, list | tuple) else getattr(of, "changes", False)


def _call(name: str, of: Sequence[Any]) -> str:
    shown = [_shown(one) for one in of]
    if name in _SIGNS and len(shown) == 2:
        return f"{shown[0]} {_SIGNS[name]} {shown[1]}"
    if name == "divide":
        return f"a division by {shown[-1]}"
    return f"{name} of {' and '.join(shown)}"


def _shown(one: Any) -> str:
    if isinstance(one, np.ndarray):
        first = _shown(one.flat[0]) if one.size else ""
        return first if one.ndim == 0 else f"[{first}, ...]"
    return repr(one)
