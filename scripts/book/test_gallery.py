"""The gallery shows each figure with the command that made it, and says what it lacks."""

import unittest
from pathlib import Path

import gallery


class Gallery(unittest.TestCase):
    def setUp(self):
        self.case = gallery.Case("map", "--set 'map.x.values=[1]'", {"map": "A map & more."})
        self.case.files = [Path("run/map-0/map.svg")]

    def test_a_figure_has_its_words_and_its_command(self):
        page = gallery.page([self.case], "gallery")
        self.assertIn('<a href="gallery/map-0-map.svg"><img src="gallery/map-0-map.png" alt="A map &amp; more."', page)
        self.assertIn("saltus map study.toml --set plate.inertia=condensed --set 'map.x.values=[1]' --out map", page)
        self.assertIn("(reference/commands/map.md)", page)

    def test_a_long_command_goes_on_in_the_next_line(self):
        case = gallery.Case("map", " ".join(f"--set map.x.count={n}" for n in range(5)), {})
        lines = gallery.shown(case).splitlines()
        self.assertEqual(lines[0], "saltus map study.toml \\")
        self.assertEqual(lines[2], "    --set map.x.count=0 \\")
        self.assertEqual(lines[-1], "    --out map")

    def test_what_is_missing_is_named(self):
        self.assertEqual(gallery.faults([self.case], ["map"]), [])
        self.case.shows = {"layers": "Layers."}
        expected = [
            "gallery: map makes map, of which nothing is said",
            "gallery: map does not make layers",
            "gallery: nothing of the command orbit",
        ]
        self.assertEqual(gallery.faults([self.case], ["map", "orbit"]), expected)


if __name__ == "__main__":
    unittest.main()
