"""The interpreter that saltus runs in, and its end.

The native module belongs to a process, not to an interpreter: in a subinterpreter, as mod_wsgi and
``concurrent.interpreters`` make them, it would share all with the main one, and end its work too.
"""

from __future__ import annotations

import atexit
import importlib

__all__: list[str] = []


def _is_main() -> bool:
    # the second is its name before Python 3.13
    for name in ("_interpreters", "_xxsubinterpreters"):
        try:
            interpreters = importlib.import_module(name)
        except ImportError:
            continue
        return bool(interpreters.get_current() == interpreters.get_main())
    return True


if not _is_main():
    raise ImportError("saltus works in the main interpreter of a process, not in a subinterpreter")

from saltus import _native  # noqa: E402 (not in a subinterpreter)

atexit.register(_native.shut_down)
