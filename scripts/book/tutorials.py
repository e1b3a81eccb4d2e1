"""Runs the code on the pages of the book, so that a page shows what its code does.

Blocks that run, in the order of the page, in a folder of the page's own:

    ```python             one namespace for the page; a traceback names the line of the page
    ```console            `$ COMMAND` and what it prints, both streams; a backslash goes on in the next line
    ```sh run             a command on each line; with `small` its questions are made small, so that a tour takes seconds
    ```text,output        what the block before it has printed
    ```toml,file=NAME     is written to the file NAME; so is any other block with `file=`

What is printed is compared only where a page shows it, but for spaces at the ends of lines and blank lines at the end;
`...` stands for anything. Words after the language, with commas between them:

    no-run                the block is only shown
    fails                 the block must fail: an exit status other than 0, or an exception

A picture that a page shows and the documentation lacks, `![Section](section.png)`, is one that its code must have
written there; it is kept beside the page.
"""

import contextlib
import doctest
import io
import os
import re
import shutil
import subprocess
import sys
import traceback
from dataclasses import dataclass
from pathlib import Path

SECONDS = 300
_PICTURE = re.compile(r"!\[[^\]]*\]\((?!\w+:)([^)\s]+)\)")


@dataclass
class Block:
    """A fenced block: the line of its fence, its language and words, and its text."""

    line: int
    language: str
    words: list[str]
    text: str

    @property
    def runs(self) -> bool:
        if self.language == "sh":
            return "run" in self.words
        return "no-run" not in self.words and (self.language in ("python", "console") or self.file is not None)

    @property
    def file(self) -> str | None:
        return next((word.removeprefix("file=") for word in self.words if word.startswith("file=")), None)


class Failed(Exception):
    """A block did not do what its page says."""


def blocks(text: str) -> list[Block]:
    """All fenced blocks of a page."""
    found, fence = [], None
    for number, line in enumerate(text.splitlines(), 1):
        mark = re.match(r"(`{3,}|~{3,})(.*)$", line)
        if fence is None and mark:
            language, *words = re.split(r"[,\s]+", mark[2].strip())
            fence, block, body = mark[1], Block(number, language, words, ""), []
        elif fence and mark and mark[1].startswith(fence) and not mark[2].strip():
            block.text = "".join(f"{each}\n" for each in body)
            found.append(block)
            fence = None
        elif fence:
            body.append(line)
    if fence:
        raise Failed(f"{block.line}: the block has no end")
    return found


def agrees(expected: str, printed: str) -> bool:
    """Whether `printed` is what a page shows."""
    expected, printed = (
        "\n".join(line.rstrip() for line in text.splitlines()).rstrip("\n") + "\n" for text in (expected, printed)
    )
    return expected == printed or doctest.OutputChecker().check_output(expected, printed, doctest.ELLIPSIS)


def commands(block: Block):
    """(line, command, output shown or None) of a console block."""
    lines = block.text.splitlines()
    starts = [i for i, line in enumerate(lines) if line.startswith("$ ")]
    if not starts or starts[0] != 0:
        raise Failed(f"{block.line}: a console block begins with `$ ` and a command")
    for start, end in zip(starts, starts[1:] + [len(lines)]):
        at = start
        while lines[at].endswith("\\") and at + 1 < end:
            at += 1
        command = "\n".join(lines[start : at + 1])[2:]
        shown = "".join(f"{line}\n" for line in lines[at + 1 : end])
        yield block.line + 1 + start, command, shown or None


def run_console(block: Block) -> str:
    """Runs the commands of a block; gives the output of the last one."""
    printed = ""
    for line, command, shown in commands(block):
        done = subprocess.run(
            command, shell=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        printed = done.stdout
        if (done.returncode != 0) != ("fails" in block.words):
            raise Failed(f"{line}: `{command}` ended with status {done.returncode}:\n{printed}")
        if shown is not None:
            compare(line, shown, printed)
    return printed


#: Keys of every question that a tour asks.
SMALL = [
    "plate.inertia=condensed",
    *(f"{table}.{axis}.count=6" for table in ("map", "basins") for axis in "xy"),
    "sweep.count=5",
    "sweep.transient=50",
    "sweep.record=20",
    "lyapunov.periods=50",
    "continue.cloud=5",
    "continue.second.curves=['none']",
    "attractors.starts=4",
    "attractors.count=2",
]


def run_sh(block: Block) -> str:
    """Runs the lines of a block; gives the output of the last one."""
    printed = ""
    for number, line in enumerate(block.text.splitlines(), block.line + 1):
        command = re.sub(r"\s+#.*$", "", line)
        if "small" in block.words and "--out" in command:
            command += "".join(f' --set "{key}"' for key in SMALL)
        done = subprocess.run(
            command, shell=True, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        printed = done.stdout
        if done.returncode:
            raise Failed(f"{number}: `{command}` ended with status {done.returncode}:\n{printed}")
    return printed


def run_python(block: Block, page: str, namespace: dict) -> str:
    """Runs a block; gives its output."""
    printed = io.StringIO()
    try:
        with contextlib.redirect_stdout(printed):
            exec(compile("\n" * block.line + block.text, page, "exec"), namespace)
    except Exception as error:
        if "fails" in block.words:
            return f"{type(error).__name__}: {error}\n"
        while error.__traceback__ and error.__traceback__.tb_frame.f_code.co_filename != page:
            error.__traceback__ = error.__traceback__.tb_next
        raise Failed(f"{block.line}: the block failed:\n{traceback.format_exc()}") from error
    if "fails" in block.words:
        raise Failed(f"{block.line}: the block was to fail and did not")
    return printed.getvalue()


def compare(line: int, shown: str, printed: str):
    if not agrees(shown, printed):
        raise Failed(f"{line}: the page shows\n{shown}but this is printed:\n{printed}")


def run_here(page: str):
    """Runs the blocks of a page in the current folder; raises `Failed` with its line."""
    namespace, printed = {"__name__": "__main__"}, ""
    for block in blocks(Path(page).read_text(encoding="utf-8")):
        if block.language == "text" and "output" in block.words:
            compare(block.line, block.text, printed)
        elif not block.runs:
            continue
        elif block.file is not None:
            Path(block.file).write_text(block.text, encoding="utf-8")
        elif block.language == "console":
            printed = run_console(block)
        elif block.language == "sh":
            printed = run_sh(block)
        else:
            printed = run_python(block, page, namespace)


def run(page: Path, folder: Path, python: str, path: str) -> str | None:
    """Runs a page in a process of its own, in the new folder `folder`; gives failures, with file and line."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    environment = os.environ | {
        "PATH": path + os.pathsep + os.environ.get("PATH", ""),
        "MPLBACKEND": "Agg",
        "PYTHONIOENCODING": "utf-8",
        "NO_COLOR": "1",
    }
    call = [python, str(Path(__file__).resolve()), str(page.resolve())]
    try:
        done = subprocess.run(
            call, cwd=folder, env=environment, stderr=subprocess.PIPE, timeout=SECONDS, text=True, encoding="utf-8"
        )
    except subprocess.TimeoutExpired:
        return f"{page.name}: still running after {SECONDS} s"
    return f"{page.name}:{done.stderr.strip()}" if done.returncode else None


def has_code(page: Path) -> bool:
    """Whether a page has a block that runs."""
    return any(block.runs for block in blocks(page.read_text(encoding="utf-8")))


def collect(page: Path, folder: Path) -> list[str]:
    """Brings the pictures that a page shows from the folder it ran in; names those missing or there already."""
    faults = []
    for name in dict.fromkeys(_PICTURE.findall(page.read_text(encoding="utf-8"))):
        made, place = folder / name, page.parent / name
        if made.is_file() and place.exists():
            faults.append(f"{page.name}: {name} is there already; pictures need names of their own")
        elif made.is_file():
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(made, place)
        elif not place.is_file():
            faults.append(f"{page.name}: the page shows {name}, and its code did not write it")
    return faults


if __name__ == "__main__":
    try:
        run_here(sys.argv[1])
    except Failed as failed:
        sys.exit(str(failed))
