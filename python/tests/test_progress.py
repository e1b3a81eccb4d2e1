"""Bars show what a function is told, and only if somebody looks."""

from __future__ import annotations

import sys

import pytest

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
    assert capsys.readouterr().err == "\rcounting: 100 %\r\x1b[K"
