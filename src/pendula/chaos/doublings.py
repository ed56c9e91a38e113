"""Cascades of period doublings, each found as a root of its orbit's multipliers."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING

from pendula._checks import finite_number, one_of, whole_number
from pendula._messages import ArgumentError
from pendula.chaos.branch import Branch
from pendula.chaos.changes import Change, changes_between
from pendula.chaos.closing import Closing
from pendula.chaos.drive import drive_period
from pendula.chaos.newton import Closed, OrbitError
from pendula.chaos.orbit import PeriodicOrbit, orbit_of
from pendula.run.solve import solve

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.systems import System

_MOST_PERIODS = 4096  # of the drive, in one of the orbit
_ASIDE = 1e-3, 1e-6  # rad: how far beside the old orbit the doubled one is taken; at least so far
_YOUNG = 0.5  # how far from 1, which it is born with, the doubled orbit's multiplier may be
_MOST_ITERATIONS = 30
_GROWTH, _LONGEST = 1.5, 0.05  # of steps, each over the last; of the longest, over the whole way


def period_doublings(
    orbit: PeriodicOrbit, parameter: str, to: float, *, periods: int = 64
) -> tuple[Change, ...]:
    """The changes of stability of an orbit, and of the orbits that it doubles into.

    The orbit is followed towards a value of a parameter up to where a multiplier passes −1; there
    the doubled orbit is taken up, and so on. At a doubling that orbit grows as the root of the way,
    so it is solved for at a distance from the old one, with the parameter unknown (Keller 1977).

    Args:
        orbit: of a driven pendulum.
        parameter: of its system.
        to: value up to which orbits are followed.
        periods: of the drive, in the longest orbit that is followed.

    Returns:
        The changes, in the order in which they are met: doublings, and others on the way.

    Raises:
        ValueError: for an orbit without a drive, or an argument out of range.
    """
    if not isinstance(orbit, PeriodicOrbit) or orbit.drive_periods is None:
        rule = "must be a periodic orbit of a driven pendulum, got {value}"
        raise ArgumentError("orbit", rule, "use <call=periodic_orbit>", value=orbit)
    name = one_of("parameter", parameter, orbit.system.parameters)
    end = finite_number("to", to)
    return tuple(cascade(orbit, name, end, whole_number("periods", periods, _MOST_PERIODS)))


def cascade(orbit: PeriodicOrbit, name: str, end: float, periods: int) -> list[Change]:
    """The changes on the way to a value, of checked arguments."""
    found: list[Change] = []
    here: PeriodicOrbit | None = orbit
    way, first = end - orbit.system.parameters[name], 0.0
    while here is not None and here.drive_periods is not None and here.drive_periods <= periods:
        branch = Branch(here, name)
        met = _followed(branch, end, first or 0.01 * way, way)
        found += met
        doubling = next((each for each in met if each.multiplier == -1), None)
        if doubling is None:
            break
        here = doubled(branch, doubling)
        if here is not None:
            first = _GROWTH * (branch.value_of(here) - doubling.value)
            if first * way <= 0.0:  # the doubled orbit goes back, beside the stable old one
                break
    return found


def _followed(branch: Branch, end: float, first: float, way: float) -> list[Change]:
    """Changes on a branch, up to and with the first doubling, in the order they are met."""
    known = [(branch.value_of(branch.template), branch.template)]
    found: list[Change] = []
    step = first
    while known[-1][0] != end:
        left = end - known[-1][0]
        target = end if abs(step) >= abs(left) else known[-1][0] + step
        more = branch.follow_on(known, target)
        if not more:
            break
        for before, after in pairwise([known[-1], *more]):
            met = changes_between(branch, sorted([before, after], key=lambda each: each[0]))
            found += met if way > 0 else met[::-1]
        known += more
        if any(each.multiplier == -1 for each in found) or known[-1][0] != target:
            break
        step = math.copysign(min(_GROWTH * abs(step), _LONGEST * abs(way)), way)
    return found


def doubled(branch: Branch, change: Change) -> PeriodicOrbit | None:
    """The orbit of twice the period that branches off at a doubling; None: it was not found.

    Args:
        branch: of the orbit that doubles.
        change: where it does.
    """
    import numpy as np

    old = change.orbit
    assert old.drive_periods is not None
    values, vectors = np.linalg.eig(old.monodromy)
    aside = vectors[:, int(abs(values + 1.0).argmin())].real
    aside = aside / np.hypot.reduce(aside)
    d = old.state.size
    turns = np.append(2.0 * math.tau * np.array(old.turns), np.zeros(d // 2))
    closing = Closing("none", 1.0, np.eye(d), -np.eye(d), turns, tuple(range(d)))
    twice = 2 * old.drive_periods
    size = _ASIDE[0]
    while size > _ASIDE[1]:
        found = _beside(branch, closing, twice, old, change.value, size * aside)
        if found is not None:
            value, closed = found
            recipe = {"state": closed.state.tolist(), "period": closed.period}
            orbit = orbit_of(branch.system_at(value), closing, closed, twice, recipe)
            if abs(orbit.multipliers[0].real - 1.0) < _YOUNG:  # or it has doubled itself by now
                return orbit
        size /= 2.0
    return None


def _beside(
    branch: Branch, closing: Closing, periods: int, old: PeriodicOrbit, value: float, aside: Array
) -> tuple[float, Closed] | None:
    """The doubled orbit so far beside the old one, and the parameter at which it is there."""
    import numpy as np

    x, start = old.state + aside, value
    size = float(np.hypot.reduce(aside))
    total = 0
    for iteration in range(1, _MOST_ITERATIONS + 1):
        system = branch.system_at(value)
        try:
            end, matrix, steps = _with_parameter(system, branch, x, periods)
        except OrbitError:
            return None
        total += steps
        miss = np.append(end - x - closing.offset, aside @ (x - old.state - aside) / size)
        slope = np.zeros((x.size + 1, x.size + 1))
        slope[:-1] = matrix
        slope[:-1, :-1] -= np.eye(x.size)
        slope[-1, :-1] = aside / size
        step = np.linalg.lstsq(slope, -miss, rcond=None)[0]
        x, value = x + step[:-1], value + float(step[-1])
        moved = abs(step[:-1]).max()
        if not moved < 0.5 or abs(value - start) > 0.1 * abs(start) + size:
            return None
        if moved < 1e-10:
            return value, Closed(x, periods * drive_period(system), moved, iteration, total)
    return None


def _with_parameter(
    system: System, branch: Branch, state: Array, periods: int
) -> tuple[Array, Array, int]:
    """The state after so many periods, its derivatives by start and parameter (d, d+1), steps."""
    import numpy as np

    period, value = periods * drive_period(system), system.parameters[branch.along]
    names = (*system.components, branch.along)
    run = solve(system, state, [period], derivatives=names)
    if run.outcome != "reached_end" or run.derivatives is None:
        raise OrbitError("state", "must be near a periodic orbit, got {value}", value=state)
    matrix = run.derivatives[-1].copy()
    # the drive's period may change with the parameter: a difference will do for Newton's steps
    near = 1e-6 * max(abs(value), 1e-3)
    late, early = (drive_period(branch.system_at(value + each)) for each in (near, -near))
    by_period = system.rhs(run.states[-1], period) * (periods * (late - early) / (2.0 * near))
    matrix[:, -1] += np.asarray(by_period)
    return run.states[-1], matrix, run.n_steps
