"""The notebooks: each runs from its first cell to its last, and holds the pictures that it draws."""

from __future__ import annotations

import json
import runpy
from pathlib import Path
from typing import Any

import pytest

REPOSITORY = Path(__file__).parents[2]
NOTEBOOKS = sorted((REPOSITORY / "notebooks").glob("*.ipynb"))


def pictures(notebook: Any) -> int:
    outputs = [output for cell in notebook["cells"] for output in cell.get("outputs", [])]
    return sum("image/png" in output.get("data", {}) for output in outputs)


@pytest.mark.filterwarnings("default")  # those of Jupyter and matplotlib are theirs
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs_and_holds_its_pictures(path: Path) -> None:
    for package in ("nbclient", "ipykernel", "matplotlib", "pandas"):
        pytest.importorskip(package)
    execute = runpy.run_path(str(REPOSITORY / "scripts/book/notebooks.py"))["execute"]
    kept = json.loads(path.read_text(encoding="utf-8"))
    assert pictures(execute(path)) == pictures(kept) >= 3


def test_all_notebooks_together_stay_small() -> None:
    assert sum(path.stat().st_size for path in NOTEBOOKS) < 1.5e6
