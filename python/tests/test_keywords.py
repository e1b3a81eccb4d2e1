"""Keys of a question's table are keywords of its function."""

from __future__ import annotations

import builtins
import dataclasses
import inspect
import re
from typing import Any

import numpy as np
import pytest

import saltus
import saltus.dask
import saltus.systems
from saltus import Axis, Study, StudyError
from saltus._tables import TABLES

TABLE_OF = {
    name: name.rstrip("_")
    for name in ("simulate", "sweep", "map", "basins", "orbit", "lyapunov", "continue_", "attractors")
}


@pytest.fixture(scope="module")
def study() -> Study:
    return Study.paper().set({"plate.inertia": "condensed"})


@pytest.mark.parametrize("name", TABLE_OF)
def test_each_key_is_a_keyword_that_the_docstring_tells(name: str) -> None:
    function = getattr(saltus, name)
    arguments = inspect.signature(function).parameters
    for field in dataclasses.fields(TABLES[TABLE_OF[name]]):
        assert arguments[field.name].default is None
        # types and meanings are those of the schema: scripts/python-tables --check
        assert re.search(rf"^ +(\w+, )*{field.name}(, \w+)* : ", function.__doc__, re.MULTILINE)


def asked(monkeypatch: pytest.MonkeyPatch, name: str, *given: Any, **named: Any) -> Study:
    """The study that a question is asked about."""
    studies: list[Study] = []
    monkeypatch.setattr(
        "saltus._commands._ask", lambda request, study, *rest, **kept: studies.append(study)
    )
    getattr(saltus, name)(*given, **named)
    return studies[0]


def test_keywords_take_the_place_of_keys(study: Study, monkeypatch: pytest.MonkeyPatch) -> None:
    one = asked(monkeypatch, "sweep", study, from_=0.2, to=0.3, count=5, direction="up", transient=7)
    assert one.sweep is not None
    assert study.sweep is not None
    assert one.sweep == dataclasses.replace(
        study.sweep, from_=0.2, to=0.3, count=5, direction="up", transient=7
    )
    assert one.map == study.map
    listed = asked(monkeypatch, "sweep", study, values=np.array([0.2, 0.3, 0.5])).sweep
    assert listed is not None
    assert (listed.values, listed.from_, listed.count) == ((0.2, 0.3, 0.5), None, None)
    even = asked(monkeypatch, "sweep", one.replace(sweep=listed), from_=0.1, to=0.2, count=3).sweep
    assert even is not None
    assert (even.values, even.from_, even.to, even.count) == (None, 0.1, 0.2, 3)
    anew = asked(monkeypatch, "sweep", study, starts=[[3.0, 2.0]]).sweep
    assert anew is not None
    assert anew.direction == "restarts"


def test_a_start_is_a_pair(study: Study, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("simulate", "sweep", "map", "orbit", "lyapunov", "continue_"):
        one = asked(monkeypatch, name, study, start=(1.5, -0.5))
        assert one.start is not None
        assert (one.start.z, one.start.v) == (1.5, -0.5)


def test_another_parameter_needs_a_range_of_its_own(study: Study) -> None:
    with pytest.raises(StudyError, match=r"sweep.*from"):
        saltus.sweep(study, parameter="jumper.mass")


def test_axes_are_tables_or_values_alone(study: Study, monkeypatch: pytest.MonkeyPatch) -> None:
    mass = Axis(parameter="jumper.mass", from_=50.0, to=90.0, count=5)
    plane = asked(monkeypatch, "map", study, x=mass, y=[0.9, 1.1], exponent=0).map
    assert plane is not None
    assert plane.x == mass
    assert (plane.y.parameter, plane.y.values, plane.y.count) == (
        "base.frequency_ratio",
        (0.9, 1.1),
        None,
    )
    assert plane.exponent == 0
    heights = Axis(parameter="start.z", values=[0.0, 1.0])
    basins = asked(monkeypatch, "basins", study, x=heights, v=[0.5, 1.0]).basins
    assert basins is not None
    assert (basins.x.values, basins.y.values) == ((0.0, 1.0), (0.5, 1.0))


def test_a_table_that_is_not_there_is_made(study: Study, monkeypatch: pytest.MonkeyPatch) -> None:
    bare = study.replace(sweep=None)
    one = asked(monkeypatch, "sweep", bare, parameter="jumper.mass", from_=60.0, to=70.0, count=3)
    assert one.sweep is not None
    assert one.sweep.parameter == "jumper.mass"


@pytest.mark.parametrize(
    ("name", "given", "said"),
    [
        ("orbit", {"period": -1}, r"orbit\.period = -1"),
        ("orbit", {"period": 65}, r"orbit\.period = 65.*0 to 64"),
        ("lyapunov", {"periods": 1.5}, r"lyapunov\.periods = 1\.5"),
        ("simulate", {"times": [0.1, 0.1]}, r"simulate\.times\.1 = 0\.1.*after the one before"),
        ("simulate", {"times": [-1.0]}, r"simulate\.times"),
        ("simulate", {"samples_per_period": 0}, r"simulate\.samples_per_period = 0"),
        ("sweep", {"direction": "sideways"}, r"sweep\.direction.*sideways"),
        ("continue_", {"second": 3}, r"continue\.second"),
    ],
)
def test_a_wrong_value_is_named_by_its_key(
    name: str, given: dict[str, Any], said: str, study: Study
) -> None:
    with pytest.raises(StudyError, match=said):
        getattr(saltus, name)(study, **given)


def test_no_public_name_hides_one_of_python() -> None:
    for module in (saltus, saltus.dask, saltus.systems):
        assert not set(module.__all__) & set(dir(builtins))
    assert saltus.map.__module__ == "saltus._commands"


def test_the_people_of_a_study_are_a_list(study: Study) -> None:
    with pytest.raises(AttributeError, match=r"jumper\[0\]\.damping_ratio is that of the first"):
        _ = study.jumper.damping_ratio  # type: ignore[attr-defined]
    with pytest.raises(AttributeError, match="the people of a study have no colour"):
        _ = study.jumper.colour  # type: ignore[attr-defined]
    with pytest.raises(AttributeError, match="there is no jumper"):
        _ = study.set({"base.reference": "plate", "jumper": []}).jumper.mass  # type: ignore[attr-defined]
