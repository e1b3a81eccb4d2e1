"""Periodic orbits and their Floquet multipliers."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from saltus._arguments import positive, reals, whole
from saltus.systems._integrate import Members, Options, Taylor

if TYPE_CHECKING:
    from collections.abc import Mapping

    from numpy.typing import ArrayLike, NDArray

    from saltus.systems._system import System

__all__ = ["Orbit", "find_orbit"]


@dataclass(frozen=True, eq=False)
class Orbit:
    """A periodic orbit, as `find_orbit` gives it.

    Attributes
    ----------
    period : int
        Periods of the forcing.
    states : ndarray of float, shape (period, states)
        The states at phase 0 of the forcing.
    modes : ndarray of int, shape (period, units)
        The modes there.
    multipliers : ndarray of complex, shape (states,)
        Floquet multipliers, by falling modulus.
    multiplier_errors : ndarray of float, shape (states,)
        Error bound of each: `tolerance` of the derivative times the condition of the eigenvalue.
    stability : {"stable", "unstable", "neutral"}
        Whether all multipliers lie inside the unit circle, or some outside, or none outside and some
        so near to it that rounding decides their side.
    in_family : bool
        Whether a multiplier is 1 to its error: other orbits lie beside this one, as many as a conserved
        quantity has values.
    monodromy : ndarray of float, shape (states, states)
        Derivative of the stroboscopic map once around, at the first state.
    switch_time : ndarray of float, shape (switches,)
        Time of each switch, in periods of the forcing since the first state.
    switch_unit, switch_source, switch_target : ndarray of int, shape (switches,)
        The unit, the mode left, and the mode entered.
    residual : float
        Largest component of P(x_i) - x_(i+1).
    iterations : int
        Newton steps taken.

    Examples
    --------
    >>> from saltus.systems import Forcing, System, find_orbit, states
    >>> (x,) = states("x")
    >>> forcing = Forcing(1.0)
    >>> orbit = find_orbit(System([x], [forcing.cos - x], forcing=forcing), [0.0])
    >>> orbit.period, orbit.stability
    (1, 'stable')
    """

    period: int
    states: NDArray[np.float64]
    modes: NDArray[np.uint8]
    multipliers: NDArray[np.complex128]
    multiplier_errors: NDArray[np.float64]
    stability: Literal["stable", "unstable", "neutral"]
    in_family: bool
    monodromy: NDArray[np.float64]
    switch_time: NDArray[np.float64]
    switch_unit: NDArray[np.int64]
    switch_source: NDArray[np.int64]
    switch_target: NDArray[np.int64]
    residual: float
    iterations: int

    @property
    def stable(self) -> bool | None:
        """Whether the orbit is stable; None if it is neutral."""
        return None if self.stability == "neutral" else self.stability == "stable"


def find_orbit(
    system: System,
    start: ArrayLike,
    *,
    period: int | None = None,
    parameters: Mapping[str, Any] | None = None,
    modes: ArrayLike | None = None,
    tolerance: float = 1e-11,
    iterations: int = 18,
    method: Taylor = Taylor(tolerance=1e-14, order=22),  # noqa: B008 (it is frozen)
    max_switches: int = 100,
    threads: int = 0,
) -> Orbit:
    """Find the periodic orbit near a start, by Newton's method with multiple shooting.

    Parameters
    ----------
    system : System
        The system.
    start : array_like of float, shape (states,) or (period, states)
        States near those of the orbit at phase 0 of the forcing, at one or at all of its periods.
    period : int, optional
        Number of periods of the forcing; by default as many as `start` has. The orbit found has the
        shortest: a start of four states that leads to an orbit of period two gives two.
    parameters : mapping of str to array_like, optional
        Values of all parameters.
    modes : array_like of int, shape (units,) or (period, units), optional
        The modes at the start.
    tolerance : float, optional
        Residual to reach, relative to the largest state or 1.
    iterations : int, optional
        Newton steps at most.
    method : Taylor, optional
        The method of integration.
    max_switches, threads : int, optional
        As for `integrate`.

    Returns
    -------
    Orbit

    Raises
    ------
    ComputationError
        If no orbit was found; the message says how far the method came.

    Warns
    -----
    UserWarning
        If the orbit is one of a family. Newton's steps then keep the conserved quantity of the start, to
        first order in the distance between the start and the orbit.

    Examples
    --------
    The forced oscillation of a damped oscillator:

    >>> from saltus.systems import Forcing, System, find_orbit, states
    >>> x, v = states("x", "v")
    >>> forcing = Forcing(2.0)
    >>> oscillator = System([x, v], [v, forcing.cos - 0.5 * v - x], forcing=forcing)
    >>> orbit = find_orbit(oscillator, [0.0, 0.0])
    >>> orbit.states.round(6)
    array([[-0.3,  0.2]])
    >>> orbit.stable
    True
    """
    members = Members.of(system, np.atleast_2d(reals("start", start)), modes, parameters)
    if len(members.shape) != 1 or members.shape[0] == 0:
        raise ValueError(
            f"start has the shape {np.shape(start)}: (states,) or (period, states) is needed"
        )
    if (members.parameters != members.parameters[0]).any():
        raise ValueError("an orbit has one value of each parameter")
    given = members.shape[0]
    around = given if period is None else whole("period", period, 1, 2**31)
    if given not in (1, around):
        raise ValueError(f"start has {given} places and period is {around}: 1 or {around} would do")
    raw = system.program.find_orbit(
        parameters=members.parameters,
        starts=members.starts,
        modes=members.modes,
        period=around,
        tolerance=positive("tolerance", tolerance),
        iterations=whole("iterations", iterations, 1, 2**31),
        settings=Options(method, max_switches, threads),
    )
    if raw.in_family:
        warnings.warn(
            "the orbit is one of a family: a Floquet multiplier is 1, as where a quantity is conserved; "
            "which member is found follows from the start",
            stacklevel=2,
        )
    n = len(system.states)
    when, *what = zip(*raw.switches, strict=True) if raw.switches else ((), (), (), ())
    unit, source, target = (np.array(one, dtype=np.int64) for one in what)
    return Orbit(
        period=raw.period,
        states=raw.places.reshape(raw.period, n),
        modes=raw.modes.reshape(raw.period, len(system.modes)),
        multipliers=np.array([complex(re, im) for re, im in raw.multipliers], dtype=np.complex128),
        multiplier_errors=np.array(raw.multiplier_errors, dtype=np.float64),
        stability=raw.stability,
        in_family=raw.in_family,
        monodromy=raw.monodromy.reshape(n, n),
        switch_time=np.array(when, dtype=np.float64),
        switch_unit=unit,
        switch_source=source,
        switch_target=target,
        residual=raw.residual,
        iterations=raw.iterations,
    )
