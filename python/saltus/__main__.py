"""The program: ``saltus`` or ``python -m saltus``."""

import sys

from saltus import _native

__all__ = ["main"]


def main() -> int:
    """Run the program with the arguments of this process and return its exit code."""
    return _native.program(["saltus", *sys.argv[1:]])


if __name__ == "__main__":
    sys.exit(main())
