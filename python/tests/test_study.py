"""Studies: the same file, the same checks and the same bits as the program has."""

from __future__ import annotations

import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import saltus
from saltus import Axis, Base, Contact, Jumper, Map, ModeLists, Plate, Study, StudyError, Sweep

PLATE = Plate(
    length=14.0,
    width=10.0,
    thickness=0.10,
    youngs_modulus=27e9,
    density=2500.0,
    poisson_ratio=0.2,
    damping_ratio=0.02,
    modes="paper",
)
BASE = Base(amplitude=0.05, frequency_ratio=1.0)
JUMPER = Jumper(x=7.0, y=5.0, mass=76.64, stiffness=18600.0, damping_ratio=0.3)


def small(**tables: object) -> Study:
    contact = Contact(law="reaction-force")
    return Study(plate=PLATE, base=BASE, contact=contact, jumper=[JUMPER]).replace(**tables)


def program(*arguments: str) -> subprocess.CompletedProcess[str]:
    run = [sys.executable, "-m", "saltus", *arguments]
    return subprocess.run(run, capture_output=True, text=True, timeout=120, check=False)


def test_what_is_left_out_has_its_default() -> None:
    study = small()
    assert study.plate.inertia == "full"
    assert study.solver is not None
    assert study.solver.method == "taylor"
    assert study.map is None


def test_a_file_of_either_side_loads_in_the_other(tmp_path: Path) -> None:
    study = Study.paper().set({"jumper.damping_ratio": 0.1 + 0.2, "plate.inertia": "condensed"})
    path = tmp_path / "study.toml"
    study.save(path)
    assert Study.load(path) == study
    assert Study.load(path).hash == study.hash
    assert program("check", str(path), "--quiet").returncode == 0
    written = tmp_path / "paper.toml"
    assert program("init", "paper", "--out", str(written)).returncode == 0
    assert Study.load(written) == Study.paper()


def test_the_program_comes_with_the_package() -> None:
    assert program("--version").stdout.split() == ["saltus", saltus.__version__]
    assert program("no-such-command").returncode == 2


@pytest.mark.parametrize(
    ("changes", "key", "said"),
    [
        ({"jumper.damping_ratio": -1}, "jumper.0.damping_ratio", "a number from 0 to 10"),
        ({"jumper.damping_ratio": float("nan")}, "jumper.0.damping_ratio", "nan"),
        ({"jumper.7.mass": 80.0}, None, "jumper.7"),
        ({"plate.colour": "red"}, None, "colour"),
        ({"plate.inertia": "ful"}, "plate.inertia", "full"),
        ({"start.z": "high"}, "start.z", "a number"),
        ({"jumper.mass": 2**63}, "jumper.0.mass", r"92233720368547\d+"),
        ({"jumper.mass": np.uint64(2**64 - 1)}, "jumper.0.mass", r"1844674407370955\d+"),
        ({"jumper.mass": -(10**40)}, "jumper.0.mass", r"-10{40}"),
        ({"simulate.periods": 10**30}, "simulate.periods", "a whole number from 1"),
        ({"simulate.periods": 10**400}, "simulate.periods", "a whole number from 1"),
        ({"simulate.periods": True}, "simulate.periods", "a whole number from 1"),
        ({"sweep.values": [0.1, 2**70]}, "sweep.values.1", r"11805916207174113\d+"),
    ],
)
def test_an_error_names_the_key_and_what_would_be_right(
    changes: dict[str, object], key: str | None, said: str
) -> None:
    with pytest.raises(StudyError, match=said) as refused:
        Study.paper().set(changes)
    assert isinstance(refused.value, ValueError)
    if key is not None:
        assert refused.value.key == key


def test_whole_numbers_that_are_too_large_are_refused_as_numbers() -> None:
    for periods in (10**30, 10**400):
        with pytest.raises(StudyError, match=r"simulate\.periods"):
            saltus.simulate(small(), periods=periods)
        with pytest.raises(StudyError, match=r"simulate\.periods"):
            small(simulate=saltus.Simulate(periods=periods))
    with pytest.raises(StudyError, match=r"simulate\.periods = true.*a whole number"):
        saltus.simulate(small(), periods=True)
    with pytest.raises(TypeError, match="threads is True"):
        saltus.simulate(small(), threads=True)


def test_a_study_that_cannot_be_written_leaves_the_old_one(tmp_path: Path) -> None:
    path = tmp_path / "study.toml"
    small().save(path)
    before = path.read_bytes()
    # what a full disk does, and nothing but the new file is that long
    found = subprocess.run(
        [
            sys.executable,
            "-c",
            "import resource, sys, signal, numpy as np, saltus\n"
            "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
            "study = saltus.Study.paper().set({'sweep.values': np.linspace(0.1, 0.5, 5000)})\n"
            "figure = saltus.simulate(saltus.Study.paper(), periods=3).figures['portrait']\n"
            "resource.setrlimit(resource.RLIMIT_FSIZE, (4096, 4096))\n"
            "for name in ('study.toml', 'a.png', 'a.svg'):\n"
            "    try:\n"
            "        (study if name == 'study.toml' else figure).save(sys.argv[1] + '/' + name)\n"
            "    except saltus.ResultError as error:\n"
            "        print(isinstance(error, OSError), name in str(error))\n",
            str(tmp_path),
        ],
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert found.stdout.split() == ["True", "True"] * 3, found.stderr
    assert path.read_bytes() == before
    assert [one.name for one in tmp_path.iterdir()] == ["study.toml"]
    with pytest.raises(saltus.ResultError, match="no-such-folder"):
        small().save(tmp_path / "no-such-folder" / "study.toml")


def test_fields_are_checked_when_a_study_is_made() -> None:
    with pytest.raises(StudyError) as refused:
        small(base=Base(amplitude=float("inf"), frequency_ratio=1.0))
    assert refused.value.key == "base.amplitude"
    wrong = Sweep(parameter="jumper.damping_ratio", values=[0.1, 0.3, 0.2])
    with pytest.raises(StudyError, match=r"sweep\.values\.2"):
        small(sweep=wrong)
    with pytest.raises(TypeError, match=r"sweep\.values"):
        small(sweep=Sweep(parameter="jumper.damping_ratio", values=[0.1, 1j]))  # type: ignore[list-item]


@pytest.mark.parametrize(
    "values",
    [
        [0.125, 0.25, 0.5],
        (0.125, 0.25, 0.5),
        np.array([0.125, 0.25, 0.5], dtype=np.float32),
        np.array([0.125, 9.0, 0.25, 9.0, 0.5])[::2],
        np.array([0.125, 0.25, 0.5], dtype=">f8"),
        np.frombuffer(b"\0" + np.array([0.125, 0.25, 0.5]).tobytes(), offset=1, dtype=np.float64),
    ],
    ids=["list", "tuple", "float32", "strided", "big-endian", "misaligned-read-only"],
)
def test_any_array_like_is_a_list_of_values(values: object) -> None:
    table = Sweep(parameter="jumper.damping_ratio", values=values)  # type: ignore[arg-type]
    study = small(sweep=table)
    assert study.sweep is not None
    assert study.sweep.values == (0.125, 0.25, 0.5)
    axis = Axis(parameter="base.frequency_ratio", values=values)  # type: ignore[arg-type]
    plane = Map(x=Axis(parameter="jumper.damping_ratio", from_=0.1, to=0.2, count=2), y=axis)
    assert small(map=plane).map.y.values == (0.125, 0.25, 0.5)  # type: ignore[union-attr]


def test_terms_may_be_arrays() -> None:
    terms = ModeLists(u=[[2, 1]], v=[[1, 2]], w=np.array([[1, 1], [3, 1]], dtype=np.int8))
    modes = small(plate=saltus.Plate(**{**vars(PLATE), "modes": terms})).plate.modes
    assert isinstance(modes, ModeLists)
    assert modes.w == ((1, 1), (3, 1))


def test_studies_are_values() -> None:
    study = small()
    assert study == small()
    assert hash(study) == hash(small())
    assert pickle.loads(pickle.dumps(study)) == study
    assert study.set({"start.z": 1.0}) != study
    assert study.set({}) == study
    with pytest.raises(AttributeError):
        study.plate = PLATE  # type: ignore[misc]


def test_what_is_probably_not_meant_is_told() -> None:
    terms = ModeLists(u=[[2, 1]], v=[[1, 2]], w=[[2, 1]])
    still = small(plate=saltus.Plate(**{**vars(PLATE), "modes": terms}))
    assert "nodal line" in still.warnings[0]
    assert small().warnings == []
    assert "plate" in str(small())


def test_a_study_of_a_newer_version_is_refused() -> None:
    with pytest.raises(StudyError, match="needs a newer saltus"):
        Study.parse(Study.paper().to_toml().replace("format = 1", "format = 2"))
