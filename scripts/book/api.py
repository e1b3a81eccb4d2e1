"""The pages of the Python package, from its docstrings.

    PYTHON scripts/book/api.py FOLDER       writes FOLDER.md and the pages in FOLDER

PYTHON must have the package saltus. Public is what a module lists in `__all__`, its other functions and classes without an
underscore in front, and of a class what has none; each needs a docstring. Sections are those of NumPy's style.
"""

import ast
import dataclasses
import functools
import importlib
import inspect
import re
import sys
import textwrap
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any

# Page, title, what stands above its names.
PAGES = {
    "commands": ("Commands as functions", "Each function asks one question about a study and returns a [`Result`](results.md#Result)."),
    "study": (
        "Studies",
        "A `Study` holds everything that is asked: the plate, the people, the base and the analysis. Its tables and keys are"
        " those of [the study file](../study-file.md).",
    ),
    "results": ("Results", "What the functions return, and what can be done with a saved result."),
    "errors": ("Errors", "Every exception of the package derives from `SaltusError`."),
    "systems": ("Your own systems: saltus.systems", ""),
    "dask": ("Clusters: saltus.dask", ""),
}
MODULES = ("saltus", "saltus.systems", "saltus.dask")
# Sections of which each item has a name, a type and a text; in the others text stands as it is.
_LISTS = ("Parameters", "Other Parameters", "Returns", "Yields", "Raises", "Warns", "Attributes", "See Also")
# The first line of a table in reStructuredText.
_RULE = re.compile(r"=+( +=+)+$", flags=re.MULTILINE)


class Undocumented(Exception):
    """Public names without a docstring."""


@dataclass
class Docstring:
    """A docstring of NumPy's style: the text above its sections, and these."""

    text: str
    sections: list[tuple[str, str]] = field(default_factory=list)


@dataclass
class Entry:
    """A public name of a module."""

    module: str
    name: str
    value: Any
    page: str

    @property
    def full(self) -> str:
        return f"{self.module}.{self.name}"


def parsed(text: str) -> Docstring:
    """Takes a docstring apart."""
    parts = re.split(r"^([A-Z][A-Za-z ]+)\n-{3,}[ ]*$", inspect.cleandoc(text), flags=re.MULTILINE)
    titles, bodies = parts[1::2], parts[2::2]
    return Docstring(parts[0].strip(), [(title, body.strip("\n")) for title, body in zip(titles, bodies)])


def items(body: str) -> list[tuple[str, str, str]]:
    """Name, type and text of each item of a section such as Parameters."""
    found: list[tuple[str, list[str]]] = []
    for line in body.splitlines():
        if line and not line.startswith(" "):
            found.append((line, []))
        elif found:
            found[-1][1].append(line)
    parts = []
    for head, lines in found:
        name, _, kind = head.partition(" : ")
        parts.append((name.strip(), kind.strip(), textwrap.dedent("\n".join(lines)).strip()))
    return parts


class Writer:
    """Markdown of docstrings, with links between the names of a package."""

    def __init__(self, entries: list[Entry]) -> None:
        self.entries = entries

    def link(self, name: str, here: Entry) -> str | None:
        """Where a name leads to from a page, if it is a public one."""
        name = name.removesuffix("()")
        first, _, member = name.removeprefix(f"{here.module}.").partition(".")
        choices = [e for e in self.entries if name == e.full or name.startswith(f"{e.full}.")]
        if not choices:
            choices = [e for e in self.entries if e.name == first and e.module in (here.module, "saltus")]
        if not choices:
            return None
        entry = max(choices, key=lambda e: (e.module == here.module, len(e.full)))
        member = name.removeprefix(entry.full).lstrip(".") if name.startswith(entry.full) else member
        if member and not hasattr(entry.value, member):
            return None
        target = "" if entry.page == here.page else f"{entry.page}.md"
        return f"{target}#{anchor(entry.name, member)}"

    def inline(self, text: str, here: Entry) -> str:
        """Prose of a docstring as Markdown."""

        def code(found: re.Match[str]) -> str:
            shown = (found[2] or found[3] or found[4]).lstrip("~")
            where = self.link(shown, here) if found[1] or found[3] else None
            return f"[`{shown}`]({where})" if where else f"`{shown}`"

        parts, last = [], 0
        for found in re.finditer(r"(:[a-z:]+:)?`(?:([^`]+)`|`([^`]+)``)|(?<![\w`])'(\w+)'(?![\w`])", text):
            parts += [_escaped(text[last : found.start()]), code(found) if not found[4] else f"'{found[4]}'"]
            last = found.end()
        return "".join([*parts, _escaped(text[last:])])

    def text(self, text: str, here: Entry) -> str:
        """Paragraphs, lists, examples and literal blocks."""
        parts = []
        blocks = re.split(r"\n\s*\n", text.strip("\n"))
        literal = False
        for block in filter(str.strip, blocks):
            lines = block.splitlines()
            if literal and lines[0].startswith(" "):
                parts.append(f"```text\n{textwrap.dedent(block)}\n```")
                continue
            literal = block.rstrip().endswith("::")
            block = textwrap.dedent(block)
            if _RULE.match(block):
                parts.append(self.table(block, here))
            elif block.startswith(">>>"):
                if parts and parts[-1].endswith("\n```") and parts[-1].startswith("```python"):
                    parts[-1] = f"{parts[-1][:-4]}\n\n{block}\n```"
                else:
                    parts.append(f"```python,no-run\n{block}\n```")
            else:
                shown = self.inline(block.rstrip(":") + ":" if literal else block, here)
                # lists keep their lines
                parts.append(re.sub(r"\n\s*\\?([*-]) ", r"\n\1 ", shown))
        return "\n\n".join(parts)

    def table(self, block: str, here: Entry) -> str:
        """A table between rules of `=`; a row without a first cell goes on with the one before."""
        rule, *lines = block.splitlines()
        spans = [found.span() for found in re.finditer("=+", rule)]
        ends = [start for start, _ in spans[1:]] + [None]
        rows: list[list[str]] = []
        for line in lines:
            if set(line) <= set("= "):
                continue
            cells = [line[start:end].strip() for (start, _), end in zip(spans, ends)]
            if cells[0] or not rows:
                rows.append(cells)
            else:
                rows[-1] = [f"{before} {more}".strip() for before, more in zip(rows[-1], cells)]
        shown = ["| " + " | ".join(self.inline(cell, here).replace("|", "\\|") for cell in row) + " |" for row in rows]
        return "\n".join([shown[0], "|" + "---|" * len(spans), *shown[1:]])

    def docstring(self, found: Docstring, here: Entry) -> str:
        """A docstring: its text, then each section below its title."""
        parts = [self.text(found.text, here)] if found.text else []
        for title, body in found.sections:
            parts.append(f"**{title}**")
            if title in _LISTS:
                linked = title not in ("Parameters", "Other Parameters", "Attributes")
                parts.append("\n".join(self.item(*item, here, linked=linked) for item in items(body)))
            else:
                parts.append(self.text(body, here))
        return "\n\n".join(parts)

    def item(self, name: str, kind: str, text: str, here: Entry, *, linked: bool = False) -> str:
        """A line of a list: what it is called, its type, its meaning."""
        where = self.link(name, here) if linked else None
        line = f"- [**`{name}`**]({where})" if where else f"- **`{name}`**"
        if kind:
            line += f" : {self.inline(kind, here)}"
        if text:
            line += "  \n" + textwrap.indent(self.text(text, here), "  ")
        return line

    def entry(self, entry: Entry) -> str:
        """A name: heading, signature, docstring; of a class also its attributes and methods."""
        value, name = entry.value, entry.name
        parts = [f"### {name} {{#{anchor(name)}}}"]
        if not callable(value):
            return "\n\n".join([*parts, f"`{entry.full}` is {value!r}." if isinstance(value, str) else ""])
        parts.append(f"```python,no-run\n{signature(entry.full, value)}\n```")
        if inspect.isclass(value):
            if issubclass(value, BaseException):
                bases = value.__bases__
                links = [self.link(base.__name__, entry) for base in bases]
                shown = [f"[`{b.__name__}`]({to})" if to else f"`{b.__name__}`" for b, to in zip(bases, links)]
                parts.append(f"Derives from {', '.join(shown)}.")
        parts.append(self.docstring(parsed(value.__doc__ or ""), entry))
        if inspect.isclass(value):
            attributes = fields(value)
            if attributes:
                parts.append("**Fields**")
                parts.append("\n".join(self.item(*each, entry) for each in attributes))
            for member, found in members(value).items():
                shown = f"{name}.{member}"
                parts.append(f"#### {shown} {{#{anchor(name, member)}}}")
                if isinstance(found, property | functools.cached_property):
                    parts.append("*Property.*")
                    doc = (found.fget if isinstance(found, property) else found.func).__doc__
                else:
                    parts.append(f"```python,no-run\n{signature(shown, getattr(value, member))}\n```")
                    doc = getattr(value, member).__doc__
                parts.append(self.docstring(parsed(doc or ""), entry))
        return "\n\n".join(part for part in parts if part)


def anchor(name: str, member: str = "") -> str:
    """The anchor of a name on its page."""
    return f"{name}.{member}" if member else name


def signature(name: str, value: Any) -> str:
    """How it is called, without annotations, which the text has in words."""
    if inspect.isclass(value):
        if issubclass(value, BaseException):
            return f"exception {name}"
        described = any(title == "Parameters" for title, _ in parsed(value.__doc__ or "").sections)
        if not described and not dataclasses.is_dataclass(value):
            return f"class {name}"
    try:
        found = inspect.signature(value)
    except (TypeError, ValueError):
        return name
    given = [each.replace(annotation=inspect.Parameter.empty) for each in found.parameters.values()]
    given = given[1:] if given and given[0].name == "self" else given
    shown = str(found.replace(parameters=given, return_annotation=inspect.Signature.empty))
    shown = re.sub(r"<[^<>]+>", "...", shown)
    line = f"{name}{shown}"
    if len(line) <= 88:
        return line
    short = shown.strip("()").split(", ")
    return f"{name}(\n" + "".join(f"    {each},\n" for each in short) + ")"


def fields(value: type) -> list[tuple[str, str, str]]:
    """The fields of a class that has its own text below each: name, type, text."""
    try:
        tree = ast.parse(textwrap.dedent(inspect.getsource(value)))
    except (OSError, TypeError):
        return []
    found = []
    body = tree.body[0].body
    init = next((each.body for each in body if isinstance(each, ast.FunctionDef) and each.name == "__init__"), [])
    for lines in (body, init):
        for node, below in zip(lines, lines[1:]):
            text = below.value.value if isinstance(below, ast.Expr) and isinstance(below.value, ast.Constant) else None
            if isinstance(node, ast.AnnAssign):
                name, kind = ast.unparse(node.target).removeprefix("self."), ast.unparse(node.annotation)
            elif isinstance(node, ast.Assign) and lines is init:
                name, kind = ast.unparse(node.targets[0]).removeprefix("self."), ""
            else:
                continue
            if isinstance(text, str) and not name.startswith("_"):
                found.append((name, f"``{kind}``" if kind else "", inspect.cleandoc(text)))
    return found


def members(value: type) -> dict[str, Any]:
    """Public methods and properties that a class defines itself."""
    kinds = (property, functools.cached_property, classmethod, staticmethod)
    return {
        name: found
        for name, found in vars(value).items()
        if not name.startswith("_") and (inspect.isfunction(found) or isinstance(found, kinds))
    }


def page_of(module: str, value: Any) -> str:
    """Which page a name belongs to."""
    if module != "saltus":
        return module.rpartition(".")[2]
    if inspect.isclass(value) and issubclass(value, BaseException):
        return "errors"
    home = getattr(value, "__module__", "")
    if home in ("saltus.study", "saltus._tables"):
        return "study"
    return "commands" if home == "saltus._commands" else "results"


def public(module: ModuleType) -> list[str]:
    """What a module offers: `__all__`, and functions and classes of its package that `import *` had better leave out."""
    own = f"{module.__name__}."
    others = [
        name
        for name, value in vars(module).items()
        if not name.startswith("_")
        and (inspect.isfunction(value) or inspect.isclass(value))
        and f"{value.__module__}.".startswith(own)
    ]
    return sorted({*module.__all__, *others})


def entries(modules: list[ModuleType]) -> list[Entry]:
    """The public names of modules; raises `Undocumented` with those that say nothing of themselves."""
    found, silent = [], []
    for module in modules:
        for name in public(module):
            value = getattr(module, name)
            found.append(Entry(module.__name__, name, value, page_of(module.__name__, value)))
            silent += [f"{module.__name__}.{each}" for each in _silent(name, value)]
    if silent:
        raise Undocumented(f"no docstring: {', '.join(silent)}")
    return found


def _silent(name: str, value: Any) -> list[str]:
    """A name and its members without a docstring."""
    if not callable(value):
        return []
    doc = value.__doc__ or ""
    # a dataclass without a docstring gets its signature as one
    found = [name] if not doc.strip() or doc.startswith(f"{name}(") else []
    if inspect.isclass(value):
        for member, each in members(value).items():
            inner = each.func if isinstance(each, functools.cached_property) else each
            if not (getattr(inner, "__doc__", None) or "").strip():
                found.append(f"{name}.{member}")
    return found


def summary(value: Any) -> str:
    """The first sentence of a docstring."""
    text = parsed(value.__doc__ or "").text.split("\n\n")[0].replace("\n", " ")
    return re.split(r"(?<=\.)\s", text)[0]


def write(modules: list[ModuleType], folder: Path) -> list[str]:
    """Writes `folder`.md and the pages in `folder`; gives their names."""
    known = entries(modules)
    writer = Writer(known)
    folder.mkdir(parents=True)
    overview = [
        "# Python API",
        "Every public name of the package `saltus`, from its docstrings. Functions check their arguments, raise exceptions that"
        " name the offending key, show a progress bar and can be interrupted with Ctrl-C.",
    ]
    pages = []
    for page, (title, about) in PAGES.items():
        here = [entry for entry in known if entry.page == page]
        if not here:
            continue
        pages.append(page)
        module = sys.modules[here[0].module]
        parts = [f"# {title}", about]
        if module.__name__ != "saltus":
            parts.append(writer.docstring(parsed(module.__doc__ or ""), here[0]))
        rows = ["| name | what it is |", "|---|---|"]
        for entry in here:
            text = writer.inline(summary(entry.value) if callable(entry.value) else "Version of the package.", entry)
            text = text.replace("|", "\\|")
            rows.append(f"| [`{entry.name}`](#{anchor(entry.name)}) | {text} |")
        table = "\n".join(rows)
        below = re.sub(r"\]\((\w*)(\.md)?#", lambda to: f"]({folder.name}/{to[1] or page}.md#", table)
        overview += [f"## [{title}]({folder.name}/{page}.md)", below]
        parts += [table, *[writer.entry(entry) for entry in here]]
        (folder / f"{page}.md").write_text("\n\n".join(filter(None, parts)) + "\n", encoding="utf-8")
    folder.with_suffix(".md").write_text("\n\n".join(overview) + "\n", encoding="utf-8")
    return pages


def _escaped(text: str) -> str:
    return re.sub(r"([\\*_<>$])", r"\\\1", text)


def main() -> None:
    try:
        pages = write([importlib.import_module(name) for name in MODULES], Path(sys.argv[1]))
    except Undocumented as fault:
        sys.exit(str(fault))
    print("\n".join(f"{page}\t{PAGES[page][0]}" for page in pages))


if __name__ == "__main__":
    main()
