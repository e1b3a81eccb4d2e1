"""Exceptions of saltus."""

from __future__ import annotations

import difflib
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = [
    "ComputationError",
    "DefinitionError",
    "FormulaError",
    "InternalError",
    "ResultError",
    "SaltusError",
    "StudyError",
    "UnknownNameError",
    "unknown",
]


class SaltusError(Exception):
    """Base of all errors of saltus; the message says what would be right."""


class StudyError(SaltusError, ValueError):
    """A study that cannot be: an unknown key, a value out of range, a contradiction.

    Attributes
    ----------
    key : str or None
        The key concerned, such as ``"jumper.0.mass"``.
    help : str or None
        What would be right.
    line : int or None
        Line of the study file, from 1, if the problem is in a file.
    """

    def __init__(
        self,
        message: str,
        key: str | None = None,
        help: str | None = None,  # noqa: A002 (the word that users know)
        line: int | None = None,
    ) -> None:
        super().__init__(message, key, help, line)
        self.key = key
        self.help = help
        self.line = line

    def __str__(self) -> str:
        """The message alone."""
        return str(self.args[0])


class DefinitionError(SaltusError, ValueError):
    """A system of one's own that cannot be, or numbers that do not fit it."""


class FormulaError(DefinitionError, TypeError):
    """An operation on an expression that makes no formula; the message says what to write instead."""


class ComputationError(SaltusError, ArithmeticError):
    """A question that has no answer, such as an orbit that Newton's method does not find."""


class ResultError(SaltusError, OSError):
    """A result that cannot be read or written."""


class UnknownNameError(SaltusError, KeyError):
    """A name that a result does not have; the message tells those that come near."""

    def __str__(self) -> str:
        """The message alone; a KeyError would show it in quotes."""
        return str(self.args[0])


def unknown(what: str, name: object, known: Iterable[str]) -> UnknownNameError:
    """Give the error of a name that is none of `known`."""
    names = list(known)
    # a part of a name comes nearer than letters that are alike
    near = [one for one in names if isinstance(name, str) and len(name) > 2 and name in one][:5]
    near = near or difflib.get_close_matches(str(name), names, 5, 0.5)
    told = f"did you mean {' or '.join(map(repr, near))}?" if near else f"there are: {', '.join(names)}"
    return UnknownNameError(f"no {what} {name!r}; {told}")


class InternalError(SaltusError, RuntimeError):
    """An error of saltus itself: please report it."""
