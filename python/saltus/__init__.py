"""People who jump on a vibrating plate, and other nonsmooth dynamics."""

from saltus._errors import (
    ComputationError,
    DefinitionError,
    InternalError,
    ResultError,
    SaltusError,
    StudyError,
)
from saltus._native import __version__

__all__ = [
    "ComputationError",
    "DefinitionError",
    "InternalError",
    "ResultError",
    "SaltusError",
    "StudyError",
    "__version__",
]
