"""What `saltus help` prints becomes a page with its options, variables and sections."""

import unittest

import commands

LIST = """People who jump

Usage: saltus <COMMAND>

Commands:
  sweep       Long-term motion while one parameter changes
  attractors  All motions, their basins and
              hysteresis
  help        Print this message

Options:
  -h, --help  Print help
"""

SWEEP = """Long-term motion while one parameter changes

Usage: saltus sweep [OPTIONS] <FILE>

Arguments:
  <FILE>  Study file (TOML); `-` is standard input

Options:
      --set <TABLE.KEY=VALUE>  Change a key, such as jumper.0.mass=80; may be
                               repeated
      --out <DIR>
          Folder for data

  -q, --quiet                  No progress

The study needs a [sweep] table; "up" runs from
sweep.from to sweep.to.

Data, in sweep.nc (--out):
  z                 Height over eta (-)
  mean_contact_ratio
                    Part of the time on the floor (-)
  kind              What it is: take-off, touch-down
Tables:
  rows: one per value, in rows.csv as
  well.

JSON (--json):
  files        one per file:
    name       within the folder
  version

Figures: bifurcation, as SVG and PNG.
"""


class Pages(unittest.TestCase):
    def test_commands_are_listed_with_their_line(self):
        expected = {
            "sweep": "Long-term motion while one parameter changes",
            "attractors": "All motions, their basins and hysteresis",
        }
        self.assertEqual(commands.commands(LIST), expected)

    def test_options_have_their_meanings_beside_or_below_them(self):
        found = commands.taken_apart(SWEEP)
        self.assertEqual(found.about, "Long-term motion while one parameter changes")
        self.assertEqual(found.usage, "saltus sweep [OPTIONS] <FILE>")
        self.assertEqual(found.arguments, [("<FILE>", "Study file (TOML); `-` is standard input")])
        expected = [
            ("--set <TABLE.KEY=VALUE>", "Change a key, such as jumper.0.mass=80; may be repeated"),
            ("--out <DIR>", "Folder for data"),
            ("-q, --quiet", "No progress"),
        ]
        self.assertEqual(found.options, expected)

    def test_variables_become_a_table_with_units(self):
        page = commands.page("sweep", SWEEP, pictures=True)
        self.assertIn("| `z` | Height over eta | - |", page)
        self.assertIn("| `mean_contact_ratio` | Part of the time on the floor | - |", page)
        self.assertIn("| `kind` | What it is: take-off, touch-down |  |", page)

    def test_names_within_names_are_marked(self):
        page = commands.page("sweep", SWEEP, pictures=False)
        self.assertIn("| `files` | one per file: |  |\n| ↳ `name` | within the folder |  |\n| `version` |  |  |", page)

    def test_sections_keys_and_options_are_set_apart(self):
        page = commands.page("sweep", SWEEP, pictures=True)
        self.assertIn('The study needs a `[sweep]` table; "up" runs from `sweep.from` to `sweep.to`.', page)
        self.assertIn("such as `jumper.0.mass=80`; may", page)
        self.assertIn("## Data\n\nIn `sweep.nc` (`--out`):", page)
        self.assertIn("## Tables\n\nrows: one per value, in `rows.csv` as well.", page)
        self.assertIn("## JSON\n\nWhat `--json` prints:", page)
        self.assertIn("## Figures\n\nBifurcation, as SVG and PNG.", page)
        self.assertIn("(../../gallery.md#sweep)", page)

    def test_an_unknown_command_has_a_page_all_the_same(self):
        self.assertNotIn("See also", commands.page("new", SWEEP, pictures=False))
        self.assertIn("[`new`](commands/new.md) | What it does", commands.overview({"new": "What it does"}))


if __name__ == "__main__":
    unittest.main()
