"""Errors say which key, what would be right, and survive a journey to another process."""

from __future__ import annotations

import pickle

import pytest

import saltus
from saltus import _native


def test_the_papers_study_is_right() -> None:
    _native.parse("paper.toml", _native.paper_template(), [])


def test_a_study_error_names_key_and_advice() -> None:
    with pytest.raises(saltus.StudyError) as caught:
        _native.parse("paper.toml", _native.paper_template(), ["jumper.masss=80"])
    error = caught.value
    assert isinstance(error, ValueError)
    assert error.key is not None
    assert "masss" in str(error)
    assert error.help is not None


def test_a_study_error_names_the_line() -> None:
    text = _native.paper_template() + "\nnonsense = 3\n"
    with pytest.raises(saltus.StudyError) as caught:
        _native.parse("mine.toml", text, [])
    assert caught.value.line is not None
    assert f"line {caught.value.line}" in str(caught.value)


@pytest.mark.parametrize(
    "error",
    [
        saltus.StudyError("no such key", "jumper.0.mas", "did you mean mass?", 3),
        saltus.DefinitionError("no"),
        saltus.FormulaError("no"),
        saltus.ComputationError("no"),
        saltus.ResultError("no"),
        saltus.InternalError("no"),
    ],
)
def test_errors_can_be_sent_to_other_processes(error: saltus.SaltusError) -> None:
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is type(error)
    assert str(again) == str(error)
    assert vars(again) == vars(error)
    assert isinstance(error, saltus.SaltusError)
