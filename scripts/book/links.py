"""Checks of the built site and of the pages: every link leads somewhere, nothing is fetched from a network."""

import re
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit


class _Page(HTMLParser):
    """Anchors, links and fetched things of one page."""

    def __init__(self, text: str):
        super().__init__()
        self.anchors, self.links, self.fetched = {""}, [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.anchors |= {attrs[key] for key in ("id", "name") if attrs.get(key)}
        target = attrs.get("href") or attrs.get("src")
        if target and tag == "a":
            self.links.append((self.getpos()[0], target))
        elif target:
            self.fetched.append((self.getpos()[0], target))


def problems(html: Path) -> list[str]:
    """Faults of the site at `html`, a line for each."""
    pages = {path: _Page(path.read_text(encoding="utf-8")) for path in sorted(html.rglob("*.html"))}
    found = []
    for path, page in pages.items():
        here = path.relative_to(html)
        for line, target in page.fetched:
            if urlsplit(target).netloc:
                found.append(f"{here}:{line}: the page fetches {target} from a network")
        for line, target in page.links + page.fetched:
            fault = _fault(path, target, pages)
            if fault:
                found.append(f"{here}:{line}: {fault}")
    for path in sorted(html.rglob("*.css")):
        for target in re.findall(
            r"url\(\s*[\"']?([^\"')]+)|@import\s+[\"']([^\"']+)", path.read_text(encoding="utf-8")
        ):
            target = "".join(target)
            if urlsplit(target).netloc:
                found.append(f"{path.relative_to(html)}: the style fetches {target} from a network")
            elif not target.startswith("data:") and not (path.parent / urlsplit(target).path).exists():
                found.append(f"{path.relative_to(html)}: no file {target}")
    return found


def _fault(path: Path, target: str, pages: dict[Path, _Page]) -> str | None:
    parts = urlsplit(target)
    if parts.scheme or parts.netloc:
        return None
    there = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if not there.is_file():
        return f"no file behind the link {target}"
    if there in pages and unquote(parts.fragment) not in pages[there].anchors:
        return f"no heading behind the link {target}"
    return None


_PATH = re.compile(r"`((?:crates|scripts|docs|benches|python)/[\w./-]+)`")
_TESTS = re.compile(r"\b[Tt]ests?\s+(`[a-z0-9_]+`(?:(?:,|\s+and|,\s+and)\s+`[a-z0-9_]+`)*)")
_LINK = re.compile(r"\]\((?!\w+:|#)([^)\s#]+)")


def stale_names(repository: Path, pages: list[Path]) -> list[str]:
    """Files, tests and links that a page names and the repository lacks."""
    tests = set()
    for suffix, word in (("rs", "fn"), ("py", "def")):
        for folder in ("crates", "python", "scripts"):
            for source in (repository / folder).rglob(f"*.{suffix}"):
                tests |= set(re.findall(rf"\b{word} ([a-z0-9_]+)", source.read_text(encoding="utf-8")))
    found = []
    for page in pages:
        text = page.read_text(encoding="utf-8")
        named = [(path.start(), "file", path[1]) for path in _PATH.finditer(text)]
        named += [(list_.start(), "test", name) for list_ in _TESTS.finditer(text) for name in re.findall(r"`(\w+)`", list_[1])]
        for place, kind, name in sorted(named):
            if name not in tests if kind == "test" else not (repository / name).exists():
                found.append(f"{page.relative_to(repository)}:{text.count(chr(10), 0, place) + 1}: no {kind} {name}")
    return found


def broken_links(page: Path) -> list[str]:
    """Relative links of a Markdown file outside the book."""
    text = page.read_text(encoding="utf-8")
    return [
        f"{page.name}: no file behind the link {target}"
        for target in _LINK.findall(text)
        if not (page.parent / target).exists()
    ]
