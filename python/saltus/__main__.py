"""The program: ``saltus`` or ``python -m saltus``."""

import sys
from collections.abc import Sequence

from saltus import _native

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program with these arguments, or those of this process, and return its exit code.

    For the rest of this process it takes Ctrl-C over.
    """
    return _native.program(["saltus", *(sys.argv[1:] if arguments is None else arguments)])


if __name__ == "__main__":
    sys.exit(main())
