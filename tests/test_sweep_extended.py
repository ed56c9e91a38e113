"""A sweep with more draws goes on with a finished one; one of an earlier version is refused."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any
from zipfile import ZipFile

import numpy as np
import pytest
import xarray as xr

from chunked import files
from pendula import sweep
from pendula.chunks import opened
from pendula.many.chunks.places import Folder
from pendula.many.sweep.rows import MISSING
from pendula.sweeping import SweepRecipe, sweep_from
from swept import RODS, bits, recipe

if TYPE_CHECKING:
    from commands import Call

OLD = Path(__file__).parent / "data" / "sweeps" / "8f2f035.zip"
GRID = """
[system]
kind = "simple"
length = { list = ["1 m", "2 m", "3 m"] }
[state]
theta = { normal = ["10 deg", "20 deg"] }
[run]
t_max = "1 s"
every = "0.5 s"
draws = 4
chunk = 5
"""


def more(asked: SweepRecipe, draws: int) -> SweepRecipe:
    return replace(asked, sampler=replace(asked.sampler, draws=draws))


@pytest.mark.parametrize("chunk", [1, 4, 5, 12, 1000])
@pytest.mark.parametrize("text", [RODS, GRID])
def test_more_draws_end_in_the_bytes_of_one_run(tmp_path: Path, text: str, chunk: int) -> None:
    asked = replace(recipe(tmp_path, text), chunk=chunk)
    first = asked.sampler.draws
    grown, calm = tmp_path / "grown.zarr", tmp_path / "calm.zarr"
    before = bits(sweep(asked, grown).load())
    for draws in (first + 1, 2 * first, 2 * first + 3):
        sweep(more(asked, draws), grown)
    found = opened(grown).load()
    assert bits(found.isel(row=slice(0, asked.sampler.count)), "outcome") == {
        name: data for name, data in before.items() if name != "outcome"
    }
    sweep(more(asked, 2 * first + 3), calm)
    assert files(grown) == files(calm)


def test_only_the_other_rows_are_run(tmp_path: Path, rods: SweepRecipe) -> None:
    """And those of the chunk that was not full."""
    told = list[float]()
    sweep(rods, tmp_path / "rods.zarr")
    sweep(more(rods, 40), tmp_path / "rods.zarr", progress=told.append)
    assert told[0] == 14 / 40


@pytest.mark.parametrize("last", range(1, 60, 3))
def test_a_sweep_stopped_while_it_grows_goes_on(
    tmp_path: Path, rods: SweepRecipe, monkeypatch: pytest.MonkeyPatch, last: int
) -> None:
    """Whatever it wrote or removed last."""
    calm, store = tmp_path / "calm.zarr", tmp_path / "rods.zarr"
    few, many = replace(rods, chunk=8), more(replace(rods, chunk=8), 31)
    sweep(many, calm)
    sweep(few, store)
    count = 0

    def counted(change: Any) -> Any:
        def wrapped(*given: Any) -> Any:
            nonlocal count
            count += 1
            if count > last:
                raise KeyboardInterrupt
            return change(*given)

        return wrapped

    with monkeypatch.context() as patched:
        patched.setattr(Folder, "write", counted(Folder.write))
        patched.setattr(Folder, "remove", counted(Folder.remove))
        with pytest.raises(KeyboardInterrupt):
            sweep(many, store)
    outcomes = opened(store)["outcome"].values
    assert set(outcomes.tolist()) <= {"reached_end", MISSING}
    sweep(many, store)
    assert files(store) == files(calm)


def test_the_command_goes_on_with_more_draws(call: Call) -> None:
    Path("rods.toml").write_text(GRID, encoding="utf-8")
    assert call("sweep rods.toml -o rods.zarr")[0] == 0
    Path("rods.toml").write_text(GRID.replace("draws = 4", "draws = 1e1"), encoding="utf-8")
    code, _, told = call("sweep rods.toml -o rods.zarr")
    assert (code, "rods.zarr exists; pass --resume to resume it" in told) == (2, True)
    code, printed, _ = call("sweep rods.toml -o rods.zarr --resume")
    assert (code, printed) == (0, "rods.zarr: 30 rows of 3 times; 30 reached_end\n")
    xr.testing.assert_identical(opened("rods.zarr").load(), sweep("rods.toml"))


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"draws": 3}, r"sweep\.sampler\.draws is 4 there and 3 here; choose another name"),
        ({"draws": 9, "seed": 1}, r"sweep\.sampler\.draws is 4 there and 9 here"),
    ],
)
def test_other_sweeps_do_not_go_on(tmp_path: Path, change: dict[str, Any], told: str) -> None:
    asked, store = recipe(tmp_path, GRID), tmp_path / "rods.zarr"
    sweep(asked, store)
    before = files(store)
    with pytest.raises(ValueError, match=told):
        sweep(replace(asked, sampler=replace(asked.sampler, **change)), store)
    assert files(store) == before


# ---- stores of an earlier version, with outcomes as numbers ----


@pytest.fixture
def old(tmp_path: Path) -> Path:
    with ZipFile(OLD) as archive:
        archive.extractall(tmp_path)
    return tmp_path


def test_an_old_store_is_read_and_not_gone_on_with(old: Path) -> None:
    store = old / "swings.zarr"
    found = opened(store).load()
    assert found["outcome"].values.tolist() == [0] * 10
    assert found["outcome"].attrs["flag_meanings"].split()[0] == "reached_end"
    before = files(store)
    told = (
        r"swings\.zarr is in the format of an earlier version: it can be read, not gone on with; "
    )
    with pytest.raises(ValueError, match=told):
        sweep(old / "swings.toml", store)
    assert files(store) == before
    new = sweep(old / "swings.toml", store, overwrite=True)
    there = np.sort(found["theta_start"].values)
    assert there.tolist() == np.sort(new["theta_start"].values).tolist()


def test_an_old_recipe_in_another_order_is_refused(old: Path) -> None:
    import json

    told = json.loads(opened(old / "swings.zarr").attrs["pendula"])["sweep"]
    with pytest.raises(ValueError, match="the recipe is of an earlier version"):
        sweep_from(told)
    told["sampler"]["columns"][0] = ["length", "fixed", 1.0]
    assert sweep_from(told).dtype == "float64"
