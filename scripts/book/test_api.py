"""Docstrings become pages: sections, examples, links; a public name without one is refused."""

import dataclasses
import sys
import tempfile
import types
import unittest
from pathlib import Path

import api


class Walker:
    """Goes about; see :func:`walk` and `Walker.steps`.

    Attributes
    ----------
    pace : float
        Steps per second, as in `own`.
    """

    def __init__(self):
        self.gone = 0
        """How far."""

    @property
    def steps(self):
        """How many."""
        return 0

    def go(self, far=1):
        """Go `far`."""


@dataclasses.dataclass
class Record:
    """A record."""

    value: int
    """What it is worth."""


@dataclasses.dataclass
class Silent:
    value: int


def walk(far, *, fast=False):
    """Walk as far as asked; a*b and x_i stay.

    ===== ==========
    how   what `far` is
    ===== ==========
    slow  a mile
    fast  two, or
          three
    ===== ==========

    It may take long::

        so long

    Parameters
    ----------
    far : float
        How far, :class:`Walker` included.
    fast : bool, optional

    Returns
    -------
    Walker
        Who walked.

    Examples
    --------
    >>> walk(1)
    1

    >>> walk(2)
    2
    """


def module(**names):
    found = types.ModuleType("saltus")
    found.__all__ = list(names)
    for name, value in names.items():
        setattr(found, name, value)
    sys.modules["saltus"] = found
    return found


class Pages(unittest.TestCase):
    def setUp(self):
        before = sys.modules.get("saltus")
        self.addCleanup(lambda: sys.modules.update(saltus=before) if before else sys.modules.pop("saltus"))
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = Path(scratch.name) / "python"

    def page(self, **names):
        self.assertEqual(api.write([module(**names)], self.folder), ["results"])
        return (self.folder / "results.md").read_text(encoding="utf-8")

    def test_sections_become_lists_with_types(self):
        page = self.page(walk=walk, Walker=Walker)
        self.assertIn("saltus.walk(far, *, fast=False)", page)
        self.assertIn("**Parameters**\n\n- **`far`** : float  \n  How far, [`Walker`](#Walker) included.\n- **`fast`** : bool, optional", page)
        self.assertIn("**Returns**\n\n- [**`Walker`**](#Walker)  \n  Who walked.", page)

    def test_examples_are_one_block_and_literal_blocks_stay(self):
        page = self.page(walk=walk, Walker=Walker)
        self.assertIn("```python,no-run\n>>> walk(1)\n1\n\n>>> walk(2)\n2\n```", page)
        self.assertIn("It may take long:\n\n```text\nso long\n```", page)

    def test_tables_are_tables(self):
        page = self.page(walk=walk, Walker=Walker)
        self.assertIn("| how | what `far` is |\n|---|---|\n| slow | a mile |\n| fast | two, or three |", page)

    def test_a_name_that_all_leaves_out_is_public_too(self):
        walk.__module__ = "saltus._walking"
        self.addCleanup(setattr, walk, "__module__", __name__)
        found = module(Walker=Walker)
        found.walk, found._hidden, found.Path = walk, walk, Path
        self.assertEqual(api.public(found), ["Walker", "walk"])

    def test_names_are_links_and_signs_of_markdown_are_not(self):
        page = self.page(walk=walk, Walker=Walker)
        self.assertIn("Goes about; see [`walk`](#walk) and `Walker.steps`.", page)
        self.assertIn("a\\*b and x\\_i stay", page)

    def test_members_and_fields_are_told(self):
        page = self.page(walk=walk, Walker=Walker, Record=Record)
        self.assertIn("#### Walker.steps {#Walker.steps}\n\n*Property.*\n\nHow many.", page)
        self.assertIn("Walker.go(far=1)", page)
        self.assertIn("- **`gone`**  \n  How far.", page)
        self.assertIn("saltus.Record(value)", page)
        self.assertIn("- **`value`** : `int`  \n  What it is worth.", page)

    def test_the_overview_has_the_first_sentence_of_each(self):
        self.page(walk=walk, Walker=Walker, Record=Record)
        overview = self.folder.with_suffix(".md").read_text(encoding="utf-8")
        self.assertIn("| [`Record`](python/results.md#Record) | A record. |", overview)
        self.assertIn("see [`walk`](python/results.md#walk)", overview)

    def test_a_public_name_without_a_docstring_is_refused(self):
        with self.assertRaisesRegex(api.Undocumented, "saltus.Silent"):
            api.write([module(Silent=Silent)], self.folder)

        class Half:
            """Has one."""

            def none(self):
                pass

        with self.assertRaisesRegex(api.Undocumented, "saltus.Half.none"):
            api.write([module(Half=Half)], self.folder)


if __name__ == "__main__":
    unittest.main()
