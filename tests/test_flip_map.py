"""Flip maps: each cell is what `solve` finds from its centre, whichever way the map is cut."""

from __future__ import annotations

import json
import math
from itertools import pairwise, product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from pendula import DoublePendulum, SimplePendulum, __version__, flip_map, solve
from pendula.events import flip
from pendula.many.maps import cells as cells_of_map

RODS = DoublePendulum.rods()
OTHER = DoublePendulum.bobs(1.0, 0.3, 0.7, 1.1)
PI = math.pi
WHOLE: Any = ((-PI, PI), (-PI, PI))
ZOOM: Any = ((1.9, 2.4), (-0.3, 0.6))
FAR: Any = ((PI, 3 * PI), (-3 * PI, 0.0))  # about other turns


def alone(
    system: DoublePendulum, first: float, second: float, t_max: float, which: int | None = None
) -> tuple[float, int]:
    """Time and rod of the first flip by `solve`; NaN and 0 where there is none."""
    rods = [which] if which else [1, 2]
    asked = [flip(rod, terminal=True) for rod in rods]
    run = solve(system, (first, second, 0.0, 0.0), [t_max], tolerance=1e-8, events=asked)
    for rod, found in zip(rods, run.events, strict=True):
        if found.times.size:
            return float(found.times[0]), rod
    return math.nan, 0


def check_cells(data: xr.Dataset, system: DoublePendulum, which: int | None = None) -> None:
    for i, j in product(range(data.sizes["theta1"]), range(data.sizes["theta2"])):
        cell = data.isel(theta1=i, theta2=j)
        start = float(cell.theta1), float(cell.theta2)
        image = -start[0], -start[1]
        time, rod = alone(system, *max(start, image), data.t_max, which)  # what is run for both
        np.testing.assert_array_equal(cell.flip_time, time)
        assert cell.flipped_rod == rod
        time, rod = alone(system, *min(start, image), data.t_max, which)
        np.testing.assert_allclose(cell.flip_time, time, rtol=3e-16)
        assert cell.flipped_rod == rod
        assert not (cell.forbidden and rod)


def turned(data: xr.Dataset) -> xr.Dataset:
    return data.isel(theta1=slice(None, None, -1), theta2=slice(None, None, -1))


# ---- the same bits ----


@pytest.mark.parametrize("shape", [(1, 1), (6, 8), (7, 9), (11, 4), (1, 13)])
@pytest.mark.parametrize("ranges", [WHOLE, ZOOM, FAR])
@pytest.mark.parametrize("system", [RODS, OTHER])
def test_a_cell_is_what_a_run_from_its_centre_finds(
    system: DoublePendulum, ranges: Any, shape: tuple[int, int]
) -> None:
    check_cells(flip_map(system, ranges[0], ranges[1], shape, 6.0), system)


@pytest.mark.parametrize("which", [1, 2])
def test_one_rod_alone(which: int) -> None:
    data = flip_map(RODS, WHOLE[0], WHOLE[1], (10, 11), 8.0, which)
    check_cells(data, RODS, which)
    assert set(np.unique(data.flipped_rod)) == {0, which}
    either = flip_map(RODS, WHOLE[0], WHOLE[1], (10, 11), 8.0)
    both = either.flip_time.notnull() & data.flip_time.notnull()
    assert (data.flip_time.where(both, 1.0) >= either.flip_time.where(both, 1.0)).all()
    assert json.loads(data.pendula)["which"] == which


@pytest.mark.parametrize("shape", [(8, 6), (7, 7), (13, 10)])
def test_a_map_about_rest_is_symmetric_and_so_are_its_coordinates(shape: tuple[int, int]) -> None:
    data = flip_map(RODS, (-3.0, 3.0), (-PI, PI), shape, 10.0)
    for name in ("theta1", "theta2"):
        np.testing.assert_array_equal(data[name].values, -data[name].values[::-1])
    for key, values in data.data_vars.items():
        np.testing.assert_array_equal(values, turned(data)[key])
    assert (shape[0] % 2 == 1) == (0.0 in data.theta1)
    check_cells(data, RODS)


def test_a_zoom_has_the_bits_of_the_whole_map() -> None:
    """What is run once for two cells is what each of them gives."""
    whole = flip_map(RODS, (-2.0, 2.0), (-2.0, 2.0), (32, 32), 10.0)
    zoom = flip_map(RODS, (-2.0, 0.0), (-1.0, 1.0), (16, 16), 10.0)
    part = whole.isel(theta1=slice(0, 16), theta2=slice(8, 24))
    for name, values in zoom.variables.items():
        np.testing.assert_array_equal(values, part[name])


@pytest.mark.parametrize("largest", [3, 4, 5, 7, 256])
@pytest.mark.parametrize(("shape", "ranges"), [((14, 13), WHOLE), ((12, 9), WHOLE), ((9, 7), ZOOM)])
def test_chunks_change_no_bit(
    shape: tuple[int, int], ranges: Any, largest: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = flip_map(RODS, ranges[0], ranges[1], shape, 5.0)
    monkeypatch.setattr(cells_of_map, "LARGEST_CHUNK", largest)
    cut = flip_map(RODS, ranges[0], ranges[1], shape, 5.0)
    xr.testing.assert_equal(cut, one)
    chunks = json.loads(cut.pendula)["chunks"]
    assert all(0 < step <= largest for step in chunks.values())


def test_threads_change_no_bit() -> None:
    one, *others = (
        flip_map(RODS, WHOLE[0], WHOLE[1], (20, 21), 20.0, threads=n) for n in (1, 2, 3, None)
    )
    for other in others:
        xr.testing.assert_identical(one, other)


def test_only_half_of_a_symmetric_map_is_run(monkeypatch: pytest.MonkeyPatch) -> None:
    counts: list[int] = []
    real = cells_of_map.Cells.starts

    def counted(self: Any, chunk: Any) -> Any:
        starts = real(self, chunk)
        counts.append(len(starts))
        return starts

    monkeypatch.setattr(cells_of_map.Cells, "starts", counted)
    for largest, shape, most in ((256, (9, 9), 41), (4, (12, 12), 80), (4, (8, 8), 32)):
        counts.clear()
        monkeypatch.setattr(cells_of_map, "LARGEST_CHUNK", largest)
        flip_map(RODS, WHOLE[0], WHOLE[1], shape, 1.0, resolve=False)
        assert sum(counts) <= most


# ---- stores ----


@pytest.mark.parametrize("ranges", [WHOLE, ZOOM])
def test_a_store_holds_the_map_and_is_resumed(
    ranges: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cells_of_map, "LARGEST_CHUNK", 5)
    asked: Any = RODS, *ranges, (15, 12), 5.0
    there = tmp_path / "flips.zarr"
    xr.testing.assert_identical(flip_map(*asked, store=there).load(), flip_map(*asked))
    bytes_of = {p: p.read_bytes() for p in there.rglob("*") if p.is_file()}
    for gone in ("flip_time/c.1.0", "resolved/c.2.2"):
        (there / gone).unlink()
    parts: list[float] = []
    flip_map(*asked, store=there, progress=parts.append)
    assert parts[0] > 0.5  # of an hour's work only what is missing is done again
    assert parts[-1] == 1.0
    assert {p: p.read_bytes() for p in there.rglob("*") if p.is_file()} == bytes_of
    later: Any = *asked[:-1], 6.0
    with pytest.raises(ValueError, match="holds another computation: t_max is 5.0 there and 6.0"):
        flip_map(*later, store=there)
    assert flip_map(*later, store=there, overwrite=True).t_max == 6.0


def test_the_map_says_what_it_is() -> None:
    data = flip_map(RODS, WHOLE[0], WHOLE[1], (4, 5), 3, 1)
    assert data.flip_time.dims == ("theta1", "theta2")
    assert data.flip_time.shape == (4, 5)
    kinds = {name: str(values.dtype) for name, values in data.data_vars.items()}
    assert kinds == {
        "flip_time": "float64",
        "flipped_rod": "uint8",
        "forbidden": "bool",
        "resolved": "bool",
    }
    assert data.flip_time.units == "s"
    assert data.theta1.units == data.theta2.units == "rad"
    recipe = json.loads(data.pendula)
    assert recipe["pendula"] == __version__
    assert recipe["system"]["parameters"] == RODS.parameters
    assert (recipe["map"], recipe["which"], recipe["t_max"]) == ("flip", 1, 3.0)
    assert (recipe["theta1"], recipe["shape"]) == ([-PI, PI], [4, 5])
    assert "resolved" not in flip_map(RODS, WHOLE[0], WHOLE[1], (4, 5), 3.0, resolve=False)


# ---- while it runs, and wrong calls ----


def test_progress_rises_to_the_end() -> None:
    parts: list[float] = []
    flip_map(RODS, WHOLE[0], WHOLE[1], (150, 150), 30.0, progress=parts.append)
    assert len(parts) > 3
    assert all(0.0 <= a <= b for a, b in pairwise(parts))
    assert parts[-1] == 1.0


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"system": SimplePendulum()}, "system must be a DoublePendulum, got"),
        ({"theta1": 1.0}, r"theta1 must be a range \(lo, hi\)"),
        ({"theta2": (1.0, 1.0)}, r"theta2 must be a range \(lo, hi\) with lo < hi"),
        ({"theta2": (1.0, math.nan)}, "theta2 must be a finite number"),
        ({"theta1": "ab"}, "theta1 must be a number"),
        ({"theta1": (0.0, 1e9)}, r"theta1 must lie within ±2\^26 rad"),
        ({"theta1": (1.0, 1.0 + 1e-15)}, "theta1 must be a range whose 3 cells are different"),
        ({"shape": 5}, "shape must be two numbers of cells"),
        ({"shape": (3, 0)}, r"shape must be a whole number from 1 to 1000000, got 0"),
        ({"shape": (10**6, 10**5)}, r"shape must be at most 10\^10 cells in all"),
        ({"shape": (3, 2.5)}, "shape must be a whole number"),
        ({"t_max": 0.0}, "t_max must be positive"),
        ({"t_max": 1e300}, "t_max must be small enough .* end the run before"),
        ({"which": 3}, "which must be rod 1 or 2, or left out .* got 3"),
        ({"which": True}, "which must be rod 1 or 2"),
        ({"which": 1.0}, "which must be rod 1 or 2"),
        ({"tolerance": 1e-14}, "tolerance must be at least 2.22e-13 for another run"),
        ({"tolerance": 1.0}, "tolerance must lie between"),
        ({"threads": 0}, "threads must be a whole number from 1 to 1024"),
        ({"client": "tcp://here"}, "client must be a Client of dask.distributed"),
        ({"resolve": "no"}, "resolve must be True or False, got 'no'"),
        ({"store": 5}, "store must be a path or a URL such as 'map.zarr', got 5"),
        ({"store": ""}, "store must be a path or a URL"),
        ({"store": "flips.nc"}, "store must be a Zarr store such as 'map.zarr', got 'flips.nc'"),
        (
            {"progress": 5},
            "progress must be a function of the part that is done, True for a bar, or None, got 5",
        ),
    ],
)
def test_wrong_calls_are_refused(given: dict[str, Any], message: str) -> None:
    good = {"system": RODS, "theta1": (0, 1), "theta2": (0, 1), "shape": (3, 4), "t_max": 1.0}
    with pytest.raises(ValueError, match=message):
        flip_map(**{**good, **given})


def test_arrays_and_numpy_numbers_are_taken() -> None:
    given: Any = (
        RODS,
        np.array([-1.0, 2.0]),
        [np.float32(-1), 2],
        np.array([3, 4]),
        np.float64(2.0),
        np.int64(2),
    )
    data = flip_map(*given)
    xr.testing.assert_identical(data, flip_map(RODS, (-1, 2), (-1, 2), (3, 4), 2.0, 2))
