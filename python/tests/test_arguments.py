"""Array-likes of all kinds become arrays of float64, or a message that names what is wrong."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import xarray
from hypothesis import given
from hypothesis import strategies as some

from saltus._arguments import modes_array, reals, whole

VALUES = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]


class OnlyByArray:
    def __array__(self, dtype: Any = None, copy: Any = None) -> np.ndarray:
        return np.array(VALUES, dtype=dtype)


def misaligned() -> np.ndarray:
    raw = np.zeros(6 * 8 + 1, dtype=np.uint8)[1:]
    out = raw.view(np.float64).reshape(2, 3)
    out[:] = VALUES
    return out


def read_only() -> np.ndarray:
    out = np.array(VALUES)
    out.flags.writeable = False
    return out


@pytest.mark.parametrize(
    "value",
    [
        VALUES,
        tuple(map(tuple, VALUES)),
        np.array(VALUES, dtype=np.float32),
        np.array(VALUES, dtype=np.longdouble),
        np.array(VALUES, dtype=np.int16),
        np.array(VALUES, dtype=np.uint64),
        np.array(VALUES, dtype=">f8"),
        np.array(VALUES, order="F"),
        np.repeat(np.array(VALUES), 2, axis=1)[:, ::2],
        np.array(VALUES)[::-1, ::-1][::-1, ::-1],
        np.ma.MaskedArray(VALUES),
        misaligned(),
        read_only(),
        xarray.DataArray(VALUES, dims=("member", "state")),
        OnlyByArray(),
    ],
    ids=lambda value: type(value).__name__,
)
def test_every_array_like_is_taken(value: Any) -> None:
    array = reals("x", value, (3,))
    assert array.dtype == np.float64
    assert array.dtype.isnative
    assert array.flags.c_contiguous
    assert array.flags.aligned
    assert array.tolist() == VALUES


def test_a_number_has_no_axes() -> None:
    assert reals("x", 2).shape == ()
    assert reals("x", np.float32(2.0)).shape == ()


@given(some.lists(some.floats(allow_nan=False, allow_infinity=False), max_size=20))
def test_finite_floats_pass_unchanged(values: list[float]) -> None:
    assert reals("x", values).tolist() == values


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ([1.0 + 2.0j], "x holds complex numbers"),
        (["1.0"], "x holds strings"),
        ([b"1.0"], "x holds bytes"),
        ([None, 1.0], "x holds objects"),
        ([True], "x holds booleans"),
        (np.array(["2026-01-01"], dtype="M8[D]"), "x holds dates"),
    ],
)
def test_what_is_no_real_number_is_refused_by_kind(value: Any, message: str) -> None:
    with pytest.raises(TypeError, match=message):
        reals("x", value)


def test_messages_name_shape_and_place() -> None:
    with pytest.raises(ValueError, match=r"x has the shape \(2, 3\): \(\.\.\., 2\) is needed"):
        reals("x", VALUES, (2,))
    with pytest.raises(ValueError, match=r"x has the shape \(\): \(\.\.\., member, 3\) is needed"):
        reals("x", 1.0, ("member", 3))
    with pytest.raises(ValueError, match=r"x\[1, 0\] is nan"):
        reals("x", [[1.0, 2.0], [np.nan, np.inf]])
    with pytest.raises(ValueError, match="x is not an array of numbers"):
        reals("x", [[1.0], [1.0, 2.0]])
    with pytest.raises(ValueError, match="x has masked entries"):
        reals("x", np.ma.MaskedArray([1.0, 2.0], mask=[True, False]))


def test_modes_are_places_in_the_lists_of_modes() -> None:
    assert modes_array("modes", [[0, 2], [1, 0]], (2, 3)).dtype == np.uint8
    with pytest.raises(ValueError, match=r"modes\[1, 0\] is 2: 0 to 1"):
        modes_array("modes", [[0, 2], [2, 0]], (2, 3))
    with pytest.raises(ValueError, match=r"modes\[0\] is -1"):
        modes_array("modes", [-1, 0], (2, 3))
    with pytest.raises(TypeError, match="modes holds entries of type float64"):
        modes_array("modes", [0.0, 1.0], (2, 3))


def test_whole_numbers_have_a_range() -> None:
    assert whole("n", np.int32(4), 1) == 4
    with pytest.raises(TypeError, match=r"n is 1\.5: a whole number"):
        whole("n", 1.5, 1)  # type: ignore[arg-type]
    for truth in (True, np.True_):
        with pytest.raises(TypeError, match=r"n is (np\.)?True_?: a whole number is needed"):
            whole("n", truth, 1)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="n is -1: at least 0"):
        whole("n", -1, 0)
    with pytest.raises(ValueError, match="n is 9: 0 to 8"):
        whole("n", 9, 0, 8)
