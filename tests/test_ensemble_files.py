"""Ensembles as labelled data, tables and files; crossings as tables."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr

import pendula
from pendula import DoublePendulum, LinearPendulum, SimplePendulum, ensemble, solve
from pendula.events import angle, flip, velocity_zero

if TYPE_CHECKING:
    from pendula import Ensemble

TIMES = [1.0, 2.0, 4.0]
STATES: dict[int, Any] = {
    2: [(0.1, 0.0), (2.0, 1.0), (0.0, 8.0)],
    4: [(2.0, 2.5, 0.0, 0.0), (0.1, 0.2, 0.0, 0.0)],
}
SYSTEMS = [LinearPendulum(), SimplePendulum(length=0.5), DoublePendulum.rods(l2=0.7)]


def made(system: Any, **options: Any) -> Ensemble:
    one = system[0] if isinstance(system, list) else system
    return ensemble(system, STATES[len(one.components)], TIMES, **options)


@pytest.mark.parametrize("system", SYSTEMS, ids=lambda system: str(system.name))
@pytest.mark.parametrize("times", [TIMES, [-1.0, -3.0]], ids=["forward", "backward"])
def test_a_dataset_holds_all_that_an_ensemble_does(system: Any, times: list[float]) -> None:
    asked = [velocity_zero(1), angle(1, 0.0, direction=1)]
    many = ensemble(system, STATES[len(system.components)], times, events=asked, certify=1e-6)
    found = many.to_xarray()
    assert dict(found.sizes) == {
        "trajectory": len(many),
        "t": len(times),
        "event1": len(many.events[0].times),
        "event2": len(many.events[1].times),
    }
    for i, name in enumerate(system.components):
        assert found[name].values.tobytes() == many.states[..., i].tobytes()
        assert found[name].units == system.component_units[name]
        np.testing.assert_array_equal(found[f"{name}_start"], np.array(many.starts)[:, i])
        for n, each in enumerate(many.events, start=1):
            assert found[f"event{n}_{name}"].values.tobytes() == each.states[:, i].tobytes()
    for n, each in enumerate(many.events, start=1):
        np.testing.assert_array_equal(found[f"event{n}_t"], each.times)
        np.testing.assert_array_equal(found[f"event{n}_trajectory"], each.trajectories)
    np.testing.assert_array_equal(found["energy"], many.energy)
    np.testing.assert_array_equal(found["trust_horizon"], np.asarray(many.trust_horizon))
    assert found["outcome"].values.tolist() == many.outcomes.tolist()
    told = json.loads(found.attrs["pendula"])
    assert told["pendula"] == pendula.__version__
    assert told["ensemble"]["system"] == system.description()
    assert all(each.attrs["long_name"] for each in found.variables.values())


def test_systems_that_differ_are_columns() -> None:
    many = ensemble(
        [SimplePendulum(length=length) for length in (0.5, 1.0, 2.0)],
        (1.0, 0.0),
        TIMES,
        "rk4",
        step=0.01,
    )
    found = many.to_xarray()
    assert found["length"].values.tolist() == [0.5, 1.0, 2.0]
    assert (found["length"].units, json.loads(found.attrs["pendula"])["ensemble"]["system"]) == (
        "m",
        None,
    )


def test_a_table_has_a_row_for_each_trajectory_and_time_that_was_reached() -> None:
    many = made(SYSTEMS[2], events=flip(2, terminal=True))
    assert many.outcomes.tolist() == ["event", "reached_end"]
    table = many.to_pandas()
    assert list(table) == [
        "trajectory",
        "t [s]",
        *("theta1 [rad]", "theta2 [rad]", "omega1 [rad/s]", "omega2 [rad/s]"),
        "energy [J]",
        "outcome",
    ]
    assert table["trajectory"].tolist() == [0, 0, 1, 1, 1]
    np.testing.assert_array_equal(table["theta1 [rad]"][2:], many.states[1, :, 0])


@pytest.mark.parametrize("ending", ["nc", "zarr"])
def test_a_file_opens_as_the_dataset(tmp_path: Path, ending: str) -> None:
    many = made(SYSTEMS[1], events=velocity_zero(1))
    path = tmp_path / f"many.{ending}"
    many.save(path)
    read = xr.open_zarr(path, consolidated=False) if ending == "zarr" else xr.open_dataset(path)
    with read:
        found, expected = read.load(), many.to_xarray()
        assert found.attrs == expected.attrs
        for name, each in expected.variables.items():
            assert found[name].values.tolist() == each.values.tolist()
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("ending", ["csv", "parquet"])
def test_a_file_is_the_table(tmp_path: Path, ending: str) -> None:
    many, path = made(SYSTEMS[1]), tmp_path / f"many.{ending}"
    many.save(path)
    read = pd.read_parquet(path) if ending == "parquet" else pd.read_csv(path, comment="#")
    pd.testing.assert_frame_equal(read, many.to_pandas(), check_exact=ending == "parquet")


def test_a_file_is_replaced_only_if_asked_to(tmp_path: Path) -> None:
    many, path = made(SYSTEMS[0]), tmp_path / "many.csv"
    path.write_text("old")
    with pytest.raises(FileExistsError, match=r"many\.csv exists"):
        many.save(path)
    many.save(path, overwrite=True)
    assert path.read_text().startswith("# pendula: {")
    with pytest.raises(ValueError, match=r"must end in \.csv, \.nc, \.parquet, \.zarr, got 'many"):
        many.save(tmp_path / "many.xlsx")


def test_crossings_are_tables() -> None:
    asked = [velocity_zero(1), flip(1), angle(1, 0.0)]
    run = solve(SYSTEMS[1], (2.0, 1.0), 4.0, events=asked)
    for each in run.events:
        table = each.to_pandas()
        assert list(table) == ["t [s]", "theta [rad]", "omega [rad/s]"]
        np.testing.assert_array_equal(table.to_numpy()[:, 1:], each.states)
        np.testing.assert_array_equal(table["t [s]"], each.times)
    section = pendula.poincare_section(
        SYSTEMS[2], (0.3, 0.1, 0.0, 0.0), angle(1, 0.0, direction=1), 3
    ).to_pandas()
    assert section.shape == (3, 5)
    (many,) = made(SYSTEMS[2], events=velocity_zero(2)).events
    table = many.to_pandas()
    assert list(table)[:3] == ["trajectory", "t [s]", "theta1 [rad]"]
    np.testing.assert_array_equal(table["trajectory"], many.trajectories)
    np.testing.assert_array_equal(table["omega2 [rad/s]"], many.states[:, 3])
