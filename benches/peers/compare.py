"""The comparison itself; `scripts/compare-peers` prepares what it needs and calls it."""

from __future__ import annotations

import argparse
import datetime
import json
import math
import platform
import subprocess
import sys
import time
import tomllib
from dataclasses import asdict, dataclass, replace
from importlib.metadata import version
from pathlib import Path

import numpy as np

import reference
from heyoka_peer import Heyoka
from model import Array, Problem, problem, write
from numba_peer import Numba
from settings import ROWS, Column, Row, Size, grid

INERTIA = {"W1": "condensed", "W2": "full"}
WORK_RATIO = 1.1


@dataclass(frozen=True)
class Measurement:
    """What one run of one program gave."""

    seconds: float
    periods: int
    error: float
    mean_z: float
    compile_seconds: float = 0.0
    steps_per_period: float = 0.0

    @property
    def rate(self) -> float:
        return self.periods / self.seconds


class Bench:
    """The problems, their known ends, and everything compiled so far."""

    def __init__(self, saltus: Path, peers: Path, folder: Path) -> None:
        self.saltus, self.peers, self.folder = saltus, peers, folder
        self.label: dict[str, Problem] = {}
        self.work: dict[str, Problem] = {}
        self.end: dict[str, Array] = {}
        self.agreement: dict[str, float] = {}
        self.compiled: dict[tuple[str, ...], Heyoka | Numba] = {}
        for work, inertia in INERTIA.items():
            self.label[work] = problem(inertia, reference.RATIO)
            self.work[work] = problem(inertia, WORK_RATIO)
            end = self.end[work] = reference.taylor(self.label[work])
            other = reference.runge_kutta(self.label[work])
            self.agreement[work] = self.label[work].norm(end - other)
            known = {"zeta": reference.ZETA, "periods": reference.PERIODS, "end": end.tolist()}
            write(self.file(work, "label"), self.label[work], label=known)
            write(self.file(work, "work"), self.work[work])

    def file(self, work: str, what: str) -> Path:
        return self.folder / f"{work}-{what}.json"

    def measure(self, row: Row, column: Column, setting: str, size: Size) -> Measurement:
        runner = {
            "saltus": self.run_saltus,
            "rust": self.run_rust,
            "heyoka": self.run_heyoka,
            "numba": self.run_numba,
        }[row.kind]
        return runner(row, column.work, setting, size)

    def run_saltus(self, row: Row, work: str, setting: str, size: Size) -> Measurement:
        inertia = row.name.split()[0 if work == "W1" else 1]
        label, end = self.label[work], self.end[work]
        n, half = label.transverse, label.freedoms
        body = np.array([end[half - 1], end[-1]]) / label.unit_z
        known = ",".join(repr(float(v)) for v in [*end[:n], *end[half : half + n], *body])
        counts = [str(size.values), str(size.periods), str(size.keep)]
        return self.command([str(self.saltus), inertia, *setting.split(), *counts, known])

    def run_rust(self, row: Row, work: str, setting: str, size: Size) -> Measurement:
        counts = [str(size.values), str(size.periods), str(size.keep)]
        files = [str(self.file(work, what)) for what in ("label", "work")]
        return self.command([str(self.peers), row.name, setting, *files, *counts])

    def command(self, words: list[str]) -> Measurement:
        run = subprocess.run(words, capture_output=True, text=True, check=False)
        if run.returncode != 0:
            raise RuntimeError(f"{' '.join(words[:3])}: {run.stderr.strip()[-500:]}")
        return Measurement(**json.loads(run.stdout.replace("NaN", "Infinity")))

    def run_heyoka(self, row: Row, work: str, setting: str, size: Size) -> Measurement:
        def build(which: Problem) -> Heyoka:
            return Heyoka(which, float(setting), batch=int(row.name))

        label = self.once(("label", row.key, work, setting), lambda: build(self.label[work]))
        solver = self.once(("work", row.key, work, setting), lambda: build(self.work[work]))
        error = self.error(work, label.end(reference.ZETA, reference.PERIODS))
        zetas = np.linspace(0.1, 0.5, size.values)
        begun, total = time.process_time(), 0.0
        for first in range(0, size.values, solver.batch):
            samples = solver.run(zetas[first : first + solver.batch], size.periods, size.keep)
            total += float(samples.sum())
        seconds = time.process_time() - begun
        mean = total / (size.values * size.keep) / self.work[work].unit_z
        return Measurement(seconds, size.values * size.periods, error, mean, solver.compile_seconds)

    def run_numba(self, row: Row, work: str, setting: str, size: Size) -> Measurement:
        label = self.once(("label", row.key, work, setting), lambda: Numba(self.label[work], float(setting)))
        solver = self.once(("work", row.key, work, setting), lambda: Numba(self.work[work], float(setting)))
        error = self.error(work, label.end(reference.ZETA, reference.PERIODS))
        begun, total = time.process_time(), 0.0
        for zeta in np.linspace(0.1, 0.5, size.values):
            samples = solver.run(float(zeta), size.periods, size.keep)
            total += float(samples[1:, self.work[work].freedoms - 1].sum())
        seconds = time.process_time() - begun
        mean = total / (size.values * size.keep) / self.work[work].unit_z
        return Measurement(seconds, size.values * size.periods, error, mean, label.compile_seconds)

    def once(self, key: tuple[str, ...], build):
        if key not in self.compiled:
            self.compiled[key] = build()
        return self.compiled[key]

    def error(self, work: str, end: Array) -> float:
        error = self.label[work].norm(end - self.end[work])
        return error if math.isfinite(error) else math.inf

    def peak(self) -> float:
        """GFlop/s of this core in f64."""
        run = subprocess.run([str(self.peers), "peak"], capture_output=True, text=True, check=True)
        return float(json.loads(run.stdout)["gflops"])


def multiply_adds(problem: Problem, order: int) -> float:
    """Multiply-adds in one step of the condensed model's series of this order, and no other work.

    A product costs k + 1 at order k, a square of one factor half of that; a sum costs its terms.
    """
    n = problem.transverse
    pairs = n * (n + 1) // 2
    products = pairs - n + n * n + n / 2
    quartic = pairs * pairs
    body = 2 * (n + 2) + 2  # d, d', F
    sums = quartic + n * 6 + body + 1
    states = 2 * problem.freedoms
    return products * order * (order + 1) / 2 + sums * order + states * order


def cpu() -> str:
    for line in Path("/proc/cpuinfo").read_text().splitlines() if Path("/proc/cpuinfo").exists() else []:
        if line.startswith("model name"):
            return line.split(":", 1)[1].strip()
    return platform.processor() or platform.machine()


def output(words: list[str]) -> str:
    return subprocess.run(words, capture_output=True, text=True, check=True).stdout.strip()


def locked(folder: Path) -> dict[str, str]:
    """Versions of the Rust libraries compared, from their lock file."""
    packages = tomllib.loads((folder / "Cargo.lock").read_text())["package"]
    wanted = {"diffsol", "differential-equations"}
    return {p["name"]: p["version"] for p in packages if p["name"] in wanted}


def compare(bench: Bench, rows: list[Row], rounds: int, shrink: int) -> dict[str, dict[str, dict]]:
    """Every program once a round, in turn; the fastest round of each counts."""
    best: dict[tuple[str, Column], Measurement] = {}
    for round_ in range(rounds):
        for column in Column:
            for row in rows:
                size = row.sizes[column.work]
                # Values stay, so that batches do; the periods shrink.
                periods = max(size.periods // shrink, 10)
                size = replace(size, periods=periods, keep=min(size.keep, periods // 2))
                found = bench.measure(row, column, row.settings[column], size)
                old = best.get((row.key, column))
                if old is None or found.rate > old.rate:
                    best[row.key, column] = found
                print(
                    f"round {round_ + 1}, {column.title}, {row.title}: "
                    f"{found.rate / 1e3:.3g} k, error {found.error:.1e}",
                    file=sys.stderr,
                )
    return {
        row.key: {
            column.title: {
                "setting": row.settings[column],
                "rate": best[row.key, column].rate,
                **asdict(best[row.key, column]),
            }
            for column in Column
        }
        for row in rows
    }


def tune(bench: Bench, rows: list[Row]) -> None:
    """All settings of the grid, and which one the rule of settings.py chooses."""
    for row in rows:
        for work in INERTIA:
            columns = [column for column in Column if column.work == work]
            size = Size(16, 200, 50) if work == "W1" else Size(8, 20, 10)
            tried = []
            for setting in grid(row, columns[0]):
                found = bench.measure(row, columns[0], setting, size)
                tried.append((setting, found))
                print(f"{row.key} {work} {setting}: {found.rate / 1e3:.3g} k, error {found.error:.2e}")
                if found.error < 1e-10 and row.kind != "saltus" and work == "W1":
                    break
            for column in columns:
                print(f"  {row.key}, {column.title}: {choose(row, column, tried)}", flush=True)


def choose(row: Row, column: Column, tried: list[tuple[str, Measurement]]) -> str:
    """The fastest setting that keeps the bound together with all that are tighter.

    For saltus "tighter" means a smaller tolerance at the same order.
    """
    good = []
    for index, (setting, found) in enumerate(tried):
        order = setting.split()[1:]
        tighter = [m for s, m in tried[index:] if s.split()[1:] == order]
        if all(m.error <= column.bound for m in tighter):
            good.append((found.rate, setting, found.error))
    if not good:
        return "none"
    rate, setting, error = max(good)
    return f"{setting}  ({rate / 1e3:.3g} k, error {error:.1e})"


def thousands(rate: float) -> str:
    value = rate / 1e3
    return f"{value:.0f}" if value >= 20 else f"{value:.1f}" if value >= 1 else f"{value:.2f}"


def table(results: dict[str, dict[str, dict]], rows: list[Row]) -> str:
    """Rates with their errors, and how many times faster the fastest row of saltus is."""
    columns = [column.title for column in Column]
    own = {
        c: max((results[r.key][c]["rate"] for r in rows if r.kind == "saltus"), default=math.nan)
        for c in columns
    }
    lines = ["| program | " + " | ".join(f"{c} | ratio" for c in columns) + " |"]
    lines.append("|---" * (1 + 2 * len(columns)) + "|")
    for row in rows:
        cells = []
        for c in columns:
            cell = results[row.key][c]
            cells.append(f"{thousands(cell['rate'])} k ({cell['error']:.0e})".replace("e-0", "e-"))
            ratio = own[c] / cell["rate"]
            cells.append(
                ""
                if math.isnan(ratio)
                else f"{ratio:.2f}"
                if ratio < 1
                else f"{ratio:.1f}"
                if ratio < 10
                else f"{ratio:.0f}"
            )
        lines.append(f"| {row.title} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def settings_table(results: dict[str, dict[str, dict]], rows: list[Row]) -> str:
    columns = [column.title for column in Column]
    lines = ["| program | setting: " + " | ".join(columns) + " | periods run in W1, W2 |"]
    lines.append("|---" * (2 + len(columns)) + "|")
    for row in rows:
        cells = [results[row.key][c]["setting"] for c in columns]
        counts = [results[row.key][c]["periods"] for c in (columns[0], columns[2])]
        cells.append(", ".join(f"{count:,}".replace(",", " ") for count in counts))
        lines.append(f"| {row.title} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def facts(report: dict) -> list[str]:
    versions = ", ".join(f"{name} {number}" for name, number in report["versions"].items())
    agreement = ", ".join(f"{work} {value:.0e}" for work, value in report["reference_agreement"].items())
    lines = [
        f"{report['date']}, {report['cpu']}, best of {report['rounds']}"
        + (", an eighth of the work." if report["quick"] else "."),
        f"Versions: {versions}.",
        f"Agreement of the two references: {agreement}.".replace("e-0", "e-"),
        f"Peak of the core: {report['peak_gflops']:.0f} GFlop/s (f64, eight lanes).",
    ]
    for title, limit in report["limit"].items():
        lines.append(
            f"At that peak the multiply-adds of saltus's series alone would allow {limit / 1e3:.0f} k "
            f"in {title}."
        )
    compiled = {
        key: max(found["compile_seconds"] for found in columns.values())
        for key, columns in report["results"].items()
    }
    spent = [f"{key} {seconds:.1f} s" for key, seconds in compiled.items() if seconds > 0]
    if spent:
        lines.append(f"Not counted: compiling at run time, for the slowest column, {', '.join(spent)}.")
    return lines


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--saltus", type=Path, required=True, help="the bench `peers` of crates/saltus")
    parser.add_argument("--peers", type=Path, required=True, help="the program of benches/peers/diffsol")
    parser.add_argument("--folder", type=Path, required=True, help="where results.json goes")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--markdown", action="store_true")
    parser.add_argument("--tune", action="store_true")
    parser.add_argument("--only", action="append", default=[])
    options = parser.parse_args()

    keys = [row.key for row in ROWS]
    unknown = [name for name in options.only if not any(key.startswith(name) for key in keys)]
    if unknown:
        parser.error(f"no program {', '.join(unknown)}; there are {', '.join(keys)}")
    rows = [row for row in ROWS if not options.only or any(row.key.startswith(n) for n in options.only)]
    bench = Bench(options.saltus, options.peers, options.folder)
    if options.tune:
        tune(bench, rows)
        return

    rounds, shrink = (1, 8) if options.quick else (3, 1)
    results = compare(bench, rows, rounds, shrink)
    report = {
        "date": datetime.date.today().isoformat(),
        "cpu": cpu(),
        "rounds": rounds,
        "quick": options.quick,
        "versions": {
            "rustc": output(["rustc", "--version"]).split()[1],
            "python": platform.python_version(),
            **{name: version(name) for name in ("heyoka", "numba", "numpy", "scipy")},
            **locked(Path(__file__).parent / "diffsol"),
        },
        "reference_agreement": bench.agreement,
        "peak_gflops": bench.peak(),
        "limit": {},
        "results": results,
    }
    for row in rows:
        if row.kind == "saltus":
            for column in (Column.W1_6, Column.W1_8):
                found, order = results[row.key][column.title], int(row.settings[column].split()[1])
                work = 2 * multiply_adds(bench.work["W1"], order) * found["steps_per_period"]
                report["limit"][column.title] = report["peak_gflops"] * 1e9 / work
    target = options.folder / "results.json"
    target.write_text(json.dumps(report, indent=1) + "\n")

    # Lists read well both in a terminal and in Markdown.
    print(table(results, rows))
    print()
    for line in facts(report):
        print(f"- {line}" if options.markdown else line)
    if options.markdown:
        print()
        print(settings_table(results, rows))
    else:
        print(f"\nWritten: {target}")


if __name__ == "__main__":
    main()
