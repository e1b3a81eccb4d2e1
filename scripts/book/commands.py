"""The pages of the commands, from what `saltus help` prints."""

import re
import subprocess
from dataclasses import dataclass
from pathlib import Path

# Where to read on, for a command that a page shows at work.
PAGES = {
    "reproduce": ["[The model](../../model.md#6-misprints-and-gaps-of-the-paper)"],
    "init": ["[The study file, key by key](../study-file.md)"],
    "check": ["[The study file, key by key](../study-file.md)"],
    "schema": ["[The study file, key by key](../study-file.md)"],
    "frequencies": ["[Getting started](../../getting-started.md#first-numbers)"],
    "simulate": ["[Getting started](../../getting-started.md#a-motion)"],
    "sweep": ["[Figure 2 of the paper](../../tutorials/figure-2.md)"],
    "map": ["[Two-parameter maps](../../how-to/maps.md)", "[Large maps on a cluster](../../how-to/clusters.md)"],
    "basins": ["[Basins of attraction](../../how-to/basins.md)"],
    "orbit": ["[Why a motion changes](../../tutorials/transitions.md#the-orbit-and-its-multipliers)"],
    "continue": [
        "[Why a motion changes](../../tutorials/transitions.md)",
        "[Bifurcation curves in two parameters](../../how-to/bifurcation-curves.md)",
    ],
    "lyapunov": ["[Lyapunov exponents](../../how-to/lyapunov.md)"],
    "attractors": ["[Basins of attraction](../../how-to/basins.md#all-attractors-and-their-hysteresis)"],
    "cite": ["[Results: read, load, compare](../../how-to/results.md#cite)"],
    "rerun": ["[Results: read, load, compare](../../how-to/results.md#the-same-bits-again)"],
}
# What begins a section of its own in the text below the options.
_SECTION = re.compile(r"(Data|Tables|Figures?|JSON|Exit codes)\b")
_ENTRY = re.compile(r"\s+(?:-\w\b|--\w|<|\[\w)")
_CODE = re.compile(
    r"`[^`]+`"
    r"|--[a-z][\w-]*(?: (?:DIR|FILE|LABEL|I/N|i/n|N)\b)?"
    r"|\[[a-z]+(?:\.[a-z]+)*\]"
    r"|\b[a-z]+(?:\.[a-z_]+|\.\d+)+\b(?: = (?:\"[\w-]+\"|\d+)|=[\w.-]*\w)?"
)


@dataclass
class Help:
    """What `saltus help COMMAND` prints, taken apart."""

    about: str
    usage: str
    arguments: list[tuple[str, str]]
    options: list[tuple[str, str]]
    rest: str


def commands(text: str) -> dict[str, str]:
    """Each command that `saltus help` lists, with its one line; not `help` itself."""
    found, name = {}, ""
    for line in _between(text, "Commands:"):
        entry = re.match(r"  (\S+)\s+(.*)", line)
        if entry:
            name = entry[1]
            found[name] = entry[2]
        else:
            found[name] += f" {line.strip()}"
    found.pop("help", None)
    return found


def taken_apart(text: str) -> Help:
    """The parts of a command's help."""
    head, _, below = text.partition("\nUsage: ")
    usage, _, below = below.partition("\n")
    arguments, options = _between(below, "Arguments:"), _between(below, "Options:")
    rest = below.split("\n".join(options))[-1] if options else below
    return Help(" ".join(head.split()), usage, _entries(arguments), _entries(options), rest.strip("\n"))


def page(name: str, text: str, pictures: bool) -> str:
    """The page of a command; `pictures` if the gallery has some of it."""
    found = taken_apart(text)
    parts = [f"# saltus {name}", f"{_inline(found.about)}.", f"```text\n{found.usage}\n```"]
    links = list(PAGES.get(name, []))
    if pictures:
        links.append(f"[its figures in the gallery](../../gallery.md#{name})")
    if links:
        parts.append(f"See also: {', '.join(links)}.")
    for title, entries in (("Arguments", found.arguments), ("Options", found.options)):
        if entries:
            rows = [f"| `{_cell(flag)}` | {_cell(_inline(meaning))} |" for flag, meaning in entries]
            parts.append("\n".join([f"## {title}\n", "| | meaning |", "|---|---|", *rows]))
    return "\n\n".join([*parts, *_text(found.rest)]) + "\n"


def overview(known: dict[str, str]) -> str:
    """The page that lists all commands."""
    rows = [f"| [`{name}`](commands/{name}.md) | {_cell(_inline(about))} |" for name, about in known.items()]
    head = [
        "# Commands",
        "The program is called `saltus`. Each command has a page with its options, and with every variable, table and"
        " figure that it writes. `saltus help COMMAND` prints the same in a terminal.",
        "Each question can also be asked from Python, by [the function of the same name](python/commands.md)."
        " [The gallery](../gallery.md) shows all figures.",
    ]
    return "\n\n".join([*head, "\n".join(["| command | what it does |", "|---|---|", *rows])]) + "\n"


def write(saltus: Path, folder: Path, pictured: set[str]) -> list[tuple[str, Path]]:
    """Writes `folder`.md and a page for each command in `folder`; gives titles and paths of the latter."""
    known = commands(_printed(saltus))
    folder.mkdir(parents=True)
    folder.with_suffix(".md").write_text(overview(known), encoding="utf-8")
    pages = []
    for name in known:
        path = folder / f"{name}.md"
        path.write_text(page(name, _printed(saltus, name), name in pictured), encoding="utf-8")
        pages.append((f"saltus {name}", path))
    return pages


def drawing(saltus: Path) -> list[str]:
    """The commands whose help speaks of figures of a study."""
    texts = {name: _printed(saltus, name) for name in commands(_printed(saltus))}
    return [name for name, text in texts.items() if re.search(r"^Figures?: ", text, flags=re.MULTILINE)]


def _printed(saltus: Path, *command: str) -> str:
    return subprocess.run([saltus, "help", *command], check=True, stdout=subprocess.PIPE, text=True).stdout


def _between(text: str, title: str) -> list[str]:
    """The lines below a title up to the next line that is not indented."""
    found, inside = [], False
    for line in text.splitlines():
        if inside and line and not line.startswith(" "):
            break
        if inside:
            found.append(line)
        inside = inside or line == title
    while found and not found[-1]:
        found.pop()
    return found


def _entries(lines: list[str]) -> list[tuple[str, str]]:
    """Options or arguments with their meanings, which may stand beside or below them."""
    found: list[list[str]] = []
    for line in lines:
        if _ENTRY.match(line):
            found.append(re.split(r" {2,}", line.strip(), maxsplit=1))
        elif line.strip():
            found[-1].append(line.strip())
    return [(flag, " ".join(meaning)) for flag, *meaning in found]


def _text(rest: str) -> list[str]:
    """The paragraphs, lists and titles below the options as Markdown."""
    parts = []
    for block in filter(None, re.split(r"\n\s*\n", rest)):
        lines = block.splitlines()
        while lines:
            indented = lines[0].startswith(" ")
            count = next((i for i, line in enumerate(lines) if line.startswith(" ") != indented), len(lines))
            run, lines = lines[:count], lines[count:]
            parts += _indented(run) if indented else _paragraph(" ".join(run))
    return parts


def _paragraph(text: str) -> list[str]:
    """A paragraph; one that begins with the title of a section is that title and what follows it."""
    title = _SECTION.match(text)
    if not title:
        return [_inline(text)]
    head = "Figures" if title[1] == "Figure" else title[1]
    below = text[title.end() :].lstrip(" ,:")
    if below == "(--json):":
        below = "what --json prints:"
    return [f"## {head}", *([_inline(below[0].upper() + below[1:])] if below else [])]


def _indented(lines: list[str]) -> list[str]:
    """Indented lines: a table if they are names with meanings, else a paragraph."""
    depth = min(len(line) - len(line.lstrip()) for line in lines)
    first = re.match(r"\s+\S+(?:  +\S|$)", lines[0])
    if not first:
        return [_inline(" ".join(line.strip() for line in lines))]
    # meanings begin in one column, whatever the indentation of the names
    deeper = [len(line) - len(line.lstrip()) for line in lines]
    beside = [match.end() - 1 for line in lines if (match := re.match(r"\s+\S+  +\S", line))]
    column = min([*beside, *[each for each in deeper if each > depth + 2]])
    rows: list[tuple[int, str, list[str]]] = []
    for line, indent in zip(lines, deeper):
        if indent >= column:
            rows[-1][2].append(line.strip())
        else:
            name, _, meaning = line.strip().partition("  ")
            rows.append((indent, name, [meaning.strip()] if meaning.strip() else []))
    table = ["| name | meaning | unit |", "|---|---|---|"]
    for indent, name, meaning in rows:
        text = " ".join(meaning)
        unit = re.fullmatch(r"(.*) \((-|[\w ^/-]{1,8})\)", text)
        text, unit = (unit[1], unit[2]) if unit else (text, "")
        mark = "" if indent == depth else "↳ "
        table.append(f"| {mark}`{name}` | {_cell(_inline(text))} | {unit} |")
    return ["\n".join(table)]


def _inline(text: str) -> str:
    """Prose as Markdown: keys, options and tables of the study as code."""
    parts, last = [], 0
    for code in _CODE.finditer(text):
        shown = code[0] if code[0].startswith("`") else f"`{code[0]}`"
        parts += [_escaped(text[last : code.start()]), shown]
        last = code.end()
    return "".join([*parts, _escaped(text[last:])])


def _escaped(text: str) -> str:
    return re.sub(r"([\\*_<>$\[\]])", r"\\\1", text)


def _cell(text: str) -> str:
    return text.replace("|", "\\|")
