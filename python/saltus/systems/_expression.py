"""Formulas of states, parameters and the forcing."""

from __future__ import annotations

import math
from numbers import Real
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from saltus._errors import DefinitionError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

__all__ = [
    "Expression",
    "ExpressionLike",
    "expression",
    "parameter_array",
    "parameters",
    "state_array",
    "states",
]

#: Larger powers of a state are no models of anything.
MAX_POWER = 64
#: How deep a formula is printed.
_SHOWN = 6


class Expression:
    """A formula: sums, products and whole powers of states, with numbers and parameters.

    Made by `states`, `parameters`, `Forcing` and by calculating with what they give; arrays of
    expressions are NumPy arrays of objects, so that ``K @ x`` and `numpy.einsum` work. Formulas of
    parameters alone may hold any power and quotient, and `numpy.sqrt`, `numpy.exp`, `numpy.log`,
    `numpy.sin`, `numpy.cos`, `numpy.tan`, `numpy.arctan` and `abs`.

    Expressions are compared by identity, and have no truth value.
    """

    __slots__ = ("changes", "of", "operation", "tag")

    def __init__(
        self, operation: str, of: tuple[Expression, ...] = (), tag: Any = None, *, changes: bool
    ) -> None:
        self.operation = operation
        self.of = of
        #: The number, the name, or what the expression belongs to.
        self.tag = tag
        #: Whether it changes with time.
        self.changes = changes

    def __add__(self, other: ExpressionLike) -> Expression:
        """Sum."""
        return _binary("add", self, other)  # type: ignore[no-any-return]

    def __radd__(self, other: ExpressionLike) -> Expression:
        """Sum."""
        return _binary("add", other, self)  # type: ignore[no-any-return]

    def __sub__(self, other: ExpressionLike) -> Expression:
        """Difference."""
        return _binary("subtract", self, other)  # type: ignore[no-any-return]

    def __rsub__(self, other: ExpressionLike) -> Expression:
        """Difference."""
        return _binary("subtract", other, self)  # type: ignore[no-any-return]

    def __mul__(self, other: ExpressionLike) -> Expression:
        """Product."""
        return _binary("multiply", self, other)  # type: ignore[no-any-return]

    def __rmul__(self, other: ExpressionLike) -> Expression:
        """Product."""
        return _binary("multiply", other, self)  # type: ignore[no-any-return]

    def __truediv__(self, other: ExpressionLike) -> Expression:
        """Quotient; the divisor must not change with time."""
        return _binary("divide", self, other)  # type: ignore[no-any-return]

    def __rtruediv__(self, other: ExpressionLike) -> Expression:
        """Quotient; the divisor must not change with time."""
        return _binary("divide", other, self)  # type: ignore[no-any-return]

    def __pow__(self, other: ExpressionLike) -> Expression:
        """Power; of what changes with time, a whole one from 0 to 64."""
        return _binary("power", self, other)  # type: ignore[no-any-return]

    def __rpow__(self, other: ExpressionLike) -> Expression:
        """Power of a number."""
        return _binary("power", other, self)  # type: ignore[no-any-return]

    def __neg__(self) -> Expression:
        """Negative."""
        return Expression("negative", (self,), changes=self.changes)

    def __pos__(self) -> Expression:
        """Return the same."""
        return self

    def __abs__(self) -> Expression:
        """Absolute value, of what does not change with time."""
        return self._function("absolute")

    # numpy.sqrt(p) and its sisters call these.
    def sqrt(self) -> Expression:
        """Square root, of what does not change with time."""
        return self._function("sqrt")

    def exp(self) -> Expression:
        """Exponential, of what does not change with time."""
        return self._function("exp")

    def log(self) -> Expression:
        """Natural logarithm, of what does not change with time."""
        return self._function("log")

    def sin(self) -> Expression:
        """Sine, of what does not change with time."""
        return self._function("sin")

    def cos(self) -> Expression:
        """Cosine, of what does not change with time."""
        return self._function("cos")

    def tan(self) -> Expression:
        """Tangent, of what does not change with time."""
        return self._function("tan")

    def arctan(self) -> Expression:
        """Inverse tangent, of what does not change with time."""
        return self._function("arctan")

    def _function(self, name: str) -> Expression:
        if self.changes:
            raise DefinitionError(_not_polynomial(f"{name} of {self!r}"))
        return Expression(name, (self,), changes=False)

    def __bool__(self) -> bool:
        """Raise TypeError: what switches is a `Unit`."""
        raise TypeError(
            f"whether {self!r} is zero is not known before the system runs; "
            "what switches is a Unit with guards"
        )

    def __repr__(self) -> str:
        """Show the formula, shortened if it is long."""
        return _shown(self, _SHOWN)


#: What may stand in a formula.
ExpressionLike: TypeAlias = Expression | float | np.floating[Any] | np.integer[Any]


def states(*names: str) -> tuple[Expression, ...]:
    """States of a system, one for each name.

    Examples
    --------
    >>> x, v = states("x", "v")
    >>> -x - 0.1 * v
    ((-x) - (0.1 * v))
    """
    return tuple(Expression("state", tag=name, changes=True) for name in names)


def state_array(name: str, shape: int | tuple[int, ...]) -> NDArray[np.object_]:
    """Give an array of states, ``name[0]``, ``name[1]``, ...

    Parameters
    ----------
    name : str
        What they are called.
    shape : int or tuple of int
        Shape of the array.

    Returns
    -------
    ndarray of Expression
    """
    return _named(name, shape, lambda label: Expression("state", tag=label, changes=True))


def parameters(*names: str) -> tuple[Expression, ...]:
    """Parameters of a system, one for each name; each member of a run may have other values."""
    return tuple(Expression("parameter", tag=(name, ()), changes=False) for name in names)


def parameter_array(name: str, shape: int | tuple[int, ...]) -> NDArray[np.object_]:
    """Give an array of parameters under one name.

    Parameters
    ----------
    name : str
        What it is called; the values are given under this name, as an array of this shape.
    shape : int or tuple of int
        Shape of the array.

    Returns
    -------
    ndarray of Expression
    """
    whole = (shape,) if isinstance(shape, int) else tuple(shape)
    array = np.empty(whole, dtype=object)
    for place, index in enumerate(np.ndindex(whole)):
        array[index] = Expression("parameter", tag=(name, whole, place), changes=False)
    return array


def expression(value: ExpressionLike) -> Expression:
    """Return a number or expression as an expression.

    Raises
    ------
    TypeError
        If it is neither.
    DefinitionError
        If it is NaN or infinite.
    """
    if isinstance(value, Expression):
        return value
    if not isinstance(value, Real):
        raise TypeError(f"{value!r} is neither a real number nor an expression")
    number = float(value)
    if not math.isfinite(number):
        raise DefinitionError(f"{number} cannot stand in a formula: a finite number is needed")
    return Expression("number", tag=number, changes=False)


def _binary(operation: str, first: ExpressionLike, second: ExpressionLike) -> Any:
    for operand in (first, second):
        if not isinstance(operand, Expression | Real):
            # Arrays go on with each of their entries; everything else is a TypeError.
            return NotImplemented
    a, b = expression(first), expression(second)
    if operation == "divide" and b.changes:
        raise DefinitionError(_not_polynomial(f"a division by {b!r}"))
    if operation == "power" and (a.changes or b.changes) and not _is_power(b):
        raise DefinitionError(
            f"{a!r} to the power {b!r}: whole powers from 0 to {MAX_POWER} are possible"
        )
    return Expression(operation, (a, b), changes=a.changes or b.changes)


def _is_power(exponent: Expression) -> bool:
    number = exponent.tag if exponent.operation == "number" else -1.0
    return bool(float(number).is_integer() and 0 <= number <= MAX_POWER)


def _not_polynomial(what: str) -> str:
    return (
        f"{what}: a system is made of sums, products and whole powers of its states; "
        "a further state whose rate is known can stand for another function"
    )


def _named(
    name: str, shape: int | tuple[int, ...], make: Callable[[str], Expression]
) -> NDArray[np.object_]:
    array = np.empty(shape, dtype=object)
    for index in np.ndindex(array.shape):
        array[index] = make(f"{name}[{', '.join(map(str, index))}]")
    return array


_SIGNS = {"add": "+", "subtract": "-", "multiply": "*", "divide": "/", "power": "**"}


def _shown(part: Expression, depth: int) -> str:
    if part.operation == "number":
        return repr(part.tag)
    if part.operation == "parameter":
        name, shape, *place = part.tag
        index = [int(i) for i in np.unravel_index(place[0], shape)] if place else ""
        return f"{name}{index}"
    if not part.of:
        return str(part.tag) if part.operation == "state" else part.operation
    if depth == 0:
        return "..."
    inner = [_shown(one, depth - 1) for one in part.of]
    if part.operation in _SIGNS:
        return f"({inner[0]} {_SIGNS[part.operation]} {inner[1]})"
    if part.operation == "negative":
        return f"(-{inner[0]})"
    return f"{part.operation}({', '.join(inner)})"
