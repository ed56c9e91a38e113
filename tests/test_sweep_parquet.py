"""Sweeps written as Parquet."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd
import pyarrow.parquet
import pytest
import xarray as xr

from pendula import sweep
from pendula.chunks import Work, computed
from pendula.sweeping import SweepRecipe


def test_a_parquet_file_has_a_row_for_each_trajectory(
    rods: SweepRecipe, in_memory: xr.Dataset, tmp_path: Path
) -> None:
    path = tmp_path / "rods.parquet"
    once = sweep(rods, path)
    file = pyarrow.parquet.ParquetFile(path)
    sizes = [file.metadata.row_group(i).num_rows for i in range(file.num_row_groups)]
    assert sizes == [7, 7, 6]
    assert file.schema_arrow.metadata[b"pendula"].decode() == in_memory.attrs["pendula"]
    table = file.read().to_pydict()
    assert table.pop("row") == list(range(20))
    assert table.pop("t [s]") == [rods.times.tolist()] * 20
    assert table.pop("outcome") == ["reached_end"] * 20
    named = {
        f"{name} [{each.attrs['units']}]": each.values.tolist()
        for name, each in in_memory.data_vars.items()
        if name != "outcome"
    }
    assert list(table) == list(named)
    assert table == named
    alone = [name for name, each in in_memory.data_vars.items() if each.dims == ("row",)]
    xr.testing.assert_identical(once, in_memory[alone])
    assert list(tmp_path.iterdir()) == [path]


def test_a_parquet_file_is_the_same_each_time_and_not_replaced_unasked(
    rods: SweepRecipe, tmp_path: Path
) -> None:
    one, other = tmp_path / "one.parquet", tmp_path / "other.parquet"
    sweep(rods, one)
    sweep(rods, other, threads=2)
    assert one.read_bytes() == other.read_bytes()
    with pytest.raises(FileExistsError, match=r"one\.parquet exists"):
        sweep(rods, one)
    sweep(replace(rods, tolerance=1e-6), one, overwrite=True)
    assert one.read_bytes() != other.read_bytes()


def test_a_stopped_parquet_file_leaves_nothing(rods: SweepRecipe, tmp_path: Path) -> None:
    def stop(share: float) -> None:
        if share > 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep(rods, tmp_path / "rods.parquet", progress=stop)
    assert list(tmp_path.iterdir()) == []


def test_chunks_that_come_in_any_order_are_written_in_theirs(
    rods: SweepRecipe, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    calm, mixed, order = tmp_path / "calm.parquet", tmp_path / "mixed.parquet", (2, 0, 1, 4, 3)
    asked = replace(rods, chunk=4)
    sweep(asked, calm)

    def shuffled(work: Work, **told: Any) -> Iterator[Any]:
        yield from computed(work, [(i,) for i in order], **told)

    monkeypatch.setattr("pendula.many.sweep.parquet.computed", shuffled)
    sweep(asked, mixed)
    assert mixed.read_bytes() == calm.read_bytes()


def test_a_reader_that_asks_finds_damage(rods: SweepRecipe, tmp_path: Path) -> None:
    path = tmp_path / "rods.parquet"
    sweep(rods, path)
    data, group = path.read_bytes(), pyarrow.parquet.ParquetFile(path).metadata.row_group(0)
    for column in map(group.column, range(group.num_columns)):
        start = column.dictionary_page_offset or column.data_page_offset
        damaged = bytearray(data)
        damaged[start + column.total_compressed_size - 1] ^= 1
        path.write_bytes(damaged)
        with pytest.raises(OSError, match="CRC"):
            pd.read_parquet(path, page_checksum_verification=True)
