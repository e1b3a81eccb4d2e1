"""Citations become links to their works, and nothing else does."""

import unittest

import citations

LITERATURE = "# Literature\n\n- **DP**: A.\n- **Müller 1995**: B.\n- **BBCK 2008**: C.\n"


class Citations(unittest.TestCase):
    def linked(self, text):
        return citations.linked(text, citations.works(LITERATURE), "references.md")

    def test_works_have_anchors_of_plain_letters(self):
        self.assertEqual(citations.works(LITERATURE), ["DP", "Müller 1995", "BBCK 2008"])
        self.assertIn('- <a id="muller-1995"></a>**Müller 1995**: B.', citations.anchored(LITERATURE))

    def test_one_and_several_are_linked(self):
        expected = (
            "as \\[[DP](references.md#dp)\\] and"
            " \\[[Müller 1995](references.md#muller-1995); [BBCK 2008](references.md#bbck-2008)\\]"
        )
        self.assertEqual(self.linked("as [DP] and [Müller 1995; BBCK 2008]"), (expected, []))
        self.assertEqual(self.linked("in [DP]: so"), ("in \\[[DP](references.md#dp)\\]: so", []))

    def test_links_code_equations_and_footnotes_stay(self):
        text = "[DP](a.md) `[DP]` $[DP]$ [^DP] [sweep]\n```sh\n[DP]\n```\n$$\n[DP]\n$$\n[DP]: x"
        self.assertEqual(self.linked(text), (text, []))

    def test_a_citation_without_its_work_is_named(self):
        self.assertEqual(self.linked("[Nobody 1999] [DP; Nobody & Co. 2001]")[1], ["Nobody 1999", "Nobody & Co. 2001"])


if __name__ == "__main__":
    unittest.main()
