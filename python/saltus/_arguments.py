"""Arguments as the native module needs them: contiguous float64 arrays and whole numbers in range."""

from __future__ import annotations

import operator
from typing import TYPE_CHECKING, Any, SupportsIndex

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import ArrayLike, NDArray

__all__ = ["flag", "modes_array", "positive", "reals", "whole"]


def reals(name: str, value: ArrayLike, trailing: Iterable[int | str] = ()) -> NDArray[np.float64]:
    """Any array-like of finite real numbers as a contiguous array of float64.

    Parameters
    ----------
    name : str
        The argument, for messages.
    value : array_like
        Lists, arrays of any real kind and layout, and whatever else NumPy takes by ``__array__``.
    trailing : iterable of int or str, optional
        What the last axes must be: a length, or a word for any length.

    Returns
    -------
    ndarray of float64, shape (..., *trailing)
        Aligned, in C order, in the byte order of the machine. Not to be written to: it may be the
        caller's own.

    Raises
    ------
    TypeError
        If the values are not real numbers.
    ValueError
        If the shape does not fit, or an entry is NaN or infinite.
    """
    array = _array(name, value)
    if array.dtype.kind not in "iuf":
        raise TypeError(f"{name} holds {_kind(array)}: real numbers are needed")
    _fit(name, array.shape, tuple(trailing))
    array = np.require(array, np.float64, ["C_CONTIGUOUS", "ALIGNED"])
    finite = np.isfinite(array)
    if not finite.all():
        first = np.unravel_index(int(np.argmin(finite)), array.shape)
        index = ", ".join(str(int(i)) for i in first)
        raise ValueError(f"{name}[{index}] is {array[first]}: finite numbers are needed")
    return array


def modes_array(name: str, value: ArrayLike, counts: tuple[int, ...]) -> NDArray[np.uint8]:
    """Modes, of each unit one, as a contiguous array.

    Parameters
    ----------
    name : str
        The argument, for messages.
    value : array_like of int, shape (..., units)
        The modes.
    counts : tuple of int
        How many modes each unit has.

    Returns
    -------
    ndarray of uint8, shape (..., units)
    """
    array = _array(name, value)
    if array.dtype.kind not in "iu" and array.size > 0:
        raise TypeError(f"{name} holds {_kind(array)}: places in the list of modes are needed")
    _fit(name, array.shape, (len(counts),))
    wrong = (array < 0) | (array >= np.array(counts, dtype=np.int64))
    if wrong.any():
        first = np.unravel_index(int(np.argmax(wrong)), array.shape)
        index = ", ".join(str(int(i)) for i in first)
        most = counts[int(first[-1])] - 1
        raise ValueError(f"{name}[{index}] is {array[first]}: 0 to {most} are the modes of that unit")
    return np.ascontiguousarray(array, dtype=np.uint8)


def whole(name: str, value: SupportsIndex, least: int, most: int | None = None) -> int:
    """A whole number from `least` to `most`; a truth value is none."""
    try:
        if isinstance(value, bool):
            raise TypeError
        number = operator.index(value)
    except TypeError:
        raise TypeError(f"{name} is {value!r}: a whole number is needed") from None
    if number < least or (most is not None and number > most):
        right = f"at least {least}" if most is None else f"{least} to {most}"
        raise ValueError(f"{name} is {number}: {right} would do")
    return number


def positive(name: str, value: ArrayLike) -> float:
    """A positive number."""
    number = reals(name, value)
    if number.ndim > 0 or number <= 0.0:
        raise ValueError(f"{name} is {value!r}: one positive number is needed")
    return float(number)


def flag(name: str, value: object) -> bool:
    """True or False, of Python or NumPy."""
    if not isinstance(value, bool | np.bool_):
        raise TypeError(f"{name} is {value!r}: True or False is needed")
    return bool(value)


def _array(name: str, value: ArrayLike) -> NDArray[Any]:
    if isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value):
        raise ValueError(f"{name} has masked entries: all must be there")
    try:
        return np.asarray(value)
    except ValueError as error:
        raise ValueError(f"{name} is not an array of numbers: {error}") from error


def _kind(array: NDArray[Any]) -> str:
    names = {
        "b": "booleans",
        "c": "complex numbers",
        "O": "objects",
        "S": "bytes",
        "U": "strings",
        "M": "dates",
        "m": "time differences",
    }
    return names.get(array.dtype.kind, f"entries of type {array.dtype}")


def _fit(name: str, shape: tuple[int, ...], trailing: tuple[int | str, ...]) -> None:
    last = shape[len(shape) - len(trailing) :] if trailing else ()
    fits = len(shape) >= len(trailing) and all(
        isinstance(wanted, str) or wanted == found for wanted, found in zip(trailing, last, strict=False)
    )
    if not fits:
        wanted = ", ".join(["...", *map(str, trailing)])
        raise ValueError(f"{name} has the shape {shape}: ({wanted}) is needed")
