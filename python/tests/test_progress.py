"""Bars show what a function is told, and only if somebody looks."""

from __future__ import annotations

import io
import sys

import pytest

import saltus
from saltus import _native, _progress
from saltus._progress import watched


def test_nobody_looks_at_a_pipe() -> None:
    with watched(None) as show:
        assert show is None
    with watched(False) as show:
        assert show is None


def test_a_function_is_called_as_it_is() -> None:
    def own(what: str, done: int, total: int | None) -> None: ...

    with watched(own) as show:
        assert show is own


def test_a_bar_shows_the_part_that_is_done(capsys: pytest.CaptureFixture[str]) -> None:
    with watched(True) as show:
        assert show is not None
        show("counting", 250, 1000)
        show("counting", 1000, 1000)
    assert capsys.readouterr().out == ""


def test_without_tqdm_one_line_is_rewritten(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    assert _progress._tqdm() is None
    with watched(True) as show:
        _native.count(1000, progress=show)
    assert capsys.readouterr().err == "", "what is quick shows no bar"
    monkeypatch.setattr(_progress, "DELAY", 0.0)
    with watched(True) as show:
        _native.count(1000, progress=show)
    assert capsys.readouterr().err == "\r\x1b[Kcounting: 100 %\r\x1b[K"


def test_each_work_has_a_bar_of_its_own(monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[tuple[str, int | None]] = []

    class Bar:
        n = 0

        def __init__(self, desc: str, total: int | None, **named: object) -> None:
            made.append((desc, total))

        def update(self, more: int) -> None:
            self.n += more
            assert self.n >= 0

        def close(self) -> None: ...

    monkeypatch.setattr(_progress, "_tqdm", lambda: Bar)
    with watched(True) as show:
        assert show is not None
        for what, done, total in (("periods", 7, 10), ("periods", 10, 10), ("pixels", 1, 30)):
            show(what, done, total)
    assert made == [("periods", 10), ("pixels", 30)]


def test_in_a_notebook_without_tqdm_one_output_is_replaced(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    shown: list[str] = []

    class Handle:
        def update(self, bundle: dict[str, str], *, raw: bool) -> None:
            shown[-1] = bundle["text/plain"]

    def display(bundle: dict[str, str], *, raw: bool, display_id: bool) -> Handle:
        shown.append(bundle["text/plain"])
        return Handle()

    monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    monkeypatch.setattr(_progress, "DELAY", 0.0)
    monkeypatch.setattr(_progress, "_in_notebook", lambda: True)
    monkeypatch.setattr("IPython.display.display", display)
    with watched(True) as show:
        assert show is not None
        for done in range(5):
            show("counting", done, 10)
        assert shown == ["counting: 40 %"]
    assert shown == [""]
    assert capsys.readouterr().err == ""


def test_an_estimate_is_never_exceeded() -> None:
    told: list[tuple[int, int | None]] = []
    study = saltus.Study.paper().set({"plate.inertia": "condensed", "jumper.damping_ratio": 0.12})
    saltus.sweep(
        study,
        values=[0.11, 0.12],
        transient=10,
        record=5,
        progress=lambda what, done, total: told.append((done, total)),
    )
    assert told
    assert all(total is None or done <= total for done, total in told)


class Gone(io.StringIO):
    """A terminal that went away."""

    def isatty(self) -> bool:
        return True

    def write(self, text: str) -> int:
        raise OSError("no such device")


class Asks(io.StringIO):
    """What does not know whether it is a terminal."""

    def isatty(self) -> bool:
        raise ValueError("I/O operation on closed file")


@pytest.mark.parametrize(
    "stderr", [None, object(), Gone(), Asks()], ids=["none", "odd", "gone", "closed"]
)
@pytest.mark.parametrize("progress", [None, True])
@pytest.mark.parametrize("tqdm", [True, False], ids=["tqdm", "line"])
def test_a_bar_that_cannot_be_drawn_is_no_reason_to_fail(
    stderr: object, progress: bool | None, tqdm: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stderr", stderr)
    if not tqdm:
        monkeypatch.setitem(sys.modules, "tqdm.auto", None)
    with watched(progress) as show:
        assert _native.count(1000, progress=show) == 1000
        if show is not None:
            show("counting", 7, None)


def test_an_interrupt_while_a_bar_is_drawn_is_not_swallowed(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted() -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(_progress, "_tqdm", interrupted)
    with pytest.raises(KeyboardInterrupt), watched(True) as show:
        _native.count(1000, progress=show)
