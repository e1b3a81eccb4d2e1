"""The runner of tutorials: blocks that it runs, comparisons, and messages when a page is wrong."""

import sys
import tempfile
import unittest
from pathlib import Path

import tutorials


class Tutorials(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.page = Path(scratch.name) / "page.md"
        self.folder = Path(scratch.name) / "run"

    def run_page(self, text):
        self.page.write_text(text, encoding="utf-8")
        return tutorials.run(self.page, self.folder, sys.executable, "/nowhere")

    def test_blocks_of_a_page_share_names_and_a_folder(self):
        fault = self.run_page(
            "```toml,file=a.toml\nx = 1\n```\n"
            "```python\nhere = open('a.toml').read()\n```\n"
            "```python\nprint(here, end='')\n```\n"
            "```text,output\nx = 1\n```\n"
            "```console\n$ cat \\\n  a.toml\nx = 1\n```\n"
        )
        self.assertIsNone(fault)

    def test_other_output_is_a_fault_with_file_and_line(self):
        fault = self.run_page("one\n\n```console\n$ true\n$ echo two\nthree\n```\n")
        self.assertRegex(fault, r"(?s)^page.md:5: the page shows\nthree\nbut this is printed:\ntwo")
        fault = self.run_page("```python\nprint(1)\n```\n\n```text,output\n2\n```\n")
        self.assertTrue(fault.startswith("page.md:5:"), fault)

    def test_blank_lines_at_the_end_make_no_difference(self):
        self.assertIsNone(self.run_page("```python\nprint('a \\n\\n')\n```\n```text,output\na\n```\n"))

    def test_dots_stand_for_anything(self):
        shown = "```console\n$ printf 'a 1.234 b\\nc\\nd\\n'\na 1.2... b\n...\nd\n```\n"
        self.assertIsNone(self.run_page(shown))

    def test_an_exception_names_the_line_of_the_page(self):
        fault = self.run_page("text\n\n```python\nx = 1\nx.nothing\n```\n")
        self.assertTrue(fault.startswith("page.md:3:"), fault)
        self.assertRegex(fault, r'page.md", line 5')
        self.assertIn("x.nothing", fault)

    def test_a_command_that_fails_is_a_fault_unless_the_page_says_so(self):
        self.assertIn("status 3", self.run_page("```console\n$ exit 3\n```\n"))
        self.assertIsNone(self.run_page("```console,fails\n$ exit 3\n```\n"))
        self.assertIn("status 0", self.run_page("```console,fails\n$ true\n```\n"))

    def test_a_block_that_must_raise_shows_its_exception(self):
        self.assertIsNone(self.run_page("```python,fails\n1 / 0\n```\n```text,output\nZeroDivisionError: ...\n```\n"))
        self.assertIn("did not", self.run_page("```python,fails\n1\n```\n"))

    def test_what_is_only_shown_does_not_run(self):
        self.assertIsNone(self.run_page("```python,no-run\n1 / 0\n```\n```sh\nexit 1\n```\n```rust\nx\n```\n"))
        self.assertFalse(tutorials.has_code(self.page))

    def test_a_block_without_an_end_is_a_fault(self):
        self.assertIn("no end", self.run_page("```python\n1\n"))

    def test_pictures_of_the_code_come_beside_the_page(self):
        text = "![a](a.png)\n```console\n$ echo x > a.png\n```\n"
        self.assertIsNone(self.run_page(text))
        self.assertEqual(tutorials.collect(self.page, self.folder), [])
        self.assertTrue((self.page.parent / "a.png").is_file())
        self.assertIn("already", tutorials.collect(self.page, self.folder)[0])
        self.run_page("![b](b.png)\n")
        self.assertIn("did not write", tutorials.collect(self.page, self.folder)[0])


if __name__ == "__main__":
    unittest.main()
