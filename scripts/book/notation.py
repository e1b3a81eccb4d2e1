"""Checks of the table of notation: its keys are those of the study file, its names those that results have."""

import re
from typing import Any


def keys(schema: dict[str, Any], path: str = "") -> set[str]:
    """All keys of the study file, such as `plate.length` and `jumper.mass`."""
    found = set()
    for name, node in schema.get("properties", {}).items():
        here = f"{path}.{name}".lstrip(".")
        found.add(here)
        for inner in (node, node.get("items", {}), *node.get("anyOf", [])):
            found |= keys(inner, here)
    return found


def names(quantities: str) -> set[str]:
    """The names of all quantities of results, from the table in `crates/saltus-commands/src/quantities.rs`."""
    return set(re.findall(r'^\s*[A-Z][A-Z0-9_]*: "(\w+)"', quantities, flags=re.MULTILINE))


def column(page: str, heading: str) -> list[str]:
    """The cells below a title, of all tables of a page that have it."""
    found, inside, titles = [], False, []
    for line in page.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")] if line.startswith("|") else []
        if not cells:
            inside, titles = False, []
        elif not titles:
            titles = cells
            inside = heading in titles
        elif inside and not set("".join(cells)) <= set("-: "):
            found.append(cells[titles.index(heading)])
    return found


def faults(page: str, known: set[str], results: set[str]) -> list[str]:
    """Keys and names in the tables that do not exist."""
    found = []
    for heading, where, what in (("key", known, "key"), ("in results", results, "name in results")):
        for cell in column(page, heading):
            found += [f"notation.md: no {what} {word}" for word in re.findall(r"`([\w.]+)`", cell) if word not in where]
    return found
