"""The native module; see crates/saltus-python."""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any, Literal, TypeAlias, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Answer",
    "Exponents",
    "Figure",
    "Orbit",
    "Program",
    "Trajectories",
    "__version__",
    "ask",
    "cite",
    "colour",
    "colours",
    "compute",
    "count",
    "describe",
    "load",
    "palette",
    "paper",
    "paper_template",
    "parse",
    "pieces",
    "program",
    "read",
    "rerun",
    "resolve",
    "schema",
    "shut_down",
    "write",
]

__version__: str

_Progress: TypeAlias = Callable[[str, int, int | None], object] | None
_Operation: TypeAlias = tuple[str, list[int], float]
_Transition: TypeAlias = tuple[int, float, int, list[tuple[int, int]], list[tuple[int, int]]]

_Resolved: TypeAlias = tuple[str, str, str]
_Array: TypeAlias = tuple[
    str, list[str], list[int], Any, dict[str, Any], list[tuple[int, str]], int | None, bool
]
_Parts: TypeAlias = tuple[
    dict[str, tuple[dict[str, str], dict[str, Any]]],
    dict[str, Figure],
    dict[str, tuple[dict[str, Any], list[_Array]]],
    dict[str, bytes],
]

def ask(
    request: str,
    study: str,
    *,
    out: PathLike[str] | None = None,
    resume: bool = False,
    pieces: Sequence[tuple[int, bytes]] | None = None,
    threads: int = 0,
    progress: _Progress = None,
) -> Answer: ...
def cite(path: PathLike[str]) -> str: ...
def colour(kind: str, period: int) -> str: ...
def colours(attractors: Sequence[tuple[str, int]]) -> list[str]: ...
def compute(
    request: str,
    study: str,
    pieces: Sequence[int],
    *,
    threads: int = 0,
    progress: _Progress = None,
) -> list[tuple[int, bytes]]: ...
def count(
    total: int, *, panics: bool = False, stops: bool = True, progress: _Progress = None
) -> int: ...
def describe(json: str) -> tuple[str, list[str]]: ...
def load(path: PathLike[str], overrides: Sequence[str]) -> _Resolved: ...
def palette() -> list[str]: ...
def paper() -> _Resolved: ...
def paper_template() -> str: ...
def parse(name: str, text: str, overrides: Sequence[str]) -> _Resolved: ...
def pieces(request: str, study: str) -> int: ...
def program(arguments: Sequence[str]) -> int: ...
def read(path: PathLike[str]) -> Answer: ...
def rerun(
    path: PathLike[str],
    *,
    out: PathLike[str] | None = None,
    threads: int = 0,
    progress: _Progress = None,
) -> tuple[bool, str, str]: ...
def resolve(json: str, overrides: Sequence[str]) -> _Resolved: ...
def schema() -> str: ...
def shut_down() -> None: ...
def write(path: PathLike[str], content: bytes) -> None: ...

@final
class Answer:
    @property
    def command(self) -> str: ...
    @property
    def study(self) -> _Resolved: ...
    def summary(self) -> str: ...
    def document(self) -> str: ...
    def cite(self) -> str: ...
    def shortfall(self) -> str | None: ...
    def parts(self) -> _Parts: ...
    def save(self, out: PathLike[str]) -> None: ...

@final
class Figure:
    def styled(self, width: str | None, font_size: str, titles: bool) -> Figure: ...
    def svg(self) -> str: ...
    def pdf(self) -> bytes: ...
    def png(self, scale: float) -> bytes: ...

@final
class Program:
    def __new__(
        cls,
        *,
        operations: Sequence[_Operation],
        parameters: int,
        rates: Sequence[int],
        forced: bool,
        clock: int,
        units: Sequence[Sequence[Sequence[_Transition]]],
        scales: Sequence[int | None] = ...,
        signs: Sequence[int] = ...,
    ) -> Program: ...
    @property
    def quantities(self) -> int: ...
    def periods(self, parameters: NDArray[np.float64]) -> list[float]: ...
    def integrate(
        self,
        *,
        parameters: NDArray[np.float64],
        starts: NDArray[np.float64],
        modes: NDArray[np.uint8],
        periods: int,
        transient: int,
        per_period: int,
        switches: bool,
        settings: object,
        progress: _Progress,
    ) -> Trajectories: ...
    def find_orbit(
        self,
        *,
        parameters: NDArray[np.float64],
        starts: NDArray[np.float64],
        modes: NDArray[np.uint8],
        period: int,
        tolerance: float,
        iterations: int,
        settings: object,
    ) -> Orbit: ...
    def lyapunov(
        self,
        *,
        parameters: NDArray[np.float64],
        starts: NDArray[np.float64],
        modes: NDArray[np.uint8],
        periods: int,
        transient: int,
        count: int,
        settings: object,
        progress: _Progress,
    ) -> Exponents: ...

@final
class Trajectories:
    @property
    def samples(self) -> NDArray[np.float64]: ...
    @property
    def modes(self) -> NDArray[np.uint8]: ...
    @property
    def end(self) -> NDArray[np.float64]: ...
    @property
    def end_modes(self) -> NDArray[np.uint8]: ...
    @property
    def periods(self) -> NDArray[np.uint64]: ...
    @property
    def steps(self) -> NDArray[np.uint64]: ...
    @property
    def status(self) -> list[tuple[str, str]]: ...
    @property
    def switch_member(self) -> NDArray[np.uint64]: ...
    @property
    def switch_time(self) -> NDArray[np.float64]: ...
    @property
    def switch_unit(self) -> NDArray[np.uint8]: ...
    @property
    def switch_source(self) -> NDArray[np.uint8]: ...
    @property
    def switch_target(self) -> NDArray[np.uint8]: ...
    @property
    def switch_state(self) -> NDArray[np.float64]: ...

@final
class Orbit:
    @property
    def period(self) -> int: ...
    @property
    def places(self) -> NDArray[np.float64]: ...
    @property
    def modes(self) -> NDArray[np.uint8]: ...
    @property
    def multipliers(self) -> list[tuple[float, float]]: ...
    @property
    def multiplier_errors(self) -> list[float]: ...
    @property
    def stability(self) -> Literal["stable", "unstable", "neutral"]: ...
    @property
    def in_family(self) -> bool: ...
    @property
    def monodromy(self) -> NDArray[np.float64]: ...
    @property
    def switches(self) -> list[tuple[float, int, int, int]]: ...
    @property
    def residual(self) -> float: ...
    @property
    def iterations(self) -> int: ...

@final
class Exponents:
    @property
    def exponents(self) -> NDArray[np.float64]: ...
    @property
    def standard_errors(self) -> NDArray[np.float64]: ...
    @property
    def intervals(self) -> NDArray[np.float64]: ...
    @property
    def on_cycle(self) -> list[bool]: ...
    @property
    def dimension(self) -> NDArray[np.float64]: ...
    @property
    def dimension_error(self) -> NDArray[np.float64]: ...
    @property
    def status(self) -> list[tuple[str, str]]: ...
