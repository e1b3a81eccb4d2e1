"""NumPy's functions on expressions: entry by entry, as on objects, or a refusal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from saltus._errors import FormulaError
from saltus.systems._refusals import is_refused, no_formula

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

__all__ = ["OURS", "Entrywise", "ExpressionArray", "array_of"]

#: NumPy's functions that are not asked of each entry, by name: they make switches.
OURS: dict[str, Callable[..., Any]] = {}


class Entrywise:
    """Mixin that takes over NumPy's functions."""

    __slots__ = ()

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **named: Any) -> Any:
        """Go on with each entry."""
        name = ufunc.__name__
        if name in OURS and method == "__call__" and not named:
            return OURS[name](*inputs)
        return _entrywise(getattr(ufunc, method), name, inputs, named)

    def __array_function__(self, function: Any, types: Any, inputs: Any, named: Any) -> Any:
        """Go on with each entry."""
        name = function.__name__
        return (
            OURS[name](*inputs, **named) if name in OURS else _entrywise(function, name, inputs, named)
        )


class ExpressionArray(Entrywise, np.ndarray):
    """An array of expressions, which refuses as they do where NumPy has no function of objects."""


def array_of(shape: int | tuple[int, ...]) -> NDArray[np.object_]:
    """Give an array for expressions, still empty."""
    return np.empty(shape, dtype=object).view(ExpressionArray)


def _entrywise(call: Callable[..., Any], name: str, inputs: Sequence[Any], named: dict[str, Any]) -> Any:
    if is_refused(name):
        raise no_formula(name, inputs)
    plain = [_plain(one) for one in inputs]
    try:
        made = call(*plain, **{key: _plain(one) for key, one in named.items()})
    except FormulaError:
        raise
    except (AttributeError, TypeError) as error:
        raise no_formula(name, inputs) from error
    return _ours(made)


def _plain(one: Any) -> Any:
    """An expression as an array without axes; NumPy's own kind of array."""
    if isinstance(one, ExpressionArray):
        return one.view(np.ndarray)
    if isinstance(one, Entrywise):
        array = np.empty((), dtype=object)
        array[()] = one
        return array
    return type(one)(map(_plain, one)) if type(one) in (list, tuple) else one


def _ours(made: Any) -> Any:
    if isinstance(made, np.ndarray) and made.dtype == object:
        return made.view(ExpressionArray) if made.ndim > 0 else made[()]
    return type(made)(map(_ours, made)) if type(made) in (list, tuple) else made
