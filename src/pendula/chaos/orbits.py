"""Periodic orbits, from starts that are near them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula._angles import warn_of_degrees
from pendula._checks import finite_number, positive_number
from pendula._messages import ArgumentError
from pendula.chaos.closing import Closing, Row, closings, held, phase_of, with_energy
from pendula.chaos.drive import drive_periods, is_driven
from pendula.chaos.newton import Closed, OrbitError, closed_orbit
from pendula.chaos.orbit import PeriodicOrbit, orbit_of
from pendula.run.request import check_angles, checked_state
from pendula.run.solve import solve
from pendula.systems import System, check_system

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import ArrayLike

    from pendula._types import Array

_SAME = 3e-5  # rad: orbits nearer to one another are one, found with more or fewer digits
_LONGEST = 40.0  # slow swings, within which a period is looked for
_SAMPLES = 60  # in a fast swing
_AT_REST = 0.03  # of the largest kinetic energy: nearly at rest again
_STILL = 1e-12  # rad from an equilibrium
_RETURNED = 0.05  # of the largest distance: nearly back


def periodic_orbit(
    system: System, state: ArrayLike, period: float | None = None, *, energy: float | None = None
) -> PeriodicOrbit:
    """The periodic orbit near a state, by Newton's method with the monodromy matrix.

    Without drive and friction orbits come in families. Of the one that passes through rest near a
    state at rest, θ1 is kept: (0.25, 0.3442, 0, 0) gives the orbit that is at rest at θ1 = 0.25.
    From a moving state its energy is kept, and, to say where on the orbit the start is, the first
    angle that moves. With `energy` that is the energy in both cases. With a drive the period is
    that many of the drive's.

    Args:
        system: a pendulum without friction, or with a drive that repeats itself.
        state: near the orbit, at t = 0, (d,) [rad, rad/s].
        period: about the orbit's [s]; None: when the motion first comes back nearly, or the
            drive's own.
        energy: of the orbit [J]; None: as said above. Not with a drive.

    Returns:
        The orbit, with period, multipliers and kind.

    Raises:
        ValueError: for a system without periodic orbits, an argument out of range, or a state that
            is not near an orbit.
    """
    check_system(system)
    start = checked_state(state, system)
    check_angles(system, start)
    warn_of_degrees("state", state, start[: system.can.degrees_of_freedom])
    about = None if period is None else positive_number("period", period, "s")
    wanted = None if energy is None else finite_number("energy", energy, "J")
    recipe = {"state": start.tolist(), "period": about, "energy": wanted}
    if is_driven(system):
        if wanted is not None:
            rule = "is not constant with a drive, got {value}"
            raise ArgumentError("energy", rule, "leave it out", value=wanted)
        count, span = drive_periods(system, about)
        closing, closed = best_closed(system, closings(system, start, span), (), start, span, True)
        return orbit_of(system, closing, closed, count, recipe)
    _check_conservative(system, start)
    span = about or _returned_after(system, start)
    rows = _conditions(system, start, wanted)
    closing, closed = best_closed(system, closings(system, start, span), rows, start, span, False)
    return orbit_of(system, closing, closed, None, recipe)


def best_closed(
    system: System,
    candidates: Sequence[Closing],
    rows: Sequence[Row],
    start: Array,
    period: float,
    driven: bool,
) -> tuple[Closing, Closed]:
    """The orbit nearest to the start, by the conditions of most symmetry that give it.

    Raises:
        OrbitError: where none of the conditions leads to one.
    """
    import numpy as np

    found: list[tuple[float, Closing, Closed]] = []
    for closing in candidates:
        try:
            closed = closed_orbit(system, closing, rows, start, period, driven=driven)
            if not driven:
                _check_moving(system, closed.state)
        except OrbitError:
            if closing is candidates[-1] and not found:
                raise
            continue
        found.append((float(abs(np.subtract(closed.state, start)).max()), closing, closed))
    nearest = min(found, key=lambda each: each[0])
    symmetric = found[0]
    apart = abs(symmetric[2].state - nearest[2].state).max()
    return (symmetric if apart < _SAME else nearest)[1:]


def _check_conservative(system: System, start: Array) -> None:
    """Refuse a system without orbits, and an equilibrium."""
    if not (system.can.conservative and system.can.autonomous):
        raise ArgumentError(
            "system",
            "must be without friction or have a drive, got {value}: no motion then repeats itself",
            "take friction out, or give it a drive",
            value=system,
        )
    if not system.rhs(start).any():
        rule, way_out = "is an equilibrium, {value}: it has no period", "let it move"
        raise ArgumentError("state", rule, way_out, value=start.tolist())


def _check_moving(system: System, state: Array) -> None:
    """Refuse an equilibrium, which closes after any time."""
    if abs(system.rhs(state)).max() < _STILL * system.fastest_frequency**2:
        rule = "must be near a periodic orbit: Newton's method leads to the equilibrium {value}"
        way_out = "start further from it, or give <period>"
        raise OrbitError("state", rule, way_out, value=[round(float(each), 6) for each in state])


def _conditions(system: System, start: Array, energy: float | None) -> list[Row]:
    """What else has to hold, so that of a family and of an orbit's points one is left."""
    dof = start.size // 2
    if not start[dof:].any():
        return [held(0, float(start[0])) if energy is None else with_energy(system, energy)]
    phase = phase_of(system, start)
    kept = float(system.energy(start)) if energy is None else energy
    return [held(phase, float(start[phase])), with_energy(system, kept)]


def _returned_after(system: System, start: Array) -> float:
    """When the motion first comes nearly back [s].

    Raises:
        OrbitError: where it does not.
    """
    import numpy as np

    dof = start.size // 2
    span = _LONGEST * math.tau / system.slowest_frequency
    count = math.ceil(_LONGEST * _SAMPLES * system.fastest_frequency / system.slowest_frequency)
    times = np.linspace(0.0, span, min(count, 10**5))
    states = solve(system, start, times).states
    at_rest = not start[dof:].any()
    if at_rest:
        distance, near = system.kinetic_energy(states), _AT_REST
    else:
        moved = states - start
        moved[:, :dof] = np.abs(np.mod(moved[:, :dof] + math.pi, math.tau) - math.pi)
        moved[:, dof:] /= system.fastest_frequency
        distance, near = np.hypot.reduce(moved, axis=1), _RETURNED
    low = (distance[1:-1] < distance[:-2]) & (distance[1:-1] <= distance[2:])
    places = np.flatnonzero(low & (distance[1:-1] < near * distance.max())) + 1
    if not places.size:
        rule = "must be near a periodic orbit: in {other} s the motion never comes nearly back"
        raise OrbitError("state", rule, "start nearer, or give <period>", other=f"{span:.4g}")
    return float(times[places[0]]) * (2.0 if at_rest else 1.0)
