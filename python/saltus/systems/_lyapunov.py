"""Lyapunov exponents with errors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus._arguments import whole
from saltus._progress import Progress, watched
from saltus.systems._integrate import Members, Options, Taylor, words

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import ArrayLike, NDArray

    from saltus.systems._system import System

__all__ = ["Exponents", "lyapunov"]


@dataclass(frozen=True, eq=False)
class Exponents:
    """Lyapunov exponents of all members.

    Attributes
    ----------
    exponents : ndarray of float, shape (..., count)
        Mean growth per unit of time (natural logarithm), the largest first but for their errors;
        NaN for a trajectory that ended early.
    standard_errors : ndarray of float, shape (..., count)
        Their standard errors, from 20 batches of the record, rounding included; infinite for fewer than
        20 periods.
    intervals : ndarray of float, shape (..., count, 2)
        Lower and upper end of the intervals that hold the true values with a probability of 0.95, by
        Student's t, if the motion forgets where it was within a twentieth of the record.
    on_cycle : ndarray of bool, shape (...)
        Whether the motion has come to a cycle; its exponents are those of the multipliers then.
    dimension : ndarray of float, shape (...)
        Kaplan-Yorke dimension; NaN where the record does not give it.
    dimension_error : ndarray of float, shape (...)
        Its standard error.
    status, reason : ndarray of str, shape (...)
        Ending of each trajectory, as a word and as a sentence; "completed" if it ran to its end.

    Examples
    --------
    >>> from saltus.systems import System, lyapunov, states
    >>> (x,) = states("x")
    >>> found = lyapunov(System([x], [-0.5 * x], interval=1.0), [1.0], periods=100)
    >>> found.exponents.round(6)
    array([-0.5])
    """

    exponents: NDArray[np.float64]
    standard_errors: NDArray[np.float64]
    intervals: NDArray[np.float64]
    on_cycle: NDArray[np.bool_]
    dimension: NDArray[np.float64]
    dimension_error: NDArray[np.float64]
    status: NDArray[np.str_]
    reason: NDArray[np.str_]


def lyapunov(
    system: System,
    starts: ArrayLike,
    periods: int,
    *,
    count: int | None = None,
    transient: int = 100,
    parameters: Mapping[str, Any] | None = None,
    modes: ArrayLike | None = None,
    method: Taylor = Taylor(),  # noqa: B008 (it is frozen)
    max_switches: int = 100,
    threads: int = 0,
    progress: Progress = None,
) -> Exponents:
    """Lyapunov exponents of many members, by tangent columns kept orthonormal.

    Benettin, Galgani, Giorgilli & Strelcyn, Meccanica 15 (1980) 9. A switch multiplies the columns by
    its saltation matrix. Where columns become parallel to rounding within a period, they are made
    orthonormal more often.

    Parameters
    ----------
    system : System
        The system.
    starts : array_like of float, shape (..., states)
        The states at the start, at phase 0 of the forcing.
    periods : int
        Periods of the record.
    count : int, optional
        Number of exponents; by default all.
    transient : int, optional
        Periods before the record begins, in which the columns find their directions.
    parameters, modes, max_switches, threads, progress
        As for `integrate`.
    method : Taylor, optional
        The method of integration.

    Returns
    -------
    Exponents

    Raises
    ------
    ValueError, TypeError
        If an argument does not fit; the message names it.

    Examples
    --------
    The sum of the exponents of a damped oscillator is minus its damping:

    >>> from saltus.systems import Forcing, System, lyapunov, states
    >>> x, v = states("x", "v")
    >>> forcing = Forcing(1.0)
    >>> duffing = System([x, v], [v, forcing.cos - 0.2 * v - x**3], forcing=forcing)
    >>> found = lyapunov(duffing, [0.1, 0.0], periods=100)
    >>> round(float(found.exponents.sum()), 6)
    -0.2
    """
    members = Members.of(system, starts, modes, parameters)
    n = len(system.states)
    some = n if count is None else whole("count", count, 1, n)
    with watched(progress) as show:
        raw = system.program.lyapunov(
            parameters=members.parameters,
            starts=members.starts,
            modes=members.modes,
            periods=whole("periods", periods, 1, 2**53),
            transient=whole("transient", transient, 0, 2**53),
            count=some,
            settings=Options(method, max_switches, threads),
            progress=show,
        )
    shape = members.shape
    status = words([word for word, _ in raw.status], shape)
    whole_record = status == "completed"

    def told(values: NDArray[np.float64], *last: int) -> NDArray[np.float64]:
        """NaN where a trajectory ended before its record was complete."""
        seen = whole_record.reshape((*shape, *(1 for _ in last)))
        return np.where(seen, values.reshape((*shape, *last)), np.nan)

    return Exponents(
        exponents=told(raw.exponents, some),
        standard_errors=told(raw.standard_errors, some),
        intervals=told(raw.intervals, some, 2),
        on_cycle=np.array(raw.on_cycle, dtype=np.bool_).reshape(shape),
        dimension=told(raw.dimension),
        dimension_error=told(raw.dimension_error),
        status=status,
        reason=words([sentence for _, sentence in raw.status], shape),
    )
