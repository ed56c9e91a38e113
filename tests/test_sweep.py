"""Sweeps: many systems and starts from a recipe, into memory, a Zarr store or a Parquet file."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

import pendula
from chunked import files
from pendula import solve, sweep
from pendula.chunks import opened
from pendula.many.sweep.rows import MISSING
from pendula.sweeping import SweepRecipe, sweep_from
from pendula.systems import system_from
from swept import RODS, bits, recipe

VERLET = """
[system]
kind = "simple"
length = { list = ["1 m", "2 m", "50 cm"] }
[state]
theta = { grid = ["-90 deg", "90 deg", 5] }
[run]
method = "verlet"
step = "10 ms"
t_max = "1 s"
every = "0.25 s"
chunk = 4
"""
DOP853 = """
[system]
kind = "linear"
gravity = { uniform = ["1 m/s^2", "10 m/s^2"] }
[run]
method = "dop853"
t_max = "3 s"
draws = 5
"""
BODIES = """
[system]
kind = "double"
form = "bodies"
m1 = "1 kg"
m2 = { uniform = ["1 kg", "3 kg"] }
l1 = "1 m"
c1 = "0.5 m"
c2 = "0.4 m"
I1 = "0.1 kg m^2"
I2 = "0.1 kg m^2"
[run]
t_max = "1 s"
every = "0.5 s"
certify = "1e-9 rad"
draws = 3
"""


def states_of(dataset: xr.Dataset, names: tuple[str, ...], row: int) -> Any:
    return np.stack([dataset[name].values[row] for name in names], axis=-1)


@pytest.mark.parametrize("text", [RODS, VERLET, DOP853, BODIES])
def test_each_row_is_what_solve_gives_alone(tmp_path: Path, text: str) -> None:
    asked = recipe(tmp_path, text)
    found = sweep(asked)
    assert dict(found.sizes) == {"row": asked.sampler.count, "t": len(asked.times)}
    assert found["t"].values.tolist() == asked.times.tolist()
    for row in range(asked.sampler.count):
        values = {name: float(found[name][row]) for name in asked.parameters}
        system = system_from({"name": asked.system, "form": asked.form, "parameters": values})
        start = [float(found[f"{name}_start"][row]) for name in asked.components]
        times = asked.times if asked.every else asked.t_max
        run = solve(system, start, times, asked.method, **asked.options)
        last = slice(None) if asked.every else slice(-1, None)
        states = states_of(found, asked.components, row)
        assert states.tobytes() == run.states[last].tobytes()
        assert found["energy"].values[row].tobytes() == run.energy[last].tobytes()
        assert found["outcome"].values[row] == run.outcome
        assert int(found["n_steps"][row]) == run.n_steps
        assert float(found["reached"][row]) == asked.t_max
        if asked.certify is not None:
            assert float(found["trust_horizon"][row]) == run.trust_horizon


def test_a_recipe_is_a_file_or_what_was_read_of_it(tmp_path: Path) -> None:
    asked = recipe(tmp_path, VERLET)
    xr.testing.assert_identical(sweep(tmp_path / "recipe.toml"), sweep(asked))


def test_neither_chunks_nor_threads_change_a_number(
    rods: SweepRecipe, in_memory: xr.Dataset
) -> None:
    for chunk, threads in ((1, 3), (20, 1), (1000, None), (7, 2)):
        assert bits(sweep(replace(rods, chunk=chunk), threads=threads)) == bits(in_memory)


def test_more_rows_leave_the_first_as_they_are(rods: SweepRecipe, in_memory: xr.Dataset) -> None:
    more = replace(rods, sampler=replace(rods.sampler, draws=31))
    assert bits(sweep(more).isel(row=slice(0, 20))) == bits(in_memory)


def test_every_variable_says_what_it_is(rods: SweepRecipe, in_memory: xr.Dataset) -> None:
    units = {name: each.attrs.get("units") for name, each in in_memory.variables.items()}
    assert units == {
        **dict.fromkeys(("m1", "m2"), "kg"),
        **dict.fromkeys(("l1", "l2"), "m"),
        "gravity": "m/s^2",
        **dict.fromkeys(("theta1", "theta2", "theta1_start", "theta2_start"), "rad"),
        **dict.fromkeys(("omega1", "omega2", "omega1_start", "omega2_start"), "rad/s"),
        **dict.fromkeys(("t", "reached"), "s"),
        "energy": "J",
        "n_steps": "1",
        "outcome": None,
    }
    assert all(each.attrs["long_name"] for each in in_memory.variables.values())
    told = json.loads(in_memory.attrs["pendula"])
    assert told["pendula"] == pendula.__version__
    assert sweep_from(told["sweep"]) == rods


@pytest.mark.usefixtures("starts_beyond_the_sine")
def test_one_bad_row_does_not_spoil_the_others(tmp_path: Path) -> None:
    good = '[state]\ntheta = { list = ["10 deg", "20 deg"] }\n'
    bad = good.replace('"20 deg"', '"1e9 rad", "20 deg"')
    run = '[run]\nt_max = "2 s"\nevery = "1 s"\n'
    kind = '[system]\nkind = "simple"\n'
    found = sweep(recipe(tmp_path, kind + bad + run))
    assert found["outcome"].values.tolist() == [
        "reached_end",
        "not_finite",
        "reached_end",
    ]
    alone = solve(pendula.SimplePendulum(), [1e9, 0.0], [0.0, 1.0, 2.0])
    for name, values in (("theta", alone.theta), ("energy", alone.energy)):
        assert found[name].values[1, :1].tobytes() == values.tobytes()
        assert np.isnan(found[name].values[1, 1:]).all()
    assert bits(found.isel(row=[0, 2])) == bits(sweep(recipe(tmp_path, kind + good + run)))


def test_a_run_that_ends_early_has_what_it_reached(tmp_path: Path) -> None:
    found = sweep(recipe(tmp_path, RODS.replace("draws", "max_steps = 40\ndraws")))
    ends = found["outcome"].values.tolist()
    assert set(ends) == {"reached_end", "step_limit"}
    for name in ("theta1", "omega2", "energy"):
        made = found["t"].values <= found["reached"].values[:, np.newaxis]
        assert (np.isfinite(found[name].values) == made).all()
    assert (found["n_steps"].values <= 40).all()


def test_a_fast_start_leaves_the_sines_range_as_an_outcome(tmp_path: Path) -> None:
    text = VERLET.replace("[run]", 'omega = { list = ["0 rad/s", "1e9 rad/s"] }\n[run]')
    found = sweep(recipe(tmp_path, text))
    assert found["outcome"].values.tolist() == ["reached_end", "not_finite"] * 15


def test_a_store_holds_the_same(rods: SweepRecipe, in_memory: xr.Dataset, tmp_path: Path) -> None:
    store = tmp_path / "rods.zarr"
    xr.testing.assert_identical(sweep(rods, store).load(), in_memory)
    xr.testing.assert_identical(xr.open_zarr(store, chunks=None).load(), in_memory)
    assert {path.name for path in (store / "theta1").glob("c.*")} == {"c.0.0", "c.1.0", "c.2.0"}


def test_a_stopped_sweep_goes_on_to_the_same_bytes(rods: SweepRecipe, tmp_path: Path) -> None:
    calm, store, told = tmp_path / "calm.zarr", tmp_path / "rods.zarr", list[float]()
    sweep(rods, calm)

    def stop(share: float) -> None:
        if share > 0.5:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep(rods, store, progress=stop)
    outcomes = opened(store)["outcome"].values
    assert (outcomes == MISSING).tolist() == [False] * 7 + [True] * 13
    sweep(rods, store, progress=told.append)
    assert told[0] == 7 / 20
    assert (told[-1], told) == (1.0, sorted(told))
    assert files(store) == files(calm)


def test_a_store_that_is_there_is_kept(rods: SweepRecipe, tmp_path: Path) -> None:
    store = tmp_path / "rods.zarr"
    sweep(rods, store)
    before = files(store)
    with pytest.raises(FileExistsError, match="pass resume=True to resume it"):
        sweep(rods, store, resume=False)
    other = replace(rods, sampler=replace(rods.sampler, seed=1))
    with pytest.raises(ValueError, match=r"sweep\.sampler\.seed is 0 there and 1 here"):
        sweep(other, store)
    assert files(store) == before
    sweep(other, store, overwrite=True)
    assert files(store) != before


# ---- on a cluster ----


def test_a_cluster_gives_the_same_bytes(
    client: Any, rods: SweepRecipe, in_memory: xr.Dataset, tmp_path: Path
) -> None:
    small = replace(rods, chunk=1)
    assert bits(sweep(small, client=client)) == bits(in_memory)
    for ending in ("zarr", "parquet"):
        here, there = tmp_path / f"here.{ending}", tmp_path / f"there.{ending}"
        sweep(small, here)
        sweep(small, there, client=client)
        if ending == "zarr":
            assert files(here) == files(there)
        else:
            assert here.read_bytes() == there.read_bytes()


# ---- wrong use ----


@pytest.mark.parametrize(
    ("store", "options", "told"),
    [
        ("rods.nc", {}, r"store must end in \.zarr or \.parquet, got '.*rods\.nc'"),
        ("rods", {}, r"store must end in \.zarr or \.parquet"),
        ("rods.parquet", {"threads": 0}, "threads must be a whole number from 1"),
        ("rods.zarr", {"threads": 2.5}, "threads must be a whole number"),
        ("rods.parquet", {"client": "tcp://x:1"}, "client must be a Client"),
        ("rods.zarr", {"client": "tcp://x:1"}, "client must be a Client"),
    ],
)
def test_a_wrong_call_is_refused_and_leaves_nothing(
    rods: SweepRecipe, tmp_path: Path, store: str, options: dict[str, Any], told: str
) -> None:
    with pytest.raises(ValueError, match=told):
        sweep(rods, tmp_path / store, **options)
    assert list(tmp_path.iterdir()) == []


def test_parquet_is_written_on_this_machine(rods: SweepRecipe) -> None:
    with pytest.raises(ValueError, match="store must be a path to write Parquet"):
        sweep(rods, "s3://bucket/rods.parquet")
