"""Questions and results: the bits, names and units of the program."""

from __future__ import annotations

import filecmp
import os
import signal
import subprocess
import sys
import textwrap
import threading
from pathlib import Path

import numpy as np
import pytest
import xarray

import saltus
from saltus import ResultError, Study, StudyError

#: Seconds on one core at most, all of it.
QUICK = {
    "plate.inertia": "condensed",
    "simulate.periods": 30,
    "sweep.count": 6,
    "sweep.transient": 40,
    "sweep.record": 8,
    "map.x.count": 5,
    "map.y.count": 4,
    "map.transient": 40,
    "map.exponent": 0,
    "basins.x.count": 5,
    "basins.y.count": 4,
    "basins.exponent": 0,
    "lyapunov.periods": 40,
    "lyapunov.transient": 40,
    "attractors.count": 3,
    "attractors.starts": 6,
}


@pytest.fixture(scope="module")
def study() -> Study:
    return Study.paper().set(QUICK)


def same_folders(first: Path, second: Path) -> None:
    names = sorted(path.name for path in first.iterdir())
    assert names == sorted(path.name for path in second.iterdir())
    _, different, broken = filecmp.cmpfiles(first, second, names, shallow=False)
    assert (different, broken) == ([], [])


@pytest.mark.parametrize("command", ["frequencies", "simulate", "sweep", "map", "basins", "attractors"])
def test_python_and_the_program_give_the_same_bits(command: str, study: Study, tmp_path: Path) -> None:
    result = getattr(saltus, command)(study)
    saved = result.save(tmp_path / "python")
    study.save(tmp_path / "study.toml")
    run = [sys.executable, "-m", "saltus", command, str(tmp_path / "study.toml")]
    subprocess.run([*run, "--out", str(tmp_path / "program"), "-q"], timeout=120, check=True)
    same_folders(saved, tmp_path / "program")
    file = xarray.open_dataset(saved / f"{command}.nc", engine="h5netcdf")
    assert file.identical(result.to_xarray())
    assert file.attrs["study_sha256"] == study.hash
    assert Study.parse(file.attrs["study"]) == study


def test_arrays_have_axes_units_and_words(study: Study) -> None:
    values = np.linspace(0.2, 0.4, 3, dtype=np.float32)
    result = saltus.sweep(study, values=values)
    assert result["z"].shape == (2, 3, 1, 8)
    assert result.variables["z"].dims[1] == "jumper_damping_ratio"
    assert result.study.sweep is not None
    assert result.study.sweep.values == tuple(values.tolist())
    assert set(result.words("label").ravel()) <= {"periodic", "quasi-periodic", "chaotic", "undecided"}
    assert result.variables["z"].values.shape[1] == len(result["jumper_damping_ratio"])
    assert result.variables["jumper_damping_ratio"].attrs["units"] == "1"


def test_tables_figures_and_documents_are_those_of_the_folder(study: Study, tmp_path: Path) -> None:
    result = saltus.simulate(study, periods=12)
    saved = result.save(tmp_path / "run")
    assert set(result.figures) == {path.stem for path in saved.glob("*.png")}
    assert set(result.tables) == {path.stem for path in saved.glob("*.csv")}
    assert result.figures["portrait"].png() == (saved / "portrait.png").read_bytes()
    assert result.figures["portrait"].svg == (saved / "portrait.svg").read_text(encoding="utf-8")
    frame = result.to_pandas("section")
    assert list(frame["z"]) == list(result["z"][:, 0])
    assert result.report["version"] == saltus.__version__
    figure = result.figures["portrait"]
    shown, size = figure._repr_mimebundle_()
    assert shown["image/png"] == figure.png()
    assert f'width="{size["image/png"]["width"]}' in figure.svg
    page = result._repr_html_()
    assert page.startswith("<p><b>Completed</b></p>")
    assert page.index("status") < page.index("<img") < page.index("<details>")
    assert page.count("<img alt=") == len(result.figures)
    assert "periods" in repr(result)


def test_start_grids_are_arrays(study: Study) -> None:
    z, v = np.array([-1.0, 0.0, 2.5]), [0.0, 1.0]
    result = saltus.basins(study, z=z, v=v)
    assert result["attractor"].shape == (2, 3)
    assert list(result["start_z"]) == list(z)
    bare = saltus.basins(study.replace(basins=None).set({"start.z": 0.0}), z=z, v=v)
    assert bare["start_v"].tolist() == v
    rows = saltus.sweep(study, starts=np.array([[3.0, 2.0], [-1.0, 0.0], [5.0, -2.0]]))
    assert rows["z"].shape[0] == 3


def test_a_motion_that_ends_early_says_why() -> None:
    study = Study.paper().set({"solver.max_switches": 1, "simulate.periods": 30})
    result = saltus.simulate(study)
    assert "chattering" in (result.shortfall or "")


def test_a_question_that_is_not_there_is_named(study: Study) -> None:
    with pytest.raises(StudyError, match=r"\[map\]"):
        saltus.map(study.replace(map=None))
    with pytest.raises(StudyError, match="sweep"):
        saltus.sweep(study.replace(sweep=None), values=[0.1, 0.2])
    with pytest.raises(ValueError, match="resume needs out"):
        saltus.map(study, resume=True)
    with pytest.raises(ValueError, match="threads is 0"):
        saltus.map(study, threads=0)
    with pytest.raises(StudyError, match=r"map\.x\.values.*nan"):
        saltus.map(study, x=[0.1, np.nan])
    with pytest.raises(StudyError, match=r"map\.x\.values"):
        saltus.map(study, x=[[0.1, 0.2], [0.3, 0.4]])  # type: ignore[list-item]


def test_a_folder_of_others_is_not_written_to(study: Study, tmp_path: Path) -> None:
    (tmp_path / "thesis.tex").write_text("mine")
    with pytest.raises(ResultError, match=str(tmp_path)):
        saltus.simulate(study, out=tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis.tex"]


def test_an_interrupted_map_goes_on_to_the_same_bits(study: Study, tmp_path: Path) -> None:
    larger = study.set({"map.x.count": 24, "map.y.count": 16, "map.exponent": 0})
    pixels = 24 * 16

    def interrupt(what: str, done: int, total: int | None) -> None:
        if what == "pixels" and done > pixels // 4:
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        saltus.map(larger, out=tmp_path / "map", progress=interrupt)
    assert not (tmp_path / "map").exists()
    with pytest.raises(ResultError, match="--resume"):
        saltus.map(larger, out=tmp_path / "map")
    told: list[int] = []
    saltus.map(
        larger, out=tmp_path / "map", resume=True, progress=lambda what, done, total: told.append(done)
    )
    assert told[0] > 0, "what was finished is made again"
    same_folders(tmp_path / "map", saltus.map(larger).save(tmp_path / "at-once"))


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
def test_a_forked_child_computes_the_same_bits(study: Study) -> None:
    before = saltus.simulate(study)["z"]
    program = f"""
        import os, sys, saltus, numpy as np
        study = saltus.Study.parse({study.to_toml()!r})
        here = saltus.map(study)["period"].tobytes() + saltus.simulate(study)["z"].tobytes()
        reading, writing = os.pipe()
        if os.fork() == 0:
            there = saltus.map(study)["period"].tobytes() + saltus.simulate(study)["z"].tobytes()
            os.write(writing, b"same" if there == here else b"other")
            os._exit(0)
        sys.stdout.write(os.read(reading, 9).decode())
    """
    run = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program)], capture_output=True, timeout=120, check=True
    )
    assert run.stdout == b"same"
    assert saltus.simulate(study)["z"].tobytes() == before.tobytes()


def test_the_program_may_end_while_a_thread_computes() -> None:
    program = """
        import threading, saltus
        study = saltus.Study.paper().set({"map.x.count": 500, "map.y.count": 500})
        begun = threading.Event()
        tell = lambda what, done, total: begun.set()
        threading.Thread(target=lambda: saltus.map(study, progress=tell), daemon=True).start()
        begun.wait()
    """
    run = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program)], capture_output=True, timeout=120, check=False
    )
    assert (run.returncode, run.stderr) == (0, b"")


def test_threads_of_python_ask_side_by_side(study: Study) -> None:
    expected = saltus.simulate(study)["z"].tobytes()
    found: list[bytes] = []

    def ask() -> None:
        found.append(saltus.simulate(study)["z"].tobytes())

    threads = [threading.Thread(target=ask) for _ in range(6)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert found == [expected] * 6


def test_a_full_disk_leaves_nothing_that_looks_whole(study: Study, tmp_path: Path) -> None:
    resource = pytest.importorskip("resource")
    study.save(tmp_path / "study.toml")
    program = f"""
        import resource, saltus
        resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000))
        try:
            saltus.simulate({str(tmp_path / "study.toml")!r}, out={str(tmp_path / "run")!r})
        except saltus.ResultError as error:
            print("refused:", error)
    """
    assert resource is not None
    run = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program)],
        capture_output=True,
        text=True,
        timeout=120,
        check=True,
    )
    assert run.stdout.startswith("refused:")
    assert str(tmp_path / "run") in run.stdout
    assert [path.name for path in tmp_path.iterdir()] == ["study.toml"]
