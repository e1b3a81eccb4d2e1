"""The table of notation names keys of the study file and quantities of results that exist."""

import re
import unittest
from pathlib import Path

import notation

ROOT = Path(__file__).resolve().parent.parent.parent
PAGE = """| symbol | key | in results |
|---|---|---|
| $a$ | `plate.length` | |
| $z$ | `start.z` | `z`, `v` |

| other | table |
|---|---|
| `nothing` | `at.all` |
"""


class Notation(unittest.TestCase):
    def test_keys_are_those_of_the_schema_lists_and_choices_included(self):
        schema = {
            "properties": {
                "plate": {"properties": {"modes": {"anyOf": [{"properties": {"u": {}}}]}}},
                "jumper": {"items": {"properties": {"mass": {}}}},
            }
        }
        self.assertEqual(notation.keys(schema), {"plate", "plate.modes", "plate.modes.u", "jumper", "jumper.mass"})

    def test_names_are_those_of_the_table_of_quantities(self):
        self.assertEqual(notation.names('    Z: "z" "1" "Height";\n    ALSO_Z: "also_z" = Z;\n'), {"z", "also_z"})

    def test_what_does_not_exist_is_named(self):
        self.assertEqual(notation.faults(PAGE, {"plate.length", "start.z"}, {"z", "v"}), [])
        expected = ["notation.md: no key start.z", "notation.md: no name in results v"]
        self.assertEqual(notation.faults(PAGE, {"plate.length"}, {"z"}), expected)

    def test_the_names_of_the_page_are_quantities(self):
        names = notation.names((ROOT / "crates/saltus-commands/src/quantities.rs").read_text(encoding="utf-8"))
        page = (ROOT / "docs/notation.md").read_text(encoding="utf-8")
        cells = " ".join(notation.column(page, "in results"))
        self.assertGreater(len(re.findall("`", cells)), 40)
        self.assertEqual([fault for fault in notation.faults(page, set(), names) if "name in results" in fault], [])


if __name__ == "__main__":
    unittest.main()
