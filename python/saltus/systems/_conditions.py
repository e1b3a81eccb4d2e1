"""What depends on a sign: conditions, and formulas that switch exactly where a sign changes."""

from __future__ import annotations

from numbers import Real
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus._errors import FormulaError
from saltus.systems._entrywise import OURS, Entrywise, array_of
from saltus.systems._expression import Expression, expression
from saltus.systems._refusals import no_formula
from saltus.systems._switching import Unit

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["Condition", "Sides"]


class Sides(Unit):
    """A unit that follows the sign of a formula. The engine sets its mode where a trajectory begins."""

    def __init__(self, guard: Expression) -> None:
        super().__init__("negative", "positive")
        self.guard = guard


class Condition(Entrywise):
    """A condition on the sign of formulas, for `numpy.where`; joined by ``&``, ``|`` and ``~``."""

    __slots__ = ("_shown", "where")

    def __init__(self, where: Callable[[Any, Any], Any], shown: str) -> None:
        #: Gives, of two formulas, the one for while the condition holds, or else the other.
        self.where = where
        self._shown = shown

    def __and__(self, other: Condition) -> Condition:
        """Whether both hold."""
        if not isinstance(other, Condition):
            return NotImplemented
        return Condition(
            lambda this, that: self.where(other.where(this, that), that), f"({self!r} & {other!r})"
        )

    def __or__(self, other: Condition) -> Condition:
        """Whether one of them holds."""
        if not isinstance(other, Condition):
            return NotImplemented
        return Condition(
            lambda this, that: self.where(this, other.where(this, that)), f"({self!r} | {other!r})"
        )

    def __invert__(self) -> Condition:
        """Whether it does not hold."""
        return Condition(lambda this, that: self.where(that, this), f"~{self!r}")

    def __bool__(self) -> bool:
        """Refuse: it has no value before the system runs."""
        raise FormulaError(
            f"bool({self!r}): a condition on formulas has no value before the system runs. "
            "if, and, or, not, max() and min() take values; write numpy.where(condition, this, that), "
            "join conditions with &, | and ~ in brackets, and take numpy.maximum and numpy.minimum"
        )

    def __repr__(self) -> str:
        """Show the condition."""
        return self._shown


def _chosen(guard: Expression, above: Any, below: Any) -> Any:
    """Give the formula that the sign of another selects."""
    if guard.sides is None:
        guard.sides = Sides(guard)
    return guard.sides.choose(negative=below, positive=above)


def _above(first: Any, second: Any) -> Condition:
    for operand in (first, second):
        if not isinstance(operand, Expression | Real):
            raise no_formula("greater", [first, second])
    a, b = expression(first), expression(second)
    guard = a if b.operation == "number" and b.tag == 0.0 else a - b
    if not guard.changes:
        raise no_formula("greater", [a, b])
    return Condition(lambda this, that: _chosen(guard, this, that), f"({a!r} > {b!r})")


def _of_entries(function: Callable[..., Any], *of: Any) -> Any:
    """Apply a function to each entry of arrays, or to formulas alone."""
    parts = np.broadcast_arrays(*(_objects(one) for one in of))
    out = array_of(parts[0].shape)
    for index in np.ndindex(out.shape):
        out[index] = function(*(part[index] for part in parts))
    return out[()]


def _objects(one: Any) -> Any:
    if isinstance(one, Entrywise) and not isinstance(one, np.ndarray):
        array = np.empty((), dtype=object)
        array[()] = one
        return array
    return np.asarray(one, dtype=object).view(np.ndarray)


def _where(condition: Any, this: Any, that: Any) -> Any:
    if isinstance(condition, Condition):
        return condition.where(expression(this), expression(that))
    return expression(this if condition else that)


def _absolute(of: Any) -> Any:
    of = expression(of)
    return _chosen(of, of, -of) if of.changes else Expression("absolute", (of,), changes=False)


def _larger(first: Any, second: Any) -> Any:
    return _where(_above(first, second), first, second)


def _smaller(first: Any, second: Any) -> Any:
    return _where(_above(first, second), second, first)


def _sign(of: Any) -> Any:
    return _where(_above(of, 0.0), 1.0, -1.0)


def _heaviside(of: Any, _at_zero: Any) -> Any:
    return _where(_above(of, 0.0), 1.0, 0.0)


def _clip(of: Any, least: Any, most: Any) -> Any:
    of = of if least is None else _larger(of, least)
    return of if most is None else _smaller(of, most)


def _taking_over(function: Callable[..., Any]) -> Callable[..., Any]:
    def entry_by_entry(*of: Any, **named: Any) -> Any:
        if named:
            raise no_formula(f"{function.__name__.strip('_')} with {', '.join(named)}", of)
        return _of_entries(function, *of)

    return entry_by_entry


OURS.update(
    {
        "absolute": _taking_over(_absolute),
        "clip": _taking_over(_clip),
        "fabs": _taking_over(_absolute),
        "fmax": _taking_over(_larger),
        "fmin": _taking_over(_smaller),
        "greater": _taking_over(_above),
        "greater_equal": _taking_over(lambda first, second: ~_above(second, first)),
        "heaviside": _taking_over(_heaviside),
        "less": _taking_over(lambda first, second: _above(second, first)),
        "less_equal": _taking_over(lambda first, second: ~_above(first, second)),
        "maximum": _taking_over(_larger),
        "minimum": _taking_over(_smaller),
        "sign": _taking_over(_sign),
        "where": _taking_over(_where),
    }
)
