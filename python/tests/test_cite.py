"""Results in memory and in folders are cited, and those in folders are asked again."""

from __future__ import annotations

from pathlib import Path

import pytest

import saltus


@pytest.fixture
def motion() -> saltus.Result:
    study = saltus.Study.paper().set({"plate.inertia": "condensed"})
    return saltus.simulate(study, periods=3, progress=False)


def test_memory_and_folder_rest_on_the_same_works(motion: saltus.Result, tmp_path: Path) -> None:
    text = motion.cite()
    assert text.startswith("% the program\n@misc{saltus,\n")
    assert saltus.__version__ in text
    folder = motion.save(tmp_path / "motion")
    assert saltus.cite(folder) == text
    assert saltus.cite(folder / "simulate.nc") == text
    assert saltus.frequencies(motion.study).cite() in text


def test_a_saved_result_comes_out_again(motion: saltus.Result, tmp_path: Path) -> None:
    folder = motion.save(tmp_path / "motion")
    again = saltus.rerun(folder, out=tmp_path / "again", threads=1, progress=False)
    assert again.identical
    assert str(again) == again.summary
    assert again.report["files"][-1] == {"name": "saltus-result.json", "outcome": "identical"}
    names = sorted(path.name for path in folder.iterdir())
    assert sorted(path.name for path in (tmp_path / "again").iterdir()) == names


def test_what_is_no_result_or_was_altered_is_refused(motion: saltus.Result, tmp_path: Path) -> None:
    with pytest.raises(saltus.ResultError, match=r"holds no `saltus-result\.json`"):
        saltus.cite(tmp_path)
    folder = motion.save(tmp_path / "motion")
    (folder / "energy.csv").write_text("")
    with pytest.raises(saltus.ResultError, match=r"`energy\.csv` has 0 bytes"):
        saltus.rerun(folder, progress=False)
