"""Progress of long work: a bar in a terminal or notebook, or a function of the user's own."""

from __future__ import annotations

import sys
import time
import warnings
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterator

__all__ = ["Progress", "ProgressFunction", "watched"]

#: Work that takes less shows no bar (s).
DELAY = 1.0


class ProgressFunction(Protocol):
    """A function that is called some ten times a second while saltus computes."""

    def __call__(self, what: str, done: int, total: int | None, /) -> object:
        """Take the name of the work, the number of its parts done, and their total, if known."""


#: ``None``: a bar if standard error is a terminal or a notebook; ``True``: always; ``False``: never.
Progress = bool | None | ProgressFunction


@contextmanager
def watched(progress: Progress) -> Iterator[ProgressFunction | None]:
    """Give the function to be called, and close its bar in the end."""
    if progress is None:
        progress = _somebody_looks()
    if callable(progress):
        yield progress
    elif progress:
        bar = _Bar()
        try:
            yield bar
        finally:
            bar.close()
    else:
        yield None


def _somebody_looks() -> bool:
    """Whether the standard error output is a terminal or a notebook; a service may have none at all."""
    try:
        return sys.stderr.isatty() or _in_notebook()
    except Exception:
        return False


def _in_notebook() -> bool:
    ipython = sys.modules.get("IPython")
    return ipython is not None and getattr(ipython.get_ipython(), "kernel", None) is not None


class _Bar:
    """A bar by tqdm, or one line that is rewritten where there is no tqdm.

    A bar that cannot be drawn is no reason to fail: it is not drawn again.
    """

    def __init__(self) -> None:
        self._bar: Any = None
        self._what = ""
        self._begun = time.monotonic()
        self._broken = False

    def __call__(self, what: str, done: int, total: int | None, /) -> None:
        if not self._broken:
            with self._at_most_broken():
                self._draw(what, done, total)

    def close(self) -> None:
        """Take the bar away."""
        with self._at_most_broken():
            if self._bar is not None:
                self._bar.close()
                self._bar = None

    @contextmanager
    def _at_most_broken(self) -> Iterator[None]:
        try:
            yield
        except Exception:
            self._broken = True

    def _draw(self, what: str, done: int, total: int | None) -> None:
        tqdm = _tqdm()
        if tqdm is not None:
            if what != self._what:
                self.close()
                self._what = what
                self._bar = tqdm(desc=what, total=total, delay=DELAY, leave=False)
            self._bar.update(done - self._bar.n)
        elif time.monotonic() - self._begun >= DELAY:
            if self._bar is None:
                self._bar = _Cell() if _in_notebook() else _Line()
            part = f"{done}" if not total else f"{100 * done // total} %"
            self._bar.show(f"{what}: {part}")


class _Line:
    """A line of the terminal."""

    def show(self, text: str) -> None:
        sys.stderr.write(f"\r\x1b[K{text}")
        sys.stderr.flush()

    def close(self) -> None:
        self.show("")


class _Cell:
    """An output of a notebook's cell, which is replaced; in the end it is empty."""

    def __init__(self) -> None:
        self._handle: Any = None

    def show(self, text: str) -> None:
        from IPython.display import display

        shown = {"text/plain": text}
        if self._handle is None:
            self._handle = display(shown, raw=True, display_id=True)  # type: ignore[no-untyped-call]
        else:
            self._handle.update(shown, raw=True)

    def close(self) -> None:
        self.show("")


def _tqdm() -> Any:
    try:
        with warnings.catch_warnings():
            # In a notebook without ipywidgets it says so, and shows a plain bar.
            warnings.simplefilter("ignore")
            from tqdm.auto import tqdm
    except ImportError:
        return None
    return tqdm
