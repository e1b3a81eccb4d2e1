"""Trajectories of many members at once."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from saltus._arguments import flag, modes_array, positive, reals, whole
from saltus._progress import Progress, watched
from saltus.systems._system import System

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike, NDArray

__all__ = [
    "Members",
    "Options",
    "RungeKutta4",
    "Switches",
    "Taylor",
    "Trajectories",
    "integrate",
]


@dataclass(frozen=True, kw_only=True)
class Taylor:
    """Taylor series with adaptive step and exact dense output, eight members at a time.

    Jorba & Zou, Experiment. Math. 14 (2005) 99.

    Parameters
    ----------
    tolerance : float
        Size allowed for the last terms of the series, relative to how large each state has lately been
        or to its scale, whichever is larger; 1e-16 to 1e-2.
    order : int, optional
        Order of the series, 4 to 30; by default the one that suits the tolerance.
    instructions : {"best", "avx2", "baseline"}
        Instruction set for the series. Results differ by rounding between "baseline" and the others;
        fix it for the same bits on other machines.

    Examples
    --------
    >>> Taylor(tolerance=1e-12).tolerance
    1e-12
    """

    tolerance: float = 1e-10
    order: int | None = None
    instructions: Literal["best", "avx2", "baseline"] = "best"


@dataclass(frozen=True, kw_only=True)
class RungeKutta4:
    """The classical Runge-Kutta method on a fixed grid, with switches located on its own solution.

    Parameters
    ----------
    steps_per_period : int
        Steps in one period.

    Examples
    --------
    >>> RungeKutta4(steps_per_period=1000).steps_per_period
    1000
    """

    steps_per_period: int


@dataclass(frozen=True)
class Options:
    """Settings of the integration, as the native module reads them."""

    method: Taylor | RungeKutta4
    max_switches: int
    threads: int
    max_steps: int = 1_000_000

    def __post_init__(self) -> None:
        """Refuse numbers that are not whole or out of range."""
        whole("max_switches", self.max_switches, 1, 2**31)
        whole("threads", self.threads, 0, 4096)
        if isinstance(self.method, RungeKutta4):
            whole("steps_per_period", self.method.steps_per_period, 1, 2**31)
        elif isinstance(self.method, Taylor):
            positive("tolerance", self.method.tolerance)
            whole("order", 4 if self.method.order is None else self.method.order, 4, 30)
            known = ("best", "avx2", "baseline")
            if self.method.instructions not in known:
                raise ValueError(
                    f"instructions is {self.method.instructions!r}: one of {known} would do"
                )
        else:
            raise TypeError(f"method is {self.method!r}: Taylor() or RungeKutta4() would do")


@dataclass(frozen=True, eq=False)
class Switches:
    """Switches of all members, member by member and in the order of time.

    Attributes
    ----------
    member : ndarray of int, shape (switches,)
        The member, as an index into the flattened leading axes of the starts.
    time : ndarray of float, shape (switches,)
        Time since the start of the run.
    unit : ndarray of int, shape (switches,)
        The unit that switches.
    source, target : ndarray of int, shape (switches,)
        The mode left and the mode entered.
    state : ndarray of float, shape (switches, states)
        The states just before, and before any reset.

    Examples
    --------
    A ball that falls from 0.5 under gravity 1 lands after a time of 1:

    >>> from saltus.systems import System, Unit, integrate, states
    >>> y, v = states("y", "v")
    >>> bounce = Unit("flight").transition("flight", "flight", falling=y, reset={v: -v})
    >>> ball = System([y, v], [v, -1.0], interval=1.5, transitions=[bounce])
    >>> integrate(ball, [0.5, 0.0], periods=1).switches.time
    array([1.])
    """

    member: NDArray[np.int64]
    time: NDArray[np.float64]
    unit: NDArray[np.uint8]
    source: NDArray[np.uint8]
    target: NDArray[np.uint8]
    state: NDArray[np.float64]

    def __len__(self) -> int:
        """Number of switches."""
        return len(self.time)

    def of(self, member: int) -> Switches:
        """The switches of one member.

        Parameters
        ----------
        member : int
            Index into the flattened leading axes of the starts.

        Returns
        -------
        Switches

        Examples
        --------
        >>> from saltus.systems import System, Unit, integrate, states
        >>> y, v = states("y", "v")
        >>> bounce = Unit("flight").transition("flight", "flight", falling=y, reset={v: -v})
        >>> ball = System([y, v], [v, -1.0], interval=3.5, transitions=[bounce])
        >>> len(integrate(ball, [[0.5, 0.0], [8.0, 0.0]], periods=1).switches.of(0))
        2
        """
        mine = self.member == member
        return Switches(
            self.member[mine],
            self.time[mine],
            self.unit[mine],
            self.source[mine],
            self.target[mine],
            self.state[mine],
        )


@dataclass(frozen=True, eq=False)
class Trajectories:
    """Trajectories of all members. ``...`` stands for the leading axes of starts and parameters.

    Attributes
    ----------
    samples : ndarray of float, shape (..., samples, states)
        The states. With one sample a period, the stroboscopic section. NaN after a trajectory ended.
    modes : ndarray of int, shape (..., samples, units)
        The mode of each unit.
    time : ndarray of float, shape (..., samples)
        Time since the start of the run.
    period : ndarray of float, shape (...)
        Period of the forcing, or the interval.
    end : ndarray of float, shape (..., states)
        Last state of each trajectory: at phase 0 of the forcing, if it completed.
    end_modes : ndarray of int, shape (..., units)
        The modes there.
    periods : ndarray of int, shape (...)
        Periods completed, the transient included.
    steps : ndarray of int, shape (...)
        Steps taken.
    status : ndarray of str, shape (...)
        "completed", "chattering", "not-finite", "out-of-domain" or "too-many-steps".
    reason : ndarray of str, shape (...)
        The same as a sentence, with the time.
    switches : Switches
        The switches of all members.

    Examples
    --------
    >>> from saltus.systems import System, integrate, states
    >>> x, v = states("x", "v")
    >>> run = integrate(System([x, v], [v, -x], interval=1.0), [1.0, 0.0], periods=10)
    >>> run
    Trajectories(samples=(10, 2), switches=0, 1 of 1 completed)
    """

    samples: NDArray[np.float64]
    modes: NDArray[np.uint8]
    time: NDArray[np.float64]
    period: NDArray[np.float64]
    end: NDArray[np.float64]
    end_modes: NDArray[np.uint8]
    periods: NDArray[np.int64]
    steps: NDArray[np.int64]
    status: NDArray[np.str_]
    reason: NDArray[np.str_]
    switches: Switches

    @property
    def completed(self) -> NDArray[np.bool_]:
        """Whether each trajectory ran to its end, shape (...)."""
        return np.equal(self.status, "completed")

    def __repr__(self) -> str:
        """Show shapes and how many completed."""
        done = f"{int(self.completed.sum())} of {self.completed.size} completed"
        return f"Trajectories(samples={self.samples.shape}, switches={len(self.switches)}, {done})"


@dataclass(frozen=True)
class Members:
    """Starts, modes and parameters of all members, broadcast against each other."""

    shape: tuple[int, ...]
    starts: NDArray[np.float64]
    modes: NDArray[np.uint8]
    parameters: NDArray[np.float64]

    @classmethod
    def of(
        cls,
        system: System,
        starts: ArrayLike,
        modes: ArrayLike | None,
        parameters: Mapping[str, Any] | None,
    ) -> Members:
        """Check and broadcast."""
        if not isinstance(system, System):
            raise TypeError(f"system is {system!r}: a System is needed")
        if not isinstance(parameters or {}, Mapping):
            raise TypeError(f"parameters is {parameters!r}: a mapping from names to values is needed")
        given = dict(parameters or {})
        shapes = system.parameters
        if set(given) != set(shapes):
            raise ValueError(
                f"parameters are given for {sorted(given)}: {sorted(shapes)} are those of the system"
            )
        counts = tuple(len(names) for names in system.modes)
        x = reals("starts", starts, (len(system.states),))
        m = modes_array("modes", np.zeros(len(counts), np.uint8) if modes is None else modes, counts)
        values = {name: reals(name, given[name], shape) for name, shape in shapes.items()}
        leads = {name: _lead(value.shape, len(shapes[name])) for name, value in values.items()}
        leads = {"starts": x.shape[:-1], "modes": m.shape[:-1], **leads}
        shape = _broadcast(leads)
        count = math.prod(shape)
        columns = [
            np.broadcast_to(value, shape + shapes[name]).reshape(count, math.prod(shapes[name]))
            for name, value in values.items()
        ]
        return cls(
            shape=shape,
            starts=np.ascontiguousarray(
                np.broadcast_to(x, shape + x.shape[-1:]).reshape(count, x.shape[-1])
            ),
            modes=np.ascontiguousarray(
                np.broadcast_to(m, shape + m.shape[-1:]).reshape(count, len(counts))
            ),
            parameters=np.concatenate([np.empty((count, 0)), *columns], axis=1),
        )


def integrate(
    system: System,
    starts: ArrayLike,
    periods: int,
    *,
    parameters: Mapping[str, Any] | None = None,
    modes: ArrayLike | None = None,
    transient: int = 0,
    samples_per_period: int = 1,
    switches: bool = True,
    method: Taylor | RungeKutta4 = Taylor(),
    max_switches: int = 100,
    threads: int = 0,
    progress: Progress = None,
) -> Trajectories:
    """Run many members of a system and keep their samples and switches.

    Each member has its own start and parameters. Its trajectory does not depend on the others, nor on
    the number of threads, to the bit.

    Parameters
    ----------
    system : System
        The system.
    starts : array_like of float, shape (..., states)
        The states at the start, at phase 0 of the forcing.
    periods : int
        Periods to keep.
    parameters : mapping of str to array_like, shape (..., *shape of the parameter)
        Values of all parameters. The leading axes of starts, modes and parameters are broadcast
        against each other.
    modes : array_like of int, shape (..., units), optional
        The mode of each unit at the start, as a place in the list of its modes; by default the
        first. A unit that follows a sign, such as that of `abs`, has the mode of that sign. A guard
        that is already beyond zero fires at once, unless it is coming back.
    transient : int, optional
        Periods to run before any are kept.
    samples_per_period : int, optional
        Samples kept in each period, at equal distances; the last is that at phase 0 of the forcing. A
        sample is the state after all switches at its instant.
    switches : bool, optional
        Whether to keep the switches.
    method : Taylor or RungeKutta4, optional
        The method.
    max_switches : int, optional
        Switches in one period before a member ends as "chattering"; without end at one instant it does
        so too, and its `reason` says which.
    threads : int, optional
        Number of threads; 0 for as many as the machine has.
    progress : bool or callable, optional
        ``None``: a bar in a terminal or notebook; or a function of (what, done, total).

    Returns
    -------
    Trajectories

    Raises
    ------
    ValueError, TypeError
        If an argument does not fit; the message names it.
    DefinitionError
        If parameters make a coefficient that is not finite, or a frequency that is not positive.

    Examples
    --------
    An oscillator from two starts, four samples a period:

    >>> import numpy as np
    >>> from saltus.systems import System, integrate, states
    >>> x, v = states("x", "v")
    >>> oscillator = System([x, v], [v, -x], interval=2.0 * np.pi)
    >>> starts = [[1.0, 0.0], [2.0, 0.0]]
    >>> run = integrate(oscillator, starts, periods=1, samples_per_period=4)
    >>> run.samples[1, :, 0].round(6) + 0.0
    array([ 0., -2.,  0.,  2.])
    """
    members = Members.of(system, starts, modes, parameters)
    keep = whole("periods", periods, 0, 2**53)
    before = whole("transient", transient, 0, 2**53)
    each = whole("samples_per_period", samples_per_period, 1, 2**31)
    options = Options(method, max_switches, threads)
    with watched(progress) as show:
        raw = system.program.integrate(
            parameters=members.parameters,
            starts=members.starts,
            modes=members.modes,
            periods=keep,
            transient=before,
            per_period=each,
            switches=flag("switches", switches),
            settings=options,
            progress=show,
        )
    shape, rows = members.shape, keep * each
    n, units = len(system.states), len(system.modes)
    period = np.array(system.program.periods(members.parameters)).reshape(shape)
    beat = before + (np.arange(rows) + 1) / each
    return Trajectories(
        samples=raw.samples.reshape(*shape, rows, n),
        modes=raw.modes.reshape(*shape, rows, units),
        time=period[..., np.newaxis] * beat,
        period=period,
        end=raw.end.reshape(*shape, n),
        end_modes=raw.end_modes.reshape(*shape, units),
        periods=raw.periods.astype(np.int64).reshape(shape),
        steps=raw.steps.astype(np.int64).reshape(shape),
        status=words([word for word, _ in raw.status], shape),
        reason=words([sentence for _, sentence in raw.status], shape),
        switches=Switches(
            raw.switch_member.astype(np.int64),
            raw.switch_time,
            raw.switch_unit,
            raw.switch_source,
            raw.switch_target,
            raw.switch_state.reshape(-1, n),
        ),
    )


def words(values: Sequence[str], shape: tuple[int, ...]) -> NDArray[np.str_]:
    """Words as an array."""
    return np.array(values, dtype=np.str_).reshape(shape)


def _lead(shape: tuple[int, ...], trailing: int) -> tuple[int, ...]:
    return shape[: len(shape) - trailing]


def _broadcast(leads: Mapping[str, tuple[int, ...]]) -> tuple[int, ...]:
    try:
        return np.broadcast_shapes(*leads.values())
    except ValueError:
        told = ", ".join(f"{name} {shape}" for name, shape in leads.items())
        raise ValueError(f"the leading axes do not fit together: {told}") from None
