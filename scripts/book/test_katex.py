"""Of the package of KaTeX pages get style, fonts and licence, and of another package nothing."""

import hashlib
import io
import tarfile
import tempfile
import unittest
from pathlib import Path

import katex


class Unpacking(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.archive, self.place = Path(scratch.name) / "katex.tgz", Path(scratch.name) / "katex"
        names = ["LICENSE", "dist/katex.min.css", "dist/fonts/A-B.woff2", "dist/katex.js", "../up", "src/fonts/make"]
        with tarfile.open(self.archive, "w:gz") as package:
            for name in names:
                member = tarfile.TarInfo(f"package/{name}")
                member.size = 1
                package.addfile(member, io.BytesIO(b"x"))
        self.sha256 = hashlib.sha256(self.archive.read_bytes()).hexdigest()

    def test_style_fonts_and_licence_are_taken(self):
        katex.unpack(self.archive, self.sha256, self.place)
        found = sorted(path.relative_to(self.place).as_posix() for path in self.place.rglob("*") if path.is_file())
        self.assertEqual(found, ["LICENSE", "fonts/A-B.woff2", "katex.min.css"])

    def test_another_package_is_refused(self):
        with self.assertRaisesRegex(katex.Unavailable, "SHA-256"):
            katex.unpack(self.archive, "0" * 64, self.place)
        self.assertFalse(self.place.exists())


if __name__ == "__main__":
    unittest.main()
