"""Formulas of states, parameters and the forcing."""

from __future__ import annotations

import math
from numbers import Complex, Real
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from saltus._errors import DefinitionError, FormulaError
from saltus.systems._entrywise import OURS, Entrywise, array_of
from saltus.systems._refusals import no_formula, refuse_others, refusing

if TYPE_CHECKING:
    from collections.abc import Sequence

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

#: Depth to which a formula is printed.
_SHOWN = 6


@refuse_others
class Expression(Entrywise):
    """A formula of states, parameters and the forcing.

    Made by `states`, `parameters` and `Forcing`, and by calculating with them: sums, products,
    quotients, powers, and NumPy's `sqrt`, `exp`, `log`, `sin`, `cos`, `tan`, `sinh`, `cosh`, `tanh`,
    `arcsin`, `arccos`, `arctan` and `hypot`. What depends on a sign switches where the sign changes,
    exactly: `abs`, `numpy.sign`, `numpy.maximum`, `numpy.minimum`, `numpy.clip`, `numpy.heaviside`
    and ``numpy.where(x > 0.0, this, that)``, with conditions joined by ``&``, ``|`` and ``~``. Arrays
    of expressions are NumPy arrays of objects, so that ``K @ x`` and `numpy.einsum` work.

    A trajectory ends where a formula is not defined: a division by 0, the logarithm of a negative
    number; its status is "out-of-domain" then. A formula of one mode of a unit is not asked in others.

    Expressions are equal to themselves alone, and have no value, so no truth value either. Any other
    operation raises a `saltus.FormulaError` that says what to write instead.

    Examples
    --------
    >>> x, v = states("x", "v")
    >>> -x - 0.1 * v**3
    ((-x) - (0.1 * (v ** 3.0)))
    """

    __slots__ = ("changes", "of", "operation", "sides", "tag")

    def __init__(
        self, operation: str, of: tuple[Expression, ...] = (), tag: Any = None, *, changes: bool
    ) -> None:
        self.operation = operation
        self.of = of
        #: The number, the name, or the owner of the expression.
        self.tag = tag
        #: Whether it changes with time.
        self.changes = changes
        #: The unit that follows its sign, once there is one.
        self.sides: Any = None

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
        """Quotient; a trajectory ends where the divisor is 0."""
        return _binary("divide", self, other)  # type: ignore[no-any-return]

    def __rtruediv__(self, other: ExpressionLike) -> Expression:
        """Quotient; a trajectory ends where the divisor is 0."""
        return _binary("divide", other, self)  # type: ignore[no-any-return]

    def __pow__(self, other: ExpressionLike) -> Expression:
        """Power; of a positive base, unless the exponent is a whole number up to 64."""
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
        """Absolute value: of what changes with time, it switches at 0."""
        return OURS["absolute"](self)  # type: ignore[no-any-return]

    def __gt__(self, other: ExpressionLike) -> Any:
        """Condition that it is above the other, for `numpy.where`."""
        return OURS["greater"](self, other)

    def __ge__(self, other: ExpressionLike) -> Any:
        """Condition that it is not below the other, for `numpy.where`."""
        return OURS["greater_equal"](self, other)

    def __lt__(self, other: ExpressionLike) -> Any:
        """Condition that it is below the other, for `numpy.where`."""
        return OURS["less"](self, other)

    def __le__(self, other: ExpressionLike) -> Any:
        """Condition that it is not above the other, for `numpy.where`."""
        return OURS["less_equal"](self, other)

    # numpy.sqrt and its sisters call these for each entry of an array.
    def sqrt(self) -> Expression:
        """Square root."""
        return self._function("sqrt")

    def exp(self) -> Expression:
        """Exponential."""
        return self._function("exp")

    def log(self) -> Expression:
        """Natural logarithm."""
        return self._function("log")

    def sin(self) -> Expression:
        """Sine."""
        return self._function("sin")

    def cos(self) -> Expression:
        """Cosine."""
        return self._function("cos")

    def tan(self) -> Expression:
        """Tangent."""
        return self._function("tan")

    def sinh(self) -> Expression:
        """Hyperbolic sine."""
        return self._function("sinh")

    def cosh(self) -> Expression:
        """Hyperbolic cosine."""
        return self._function("cosh")

    def tanh(self) -> Expression:
        """Hyperbolic tangent."""
        return self._function("tanh")

    def arcsin(self) -> Expression:
        """Inverse sine."""
        return self._function("arcsin")

    def arccos(self) -> Expression:
        """Inverse cosine."""
        return 0.5 * math.pi - self._function("arcsin")

    def arctan(self) -> Expression:
        """Inverse tangent."""
        return self._function("arctan")

    def hypot(self, other: ExpressionLike) -> Expression:
        """Hypotenuse of two legs."""
        return (self * self + other * other).sqrt()

    def square(self) -> Expression:
        """Square."""
        return self * self

    def reciprocal(self) -> Expression:
        """One over it."""
        return 1.0 / self

    def conjugate(self) -> Expression:
        """Return the same: formulas are real."""
        return self

    def _function(self, name: str) -> Expression:
        return Expression(name, (self,), changes=self.changes)

    def __eq__(self, other: object) -> bool:
        """Whether it is the other expression; FormulaError for a number."""
        if isinstance(other, Real):
            raise no_formula("equal", [self, other])
        return self is other if isinstance(other, Expression) else NotImplemented

    __hash__ = object.__hash__

    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Refuse a function that NumPy calls for each entry of an array."""
            if not isinstance(getattr(np, name, None), np.ufunc):
                raise AttributeError(f"an expression has no {name}")
            return refusing(name).__get__(self)

    def __repr__(self) -> str:
        """Show the formula, shortened if it is long."""
        return _shown(self, _SHOWN)


#: Entries of a formula.
ExpressionLike: TypeAlias = Expression | float | np.floating[Any] | np.integer[Any]


#: One scale, or one for each state; None where the state's own size is enough.
Scales: TypeAlias = Any


def states(*names: str, scale: Scales = None) -> tuple[Expression, ...]:
    """States of a system, one for each name.

    Parameters
    ----------
    *names : str
        What they are called, such as ``"x", "v"``.
    scale : float or Expression of parameters, or a sequence of one for each state, optional
        The size below which a state need not be resolved further, in its unit: errors are relative to
        how large a state has lately been, and to its scale where that is larger.

    Returns
    -------
    tuple of Expression
        To be calculated with.

    Raises
    ------
    DefinitionError
        If a scale is not positive, or changes with time.

    Examples
    --------
    >>> x, v = states("x", "v")
    >>> -x - 0.1 * v
    ((-x) - (0.1 * v))
    """
    return tuple(_state_entries(names, (len(names),), scale))


def state_array(name: str, shape: int | tuple[int, ...], *, scale: Scales = None) -> NDArray[np.object_]:
    """Give an array of states, ``name[0]``, ``name[1]``, ...

    Parameters
    ----------
    name : str
        What they are called.
    shape : int or tuple of int
        Shape of the array.
    scale : float, Expression of parameters, or array_like of them, optional
        As for `states`; an array is broadcast to `shape`.

    Returns
    -------
    ndarray of Expression

    Examples
    --------
    >>> import numpy as np
    >>> q = state_array("q", 2)
    >>> stiffness = np.array([[2.0, -1.0], [-1.0, 2.0]])
    >>> (stiffness @ q)[0]
    ((2.0 * q[0]) + (-1.0 * q[1]))
    """
    places = list(np.ndindex(shape))
    labels = [f"{name}[{', '.join(map(str, place))}]" for place in places]
    array = array_of(shape)
    for place, entry in zip(places, _state_entries(labels, array.shape, scale), strict=True):
        array[place] = entry
    return array


def _state_entries(labels: Sequence[str], shape: tuple[int, ...], scale: Scales) -> list[Expression]:
    given = np.asarray(scale, dtype=object)
    try:
        scales = np.broadcast_to(given, shape).ravel()
    except ValueError:
        raise DefinitionError(
            f"scale has the shape {given.shape}: one number, or one for each of {list(labels)} is needed"
        ) from None
    return [
        Expression("state", tag=(label, _scale(label, one)), changes=True)
        for label, one in zip(labels, scales, strict=True)
    ]


def _scale(label: str, value: Any) -> Expression | None:
    if value is None:
        return None
    scale = expression(value)
    if scale.changes:
        raise DefinitionError(f"the scale of {label} is {scale!r}: it must not change with time")
    if scale.operation == "number" and scale.tag <= 0.0:
        raise DefinitionError(f"the scale of {label} is {scale!r}: a positive number is needed")
    return scale


def parameters(*names: str) -> tuple[Expression, ...]:
    """Parameters of a system, one for each name; each member of a run may have other values.

    Parameters
    ----------
    *names : str
        What they are called, and the values are given under.

    Returns
    -------
    tuple of Expression

    Examples
    --------
    >>> f, omega = parameters("f", "omega")
    >>> f * omega**2
    (f * (omega ** 2.0))
    """
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

    Examples
    --------
    >>> parameter_array("k", 3)[1]
    k[1]
    """
    whole = (shape,) if isinstance(shape, int) else tuple(shape)
    array = array_of(whole)
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
            if isinstance(operand, Complex):
                raise FormulaError(
                    f"{operand!r} cannot stand in a formula: write real and imaginary part as two states"
                )
            # Arrays go on with each of their entries; everything else is a TypeError.
            return NotImplemented
    a, b = expression(first), expression(second)
    if operation == "power" and b.changes:
        # a^b with a moving exponent
        return (b * a.log()).exp()
    return Expression(operation, (a, b), changes=a.changes or b.changes)


_SIGNS = {"add": "+", "subtract": "-", "multiply": "*", "divide": "/", "power": "**"}


def _shown(part: Expression, depth: int) -> str:
    if part.operation == "number":
        return repr(part.tag)
    if part.operation == "parameter":
        name, shape, *place = part.tag
        index = [int(i) for i in np.unravel_index(place[0], shape)] if place else ""
        return f"{name}{index}"
    if part.operation == "state":
        return str(part.tag[0])
    if not part.of:
        return part.operation
    if depth == 0:
        return "..."
    inner = [_shown(one, depth - 1) for one in part.of]
    if part.operation in _SIGNS:
        return f"({inner[0]} {_SIGNS[part.operation]} {inner[1]})"
    if part.operation == "negative":
        return f"(-{inner[0]})"
    return f"{part.operation}({', '.join(inner)})"
