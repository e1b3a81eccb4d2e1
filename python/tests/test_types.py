"""The stub of the native module is true."""

from __future__ import annotations

import subprocess
import sys

import pytest

pytest.importorskip("mypy")


def test_the_stub_says_what_the_module_has() -> None:
    check = [sys.executable, "-m", "mypy.stubtest", "saltus._native"]
    found = subprocess.run(check, capture_output=True, text=True, check=False)
    assert found.returncode == 0, found.stdout + found.stderr
