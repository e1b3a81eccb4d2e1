"""A system: states, their rates, and switches."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from saltus import _native
from saltus._errors import DefinitionError
from saltus.systems._conditions import Sides
from saltus.systems._expression import Expression, ExpressionLike, expression
from saltus.systems._switching import Forcing, Transition

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from saltus.systems._switching import Unit

__all__ = ["Definition", "System"]


@dataclass(frozen=True)
class Definition:
    """A system as flat lists, as the native module reads it and as it is sent to other processes."""

    #: Name, places of its operands among earlier ones, number or index.
    operations: tuple[tuple[str, list[int], float], ...]
    rates: tuple[int, ...]
    forced: bool
    #: Place of the forcing frequency, or of the interval.
    clock: int
    #: For each mode of each unit: guard, sign, target, resets, vanishing guards.
    units: tuple[tuple[tuple[Any, ...], ...], ...]
    states: tuple[str, ...]
    modes: tuple[tuple[str, ...], ...]
    #: Shape of each parameter, by name.
    parameters: dict[str, tuple[int, ...]] = field(default_factory=dict)
    #: Place of the scale of each state, where one is given.
    scales: tuple[int | None, ...] = ()
    #: Units that follow the sign of the guard of their first mode.
    signs: tuple[int, ...] = ()

    def program(self) -> _native.Program:
        """The same as a program of the engine."""
        return _native.Program(
            operations=self.operations,
            parameters=sum(math.prod(shape) for shape in self.parameters.values()),
            rates=self.rates,
            forced=self.forced,
            clock=self.clock,
            units=self.units,
            scales=self.scales,
            signs=self.signs,
        )


class System:
    """A forced piecewise-smooth system x' = f(x, cos Ωt, sin Ωt).

    Parameters
    ----------
    states : array_like of Expression
        The states, in the order in which starts and samples hold them: a list of states, of arrays
        of them, or one array.
    rates : array_like of Expression or float
        The rate of each, in the same arrangement.
    forcing : Forcing, optional
        The forcing. The system is sampled once in each period, at phase 0.
    interval : float or Expression, optional
        Sampling interval of a system without forcing; a period is this long then.
    transitions : iterable of Transition, optional
        Transitions between the modes of its units.

    Attributes
    ----------
    states : tuple of str
        Names of the states.
    parameters : dict of str to tuple of int
        Shape of each parameter.
    modes : tuple of tuple of str
        Names of the modes of each unit. Units come in the order in which the transitions name them.

    Raises
    ------
    DefinitionError
        If states, rates and transitions do not make a system, or a name stands for two things; the
        message says why.

    Examples
    --------
    A ball under gravity 1 that bounces with restitution 0.8 on a table vibrating as 0.1 cos t:

    >>> from saltus.systems import Forcing, Unit, states
    >>> y, v = states("y", "v")
    >>> table, ball = Forcing(1.0), Unit("flight")
    >>> rebound = -0.8 * v - 1.8 * 0.1 * table.sin
    >>> bounce = ball.transition(
    ...     "flight", "flight", falling=y - 0.1 * table.cos, reset={v: rebound}
    ... )
    >>> System([y, v], [v, -1.0], forcing=table, transitions=[bounce])
    System(states=('y', 'v'), parameters={}, modes=(('flight',),))
    """

    def __init__(
        self,
        states: Any,
        rates: Any,
        *,
        forcing: Forcing | None = None,
        interval: ExpressionLike | None = None,
        transitions: Iterable[Transition] = (),
    ) -> None:
        leaves = [transitions] if isinstance(transitions, Transition) else list(transitions)
        wrong = [one for one in leaves if not isinstance(one, Transition)]
        if wrong:
            raise DefinitionError(f"{wrong[0]!r} is no transition: Unit.transition makes them")
        self._open(_define(states, rates, forcing, interval, tuple(leaves)))

    def _open(self, definition: Definition) -> None:
        self._definition = definition
        self._program = definition.program()

    @property
    def states(self) -> tuple[str, ...]:
        """Names of the states."""
        return self._definition.states

    @property
    def parameters(self) -> dict[str, tuple[int, ...]]:
        """Shape of each parameter."""
        return dict(self._definition.parameters)

    @property
    def modes(self) -> tuple[tuple[str, ...], ...]:
        """Names of the modes of each unit."""
        return self._definition.modes

    @property
    def program(self) -> _native.Program:
        """The system as a program of the engine."""
        return self._program

    def __repr__(self) -> str:
        """Show states, parameters and modes."""
        states, parameters = self.states, self.parameters
        return f"System(states={states}, parameters={parameters}, modes={self.modes})"

    def __reduce__(self) -> tuple[Any, tuple[Definition]]:
        """Send the definition to other processes."""
        return _reopened, (self._definition,)


def _reopened(definition: Definition) -> System:
    system = System.__new__(System)
    system._open(definition)
    return system


def _define(
    states: Any,
    rates: Any,
    forcing: Forcing | None,
    interval: ExpressionLike | None,
    transitions: tuple[Transition, ...],
) -> Definition:
    own = list(_flat(states))
    wrong = [one for one in own if not isinstance(one, Expression) or one.operation != "state"]
    if not own or wrong:
        raise DefinitionError(f"{wrong[0]!r} is no state" if wrong else "a system needs a state")
    if len(set(own)) < len(own):
        raise DefinitionError("a state is named twice")
    twice = [name for name, count in Counter(map(str, own)).items() if count > 1]
    if twice:
        raise DefinitionError(f"two states have the name {twice[0]!r}: give them different names")
    flow = [expression(rate) for rate in _flat(rates)]
    if len(flow) != len(own):
        raise DefinitionError(f"{len(own)} states and {len(flow)} rates: each state needs one rate")
    if (forcing is None) == (interval is None):
        raise DefinitionError("a system is sampled by its forcing or at an interval: give one of them")
    if forcing is not None and not isinstance(forcing, Forcing):
        raise DefinitionError(f"forcing is {forcing!r}: one Forcing is needed, such as Forcing(1.0)")
    clock = forcing.frequency if forcing is not None else expression(interval)  # type: ignore[arg-type]
    listing = _Listing(own, forcing, transitions)
    definition = Definition(
        rates=tuple(listing.place(rate) for rate in flow),
        forced=forcing is not None,
        clock=listing.place(clock),
        units=listing.units(transitions),
        signs=listing.signs(),
        scales=tuple(None if (scale := state.tag[1]) is None else listing.place(scale) for state in own),
        operations=tuple(listing.operations),
        states=tuple(str(state) for state in own),
        modes=tuple(unit.modes for unit in listing.known_units),
        parameters=listing.parameters,
    )
    # q[0] belongs to q
    named = {name.partition("[")[0] for name in definition.states}
    both = [name for name in definition.parameters if name in named]
    if both:
        raise DefinitionError(
            f"a state and a parameter have the name {both[0]!r}: give them different names"
        )
    return definition


def _flat(values: Any) -> Iterator[Any]:
    """The entries of nested lists and arrays, in order."""
    if isinstance(values, list | tuple | np.ndarray):
        for value in values:
            yield from _flat(value)
    else:
        yield values


class _Listing:
    """Expressions as a flat list of operations, each once."""

    def __init__(
        self,
        states: Sequence[Expression],
        forcing: Forcing | None,
        transitions: Sequence[Transition],
    ) -> None:
        self.operations: list[tuple[str, list[int], float]] = []
        self.parameters: dict[str, tuple[int, ...]] = {}
        self.known_units: list[Unit] = list(dict.fromkeys(one.unit for one in transitions))
        self._states = {state: index for index, state in enumerate(states)}
        self._forcing = forcing
        self._first_of: dict[str, int] = {}
        self._places: dict[Expression, int] = {}

    def place(self, root: Expression) -> int:
        """The place of an expression on the list; it is added after its operands if it is not there."""
        waiting = [root]
        while waiting:
            part = waiting[-1]
            missing = [one for one in part.of if one not in self._places]
            if part in self._places:
                waiting.pop()
            elif missing:
                waiting.extend(reversed(missing))
            else:
                waiting.pop()
                self._places[part] = len(self.operations)
                of = [self._places[one] for one in part.of]
                self.operations.append((part.operation, of, self._value(part)))
        return self._places[root]

    def _value(self, part: Expression) -> float:
        if part.operation == "number":
            return float(part.tag)
        if part.operation == "state":
            return self.state(part)
        if part.operation == "parameter":
            return self._parameter(*part.tag)
        if part.operation == "choice":
            if part.tag not in self.known_units:
                self.known_units.append(part.tag)
            return self.known_units.index(part.tag)
        if part.operation.startswith("forcing") and part.tag is not self._forcing:
            raise DefinitionError(self._foreign(part.operation, part.tag))
        return 0.0

    def _foreign(self, what: str, other: Forcing) -> str:
        """Error of a forcing in a formula that is not that of the system."""
        if self._forcing is None:
            return (
                f"a formula holds the {what} of {other!r}, and the system has no forcing: "
                "give it as forcing=... in place of the interval"
            )
        return (
            f"a formula holds the {what} of {other!r}, which is not the forcing of the system, "
            f"{self._forcing!r}: a system has one, so take its own cos and sin. A multiple n of its "
            "frequency is harmonic(n); another frequency w takes two further states c and s, with the "
            "rates -w * s and w * c and the start (1, 0)"
        )

    def state(self, state: Expression) -> int:
        """The index of a state."""
        if state not in self._states:
            raise DefinitionError(f"{state!r} is not among the states of the system")
        return self._states[state]

    def _parameter(self, name: str, shape: tuple[int, ...], place: int = 0) -> int:
        known = self.parameters.setdefault(name, shape)
        if known != shape:
            raise DefinitionError(f"the parameter {name} has the shapes {known} and {shape}")
        if name not in self._first_of:
            others = [math.prod(one) for key, one in self.parameters.items() if key != name]
            self._first_of[name] = sum(others)
        return self._first_of[name] + place

    def units(self, transitions: Iterable[Transition]) -> tuple[tuple[tuple[Any, ...], ...], ...]:
        """The transitions of each mode of each unit."""
        leaves: dict[tuple[Unit, str], list[Any]] = {}
        for one in transitions:
            resets = [(self.state(state), self.place(value)) for state, value in one.resets]
            vanishing = [(self.place(guard), count) for guard, count in one.vanishing]
            sign = 1.0 if one.direction == "falling" else -1.0
            target = one.unit.modes.index(one.target)
            leave = (self.place(one.guard), sign, target, resets, vanishing)
            leaves.setdefault((one.unit, one.source), []).append(leave)
        # a guard may hold units that were not known before
        for unit in self.known_units:
            if isinstance(unit, Sides):
                guard = self.place(unit.guard)
                leaves[unit, "negative"] = [(guard, -1.0, 1, [], [])]
                leaves[unit, "positive"] = [(guard, 1.0, 0, [], [])]
        return tuple(
            tuple(tuple(leaves.get((unit, mode), ())) for mode in unit.modes)
            for unit in self.known_units
        )

    def signs(self) -> tuple[int, ...]:
        """The units that follow a sign, those first on which the guards of others depend."""
        follow = [index for index, unit in enumerate(self.known_units) if isinstance(unit, Sides)]
        return tuple(sorted(follow, key=lambda index: self._places[self.known_units[index].guard]))  # type: ignore[attr-defined]
