"""What the numbers of a flip map mean, against long runs, certified ones and many digits."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
import xarray as xr

from pendula import DoublePendulum, ensemble, flip_map, solve
from pendula.events import flip

RODS = DoublePendulum.rods()
OTHER = DoublePendulum.bobs(1.0, 0.3, 0.7, 1.1)
PI = math.pi
WHOLE: Any = ((-PI, PI), (-PI, PI))


@pytest.mark.parametrize("which", [None, 1, 2])
@pytest.mark.parametrize("system", [RODS, OTHER, DoublePendulum.bobs(1.0, 5.0, 1.0, 0.1)])
def test_forbidden_cells_never_flip(system: DoublePendulum, which: int | None) -> None:
    """Without the bound they are run like the others, and long."""
    data = flip_map(system, WHOLE[0], WHOLE[1], (40, 40), 0.1, which)
    forbidden = np.argwhere(data.forbidden.values)
    assert 0 < len(forbidden) < 1600
    energy = system.potential_energy(grid_states(data))
    tops = system.potential_energy(np.array([[PI, 0.0, 0.0, 0.0], [0.0, PI, 0.0, 0.0]]))
    least = min(tops) if which is None else tops[which - 1]
    np.testing.assert_array_equal(data.forbidden, energy < least)
    rods = [which] if which else [1, 2]
    states = grid_states(data)[data.forbidden.values]
    near = states[np.argsort(system.potential_energy(states))[-150:]]
    many = ensemble(system, near, [200.0], tolerance=1e-8, events=[flip(rod) for rod in rods])
    assert all(each.times.size == 0 for each in many.events)
    assert (data.flip_time.values[data.forbidden.values] != 0).all()
    assert data.resolved.values[data.forbidden.values].all()


def grid_states(data: xr.Dataset) -> np.ndarray:
    first, second = np.meshgrid(data.theta1, data.theta2, indexing="ij")
    return np.stack([first, second, 0 * first, 0 * first], axis=-1)


def test_all_forbidden_is_no_error() -> None:
    data = flip_map(RODS, (-0.5, 0.5), (-0.5, 0.5), (3, 4), 1e6)
    assert data.forbidden.all()
    assert data.flip_time.isnull().all()
    assert data.resolved.all()


def test_a_longer_wait_only_adds_flips() -> None:
    short, long = (flip_map(RODS, WHOLE[0], WHOLE[1], (20, 20), t) for t in (2.0, 20.0))
    early = short.flip_time.notnull().values
    assert 0 < early.sum() < long.flip_time.notnull().sum()
    np.testing.assert_array_equal(short.flip_time.values[early], long.flip_time.values[early])
    later = long.flip_time.values[~early]
    assert (later[~np.isnan(later)] > 2.0).all()
    assert long.flip_time.max() <= 20.0


def test_the_number_of_cells_that_are_forbidden_is_that_of_the_area() -> None:
    """Equal rods: 3 cos θ1 + cos θ2 > 2 (Heyl 2008)."""
    data = flip_map(RODS, WHOLE[0], WHOLE[1], (300, 300), 1e-3)
    second = (np.arange(4000) + 0.5) / 4000 * PI
    reach = np.arccos(np.clip((2 - np.cos(second)) / 3, -1, 1))
    assert float(data.forbidden.mean()) == pytest.approx(reach.mean() / PI, abs=1e-3)


def true_flip(first: float, second: float, t_max: float) -> tuple[float, int]:
    """Time and rod of a run at the best tolerance, all of which is certified; or NaN and 0."""
    asked = [flip(1, terminal=True), flip(2, terminal=True)]
    run = solve(RODS, (first, second, 0.0, 0.0), [t_max], events=asked, certify=1e-6)
    assert run.trust_horizon == math.inf
    for rod, found in enumerate(run.events, 1):
        if found.times.size:
            return float(found.times[0]), rod
    return math.nan, 0


def test_what_is_resolved_is_right() -> None:
    """Of the chaotic cells no false positive (of 300 others, none either)."""
    data = flip_map(RODS, (1.5, 3.0), (-3.0, 3.0), (60, 60), 14.0)
    late = data.resolved & (data.flip_time > 7.0)
    chosen = np.random.default_rng(5).permutation(np.argwhere(late.values))[:60]
    assert len(chosen) == 60
    assert 0.002 < float((~data.resolved).mean()) < 0.2
    for i, j in chosen:
        cell = data.isel(theta1=i, theta2=j)
        time, rod = true_flip(float(cell.theta1), float(cell.theta2), 14.0)
        assert float(cell.flip_time) == pytest.approx(time, rel=1e-4)
        assert cell.flipped_rod == rod


def test_a_resolved_flip_is_where_many_digits_say() -> None:
    """Neither rod has flipped just before, and the one that is listed has just after."""
    data = flip_map(RODS, (2.0, 2.6), (-1.0, 1.0), (16, 16), 6.0)
    late = data.resolved & (data.flip_time > 3.0)
    for i, j in np.argwhere(late.values)[::40][:3]:
        cell = data.isel(theta1=i, theta2=j)
        state = (float(cell.theta1), float(cell.theta2), 0.0, 0.0)
        time, rod = float(cell.flip_time), int(cell.flipped_rod)
        before = np.append(np.arange(0.05, 0.999 * time, 0.05), 0.999 * time)
        angles = solve(RODS, state, [*before, 1.001 * time], digits=12).theta
        assert (abs(angles[:-1]) < PI).all()
        assert abs(angles[-1, rod - 1]) > PI


def test_what_is_not_resolved_need_not_be_right() -> None:
    """The flag is no ornament: most of the other cells are wrong."""
    asked: Any = RODS, *WHOLE, (120, 120), 30.0
    data, best = flip_map(*asked), flip_map(*asked, tolerance=2.0**-52, resolve=False)
    resolved, flipped = data.resolved.values, (data.flipped_rod | best.flipped_rod).values > 0
    near = abs(best.flip_time - data.flip_time).values <= 1e-4 * best.flip_time.values
    same = near & (data.flipped_rod == best.flipped_rod).values
    assert (~resolved & flipped).sum() > 50
    assert same[~resolved & flipped].mean() < 0.1
    assert same[resolved & flipped].all()
