"""Chunks on a real scheduler with two worker processes, of which some are killed."""

from __future__ import annotations

import os
import signal
import threading
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import xarray as xr

from chunked import Waves, files, mirrored, waves
from clusters import workers
from pendula.chunks import Chunk, Work, computed, connect, opened, run

dask = pytest.importorskip("dask")
distributed = pytest.importorskip("distributed")


def test_no_worker_is_told(
    caplog: pytest.LogCaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pendula.many.chunks.cluster._UNATTENDED", 0.1)
    with (
        distributed.LocalCluster(n_workers=0, processes=False, dashboard_address=":0") as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        threading.Timer(0.5, cluster.scale, [1]).start()
        xr.testing.assert_identical(run(waves(), client=client), run(waves()))
        address = client.scheduler.address
    mine = [each.getMessage() for each in caplog.records if each.name == "pendula"]
    assert mine == [f"no worker is at {address}; waiting for one"]


@pytest.fixture(scope="module")
def local(tmp_path_factory: pytest.TempPathFactory) -> Path:
    store = tmp_path_factory.mktemp("local") / "waves.zarr"
    run(waves(), store)
    return store


def logged(log: Path) -> list[tuple[str, int]]:
    """The chunks that were begun, and by which process."""
    rows = (line.rpartition(" ") for line in log.read_text(encoding="utf-8").splitlines())
    return [(chunk, int(process)) for chunk, _, process in rows]


def test_a_cluster_gives_the_same_bytes(client: Any, local: Path, tmp_path: Path) -> None:
    log, told, store = tmp_path / "log", list[float](), tmp_path / "w.zarr"
    work = waves(log=log, seconds=0.02)
    dataset = run(work, store, client=client, progress=told.append)
    assert files(store) == files(local)
    assert len({process for _, process in logged(log)} - {os.getpid()}) == 2
    assert len(logged(log)) == 25
    assert told == sorted(told)
    assert (told[0], told[-1]) == (0.0, 1.0)
    xr.testing.assert_identical(run(waves(), client=client), dataset.load())


def test_a_killed_worker_costs_its_chunk(client: Any, local: Path, tmp_path: Path) -> None:
    log, store, killed = tmp_path / "log", tmp_path / "w.zarr", list[int]()

    def kill(share: float) -> None:
        if share > 0.2 and not killed:
            killed.append(logged(log)[-1][1])
            os.kill(killed[0], signal.SIGKILL)

    run(waves(log=log, seconds=0.1), store, client=client, progress=kill)
    assert killed
    assert files(store) == files(local)
    begun = [chunk for chunk, _ in logged(log)]
    assert len(set(begun)) == 25
    assert len(begun) <= 25 + 3  # what it ran, and what it had done that was not fetched yet


def test_an_interrupted_run_goes_on_with_or_without_a_cluster(
    client: Any, local: Path, tmp_path: Path
) -> None:
    def stop(share: float) -> None:
        if share > 0.3:
            raise KeyboardInterrupt

    log, store = tmp_path / "log", tmp_path / "w.zarr"
    with pytest.raises(KeyboardInterrupt):
        run(waves(log=log, seconds=0.02), store, client=client, progress=stop)
    assert "unfinished" in opened(store).attrs
    there = len(list(store.glob("wave/c.*")))
    assert 0 < there < 25
    begun = len(logged(log))
    assert begun < 25, "what is not begun yet is cancelled"
    run(waves(log=log), store)
    assert len(logged(log)) <= begun + 25 - there + 2
    assert files(store) == files(local)


def test_a_mirrored_work_is_shared_out_too(client: Any) -> None:
    from test_chunks import Even, even

    work = even(Even())
    xr.testing.assert_identical(run(mirrored(work), client=client), run(work))


@dataclass(frozen=True)
class Deadly(Waves):
    """Its second chunk ends the process, once Dask has seen that it is there."""

    def __call__(self, chunk: Chunk, threads: int | None, progress: Any) -> dict[str, Any]:
        if chunk.index == (0, 1):
            time.sleep(1.0)  # Dask does not start again what ends while it starts
            os._exit(1)
        return super().__call__(chunk, threads, progress)


@dataclass(frozen=True)
class Wrong(Waves):
    """Its last chunk fails."""

    def __call__(self, chunk: Chunk, threads: int | None, progress: Any) -> dict[str, Any]:
        if chunk.index == (4, 4):
            raise ValueError("theta1 must be a number, got 'x'")
        return super().__call__(chunk, threads, progress)


def with_compute(compute: Any) -> Work:
    from dataclasses import replace

    return replace(waves(), compute=compute)


def test_an_error_of_a_chunk_comes_back_as_it_is(client: Any, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="^theta1 must be a number, got 'x'$"):
        run(with_compute(Wrong()), tmp_path / "w.zarr", client=client)
    assert "unfinished" in opened(tmp_path / "w.zarr").attrs


def test_a_worker_of_another_version_is_refused(
    client: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pendula.many.chunks.cluster.__version__", "0.0.9")
    with pytest.raises(RuntimeError, match=r"the worker has pendula .*, the caller 0\.0\.9"):
        run(waves(), client=client)


def test_few_chunks_are_under_way(client: Any, tmp_path: Path) -> None:
    """However slow the caller is: two for each worker, so that memory stays what it is."""
    log = tmp_path / "log"
    made = computed(waves(log=log), client=client)
    for done, _ in enumerate(made):
        if done == 5:
            time.sleep(0.3)
            assert len(logged(log)) <= done + 4
            break
    made.close()


def test_a_chunk_that_ends_its_workers_is_told(tmp_path: Path) -> None:
    store = tmp_path / "w.zarr"
    told = r"^2 workers ended with chunk \([0-4], [0-4]\) or one beside it; .*is kept$"
    # a new worker takes seconds
    fewer = dask.config.set({"distributed.scheduler.allowed-failures": 1})
    with fewer, workers() as client, pytest.raises(RuntimeError, match=told):
        run(with_compute(Deadly()), store, client=client)
    run(waves(), store)
    assert "unfinished" not in opened(store).attrs


def test_a_scheduler_that_goes_away_is_told(local: Path, tmp_path: Path) -> None:
    def leave(share: float) -> None:
        if share > 0.3:
            cluster.close()

    store = tmp_path / "w.zarr"
    with (
        distributed.LocalCluster(n_workers=1, processes=False, dashboard_address=":0") as cluster,
        distributed.Client(cluster, set_as_default=False) as gone,
        pytest.raises(
            RuntimeError,
            match=r"^the cluster dropped the work \(.*run the same call again; [^\n]*kept$",
        ),
    ):
        run(waves(), store, client=gone, progress=leave)
    assert 0 < len(list(store.glob("wave/c.*"))) < 25
    run(waves(), store)
    assert files(store) == files(local)


def test_an_address_is_no_client(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"client must be a Client .*, got 'tcp://host:1'"):
        run(waves(), tmp_path / "w.zarr", client="tcp://host:1")
    assert not list(tmp_path.iterdir())


def test_a_scheduler_is_reached_by_its_address(client: Any, local: Path, tmp_path: Path) -> None:
    with connect(client.scheduler.address) as other:
        run(waves(), tmp_path / "w.zarr", client=other)
    assert files(tmp_path / "w.zarr") == files(local)


@pytest.mark.parametrize("address", ["nonsense://x", "tcp://", "foo", "", "http://127.0.0.1:80"])
def test_what_is_no_address_is_refused_at_once(address: str) -> None:
    with pytest.raises(
        ValueError, match="^scheduler must be an address such as tcp://localhost:8786"
    ):
        connect(address)


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:1", "tcp://[::1]:1"])
def test_no_scheduler_is_told_in_one_line(address: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pendula.many.chunks.cluster._PATIENCE", "0.3s")
    with pytest.raises(ConnectionError, match="^no Dask scheduler answers at 'tcp://") as told:
        connect(address)
    assert "\n" not in str(told.value)
