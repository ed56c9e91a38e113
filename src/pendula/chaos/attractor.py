"""Where a motion goes in the end at each value of a parameter, and what changes in between."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from pendula._checks import positive_number
from pendula._messages import ArgumentError
from pendula.chaos.closing import closings
from pendula.chaos.doublings import cascade
from pendula.chaos.drive import drive_period
from pendula.chaos.flow import over_span
from pendula.chaos.newton import OrbitError
from pendula.chaos.orbit import PeriodicOrbit, orbit_of
from pendula.chaos.orbits import best_closed
from pendula.chaos.section_plane import momentum2, section_starts
from pendula.chaos.sections import SURFACE, wrapped
from pendula.chaos.spectrum import exponents_of
from pendula.run.sections import poincare_section
from pendula.run.solve import solve

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula._progress import Progress
    from pendula._types import Array
    from pendula.chaos.changes import Change
    from pendula.systems import DoublePendulum, System

_MOST_PERIODS = 64
_BACK = 0.05  # rad and rad/s: points so near to an earlier one may be of an orbit
_CHUNK = 256  # periods in one run; angles are wrapped between, which keeps their digits
_SAME = 1e-9  # of a value: changes that are found from both sides


class Attractor(NamedTuple):
    """Where a motion goes in the end.

    Attributes:
        system: the pendulum.
        points: after the transient, (m, 2).
        exponents: falling, (d,) [1/s].
        standard_error: of the largest [1/s].
        period: in those of the drive; 0: not an orbit.
        orbit: that orbit; None: it is none, or was not looked for.
        n_steps: of all runs.
    """

    system: System
    points: Array
    exponents: Array
    standard_error: float
    period: int
    orbit: PeriodicOrbit | None
    n_steps: int


def at_strobes(
    systems: Sequence[System],
    state: Array,
    transient: int,
    count: int,
    follow: bool,
    progress: Progress,
) -> list[Attractor]:
    """Attractors of driven pendulums, seen once in each period of the drive.

    Args:
        systems: in the order they are taken.
        state: start, (2,).
        transient: periods left out.
        count: points kept.
        follow: whether each starts where the one before ended.
        progress: called with the part that is done.
    """
    found, start = [], state
    for i, system in enumerate(systems):
        before, steps = _strobes(system, start, transient)
        points, more = _strobes(system, before[-1], count)
        period = drive_period(system)
        spans = over_span(system, points, period)
        exponents, error = exponents_of(spans.matrices, period)
        orbit = _orbit_of(system, points) if exponents[0] < 0.0 else None
        taken = 0 if orbit is None else orbit.drive_periods or 0
        total = steps + more + spans.n_steps
        found.append(Attractor(system, points, exponents, error, taken, orbit, total))
        start = points[-1] if follow else state
        if progress is not None:
            progress((i + 1) / len(systems))
    return found


def _strobes(system: System, state: Array, count: int) -> tuple[Array, int]:
    """States after 1, 2, … periods of the drive, angles wrapped, (count, 2); steps.

    With a count of 0 the start alone.
    """
    import numpy as np

    period, kept, steps = drive_period(system), [state[np.newaxis]], 0
    for first in range(0, count, _CHUNK):
        times = period * np.arange(min(_CHUNK, count - first) + 1)
        run = solve(system, kept[-1][-1], times)
        if run.outcome != "reached_end":
            rule = "must be one with which runs come to their end: {text} for {value}"
            raise ArgumentError("values", rule, value=system, text=run.outcome)
        states = run.states[1:].copy()
        states[:, 0] = wrapped(states[:, 0])
        kept.append(states)
        steps += run.n_steps
    return np.concatenate(kept[1:] or kept), steps


def _orbit_of(system: System, points: Array) -> PeriodicOrbit | None:
    """The stable orbit that the points end on; None: there is none up to 64 periods."""
    last = points[-1]
    for periods in range(1, min(_MOST_PERIODS, len(points) - 1) + 1):
        apart = points[-1 - periods] - last
        apart[0] = wrapped(apart[0])
        if abs(apart).max() > _BACK:
            continue
        span = periods * drive_period(system)
        try:
            known = closings(system, last, span)
            closing, closed = best_closed(system, known, (), last, span, True)
            orbit = orbit_of(system, closing, closed, periods, {"state": closed.state.tolist()})
        except OrbitError:
            continue
        if orbit.stable and abs(orbit.state - last).max() < _BACK:
            return orbit
    return None


def changes_over(found: Sequence[Attractor], parameter: str) -> list[Change]:
    """Changes of stability between neighbouring values, rising.

    From the orbit of the shorter period, or of more symmetry, towards the other value: doublings
    and the breaking of a symmetry lead away from it.
    """
    changes: list[Change] = []
    for one, other in pairwise(found):
        orbits = [each.orbit for each in (one, other) if each.orbit is not None]
        if not orbits:
            continue
        first = min(orbits, key=lambda each: (each.drive_periods or 0, each.symmetry != "odd"))
        away = other if first is one.orbit else one
        end = away.system.parameters[parameter]
        if end == first.system.parameters[parameter]:
            continue
        for change in cascade(first, parameter, end, _MOST_PERIODS):
            if all(abs(change.value - each.value) > _SAME * abs(each.value) for each in changes):
                changes.append(change)
    return sorted(changes, key=lambda each: each.value)


def on_section(
    system: DoublePendulum,
    parameter: str,
    values: Array,
    energy: float | None,
    start: tuple[float, float],
    count: int,
    progress: Progress,
) -> list[Attractor]:
    """Motions of double pendulums at their crossings of θ1 = 0, ω1 > 0.

    Args:
        system: with all but the parameter.
        parameter: its name, or "energy".
        values: of it, (n,).
        energy: of the motions, where it is not the parameter [J].
        start: (θ2, p2) on the section.
        count: crossings kept.
        progress: called with the part that is done.
    """
    if (energy is None) != (parameter == "energy"):
        rule = "must be given, unless it is the <parameter>"
        raise ArgumentError("energy", rule)
    found = []
    for i, value in enumerate(values.tolist()):
        one, total = system, value
        if energy is not None:
            one = type(system).of_form(system.form, {**system.parameters, parameter: value})
            total = positive_number("energy", energy, "J")
        found.append(_of_motion(one, section_starts(one, total, *start), count))
        if progress is not None:
            progress((i + 1) / values.size)
    return found


def _of_motion(system: DoublePendulum, start: Array, count: int) -> Attractor:
    """The crossings of one motion, and the exponents along it."""
    import numpy as np

    crossings = poincare_section(system, start, SURFACE, count)
    points = np.stack(
        [wrapped(crossings.states[:, 1]), momentum2(system, crossings.states)], axis=-1
    )
    spans = max(count, int(np.ceil(crossings.times[-1] * system.fastest_frequency)))
    span = float(crossings.times[-1]) / spans
    run = solve(system, start, span * np.arange(spans))
    steps = over_span(system, run.states, span)
    exponents, error = exponents_of(steps.matrices, span)
    total = 2 * run.n_steps + steps.n_steps
    return Attractor(system, points, exponents, error, 0, None, total)
