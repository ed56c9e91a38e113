"""Labelled tables: columns with units for pandas and CSV, a dataset for xarray."""

from __future__ import annotations

import json
import math
from typing import TYPE_CHECKING

from pendula._attributes import KEY
from pendula._checks import extra
from pendula._late_methods import method_of
from pendula.io.attributes import attributes
from pendula.io.columns import columns, labelled, stored_columns
from pendula.run.trajectory import Trajectory

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from pendula._types import Array


def one_motion(trajectory: Trajectory, what: str) -> None:
    """Refuse several exact solutions where a table has one row for each time.

    Raises:
        ValueError: for states of shape (m, n, d).
    """
    if trajectory.states.ndim != 2:
        raise ValueError(
            f"{what} takes one motion, got {math.prod(trajectory.states.shape[:-2])}; "
            "use to_xarray, save as .nc or .zarr, or save them one by one"
        )


@method_of(Trajectory)
def to_pandas(trajectory: Trajectory) -> pd.DataFrame:
    """A table with a row for each time; columns such as "theta [rad]" (extra: io)."""
    pandas = extra("pandas", "io")
    one_motion(trajectory, "to_pandas")
    frame: pd.DataFrame = pandas.DataFrame(labelled(trajectory))
    return frame


@method_of(Trajectory)
def to_xarray(trajectory: Trajectory) -> xr.Dataset:
    """A dataset over t, units on each variable (extra: io).

    For several motions also over trajectory; for a grid of them, from states (m1, m2, …, d), over
    trajectory1, trajectory2 and so on. Derivatives are one variable over component and derived_by,
    too; in files they are columns, such as "dtheta_dlength".

    Its attribute "pendula" describes the run as JSON, from which `rerun` repeats the run.
    """
    dataset = _dataset(trajectory, columns(trajectory))
    if trajectory.derivatives is not None:
        over = (*dataset["energy_error"].dims, "component", "derived_by")
        dataset["derivatives"] = (over, trajectory.derivatives)
        dataset["component"] = list(trajectory.system.components)
        dataset["derived_by"] = list(trajectory.derivative_names)
    return dataset


def stored_dataset(trajectory: Trajectory) -> xr.Dataset:
    """What files hold: a variable for each derivative."""
    return _dataset(trajectory, stored_columns(trajectory))


def _dataset(trajectory: Trajectory, table: dict[str, tuple[str, Array]]) -> xr.Dataset:
    xarray = extra("xarray", "io")
    axes = trajectory.states.ndim - 2
    grid = ["trajectory"] if axes == 1 else [f"trajectory{i}" for i in range(1, axes + 1)]
    dims = (*grid, "t")
    variables = {name: (dims, values, {"units": unit}) for name, (unit, values) in table.items()}
    dataset: xr.Dataset = xarray.Dataset(
        variables,
        coords={"t": ("t", trajectory.t, {"units": "s"})},
        attrs={KEY: attributes(trajectory), **_readable(trajectory)},
    )
    return dataset


def _readable(trajectory: Trajectory) -> dict[str, str]:
    """The attributes a person reads first."""
    return {
        "system": json.dumps(trajectory.system.description(), ensure_ascii=False),
        "method": trajectory.method,
        "outcome": trajectory.outcome,
    }
