"""The columns of a trajectory's table: names, units, values."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pendula import _engine
from pendula.run.derivatives import derivative_columns

if TYPE_CHECKING:
    from collections.abc import Collection

    from pendula._types import Array
    from pendula.run.trajectory import Trajectory

TIME = "t [s]"


def columns(trajectory: Trajectory) -> dict[str, tuple[str, Array]]:
    """Name → (unit, values): states first, then what follows from them.

    Values have the shape of the times, (n,), or (m, n) for several exact solutions.
    """
    entry = _engine.system_entries()[trajectory.system.name]
    states = trajectory.states
    table = {each.name: (each.unit, states[..., i]) for i, each in enumerate(entry.components)}
    table["kinetic_energy"] = ("J", trajectory.kinetic_energy)
    table["potential_energy"] = ("J", trajectory.potential_energy)
    table["energy_error"] = ("1", trajectory.energy_error)
    if any(_engine.powers(trajectory.system.name)) and trajectory.request.digits is None:
        table["work"], table["heat"] = ("J", trajectory.work), ("J", trajectory.heat)
    return table


def stored_columns(trajectory: Trajectory) -> dict[str, tuple[str, Array]]:
    """Name → (unit, values) of everything a file holds: the columns, and one a derivative."""
    if trajectory.derivatives is None:
        return columns(trajectory)
    names = trajectory.derivative_names
    return columns(trajectory) | derivative_columns(
        trajectory.system, names, trajectory.derivatives
    )


def labelled(trajectory: Trajectory) -> dict[str, Array]:
    """The times and the columns, by label: "theta [rad]"."""
    table = {
        f"{name} [{unit}]": values for name, (unit, values) in stored_columns(trajectory).items()
    }
    return {TIME: trajectory.t, **table}


def states_labels(labels: Collection[str]) -> list[str]:
    """Those of the states, in their order; their names say which system it is. None: empty."""
    for entry in _engine.system_entries().values():
        wanted = [f"{each.name} [{each.unit}]" for each in entry.components]
        if all(each in labels for each in wanted):
            return wanted
    return []
