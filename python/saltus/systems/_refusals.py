"""Operations that make no formula, and what to write instead."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from saltus._errors import FormulaError

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

__all__ = ["is_refused", "no_formula", "refuse_others", "refusing"]

#: Functions that formulas of parameters may hold.
_KNOWN = "sqrt, exp, log, sin, cos, tan, arctan and abs"

_TWO = "let two further states s and c stand for {} and {}, with the rates c * u' and {}s * u'"
_ONE = "let a further state y stand for it, with the rate {} * u'"
_ROOT = "let two further states stand for it, r = {} with the rate {} * u', and y with the rate {} * u'"

#: States to take instead of a function of a state u: their rates are formulas; u' is the rate of u.
_STATES = {
    "exp": _ONE.format("y"),
    "expm1": _ONE.format("(1 + y)"),
    "log": _ROOT.format("1/u", "-r**2", "r"),
    "sqrt": _ROOT.format("1/sqrt(u)", "-0.5 * r**3", "0.5 * r"),
    "sin": _TWO.format("sin(u)", "cos(u)", "-"),
    "cos": _TWO.format("sin(u)", "cos(u)", "-"),
    "sinh": _TWO.format("cosh(u)", "sinh(u)", ""),
    "cosh": _TWO.format("cosh(u)", "sinh(u)", ""),
    "tan": _ONE.format("(1 + y**2)"),
    "tanh": _ONE.format("(1 - y**2)"),
    "arctan": _ROOT.format("1/(1 + u**2)", "-2 * u * r**2", "r"),
    "reciprocal": _ONE.format("-y**2"),
}
_STATES["divide"] = "let a further state y stand for one over it, with the rate -y**2 * u'"
_STATES["power"] = (
    "whole powers from 0 to 64 are possible; for others let a further state stand, such as y = 1/u "
    "with the rate -y**2 * u'"
)
_START = "; u' is the rate of u = {}, and what resets u resets them too"

#: Operations and functions that ask for the sign of something.
_SWITCHING = {
    "absolute",
    "clip",
    "copysign",
    "equal",
    "fabs",
    "fmax",
    "fmin",
    "greater",
    "greater_equal",
    "heaviside",
    "interp",
    "less",
    "less_equal",
    "maximum",
    "minimum",
    "not_equal",
    "piecewise",
    "sign",
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
    "what depends on a sign switches: with side = Unit('below', 'above') write side.choose(below=..., "
    "above=...), and let side.transition('below', 'above', rising=u) and side.transition('above', "
    "'below', falling=u) switch it where the difference u of the two is 0"
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
    "ge": "greater_equal",
    "gt": "greater",
    "invert": "invert",
    "le": "less_equal",
    "lt": "less",
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
            f"dtype=object); of parameters NumPy's {_KNOWN} may be taken; what switches is a Unit with "
            "guards"
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
            f"{what}: formulas of parameters hold sums, products, powers and quotients, {_KNOWN}; "
            "compute other values beforehand, and give them as parameters of their own"
        )
    if name in _SWITCHING:
        instead = _UNIT
    elif name in _ROUNDING:
        instead = _RESET
    elif name in _STATES:
        instead = _STATES[name] + _START.format(_shown(of[-1] if name == "divide" else of[0]))
    else:
        instead = "a further state whose rate is known can stand for another function"
    return FormulaError(
        f"{what}: a system is made of sums, products and whole powers of its states; {instead}"
    )


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
