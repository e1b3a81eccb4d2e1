"""Work on several processes by Dask, one of which is killed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

import saltus
import saltus.dask
from saltus import ComputationError, ResultError, Study, _native

distributed = pytest.importorskip("distributed")

if TYPE_CHECKING:
    from collections.abc import Iterator

pytestmark = [
    # of distributed itself and what it stands on
    pytest.mark.filterwarnings("default::DeprecationWarning"),
    pytest.mark.filterwarnings("default::ResourceWarning"),
    pytest.mark.filterwarnings("default::UserWarning"),
    pytest.mark.filterwarnings("default::pytest.PytestUnraisableExceptionWarning"),
]


#: A cluster in one process, until it is killed or its input ends.
SCHEDULER = """
import sys
from distributed import LocalCluster
with LocalCluster(
    n_workers=1, threads_per_worker=1, processes=False, protocol="tcp://", dashboard_address=None
) as cluster:
    print(cluster.scheduler.address, flush=True)
    sys.stdin.read()
"""


@pytest.fixture(scope="module")
def client() -> Iterator[Any]:
    cluster = distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    )
    with cluster, distributed.Client(cluster) as client:
        yield client


@pytest.fixture(scope="module")
def study() -> Study:
    return Study.paper().set(
        {
            "plate.inertia": "condensed",
            "map.x.count": 32,
            "map.y.count": 24,
            "map.exponent": 0,
            "basins.x.count": 8,
            "basins.y.count": 8,
            "sweep.direction": "restarts",
            "sweep.count": 9,
            "sweep.transient": 50,
            "sweep.record": 8,
        }
    )


def test_a_killed_worker_changes_no_bit(client: Any, study: Study, tmp_path: Path) -> None:
    workers = client.run(os.getpid)
    killed: list[int] = []

    def kill_one(what: str, done: int, total: int | None) -> None:
        if what == "pieces" and not killed:
            killed.append(next(iter(workers.values())))
            os.kill(killed[0], signal.SIGKILL)

    result = saltus.dask.map(study, client=client, tasks=48, out=tmp_path / "dask", progress=kill_one)
    assert killed, "nobody was killed: there was no progress to see"
    client.wait_for_workers(2)
    assert killed[0] not in client.run(os.getpid).values()
    here = saltus.map(study)
    assert result["period"].tobytes() == here["period"].tobytes()
    assert result.to_xarray().identical(here.to_xarray())
    names = sorted(path.name for path in (tmp_path / "dask").iterdir())
    saved = here.save(tmp_path / "here")
    assert [
        name for name in names if (saved / name).read_bytes() != (tmp_path / "dask" / name).read_bytes()
    ] == []


def test_basins_and_sweeps_too(client: Any, study: Study) -> None:
    there, here = saltus.dask.basins(study, client=client), saltus.basins(study)
    assert there.to_xarray().identical(here.to_xarray())
    there, here = saltus.dask.sweep(study, client=client), saltus.sweep(study)
    assert there.to_xarray().identical(here.to_xarray())


def test_states_that_are_carried_on_are_no_work_for_many(client: Any, study: Study) -> None:
    with pytest.raises(saltus.StudyError, match=r"sweep\.direction"):
        saltus.dask.sweep(study.set({"sweep.direction": "up"}), client=client)


def test_a_cluster_that_is_lost_is_told(study: Study) -> None:
    larger = study.set({"map.x.count": 200, "map.y.count": 200})
    run = [sys.executable, "-c", SCHEDULER]
    with subprocess.Popen(run, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as cluster:
        assert cluster.stdout is not None
        address = cluster.stdout.readline().strip()
        with distributed.Client(address, timeout=30) as client:
            told = r"the cluster lost the work .*it can be asked again"
            with pytest.raises(ComputationError, match=told):
                saltus.dask.map(larger, client=client, tasks=400, progress=lambda *_: cluster.kill())
    with pytest.raises(ComputationError, match="its client is closed"):
        saltus.dask.map(study, client=client)


def test_a_broken_piece_is_refused_by_its_number(study: Study) -> None:
    request, about = '{"command": "basins"}', study._resolved[0]
    pieces = _native.compute(request, about, range(_native.pieces(request, about)))
    number, content = pieces[1]
    for broken in (content[:-3], content[:40] + bytes([content[40] ^ 1]) + content[41:], b""):
        with pytest.raises(ResultError, match=f"piece {number}"):
            _native.ask(request, about, pieces=[pieces[0], (number, broken), *pieces[2:]])
    with pytest.raises(ResultError, match=f"piece {number}"):
        _native.ask(request, about, pieces=[pieces[0], *pieces[2:]])
    other = study.set({"basins.transient": 77})
    with pytest.raises(ResultError, match="other work"):
        _native.ask(request, other._resolved[0], pieces=pieces)
