"""The checks of links and names find what is broken, and nothing else."""

import tempfile
import unittest
from pathlib import Path

import links


class Links(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.root = Path(scratch.name)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def test_a_site_that_holds_together_has_no_problems(self):
        self.write("a.html", '<h1 id="top">A</h1><a href="b/b.html#x">b</a><a href="#top">t</a><img src="p.png">')
        self.write("b/b.html", '<p id="x"></p><a href="../a.html">a</a><a href="https://example.org">out</a>')
        self.write("s.css", "p { background: url('p.png'); } q { background: url(data:abc) }")
        self.write("p.png", "")
        self.assertEqual(links.problems(self.root), [])

    def test_each_broken_link_is_named_with_its_line(self):
        self.write("a.html", '\n<a href="b.html">b</a>\n<a href="#no">n</a><img src="no.png">')
        found = [
            "a.html:2: no file behind the link b.html",
            "a.html:3: no heading behind the link #no",
            "a.html:3: no file behind the link no.png",
        ]
        self.assertEqual(links.problems(self.root), found)

    def test_whatever_is_fetched_from_a_network_is_a_problem(self):
        self.write("a.html", '<script src="https://example.org/x.js"></script><link href="//example.org/x.css">')
        self.write("a.css", '@import "https://example.org/y.css"; p { background: url(https://example.org/z.png) }')
        self.assertEqual(len([each for each in links.problems(self.root) if "network" in each]), 4)

    def test_files_and_tests_that_are_gone_are_named(self):
        self.write("crates/a.rs", "fn it_holds() {}")
        page = self.write("docs/a.md", "`crates/a.rs` test `it_holds`\n`crates/b.rs` and test `it_does_not`\n")
        self.assertEqual(
            links.stale_names(self.root, [page]),
            ["docs/a.md:2: no file crates/b.rs", "docs/a.md:2: no test it_does_not"],
        )

    def test_each_of_several_tests_is_looked_for_across_lines_too(self):
        self.write("crates/a.rs", "fn it_holds() {}")
        page = self.write("docs/a.md", "[^a]: Tests `it_holds`, `gone` and\n    `gone_too`.\n")
        found = ["docs/a.md:1: no test gone", "docs/a.md:1: no test gone_too"]
        self.assertEqual(links.stale_names(self.root, [page]), found)

    def test_relative_links_of_a_page_outside_the_book_are_checked(self):
        page = self.write("README.md", "[a](a.md) [b](docs/b.md#x) [c](https://example.org) [d](#here)")
        self.write("a.md", "")
        self.assertEqual(links.broken_links(page), ["README.md: no file behind the link docs/b.md"])


if __name__ == "__main__":
    unittest.main()
