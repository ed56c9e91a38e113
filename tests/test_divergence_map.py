"""Divergence maps: how far neighbours have parted, against what is known and what `solve` finds."""

from __future__ import annotations

import json
import math
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from pendula import DoublePendulum, SimplePendulum, divergence_map, solve
from pendula.many.maps import cells as cells_of_map

RODS = DoublePendulum.rods()
PI = math.pi
WHOLE = ((-PI, PI), (-PI, PI))
SEPARATION = 1e-8


def small_motion(t: float) -> np.ndarray:
    """Angles at t of small angles at the start, from rest: a matrix, by the normal modes."""
    modes = RODS.normal_modes()
    shapes = np.array(modes.shapes)
    shapes = shapes if shapes.shape == (2, 2) else shapes.T
    basis = shapes.T  # its columns are the modes
    frequencies = np.asarray(modes.frequencies)
    moved: np.ndarray = basis @ np.diag(np.cos(frequencies * t)) @ np.linalg.inv(basis)
    return moved


@pytest.mark.parametrize("t_max", [0.5, 2.0, 10.0])
def test_near_rest_neighbours_part_as_the_normal_modes_do(t_max: float) -> None:
    data = divergence_map(RODS, (-1e-4, 1e-4), (-1e-4, 1e-4), (5, 4), t_max)
    expected = abs(small_motion(t_max) @ np.ones(2)).max()
    np.testing.assert_allclose(data.growth, expected, rtol=1e-4)


def test_a_standing_rod_falls_at_the_rate_of_its_linear_motion() -> None:
    """Both rods up, from a very small angle: the growth is that of cosh."""
    up = divergence_map(RODS, (PI - 2e-9, PI), (PI - 2e-9, PI), (1, 1), 2.0, separation=1e-9)
    frequencies = np.asarray(RODS.normal_modes().frequencies)  # with gravity turned about
    shapes = np.array(RODS.normal_modes().shapes)
    moved = shapes.T @ np.diag(np.cosh(frequencies * 2.0)) @ np.linalg.inv(shapes.T)
    assert up.growth.item() == pytest.approx(abs(moved @ np.ones(2)).max(), rel=1e-3)


@pytest.mark.parametrize("tolerance", [None, 1e-9])
@pytest.mark.parametrize("ranges", [WHOLE, ((1.0, 2.0), (-0.5, 0.5)), ((-2.0, -1.0), (0.0, 1.0))])
def test_a_cell_is_what_two_runs_find(ranges: Any, tolerance: float | None) -> None:
    data = divergence_map(RODS, ranges[0], ranges[1], (5, 7), 3.0, tolerance=tolerance)
    for i, j in product(range(5), range(7)):
        cell = data.isel(theta1=i, theta2=j)
        start = np.array([float(cell.theta1), float(cell.theta2), 0.0, 0.0])
        away = SEPARATION if tuple(start) >= tuple(-start) else -SEPARATION
        beside = start + np.array([away, away, 0.0, 0.0])
        ends = [solve(RODS, s, [3.0], tolerance=tolerance).theta[0] for s in (start, beside)]
        assert cell.growth == abs(ends[1] - ends[0]).max() / SEPARATION


@pytest.mark.parametrize("shape", [(8, 6), (7, 7)])
def test_a_map_about_rest_is_symmetric(shape: tuple[int, int]) -> None:
    growth = divergence_map(RODS, WHOLE[0], WHOLE[1], shape, 5.0).growth.values
    np.testing.assert_array_equal(growth, growth[::-1, ::-1])


def test_a_zoom_has_the_bits_of_the_whole_map() -> None:
    whole = divergence_map(RODS, (-2.0, 2.0), (-2.0, 2.0), (32, 32), 5.0)
    zoom = divergence_map(RODS, (-2.0, 0.0), (-1.0, 1.0), (16, 16), 5.0)
    part = whole.isel(theta1=slice(0, 16), theta2=slice(8, 24))
    np.testing.assert_array_equal(zoom.growth, part.growth)


def test_neighbours_of_a_regular_motion_part_slowly_and_of_a_wild_one_fast() -> None:
    calm = divergence_map(RODS, (-0.4, 0.4), (-0.4, 0.4), (8, 8), 20.0)
    wild = divergence_map(RODS, (2.2, 2.8), (2.0, 2.8), (8, 8), 20.0)
    assert float(calm.growth.max()) < 100.0
    assert float(np.log(wild.growth).median()) / 20.0 > 0.3
    assert float(wild.growth.max()) < 100 * 2 * PI / SEPARATION


def test_the_separation_hardly_matters_while_it_is_small() -> None:
    asked = RODS, (0.2, 1.2), (0.2, 1.2), (6, 6), 3.0
    one, other = (divergence_map(*asked, separation=s).growth for s in (1e-8, 1e-7))
    np.testing.assert_allclose(one, other, rtol=1e-3)


@pytest.mark.parametrize("largest", [3, 4, 256])
def test_chunks_threads_and_stores_change_no_bit(
    largest: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: Any = RODS, *WHOLE, (9, 8), 4.0
    one = divergence_map(*asked)
    monkeypatch.setattr(cells_of_map, "LARGEST_CHUNK", largest)
    cut = divergence_map(*asked, threads=3)
    xr.testing.assert_equal(cut, one)
    stored = divergence_map(*asked, store=tmp_path / "growth.zarr")
    xr.testing.assert_identical(stored.load(), cut)


def test_angles_beyond_the_sine_are_nan() -> None:
    edge = 2.0**26
    data = divergence_map(RODS, (edge - 7.0, edge), (1.0, 2.0), (16, 2), 5.0)
    assert data.growth.isnull().sum() == 1


def test_the_map_says_what_it_is() -> None:
    data = divergence_map(RODS, WHOLE[0], WHOLE[1], (2, 3), 4, separation=1e-6, tolerance=1e-10)
    recipe = json.loads(data.pendula)
    assert recipe["map"] == "divergence"
    assert (recipe["separation"], recipe["tolerance"], recipe["t_max"]) == (1e-6, 1e-10, 4.0)
    assert data.t_max == 4.0
    assert data.growth.units == "1"


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"system": SimplePendulum()}, "system must be a DoublePendulum"),
        ({"separation": 0.0}, "separation must be positive"),
        ({"separation": 0.1}, r"separation must lie between 1e-13 and 0.01 rad, got 0.1"),
        ({"separation": 1e-17}, "separation must lie between"),
        ({"t_max": -1.0}, "t_max must be positive"),
        ({"theta1": (1.0, 0.0)}, r"theta1 must be a range \(lo, hi\) with lo < hi"),
    ],
)
def test_wrong_calls_are_refused(given: dict[str, Any], message: str) -> None:
    good = {"system": RODS, "theta1": (0, 1), "theta2": (0, 1), "shape": (3, 4), "t_max": 1.0}
    with pytest.raises(ValueError, match=message):
        divergence_map(**{**good, **given})
