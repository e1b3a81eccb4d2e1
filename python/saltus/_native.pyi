"""The native module; see crates/saltus-python."""

from collections.abc import Callable, Sequence
from typing import TypeAlias, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "Exponents",
    "Orbit",
    "Program",
    "Trajectories",
    "__version__",
    "check_study",
    "count",
    "paper_template",
    "schema",
    "shut_down",
]

__version__: str

_Progress: TypeAlias = Callable[[str, int, int | None], object] | None
_Operation: TypeAlias = tuple[str, list[int], float]
_Transition: TypeAlias = tuple[int, float, int, list[tuple[int, int]], list[tuple[int, int]]]

def check_study(name: str, text: str, overrides: Sequence[str]) -> None: ...
def count(total: int, *, panics: bool = False, progress: _Progress = None) -> int: ...
def paper_template() -> str: ...
def schema() -> str: ...
def shut_down() -> None: ...

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
    def dimension(self) -> NDArray[np.float64]: ...
    @property
    def dimension_error(self) -> NDArray[np.float64]: ...
    @property
    def status(self) -> list[tuple[str, str]]: ...
