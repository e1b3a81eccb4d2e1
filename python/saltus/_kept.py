"""Saved results: their citations, and the same question asked again."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from saltus import _native
from saltus._arguments import whole
from saltus._progress import Progress, watched

__all__ = ["Rerun", "cite", "rerun"]


@dataclass(frozen=True)
class Rerun:
    """Comparison of a saved result with the same question asked again.

    Examples
    --------
    >>> import saltus, tempfile
    >>> saved = saltus.frequencies(saltus.Study.paper()).save(tempfile.mkdtemp())
    >>> print(saltus.rerun(saved).summary.splitlines()[-1])
    Same bits: all 4 files.
    """

    identical: bool
    """Whether all files are the same to the bit."""
    summary: str
    """The differences in words, with their sizes and the reasons that are known."""
    report: dict[str, Any] = field(repr=False)
    """The JSON document that ``saltus rerun --json`` prints; ``saltus help rerun`` explains each key."""

    def __str__(self) -> str:
        """Return the summary."""
        return self.summary


def cite(result: str | os.PathLike[str]) -> str:
    """The works that a saved result rests on, as BibTeX, each below what it was used for.

    Parameters
    ----------
    result : path
        Folder that ``out`` or :meth:`Result.save` named, or a file in it.

    Returns
    -------
    str
        BibTeX.

    Raises
    ------
    ResultError
        If there is no result, or its study was altered.

    Examples
    --------
    >>> import saltus, tempfile
    >>> saved = saltus.frequencies(saltus.Study.paper()).save(tempfile.mkdtemp())
    >>> "@" in saltus.cite(saved)
    True
    """
    return _native.cite(Path(result))


def rerun(
    result: str | os.PathLike[str],
    *,
    out: str | os.PathLike[str] | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Rerun:
    """Compute a saved result again and compare, file by file.

    Parameters
    ----------
    result : path
        Folder that ``out`` or :meth:`Result.save` named, or a file in it.
    out : path, optional
        Folder to keep the new result in; without it only the comparison is left.
    threads, progress
        As in :func:`simulate`.

    Returns
    -------
    Rerun
        Whether all files are the same to the bit, and where they differ.

    Raises
    ------
    ResultError
        If there is no result, or a file of it is missing or was altered.

    Examples
    --------
    >>> import saltus, tempfile
    >>> saved = saltus.frequencies(saltus.Study.paper()).save(tempfile.mkdtemp())
    >>> saltus.rerun(saved).identical
    True
    """
    with watched(progress) as told:
        identical, summary, document = _native.rerun(
            Path(result),
            out=None if out is None else Path(out),
            threads=0 if threads is None else whole("threads", threads, 1, 1024),
            progress=told,
        )
    return Rerun(identical, summary, json.loads(document))
