"""The tables of the study file, as `saltus schema` describes them, for what is written from them.

Standard library only, Python 3.11 or later.
"""

import argparse
import json
import os
import subprocess
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent

# The order of tables in a file that a person wrote; a schema's keys come by name.
EXAMPLE = ROOT / "crates" / "saltus-config" / "src" / "template.toml"

# Names of classes where the last part of the table's name would not do.
CLASSES = {"": "Study", "plate.modes": "ModeLists"} | {
    f"{plane}.{axis}": "Axis" for plane in ("map", "basins") for axis in "xy"
}

# Descriptions of tables that stand in several places, each of which describes itself only.
ABOUT = {
    "Axis": "One axis of a plane: a key of the study and the values it takes.",
    "ModeLists": "The terms of the displacement fields, one by one.",
}


@dataclass
class Key:
    """One key of a table."""

    name: str
    schema: dict[str, Any]
    required: bool

    @property
    def description(self) -> str:
        """Its meaning, with its unit in brackets."""
        return str(self.schema["description"])

    @property
    def words(self) -> dict[str, str]:
        """The words allowed, each with its meaning; empty if it is no choice."""
        choices = self.schema.get("oneOf", [])
        return {choice["const"]: choice["description"] for choice in choices}

    @property
    def range(self) -> str:
        """The least and the largest number, of each item in a list; empty if any will do."""
        node = self.schema
        while "items" in node:
            node = node["items"]
        if "exclusiveMinimum" in node:
            low, high = node["exclusiveMinimum"], node["exclusiveMaximum"]
            return f"between {tidy(low)} and {tidy(high)}"
        low, high = node.get("minimum"), node.get("maximum")
        if low is None:
            return ""
        if high is None:
            return f"{tidy(low)} or more"
        return tidy(low) if low == high else f"{tidy(low)} to {tidy(high)}"

    @property
    def default(self) -> str:
        """As a file has it; empty if there is none."""
        if self.required or "default" not in self.schema:
            return ""
        return json.dumps(self.schema["default"], ensure_ascii=False)

    @property
    def unit(self) -> str:
        """The SI unit, or `-` of a pure number; empty if it is neither."""
        if "x-unit" in self.schema:
            return str(self.schema["x-unit"])
        return "-" if "(-" in self.description else ""


@dataclass
class Table:
    """One table of the study file; `path` is its dotted name, empty for the file itself."""

    path: str
    schema: dict[str, Any]
    about: str
    listed: bool
    required: bool
    keys: list[Key] = field(default_factory=list)

    @property
    def name(self) -> str:
        """Name of the class, such as `Plate`."""
        return CLASSES.get(self.path) or self.path.rpartition(".")[2].capitalize()


def tables(schema: dict[str, Any]) -> list[Table]:
    """All tables in the order of the template, each before those within it."""
    example = tomllib.loads(EXAMPLE.read_text(encoding="utf-8"))
    root = Table("", schema, schema["description"], listed=False, required=True)
    return list(_tables(root, example))


def _tables(table: Table, example: Any) -> Iterator[Table]:
    names = list(table.schema["properties"])
    first = list(example) if isinstance(example, dict) else []
    names.sort(key=lambda name: first.index(name) if name in first else len(first))
    within: list[Table] = []
    for name in names:
        node = table.schema["properties"][name]
        required = name in table.schema.get("required", [])
        found, listed = _table(node)
        if found:
            path = f"{table.path}.{name}".lstrip(".")
            about = ABOUT.get(CLASSES.get(path, ""), found["description"])
            part = Table(path, found, about, listed, required)
            inner = example.get(name) if isinstance(example, dict) else None
            within += _tables(part, inner[0] if listed and inner else inner)
        if not found or "anyOf" in node:
            table.keys.append(Key(name, node, required))
    yield table
    yield from within


def _table(node: dict[str, Any]) -> tuple[dict[str, Any] | None, bool]:
    """The table that a key is, has among its alternatives, or is a list of (then true)."""
    listed = node.get("items", {}).get("type") == "object"
    choices = [node["items"] if listed else node, *node.get("anyOf", [])]
    return next((n for n in choices if n.get("type") == "object"), None), listed


def tidy(value: float) -> str:
    """A number as a person writes it: 10000, 1e6, 1e-6."""
    if value == 0 or 1e-3 <= abs(value) < 1e6:
        return f"{value:.15g}"
    digits, _, power = f"{value:e}".partition("e")
    return f"{digits.rstrip('0').rstrip('.')}e{int(power)}"


def parser(about: str | None) -> argparse.ArgumentParser:
    """Arguments of a script that reads the schema."""
    target = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))
    found = argparse.ArgumentParser(
        description=about, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    found.add_argument(
        "--saltus",
        metavar="PROGRAM",
        default=target / "release" / "saltus",
        help="the program whose schema is read (default: %(default)s)",
    )
    return found


def read(program: str | Path) -> list[Table]:
    """The tables that this program knows."""
    done = subprocess.run([program, "schema"], check=True, stdout=subprocess.PIPE)
    return tables(json.loads(done.stdout))
