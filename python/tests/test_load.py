"""Results that were saved, pickled or copied are those that were computed."""

from __future__ import annotations

import copy
import pickle
import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest

import saltus
from saltus import Result, ResultError, Study, StudyError, UnknownNameError
from saltus.systems import Forcing, System, find_orbit, integrate, lyapunov, states

COMMANDS = ("frequencies", "simulate", "sweep", "map", "basins", "orbit", "lyapunov", "attractors")


@pytest.fixture(scope="module")
def study() -> Study:
    return Study.paper().set(
        {
            "plate.inertia": "condensed",
            "base.frequency_ratio": 0.9,
            "simulate.periods": 12,
            "sweep.count": 4,
            "sweep.transient": 40,
            "sweep.record": 8,
            "map.x.count": 4,
            "map.y.count": 3,
            "map.exponent": 0,
            "basins.x.count": 4,
            "basins.y.count": 3,
            "basins.exponent": 0,
            "lyapunov.periods": 40,
            "attractors.count": 2,
            "attractors.starts": 4,
        }
    )


def alike(one: np.ndarray, other: np.ndarray) -> bool:
    """Equal values of one type, NaN included; without rows a table does not tell the type."""
    assert one.shape == other.shape
    if one.size > 0:
        assert one.dtype == other.dtype
    return np.array_equal(one, other, equal_nan=one.dtype.kind == "f")


def same(one: Result, other: Result) -> None:
    assert list(one) == list(other)
    assert all(alike(one[name], other[name]) for name in one)
    for name, variable in one.variables.items():
        like = other.variables[name]
        assert (variable.dims, variable.attrs, variable.meanings) == (
            like.dims,
            like.attrs,
            like.meanings,
        )
        assert (variable.fill, variable.coordinate) == (like.fill, like.coordinate)
    assert one.attrs == other.attrs
    assert (one.command, one.study, one.summary) == (other.command, other.study, other.summary)
    assert (one.shortfall, one.report, one.cite()) == (other.shortfall, other.report, other.cite())
    assert list(one.tables) == list(other.tables)
    for name, table in one.tables.items():
        assert table.notes == other.tables[name].notes
        assert list(table) == list(other.tables[name])
        assert all(alike(table[column], other.tables[name][column]) for column in table)
    assert list(one.figures) == list(other.figures)
    for name, figure in one.figures.items():
        twin = other.figures[name]
        assert (figure.svg, figure.pdf, figure.about) == (twin.svg, twin.pdf, twin.about)
        assert figure.png() == twin.png()
    assert one.to_xarray().identical(other.to_xarray())


@pytest.mark.parametrize("command", COMMANDS)
def test_a_result_is_read_as_it_was_saved(command: str, study: Study, tmp_path: Path) -> None:
    result = getattr(saltus, command)(study)
    loaded = saltus.load(result.save(tmp_path / "first"))
    same(result, loaded)
    again = loaded.save(tmp_path / "again")
    for path in (tmp_path / "first").iterdir():
        assert path.read_bytes() == (again / path.name).read_bytes(), path.name
    same(loaded, pickle.loads(pickle.dumps(loaded)))


def test_branches_are_read_as_they_were_saved(study: Study, tmp_path: Path) -> None:
    asked = study.set({"continue.second.curves": ["none"], "jumper.damping_ratio": 0.2})
    result = saltus.continue_(asked, from_=0.18, to=0.22, doublings=0, cloud=0, out=tmp_path / "branch")
    same(result, saltus.load(tmp_path / "branch"))
    assert "jumper_damping_ratio" in result.tables["branches"]
    assert {"branch", "jumper_damping_ratio"} <= set(result.to_xarray().coords)


def test_a_motion_that_ended_early_says_so_when_it_is_read(tmp_path: Path) -> None:
    short = Study.paper().set({"plate.inertia": "condensed", "solver.max_switches": 1})
    result = saltus.simulate(short, periods=30)
    assert "chattering" in (result.shortfall or "")
    same(result, saltus.load(result.save(tmp_path / "short")))


def test_results_go_to_other_processes_and_back(study: Study) -> None:
    asked = [study, study.set({"start.z": 1.0})]
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        for one, result in zip(asked, pool.map(saltus.simulate, asked), strict=True):
            same(saltus.simulate(one), result)


def test_a_copy_has_arrays_of_its_own(study: Study) -> None:
    result = saltus.simulate(study)
    for twin in (copy.copy(result), copy.deepcopy(result)):
        same(result, twin)
        before = float(result["z"][0, 0])
        twin["z"][0, 0] = before + 1.0
        assert result["z"][0, 0] == before


def test_results_of_own_systems_pickle() -> None:
    x, v = states("x", "v")
    forcing = Forcing(1.0)
    duffing = System([x, v], [v, 0.3 * forcing.cos - 0.2 * v - x**3], forcing=forcing)
    run = integrate(duffing, [0.1, 0.0], periods=5)
    assert np.array_equal(pickle.loads(pickle.dumps(run)).samples, run.samples)
    assert np.array_equal(integrate(copy.deepcopy(duffing), [0.1, 0.0], periods=5).samples, run.samples)
    orbit = find_orbit(duffing, integrate(duffing, [0.1, 0.0], periods=60).end)
    assert np.array_equal(pickle.loads(pickle.dumps(orbit)).states, orbit.states)
    found = lyapunov(duffing, [0.1, 0.0], periods=40)
    assert np.array_equal(pickle.loads(pickle.dumps(found)).exponents, found.exponents)


def test_a_folder_that_is_no_result_is_refused(study: Study, tmp_path: Path) -> None:
    with pytest.raises(ResultError, match="no result of saltus"):
        saltus.load(tmp_path / "nowhere")
    (tmp_path / "mine").mkdir()
    with pytest.raises(ResultError, match="no result of saltus: it holds no"):
        saltus.load(tmp_path / "mine")
    saved = saltus.frequencies(study).save(tmp_path / "saved")
    assert saltus.load(saved / "frequencies.json").command == "frequencies"
    (saved / "frequencies.nc").write_bytes(b"something else")
    with pytest.raises(ResultError, match=r"frequencies\.nc.*bytes"):
        saltus.load(saved)
    (saved / "frequencies.nc").unlink()
    with pytest.raises(ResultError, match=r"frequencies\.nc.* is missing"):
        saltus.load(saved)


def test_a_study_alone_is_no_result(study: Study, tmp_path: Path) -> None:
    study.save(tmp_path / "study.toml")
    run = [sys.executable, "-m", "saltus", "check", "study.toml", "--out", "alone", "-q"]
    subprocess.run(run, cwd=tmp_path, timeout=120, check=True)
    with pytest.raises(StudyError, match="answers no question"):
        saltus.load(tmp_path / "alone")


def test_pixels_of_a_loaded_figure_are_those_of_its_file(study: Study, tmp_path: Path) -> None:
    loaded = saltus.load(saltus.simulate(study).save(tmp_path / "run"))
    with pytest.raises(ValueError, match="loaded has its pixels already"):
        loaded.figures["portrait"].png(3.0)


def test_a_name_that_is_not_there_is_told_with_those_that_come_near(study: Study) -> None:
    result = saltus.simulate(study)
    with pytest.raises(UnknownNameError, match=r"no array 'floor'; did you mean 'history_floor'"):
        result["floor"]
    with pytest.raises(KeyError, match=r"did you mean 'history_prf'"):
        result["histroy_prf"]
    with pytest.raises(UnknownNameError, match=r"no figure 'portriat'; did you mean 'portrait'"):
        result.figures["portriat"]
    with pytest.raises(UnknownNameError, match=r"no table 'rows'; there are: section"):
        result.to_pandas("rows")
    with pytest.raises(UnknownNameError, match=r"no column 'time'; did you mean 'time_s'"):
        result.tables["history"]["time"]
    assert result.get("floor") is None
    assert "floor" not in result
