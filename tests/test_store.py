"""A store: what is in it, how it is gone on with, how it is read."""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr
import zarr

from chunked import PAIR, Waves, chunks_in, files, waves
from pendula._checks import how_to_install
from pendula.chunks import opened, run


def test_a_result_is_the_same_in_memory_and_in_a_store(undisturbed: Path) -> None:
    in_memory, whole = run(waves()), Waves()(waves((30, 24)).chunk((0, 0)), None, None)
    for name, values in whole.items():
        assert in_memory[name].values.tobytes() == values.tobytes()
    xr.testing.assert_identical(in_memory, opened(undisturbed))
    assert in_memory["wave"].dims == PAIR
    assert in_memory["wave"].attrs["units"] == "m"
    assert in_memory["x"].attrs["units"] == "rad"
    assert json.loads(in_memory.attrs["pendula"])["chunks"] == {"x": 7, "y": 5}


def test_anyone_opens_a_store(undisturbed: Path) -> None:
    """With xarray, as it comes, and with zarr alone."""
    xr.testing.assert_identical(xr.open_zarr(undisturbed, chunks=None), run(waves()))
    plain: Any = zarr.open_group(undisturbed, mode="r")
    assert plain["wave"].metadata.dimension_names == PAIR
    assert plain["positive"][:].tolist() == run(waves())["positive"].values.tolist()
    codecs = [type(codec).__name__ for codec in plain["wave"].metadata.codecs]
    assert codecs == ["BytesCodec", "Crc32cCodec"]


def test_a_stored_dataset_is_read_when_it_is_used(undisturbed: Path) -> None:
    assert not opened(undisturbed)["wave"].variable._in_memory
    part = opened(undisturbed)["wave"].sel(x=2.9, y=slice(0, 1))
    assert part.shape == (4,)


def test_chunks_of_nothing_are_written_too(undisturbed: Path) -> None:
    assert np.isnan(opened(undisturbed)["wave"].values[:7, :5]).all()
    assert len([key for key in files(undisturbed) if key.startswith("wave/c.")]) == 25
    assert {len(data) for key, data in files(undisturbed).items() if key.startswith("wave/c.")} == {
        7 * 5 * 8 + 4
    }


def test_a_finished_store_is_not_computed_again(undisturbed: Path, counted: Path) -> None:
    before, times = files(undisturbed), undisturbed.stat().st_mtime_ns
    told: list[float] = []
    run(waves(log=counted), undisturbed, progress=told.append)
    assert (chunks_in(counted), told) == (0, [1.0])
    assert (files(undisturbed), undisturbed.stat().st_mtime_ns) == (before, times)


def test_progress_rises_from_what_is_there_to_the_end(tmp_path: Path) -> None:
    def stop(share: float) -> None:
        told.append(share)
        if share > 0.5:
            raise KeyboardInterrupt

    told: list[float] = []
    with pytest.raises(KeyboardInterrupt):
        run(waves(), tmp_path / "w.zarr", progress=stop)
    assert told[0] == 0.0
    assert told == sorted(told)
    again: list[float] = []
    run(waves(), tmp_path / "w.zarr", progress=again.append)
    assert 0.4 < again[0] <= told[-1]
    assert again == sorted(again)
    assert again[-1] == 1.0


@pytest.mark.parametrize("after", [0.0, 0.02, 0.3, 0.99])
def test_an_interrupted_run_goes_on(
    after: float, undisturbed: Path, tmp_path: Path, counted: Path
) -> None:
    def stop(share: float) -> None:
        if share >= after:
            raise KeyboardInterrupt

    store = tmp_path / "w.zarr"
    with pytest.raises(KeyboardInterrupt, match=r"^\d+ of 25 chunks are in .*w\.zarr$") as told:
        run(waves(log=counted), store, progress=stop)
    partial = opened(store)
    assert partial.attrs["unfinished"] == "chunks are missing; the same call again computes them"
    there = min(len(list(store.glob(f"{name}/c.*"))) for name in ("wave", "positive", "moments"))
    assert int(str(told.value).split()[0]) == there
    run(waves(log=counted), store)
    assert chunks_in(counted) <= 25 + 1
    assert there == int(after * 25) or after in {0.02, 0.3, 0.99}
    assert files(store) == files(undisturbed)


@pytest.mark.parametrize("seed", range(4))
def test_missing_and_spoilt_files_come_back(
    seed: int, undisturbed: Path, tmp_path: Path, counted: Path
) -> None:
    """Whatever is lost, cut short or changed, chunk or metadata: only such chunks are computed."""
    store, chance = tmp_path / "w.zarr", np.random.default_rng(seed)
    run(waves(), store)
    keys = [key for key in files(store) if key != "zarr.json"]
    lost = set()
    for key in chance.choice(keys, 8, replace=False):
        path, data = store / key, bytearray((store / key).read_bytes())
        match chance.integers(4):
            case 0:
                path.unlink()
            case 1:
                path.write_bytes(data[: len(data) // 2])
            case 2:
                path.write_bytes(b"")
            case _:
                data[chance.integers(len(data))] ^= 1
                path.write_bytes(data)
        if key.split("/")[0] in {"wave", "positive", "moments"} and "c." in key:
            lost.add(tuple(key.split(".")[-2:]))
    (store / "wave/.c.0.0.part").write_bytes(b"left over")
    (store / ".zarr.json.part").write_bytes(b"left over")
    run(waves(log=counted), store)
    assert chunks_in(counted) == len(lost)
    assert files(store) == files(undisturbed)


def test_a_finished_store_that_lost_a_chunk_says_so_until_it_is_back(tmp_path: Path) -> None:
    def stop(share: float) -> None:
        raise KeyboardInterrupt

    store = tmp_path / "w.zarr"
    run(waves(), store)
    (store / "positive/c.0.0").unlink()
    with pytest.raises(KeyboardInterrupt):
        run(waves(), store, progress=stop)
    assert "unfinished" in opened(store).attrs
    assert "unfinished" not in run(waves(), store).attrs


def test_a_damaged_chunk_is_named_when_it_is_read(tmp_path: Path) -> None:
    store = tmp_path / "w.zarr"
    run(waves(), store)
    path = store / "wave/c.1.2"
    path.write_bytes(path.read_bytes()[:-5])
    dataset = opened(store)
    assert np.isfinite(dataset["wave"][7:14, :5].values).any()
    with pytest.raises(
        ValueError, match=r"^/.*w.zarr/wave/c.1.2 is damaged.*run the call"
    ) as error:
        dataset["wave"].load()
    assert "\n" not in str(error.value)
    run(waves(), store)
    assert np.isfinite(opened(store)["wave"].values[7:14, 10:15]).any()


@pytest.mark.parametrize("key", ["wave/c.1.2", "positive/c.0.0", "x/c.0"])
def test_a_chunk_that_a_finished_store_lacks_is_named_when_it_is_read(
    key: str, tmp_path: Path
) -> None:
    """Not given as what stands where nothing has been computed; that is in an unfinished one."""
    store = tmp_path / "w.zarr"
    run(waves(), store)
    (store / key).unlink()
    with pytest.raises(ValueError, match=f"w.zarr/{key} is missing; run the call") as error:
        opened(store).load()
    assert "\n" not in str(error.value)
    run(waves(), store)
    xr.testing.assert_identical(opened(store).load(), run(waves()))


@pytest.mark.parametrize("missing", [None, "zarr.json"])
def test_what_is_no_store_cannot_be_opened(missing: str | None, tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="no such store: .*w.zarr"):
        opened(tmp_path / "w.zarr")
    (tmp_path / "w.zarr").mkdir()
    (tmp_path / "w.zarr/zarr.json").write_text("{", encoding="utf-8")
    with pytest.raises(ValueError, match=r"w\.zarr cannot be read as a store"):
        opened(tmp_path / "w.zarr")


# ---- elsewhere ----


def test_an_object_store_is_written_and_resumed(tmp_path: Path, counted: Path) -> None:
    fsspec = pytest.importorskip("fsspec")
    memory, url = fsspec.filesystem("memory"), "memory://waves.zarr"

    def stop(share: float) -> None:
        if share > 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run(waves(log=counted), url, progress=stop)
    assert "unfinished" in opened(url).attrs
    xr.testing.assert_identical(run(waves(log=counted), url).load(), run(waves()))
    assert chunks_in(counted) <= 25 + 1
    spoilt = memory.cat_file("/waves.zarr/wave/c.1.1")
    memory.pipe_file("/waves.zarr/wave/c.1.1", spoilt[:-1])
    with pytest.raises(ValueError, match=r"waves.zarr/wave/c.1.1 is damaged.*; remove it and run"):
        opened(url).load()
    xr.testing.assert_identical(run(waves(), url).load(), run(waves()))
    with pytest.raises(ValueError, match="memory://waves.zarr holds another computation"):
        run(waves((9, 9)), url)
    run(waves((9, 9)), tmp_path / "w.zarr")
    run(waves((9, 9)), url, overwrite=True)
    memory.get(url, str(tmp_path / "copy.zarr"), recursive=True)
    assert files(tmp_path / "copy.zarr") == files(tmp_path / "w.zarr")


def test_a_missing_extra_is_named(tmp_path: Path) -> None:
    code = """
import sys
for hidden in ("xarray", "distributed", "fsspec"):
    sys.modules[hidden] = None
from pendula.chunks import connect, run
from chunked import waves
def told(call):
    try:
        call()
    except ImportError as error:
        print(error)
told(lambda: run(waves()))
told(lambda: connect("tcp://127.0.0.1:1"))
sys.modules["xarray"] = sys
told(lambda: run(waves(), "s3://bucket/w.zarr"))
told(lambda: run(waves(), client=object()))
"""
    here = Path(__file__).parent
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=here, capture_output=True, text=True, check=True
    )
    assert done.stdout.splitlines() == [
        f"xarray is not installed; {how_to_install('io')}",
        f"distributed is not installed; {how_to_install('cluster')}",
        f"fsspec is not installed; {how_to_install('cluster')}",
        f"distributed is not installed; {how_to_install('cluster')}",
    ]
