"""A notebook becomes a page with its text, code, outputs and pictures."""

import base64
import json
import tempfile
import unittest
from pathlib import Path

import notebooks


class Pages(unittest.TestCase):
    def test_text_code_outputs_and_pictures_come_in_their_order(self):
        picture = {"data": {"image/png": base64.b64encode(b"picture").decode(), "text/plain": "<Figure>"}}
        table = {"data": {"text/html": "<style>\n</style>\n<table border=\"1\" class=\"a\">\n\n<tr></tr>\n</table>"}}
        cells = [
            {"cell_type": "markdown", "source": ["# Title\n", "[next](other.ipynb)"]},
            {"cell_type": "code", "source": "a", "outputs": [{"name": "stdout", "text": ["1\n", "2\n"]}, picture]},
            {"cell_type": "code", "source": "b", "outputs": [table, {"data": {"text/plain": ["3"]}}]},
        ]
        with tempfile.TemporaryDirectory() as scratch:
            path, page = Path(scratch) / "n.ipynb", Path(scratch) / "n.md"
            path.write_text(json.dumps({"cells": cells}), encoding="utf-8")
            notebooks.page(path, page)
            self.assertEqual((page.parent / "n-1.png").read_bytes(), b"picture")
            text = page.read_text(encoding="utf-8")
        parts = [
            "# Title\n[next](other.md)",
            "```python,no-run\na\n```",
            "```text\n1\n2\n```",
            "![Output of the code above](n-1.png)",
            "```python,no-run\nb\n```",
            '<table class="a">\n<tr></tr>\n</table>',
            "```text\n3\n```",
        ]
        self.assertEqual(text, "\n\n".join(parts) + "\n")


if __name__ == "__main__":
    unittest.main()
