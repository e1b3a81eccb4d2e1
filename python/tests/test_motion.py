"""The history of a motion: accelerations, shapes and films, against what is known otherwise."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

import saltus
from saltus import Jumper, Result, Study

#: Half of the time over which differences are taken (s).
HALF = 2e-4


@pytest.fixture(scope="module")
def study() -> Study:
    paper = Study.paper().set({"plate.inertia": "condensed", "base.frequency_ratio": 0.9})
    first = paper.jumper[0]
    other = Jumper(x=4.0, y=3.0, mass=60.0, stiffness=15000.0, damping_ratio=0.4)
    return paper.replace(jumper=[first, other])


@pytest.fixture(scope="module")
def triples(study: Study) -> Result:
    """Times in threes, at distances of HALF."""
    period = float(saltus.simulate(study, periods=1)["forcing_period"])
    centres = (1.0 + np.arange(1, 400) / 100.0) * period
    times = (centres[:, None] + HALF * np.array([-1.0, 0.0, 1.0])).ravel()
    return saltus.simulate(study.set({"solver.tolerance": 1e-13}), periods=6, times=times)


def second_difference(values: Any) -> Any:
    first, middle, last = values[0::3], values[1::3], values[2::3]
    return (first - 2.0 * middle + last) / HALF**2


def smooth(result: Result) -> Any:
    """Times with no switch near them."""
    at = result["history_time"][1::3]
    return np.abs(at[:, None] - result["switch_time"]).min(axis=1) > 2.0 * HALF


def test_the_acceleration_of_the_floor_is_the_second_derivative_of_its_height(triples: Result) -> None:
    here = smooth(triples)
    assert here.sum() > 300
    found = second_difference(triples["history_floor"])[here]
    told = triples["history_floor_acceleration"][1::3][here]
    assert np.abs(found - told).max() < 1e-3 * np.abs(told).max()
    base = second_difference(triples["history_base"])[here]
    relative = triples["history_floor_acceleration_relative"][1::3][here]
    assert np.abs(told - relative - base[:, None]).max() < 1e-3 * np.abs(told).max()


def test_a_body_falls_freely_in_flight_and_obeys_newton_on_the_floor(
    triples: Result, study: Study
) -> None:
    assert study.gravity is not None
    gravity = study.gravity.acceleration
    assert gravity is not None
    here = smooth(triples)
    body = second_difference(triples["history_z"] * triples["eta"])[here]
    flying = triples.words("history_phase")[1::3][here] == "flight"
    assert flying.any()
    assert (~flying).any()
    assert np.abs(body[flying] + gravity).max() < 2e-3 * gravity
    force = triples["history_prf"][1::3][here]
    assert np.abs(body - gravity * (force - 1.0)).max() < 2e-3 * gravity
    assert (force[flying] == 0.0).all()


def test_the_surface_under_the_feet_is_the_floor(triples: Result, study: Study) -> None:
    for i, person in enumerate(study.jumper):
        height = triples.surface([person.x], [person.y], absolute=True)[:, 0, 0]
        assert np.abs(height - triples["history_floor"][:, i]).max() < 1e-15
    edge = triples.surface([0.0, 14.0], [0.0, 10.0])
    assert np.abs(edge).max() < 1e-15


def test_the_surface_is_the_sum_of_the_terms(triples: Result, study: Study) -> None:
    t = triples["history_time"][[4, 40]]
    w = triples.surface([3.0, 9.0], [2.0, 5.0, 8.0], t[:, None])
    assert w.shape == (2, 1, 3, 2)
    amplitudes = triples["history_w"][40] * study.plate.thickness
    terms = zip(triples["m"], triples["n"], amplitudes, strict=True)
    expected = sum(
        a * np.sin(m * np.pi * 9.0 / 14.0) * np.sin(n * np.pi * 2.0 / 10.0) for m, n, a in terms
    )
    assert w[1, 0, 0, 1] == pytest.approx(expected, abs=1e-15)


def test_times_and_density_of_a_history_can_be_chosen(study: Study) -> None:
    dense = saltus.simulate(study, periods=10, history=2, samples_per_period=50)
    assert len(dense["history_time"]) == 100
    period = float(dense["forcing_period"])
    assert dense["history_time"][0] == pytest.approx(8.0 * period)
    chosen = saltus.simulate(study, periods=10, times=dense["history_time"])
    assert np.abs(chosen["history_z"] - dense["history_z"]).max() < 1e-9
    assert list(chosen.tables["history"]["floor_acceleration_0"]) == list(
        chosen["history_floor_acceleration"][:, 0]
    )
    with pytest.raises(saltus.StudyError, match=r"simulate\.times: .* lies after the end of the run"):
        saltus.simulate(study, periods=2, times=[3.0 * period])


def test_a_place_beside_the_plate_or_another_time_is_told(triples: Result, study: Study) -> None:
    with pytest.raises(ValueError, match=r"x is 14\.5: 0 to 14\.0 m is the plate"):
        triples.surface([14.5], [1.0])
    with pytest.raises(ValueError, match=r"t = 0\.01 s is no time of the history, which has 1197 from"):
        triples.surface(t=0.01)
    with pytest.raises(ValueError, match="surface is of simulate and orbit"):
        saltus.frequencies(study).surface()
    early = saltus.simulate(study.set({"solver.max_switches": 1}), periods=30, history=1)
    with pytest.raises(ValueError, match="the history has no times"):
        early.surface()
    with pytest.raises(ValueError, match="the history has no times"):
        early.plot()


@pytest.mark.parametrize("view", ["section", "surface"])
def test_a_film_shows_plate_and_people(view: str, study: Study, tmp_path: Path) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("agg")
    pytest.importorskip("PIL")
    motion = saltus.simulate(study, periods=12, history=3, samples_per_period=60)
    film = motion.animate(view, periods=2, frames=5, slower=2.0)  # type: ignore[arg-type]
    film.save(tmp_path / "jump.gif", writer="pillow", dpi=40)
    assert (tmp_path / "jump.gif").stat().st_size > 1000
    assert "<img" in film.to_jshtml(fps=5)
    with pytest.raises(ValueError, match="view is 'above'"):
        motion.animate("above")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="animate is of simulate and orbit"):
        saltus.frequencies(study).animate()
