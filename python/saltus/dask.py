"""Maps, basins and sweeps on many machines, by the workers of Dask.

The work is cut into pieces, the same as those of ``saltus map --shard i/n``. Workers make them in
any order; a piece that was lost with its worker is made again. The result has the same bits as on
one machine: each piece carries its checksum and that of its work, and a piece of other work, or a
damaged one, is refused with its number.

Needs ``distributed``, and saltus of the same version on every worker.
"""

from __future__ import annotations

import json
import os
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from saltus import _native
from saltus._arguments import whole
from saltus._errors import ComputationError, SaltusError
from saltus._progress import Progress, watched
from saltus._results import Result
from saltus.study import StudyLike, as_study

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from distributed import Client, Future

# `map` is left out: it would take the place of Python's own where all names are imported
__all__ = ["basins", "sweep"]

#: Tasks per thread of the cluster, about: enough to even out costs, few enough for the scheduler.
TASKS_PER_THREAD = 8


def map(  # noqa: A001 (the word of the program)
    study: StudyLike,
    *,
    client: Client,
    tasks: int | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: Progress = None,
) -> Result:
    """Long-term motion at each point of the plane of two parameters in ``study.map``.

    Parameters
    ----------
    study : Study or path
    client : distributed.Client
        Client of the cluster. Each task takes one thread; give workers one thread per core.
    tasks : int, optional
        Number of tasks that the work is put into; some 8 per thread of the cluster by default, and never
        more than it has pieces.
    out : path, optional
        Folder to write on this machine, as :func:`saltus.map` does.
    progress : bool or callable, optional
        As for :func:`saltus.map`; it counts pieces.

    Returns
    -------
    Result
        The same bits as :func:`saltus.map` gives.

    Raises
    ------
    ComputationError
        If the cluster loses the work, as with its scheduler. It can be asked again.

    Examples
    --------
    >>> from distributed import Client  # doctest: +SKIP
    >>> result = saltus.dask.map(study, client=Client("scheduler:8786"))  # doctest: +SKIP
    """
    return _run({"command": "map"}, study, client, tasks, out, progress)


def basins(
    study: StudyLike,
    *,
    client: Client,
    match: bool = False,
    tasks: int | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: Progress = None,
) -> Result:
    """Basins of attraction: the long-term motion that each initial condition leads to.

    Parameters
    ----------
    study : Study or path
        With a table ``basins``.
    match : bool
        As for :func:`saltus.basins`.
    client, tasks, out, progress
        As for :func:`map`.

    Returns
    -------
    Result
        The same bits as :func:`saltus.basins` gives.

    Examples
    --------
    >>> result = saltus.dask.basins(study, client=client)  # doctest: +SKIP
    """
    request = {"command": "basins", "match": bool(match)}
    return _run(request, study, client, tasks, out, progress)


def sweep(
    study: StudyLike,
    *,
    client: Client,
    tasks: int | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: Progress = None,
) -> Result:
    """Long-term motion along a parameter, each value anew from several starts.

    Parameters
    ----------
    study : Study or path
        With a table ``sweep`` whose ``direction`` is "restarts": a state that is carried on is no work
        for many.
    client, tasks, out, progress
        As for :func:`map`.

    Returns
    -------
    Result
        The same bits as :func:`saltus.sweep` gives.

    Examples
    --------
    >>> result = saltus.dask.sweep(study, client=client)  # doctest: +SKIP
    """
    return _run({"command": "sweep"}, study, client, tasks, out, progress)


def _run(
    request: dict[str, Any],
    study: StudyLike,
    client: Client,
    tasks: int | None,
    out: str | os.PathLike[str] | None,
    progress: Progress,
) -> Result:
    asked, about = json.dumps(request), as_study(study)._resolved[0]
    pieces = _native.pieces(asked, about)
    futures: list[Future[Any]] = []
    made: list[tuple[int, bytes]] = []
    try:
        with _cluster():
            if client.status == "closed":
                raise OSError("its client is closed")
            shares = _shares(pieces, _tasks(client, tasks))
            # results of pure tasks may be taken from an earlier run: a broken piece must not
            made_there = (client.submit(_compute, asked, about, share, pure=False) for share in shares)
            futures.extend(made_there)
        with watched(progress) as told:
            for parts in _completed(futures):
                made += parts
                if told is not None:
                    told("pieces", len(made), pieces)
            answer = _native.ask(
                asked, about, out=None if out is None else Path(out), pieces=made, progress=told
            )
    finally:
        # a cluster that is gone has nothing to cancel
        with suppress(Exception):
            client.cancel(futures)
    return Result(answer)


def _completed(futures: Sequence[Future[Any]]) -> Iterator[list[tuple[int, bytes]]]:
    """The pieces of each task, as they are made."""
    from distributed import as_completed

    with _cluster():
        for _, parts in as_completed(futures, with_results=True):
            # of a task that was cancelled, the reason
            if isinstance(parts, BaseException):
                raise parts
            yield parts


@contextmanager
def _cluster() -> Iterator[None]:
    """Raise ComputationError if the cluster is lost; an error of saltus is raised as it is."""
    from distributed import CancelledError
    from distributed.scheduler import KilledWorker

    try:
        yield
    except SaltusError:
        raise
    except (CancelledError, KilledWorker, OSError, TimeoutError) as reason:
        why = " ".join(str(reason).split())
        raise ComputationError(
            f"the cluster lost the work ({why}): nothing is wrong with the study, and it can be asked "
            "again with the client of a cluster that runs"
        ) from reason


def _tasks(client: Client, tasks: int | None) -> int:
    if tasks is not None:
        return whole("tasks", tasks, 1)
    threads: int = sum(client.nthreads().values())
    return TASKS_PER_THREAD * max(1, threads)


def _shares(pieces: int, tasks: int) -> list[list[int]]:
    """Shares of every n-th piece, n being their number: neighbours cost alike, so costs even out."""
    tasks = min(tasks, pieces)
    return [list(range(first, pieces, tasks)) for first in range(tasks)]


def _compute(request: str, study: str, pieces: Sequence[int]) -> list[tuple[int, bytes]]:
    """Run on a worker, which has one thread for it."""
    return _native.compute(request, study, pieces, threads=1)
