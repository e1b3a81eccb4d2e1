"""The program: ``saltus`` or ``python -m saltus``."""

import signal
import sys
import threading
from collections.abc import Sequence

from saltus import _native

__all__ = ["main"]


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the program with these arguments, or those of this process, and return its exit code.

    For the rest of this process it takes Ctrl-C over.
    """
    main_thread = threading.current_thread() is threading.main_thread()
    if main_thread and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        # or Python would raise KeyboardInterrupt when the program has ended by itself
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    return _native.program(["saltus", *(sys.argv[1:] if arguments is None else arguments)])


if __name__ == "__main__":
    sys.exit(main())
