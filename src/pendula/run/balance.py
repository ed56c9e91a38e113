"""Work and heat of a motion: where its energy comes from, and what friction makes of it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

from pendula import _engine
from pendula._messages import ArgumentError

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import Array
    from pendula.run.trajectory import Trajectory


@dataclass(frozen=True, eq=False)
class EnergyBalance:
    """What the energy of a motion changed by since t0, at its output times [J].

    Attributes:
        work_by: work done by each kind of drive, (n,), or (..., n) for exact solutions.
        heat_by: heat that each kind of friction gave off, shaped alike.
        net: all work less all heat, shaped alike: what the energy has to have changed by.
        net_tail: what that goes on with, below its last bit.
    """

    work_by: Mapping[str, Array]
    heat_by: Mapping[str, Array]
    net: Array
    net_tail: Array


class Pieces(NamedTuple):
    """When friction in a joint changed.

    Attributes:
        times: (k,) [s].
        states: which way each joint slips from then on, 1 or -1, or that it sticks, 0: (k, joints).
        start: the same from the start of the run on, (joints,); empty: there is no such friction.
    """

    times: Array
    states: Array
    start: Array


def pieces_of(found: _engine.Pieces, joints: int) -> Pieces:
    """Those that the core gave, whose first is the start's."""
    times, states = found.times, found.senses(joints)
    return Pieces(times[1:], states[1:], states[:1].ravel())


def balance_of(run: Trajectory) -> EnergyBalance:
    """The balance of a run's energy; that of a closed form is integrated along the Taylor method.

    Raises:
        ValueError: for a run with `digits`, whose work and heat have a double's digits only.
    """
    import numpy as np

    works, heats = _engine.powers(run.system.name)
    if run.request.digits is not None:
        rule = "is not worked out for a run with <digits>, got {value}"
        raise ArgumentError("energy balance", rule, "leave digits out", value=run.request.digits)
    starts = run.request.state.reshape(-1, run.request.state.shape[-1])
    shape = (*run.request.state.shape[:-1], run.t.size)
    columns = np.zeros((len(starts), run.t.size, len(works) + len(heats) + 2))
    if works or heats:
        for start, rows in zip(starts, columns, strict=True):
            _fill(run, start, rows)
    parts = [columns[..., i].reshape(shape) for i in range(columns.shape[-1])]
    count = len(works)
    return EnergyBalance(
        dict(zip(works, parts[:count], strict=True)),
        dict(zip(heats, parts[count:-2], strict=True)),
        parts[-2],
        parts[-1],
    )


def _fill(run: Trajectory, start: Array, rows: Array) -> None:
    """The energies of the motion from a start, each power's and the net with its tail, (n, k)."""
    import numpy as np

    exact, t0 = run.method == "exact", run.request.t0
    for direction in (1.0, -1.0):
        ahead = np.flatnonzero(direction * (run.t - t0) >= 0.0)
        times, place = np.unique(direction * run.t[ahead], return_inverse=True)
        if not times.size or times[-1] == direction * t0:
            continue
        asked = replace(
            run.request, t=direction * times, events=(), certify=None, max_steps=None, state=start
        )
        method = "taylor" if exact else run.method
        found = _engine.balance(asked.for_core(run.system, method), None)
        reached = len(found.net)
        all_rows = np.full((times.size, rows.shape[1]), np.nan)  # NaN: the run broke down before
        all_rows[:reached, :-2] = found.parts(rows.shape[1] - 2)
        all_rows[:reached, -2], all_rows[:reached, -1] = found.net, found.net_tails
        rows[ahead] = all_rows[place]
