"""The gallery: every figure of every command, made by small runs when the site is built."""

import html
import shlex
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

# An empty plate, which has a figure that plates with people on them have not.
EMPTY = """[plate]
length = 14.0
width = 10.0
thickness = 0.10
youngs_modulus = 27e9
density = 2500.0
poisson_ratio = 0.2
damping_ratio = 0.02
modes = "paper"
inertia = "condensed"

[contact]
law = "reaction-force"

[base]
amplitude = 0.013
frequency = 2.2
"""


@dataclass
class Case:
    """One command and what its figures show, by the names of their files."""

    command: str
    options: str
    shows: dict[str, str]
    study: str = "study.toml"
    files: list[Path] = field(default_factory=list)

    def line(self, folder: str) -> list[str]:
        """The command, as a list of words."""
        inertia = [] if self.study == "empty.toml" else ["--set", "plate.inertia=condensed"]
        return ["saltus", self.command, self.study, *inertia, *shlex.split(self.options), "--out", folder]


CASES = [
    Case(
        "simulate",
        "--set simulate.transient=60",
        {
            "portrait": "Phase portrait after the transient, with the stroboscopic section: here a limit cycle of period 2.",
            "history": "Time history: heights of body and floor, and the reaction force.",
        },
    ),
    Case(
        "simulate",
        "--periods 300 --set simulate.transient=100",
        {"section": "Stroboscopic section (Poincaré section) of a plate without people, after the transient."},
        study="empty.toml",
    ),
    Case(
        "sweep",
        "--set sweep.count=121 --set sweep.transient=150 --set sweep.record=50 --set sweep.direction=up"
        " --set sweep.exponents=1 --set sweep.exponent_periods=60",
        {
            "bifurcation": "Bifurcation diagram: height once per forcing period against the damping of the legs.",
            "exponents": "Largest Lyapunov exponent along the same sweep; chaos where it is positive.",
        },
    ),
    Case(
        "map",
        "--set map.x.count=32 --set map.y.count=20 --set map.transient=150 --set map.record=32 --set map.exponent=0",
        {
            "map": "Two-parameter map: the period of the long-term motion over damping and frequency.",
            "layers": "The same map: contact ratio, largest reaction force, largest floor acceleration.",
        },
    ),
    Case(
        "basins",
        "--set jumper.damping_ratio=0.25 --set basins.x.from=-4 --set basins.x.to=14 --set basins.y.from=-8"
        " --set basins.y.to=8 --set basins.x.count=54 --set basins.y.count=42 --set basins.exponent=0"
        " --set basins.transient=200",
        {
            "basins": "Basins of attraction: which initial condition leads to which of two limit cycles.",
            "layers": "The same plane: contact ratio, reaction force and floor acceleration of the motion reached.",
        },
    ),
    Case(
        "orbit",
        "",
        {
            "portrait": "The periodic orbit near the long-term motion, by Newton's method.",
            "multipliers": "Its Floquet multipliers and the unit circle.",
        },
    ),
    Case(
        "continue",
        "--set continue.from=0.18 --set continue.to=0.35 --set continue.step=0.06 --set continue.doublings=1"
        " --set continue.cloud=60 --set continue.second.from=0.98 --set continue.second.to=1.02 --set 'continue.second.curves=[\"LP1\"]'",
        {
            "branches": "Branches of periodic orbits with folds, period doublings and a grazing; dashed where unstable.",
            "curves": "A curve of folds over two parameters.",
        },
    ),
    Case(
        "lyapunov",
        "--set jumper.damping_ratio=0.14 --set lyapunov.periods=120",
        {"convergence": "Lyapunov exponents of a chaotic motion while the record grows, with their errors."},
    ),
    Case(
        "attractors",
        "--set attractors.from=0.2 --set attractors.to=0.3 --set attractors.count=11 --set attractors.starts=16"
        " --set attractors.z=[-4,14] --set attractors.v=[-8,8]",
        {"attractors": "Coexisting attractors and the shares of their basins along a parameter: hysteresis."},
    ),
]


class Incomplete(Exception):
    """A figure without a word, a word without a figure, or a run that failed."""


def make(cases: list[Case], saltus: Path, folder: Path) -> None:
    """Runs the commands in `folder`, and notes the pictures that each has made."""
    folder.mkdir(parents=True)
    subprocess.run([saltus, "init", "paper", "--out", "study.toml"], cwd=folder, check=True)
    (folder / "empty.toml").write_text(EMPTY, encoding="utf-8")
    for number, case in enumerate(cases):
        place = f"{case.command}-{number}"
        call = [saltus, *case.line(place)[1:], "--quiet"]
        done = subprocess.run(call, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        if done.returncode:
            raise Incomplete(f"`{shlex.join(case.line(place))}` ended with status {done.returncode}:\n{done.stderr}")
        told = list(case.shows)
        case.files = sorted(
            (folder / place).glob("*.svg"),
            key=lambda path: (told.index(path.stem) if path.stem in told else len(told), path.stem),
        )


def faults(cases: list[Case], drawing: list[str]) -> list[str]:
    """Figures that are not told, words for figures that are not made, commands that are left out."""
    found = []
    for case in cases:
        made = {path.stem for path in case.files}
        found += [f"gallery: {case.command} makes {name}, of which nothing is said" for name in sorted(made - set(case.shows))]
        found += [f"gallery: {case.command} does not make {name}" for name in sorted(set(case.shows) - made)]
    missing = set(drawing) - {case.command for case in cases}
    return found + [f"gallery: nothing of the command {name}" for name in sorted(missing)]


def page(cases: list[Case], pictures: str) -> str:
    """The gallery; `pictures` is the folder of the pictures as seen from it."""
    parts = [
        "# Gallery",
        "Every figure of every command, as the program draws it. The line below the figures made them, from the study that"
        " `saltus init paper` writes; the runs are small, so that they take seconds. A figure leads to its SVG."
        " From Python the same figures are `result.figures`.",
        "`saltus reproduce` draws the figures of one paper; they are shown on the page that it writes.",
    ]
    last = ""
    for case in cases:
        if case.command != last:
            parts.append(f"## {case.command}")
            parts.append(f"[Options of `saltus {case.command}`](reference/commands/{case.command}.md)")
            last = case.command
        rows = ['<div class="gallery">']
        for path in case.files:
            told = html.escape(case.shows.get(path.stem, path.stem))
            name = f"{pictures}/{path.parent.name}-{path.stem}"
            rows.append(
                f'<figure><a href="{name}.svg"><img src="{name}.png" alt="{told}" loading="lazy"></a>'
                f"<figcaption><b>{path.stem}</b>. {told}</figcaption></figure>"
            )
        parts.append("\n".join([*rows, "</div>"]))
        parts.append(f"```sh\n{shown(case)}\n```")
        if case.study == "empty.toml":
            parts.append(f"with the study `empty.toml`, a plate without people:\n\n```toml\n{EMPTY}```")
    return "\n\n".join(parts) + "\n"


def shown(case: Case) -> str:
    """The command as one types it, with an option of `--set` in each line if there are many."""
    folder = case.command if case.study == "study.toml" else "empty"
    line = shlex.join(case.line(folder))
    if len(line) <= 100:
        return line
    head, *options = line.split(" --set ")
    *options, last = options
    last, _, out = last.rpartition(" --out ")
    return " \\\n    ".join([head, *[f"--set {option}" for option in [*options, last]], f"--out {out}"])


def write(saltus: Path, run: Path, page_path: Path, drawing: list[str]) -> list[str]:
    """Makes all figures, writes the page and its pictures; gives what is wrong."""
    make(CASES, saltus, run)
    pictures = page_path.parent / "gallery"
    pictures.mkdir()
    for case in CASES:
        for path in case.files:
            for suffix in (".svg", ".png"):
                name = f"{path.parent.name}-{path.stem}{suffix}"
                (pictures / name).write_bytes(path.with_suffix(suffix).read_bytes())
    page_path.write_text(page(CASES, "gallery"), encoding="utf-8")
    return faults(CASES, drawing)
