"""Forcing and switches of a system."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

import numpy as np

from saltus._arguments import whole
from saltus._errors import DefinitionError
from saltus.systems._entrywise import array_of
from saltus.systems._expression import Expression, ExpressionLike, expression

__all__ = ["Forcing", "Pairs", "Transition", "Unit", "pairs"]

#: One or many things that belong to one or many expressions: a mapping, or pairs of (arrays of) them.
Pairs: TypeAlias = Mapping[Expression, Any] | Iterable[tuple[Any, Any]]


class Forcing:
    """A periodic forcing. A system has one.

    Parameters
    ----------
    frequency : float or Expression
        Angular frequency Ω (rad per unit of time); positive. Of several commensurate frequencies the
        largest of which all are whole multiples: 1 for 2 and 3.

    Attributes
    ----------
    cos, sin : Expression
        cos Ωt and sin Ωt. `harmonic` gives multiples and other phases. A frequency ω that is no
        multiple takes two further states c and s, with the rates -ω s and ω c and the start (1, 0).

    Examples
    --------
    A beat of the frequencies 2 and 3, which repeats after 2π, the second a quarter of its period late:

    >>> import numpy as np
    >>> forcing = Forcing(1.0)
    >>> beat = forcing.harmonic(2) + forcing.harmonic(3, phase=-0.5 * np.pi)
    """

    def __init__(self, frequency: ExpressionLike) -> None:
        self.frequency = expression(frequency)
        if self.frequency.changes:
            raise DefinitionError("the frequency of a forcing must not change with time")
        self.cos = Expression("forcing cos", tag=self, changes=True)
        self.sin = Expression("forcing sin", tag=self, changes=True)

    def harmonic(self, multiple: int = 1, phase: ExpressionLike = 0.0) -> Expression:
        """Give cos(n Ωt + phase) as a formula.

        Parameters
        ----------
        multiple : int, optional
            The multiple n of the frequency; 0 to 64.
        phase : float or Expression, optional
            The phase (rad). A formula of parameters is possible; the sample of each period is taken at
            Ωt = 0 whatever it is.

        Returns
        -------
        Expression

        Raises
        ------
        ValueError
            If the multiple is out of its range.
        DefinitionError
            If the phase changes with time.

        Examples
        --------
        >>> Forcing(2.0).harmonic(phase=0.3)
        ((0.955336489125606 * forcing cos) - (0.29552020666133955 * forcing sin))
        """
        n = whole("multiple", multiple, 0, 64)
        shift = expression(phase)
        if shift.changes:
            raise DefinitionError(f"the phase {shift!r} of a forcing must not change with time")
        cos, sin = self._multiple(n) if n else (expression(1.0), expression(0.0))
        if shift.operation == "number" and shift.tag == 0.0:
            return cos
        if shift.operation == "number":
            return math.cos(shift.tag) * cos - math.sin(shift.tag) * sin
        return shift.cos() * cos - shift.sin() * sin

    def _multiple(self, n: int) -> tuple[Expression, Expression]:
        """Give cos and sin of n Ωt, by halves, so that errors do not grow with n."""
        if n == 1:
            return self.cos, self.sin
        cos, sin = self._multiple(n // 2)
        cos, sin = 2.0 * cos * cos - 1.0, 2.0 * sin * cos
        if n % 2:
            cos, sin = cos * self.cos - sin * self.sin, sin * self.cos + cos * self.sin
        return cos, sin

    def __repr__(self) -> str:
        """Show the frequency."""
        return f"Forcing({self.frequency!r})"


@dataclass(frozen=True, eq=False)
class Transition:
    """The end of a mode of a unit: guard, next mode and resets; made by `Unit.transition`.

    Examples
    --------
    >>> from saltus.systems import states
    >>> (x,) = states("x")
    >>> Unit("free", "contact").transition("free", "contact", rising=x).target
    'contact'
    """

    unit: Unit
    source: str
    target: str
    guard: Expression
    direction: Literal["falling", "rising"]
    resets: tuple[tuple[Expression, Expression], ...]
    vanishing: tuple[tuple[Expression, int], ...]


class Unit:
    """A part that switches on its own, such as one contact: an automaton with modes.

    Parameters
    ----------
    *modes : str
        Names of its modes. The first is the one to start in unless another is given.

    Examples
    --------
    A wall of stiffness 50 at x = 1:

    >>> from saltus.systems import states
    >>> x, v = states("x", "v")
    >>> wall = Unit("free", "contact")
    >>> force = wall.choose(free=0.0, contact=-50.0 * (x - 1.0))
    >>> hit = wall.transition("free", "contact", rising=x - 1.0)
    >>> leave = wall.transition("contact", "free", falling=x - 1.0)
    """

    def __init__(self, *modes: str) -> None:
        if not modes or len(modes) > 256 or len(set(modes)) < len(modes):
            raise DefinitionError(f"{modes} are no modes: 1 to 256 different names are needed")
        self.modes = tuple(str(mode) for mode in modes)

    def __repr__(self) -> str:
        """Show the modes."""
        return f"Unit({', '.join(map(repr, self.modes))})"

    def choose(self, by_mode: Mapping[str, Any] | None = None, /, **more: Any) -> Any:
        """Give the formula that the present mode selects.

        Parameters
        ----------
        by_mode : mapping of str to array_like of Expression or float, optional
            A formula, or an array of them, for each mode.
        **more
            The same, for modes whose names are identifiers.

        Returns
        -------
        Expression, or ndarray of Expression

        Raises
        ------
        DefinitionError
            If a mode has no formula, or there is one for another.

        Examples
        --------
        A force in contact alone:

        >>> from saltus.systems import states
        >>> x, v = states("x", "v")
        >>> force = Unit("free", "contact").choose(free=0.0, contact=-50.0 * (x - 1.0))
        """
        all_modes = {**(by_mode or {}), **more}
        if set(all_modes) != set(self.modes):
            raise DefinitionError(
                f"formulas for {sorted(all_modes)}: one is needed for each of {list(self.modes)}"
            )
        parts: Any = np.broadcast_arrays(*(_objects(all_modes[mode]) for mode in self.modes))
        out = array_of(parts[0].shape)
        for index in np.ndindex(out.shape):
            of = tuple(expression(part[index]) for part in parts)
            changes = any(one.changes for one in of)
            out[index] = Expression("choice", of, tag=self, changes=changes)
        return out[()]

    def transition(
        self,
        source: str,
        target: str,
        *,
        falling: ExpressionLike | None = None,
        rising: ExpressionLike | None = None,
        reset: Pairs = (),
        vanishing: Pairs = (),
    ) -> Transition:
        """Leave a mode when a guard comes to zero.

        Parameters
        ----------
        source, target : str
            The mode that ends and the one that follows, which may be the same.
        falling, rising : Expression
            The guard, one of the two: positive while the mode lasts, and falling to zero at its end;
            or negative, and rising. It is looked at again after the switch: a mode that follows itself
            needs a reset that moves its guard back.
        reset : mapping or pairs of (states, values), optional
            States that jump, and where to, from the values of all states just before. Both may be
            arrays.
        vanishing : mapping or pairs of (guards, multiplicities), optional
            Guards that are zero after the switch by construction, and the number of their derivatives
            that are zero, themselves included. It may be left out: such zeros are found, to rounding. If
            given, it also holds where rounding hides one.

        Returns
        -------
        Transition
            To be handed to `System`.

        Raises
        ------
        DefinitionError
            If there is no such mode, not one guard, or a reset or guard that is no expression.

        Examples
        --------
        A ball that bounces with restitution 0.8 on a floor at y = 0:

        >>> from saltus.systems import states
        >>> y, v = states("y", "v")
        >>> bounce = Unit("flight").transition("flight", "flight", falling=y, reset={v: -0.8 * v})
        """
        for mode in (source, target):
            if mode not in self.modes:
                raise DefinitionError(f"{mode!r} is not one of the modes {list(self.modes)}")
        if (falling is None) == (rising is None):
            raise DefinitionError("a transition has one guard: give either falling or rising")
        guard = expression(falling if falling is not None else rising)  # type: ignore[arg-type]
        resets = tuple((state, expression(value)) for state, value in pairs("reset", reset))
        once = {state for state, _ in resets}
        if len(once) < len(resets):
            raise DefinitionError(f"reset: {[state for state, _ in resets]}: each state is reset once")
        return Transition(
            unit=self,
            source=source,
            target=target,
            guard=guard,
            direction="falling" if falling is not None else "rising",
            resets=resets,
            vanishing=tuple(
                (one, whole("a multiplicity", count, 1, 255))
                for one, count in pairs("vanishing", vanishing)
            ),
        )


def pairs(name: str, given: Pairs) -> list[tuple[Expression, Any]]:
    """Expressions and what belongs to them, one by one.

    Raises
    ------
    DefinitionError
        If shapes do not fit or something is no expression.
    """
    out: list[tuple[Expression, Any]] = []
    for left, right in given.items() if isinstance(given, Mapping) else given:
        first, second = _objects(left), _objects(right)
        try:
            second = np.broadcast_to(second, first.shape)
        except ValueError:
            raise DefinitionError(
                f"{name}: an array of shape {second.shape} for one of shape {first.shape}"
            ) from None
        for index in np.ndindex(first.shape):
            if not isinstance(first[index], Expression):
                raise DefinitionError(f"{name}: {first[index]!r} is not an expression")
            out.append((first[index], second[index]))
    return out


def _objects(value: Any) -> Any:
    return np.asarray(value, dtype=object)
