"""Which setting each program runs with in each column, and how much of the work it does.

A setting is the fastest of a grid whose error on the accuracy label stays within the bound of the
column, for itself and for every tighter setting of the grid (`scripts/compare-peers --tune` tries them
all and prints the choice). The error is measured again in every comparison and printed beside the rate.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum


class Column(Enum):
    """A column of the table: a piece of work at an accuracy."""

    W1_6 = ("W1", 1e-6)
    W1_8 = ("W1", 1e-8)
    W2_6 = ("W2", 1e-6)
    W2_8 = ("W2", 1e-8)

    @property
    def work(self) -> str:
        return self.value[0]

    @property
    def bound(self) -> float:
        return self.value[1]

    @property
    def title(self) -> str:
        return f"{self.work} at {self.bound:.0e}".replace("e-0", "e-")


@dataclass(frozen=True)
class Size:
    """How many values of zeta, how many periods each, and how many of those are sampled."""

    values: int
    periods: int
    keep: int


@dataclass(frozen=True)
class Row:
    """A program of the table. `kind` says who runs it, `name` what to tell that runner."""

    key: str
    title: str
    kind: str
    name: str
    settings: dict[Column, str]
    sizes: dict[str, Size]


# The whole work, and what slower programs do of it: rates are per period of one trajectory.
WHOLE = {"W1": Size(256, 400, 100), "W2": Size(16, 50, 10)}
PART = {"W1": Size(32, 400, 100), "W2": Size(16, 50, 10)}


def same(work_1: tuple[str, str], work_2: tuple[str, str]) -> dict[Column, str]:
    return dict(zip(Column, (*work_1, *work_2)))


ROWS = [
    # For saltus a setting is "tolerance order".
    Row(
        "saltus",
        "saltus",
        "saltus",
        "condensed slow-manifold",
        same(("3.2e-07 16", "3.2e-09 18"), ("1e-07 14", "3.2e-09 18")),
        WHOLE,
    ),
    Row(
        "saltus-full",
        "saltus, W2 by the full model",
        "saltus",
        "condensed full",
        same(("3.2e-07 16", "3.2e-09 18"), ("1e-08 10", "1e-08 10")),
        WHOLE,
    ),
    # heyoka's tolerance sets the order; the step follows from the order.
    Row(
        "heyoka-8",
        "heyoka, batches of 8",
        "heyoka",
        "8",
        same(("1e-6", "1e-8"), ("1e-7", "1e-7")),
        WHOLE,
    ),
    Row(
        "heyoka-1",
        "heyoka, one at a time",
        "heyoka",
        "1",
        same(("1e-6", "1e-8"), ("1e-6", "1e-6")),
        PART,
    ),
    # For RK4 a setting is the number of steps in one period of the body on rigid ground.
    Row(
        "rk4",
        "RK4 by hand, one at a time",
        "rust",
        "rk4",
        same(("312", "973"), ("1350", "1350")),
        PART,
    ),
    Row(
        "dopri5",
        "differential-equations, dopri5",
        "rust",
        "dopri5",
        same(("3.2e-9", "3.2e-11"), ("5.6e-9", "5.6e-9")),
        PART,
    ),
    Row(
        "dop853",
        "differential-equations, dop853",
        "rust",
        "dop853",
        same(("5.6e-8", "1.8e-10"), ("3.2e-9", "3.2e-9")),
        PART,
    ),
    Row(
        "tsit45",
        "diffsol, tsit45",
        "rust",
        "tsit45",
        same(("1e-8", "5.6e-11"), ("1e-11", "1e-11")),
        PART,
    ),
    Row(
        "numba",
        "Numba, RK4",
        "numba",
        "rk4",
        same(("312", "973"), ("1350", "1350")),
        PART,
    ),
]


def tenths(first: int, last: int, parts: int) -> list[str]:
    """Powers of ten from 10^-first to 10^-last, so many to a factor of ten."""
    return [f"{10 ** (-k / parts):.2g}" for k in range(first * parts, last * parts + 1)]


def grid(row: Row, column: Column) -> list[str]:
    """Settings to try, loosest first."""
    if row.kind == "saltus":
        orders = range(8, 21, 2)
        return [f"{tolerance} {order}" for order in orders for tolerance in tenths(4, 12, 2)]
    if row.kind == "heyoka":
        return tenths(3, 12, 2)
    if row.name == "rk4":
        first = 100 if column.work == "W1" else 1200
        return [str(round(first * 1.04**k)) for k in range(80 if column.work == "W1" else 12)]
    return tenths(4, 13, 4)
