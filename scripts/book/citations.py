"""Citations such as [DP] or [Müller 1995; BBCK 2008] in the pages lead to their works on the page of literature."""

import re
import unicodedata
from collections.abc import Callable

_WORK = re.compile(r"^- \*\*([^*]+)\*\*:", flags=re.MULTILINE)
# Neither the text of a link nor the definition of one, which begins a line.
_CITED = re.compile(r"^\[[^\]]+\]:|(?<!\])\[([^\[\]()]+)\](?![\[(])", flags=re.MULTILINE)
# What looks like a citation, so that one without its work is noticed: a name and a year.
_LIKE = re.compile(r"[A-ZÀ-Þ][\w &'.-]* (?:1[89]|20)\d\d$")
# Code and equations hold no citations.
_OTHER = re.compile(r"^(`{3,}|~{3,}).*?^\1\s*$|`[^`\n]+`|\$\$.*?\$\$|\$[^$\n]+\$", flags=re.MULTILINE | re.DOTALL)


def works(literature: str) -> list[str]:
    """The keys of the page of literature."""
    return _WORK.findall(literature)


def anchor(key: str) -> str:
    """Anchor of a work: `Müller 1995` is `muller-1995`."""
    plain = unicodedata.normalize("NFKD", key).encode("ascii", "ignore").decode()
    return re.sub(r"\W+", "-", plain.lower()).strip("-")


def anchored(literature: str) -> str:
    """The page of literature with an anchor at each work."""
    return _WORK.sub(lambda work: f'- <a id="{anchor(work[1])}"></a>**{work[1]}**:', literature)


def linked(text: str, known: list[str], page: str) -> tuple[str, list[str]]:
    """A page whose citations are links to `page`, and what is cited but not there."""
    unknown: list[str] = []

    def link(cited: re.Match[str]) -> str:
        parts = re.split(r"([;,] )", cited[1] or "")
        keys = parts[::2]
        if not any(key in known or _LIKE.match(key) for key in keys):
            return cited[0]
        unknown.extend(key for key in keys if key not in known)
        shown = [f"[{key}]({page}#{anchor(key)})" if key in known else key for key in keys]
        marks = [*parts[1::2], ""]
        return "\\[" + "".join(key + mark for key, mark in zip(shown, marks)) + "\\]"

    return _outside(text, lambda prose: _CITED.sub(link, prose)), unknown


def _outside(text: str, change: Callable[[str], str]) -> str:
    """A page with its prose changed, and its code and equations as they are."""
    parts, last = [], 0
    for other in _OTHER.finditer(text):
        parts += [change(text[last : other.start()]), other[0]]
        last = other.end()
    return "".join([*parts, change(text[last:])])
