"""Families of periodic orbits followed by their length, round folds (Keller 1977)."""

from __future__ import annotations

import math
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from pendula.chaos.closing import across, held, phase_of
from pendula.chaos.newton import OrbitError, closed_orbit
from pendula.chaos.orbit import PeriodicOrbit, orbit_of
from pendula.chaos.roots import root

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from pendula._types import Array
    from pendula.chaos.branch import Branch
    from pendula.chaos.closing import Row

# Of a step: radians, velocities over the first orbit's frequency, periods over its own
_FIRST, _LONGEST, _SHORTEST, _GROWTH = 0.01, 0.15, 1e-7, 1.5
_BEND, _TURN = 0.02, 0.25  # by which an orbit may miss its place, and as a part of the step
_PERIODS = 12.0  # of the first orbit: a family with longer ones ends at an equilibrium
_LARGEST = 1e11  # of multipliers: those of 1 have no more than four digits beside larger ones
_STEEP = 1.5  # times the way between two energies asked for, which a step goes at most


class Path(NamedTuple):
    """Orbits in their order along a family.

    Attributes:
        orbits: from the second on.
        ended: "left": the energies asked for; "closed": on itself; "lost": there is no further one.
    """

    orbits: list[PeriodicOrbit]
    ended: str


class Arc:
    """A family of orbits without a drive, by its length.

    On the plane across the chord through two of them the family has no fold: that plane takes the
    place of the energy in Newton's method (Keller 1977, "Numerical solution of bifurcation and
    nonlinear eigenvalue problems").
    """

    def __init__(self, branch: Branch) -> None:
        import numpy as np

        self.branch, start = branch, branch.template
        dof = start.state.size // 2
        rate = math.tau / start.period
        self.units: Array = np.repeat([1.0, rate, start.period], [dof, dof, 1])

    def place(self, orbit: PeriodicOrbit) -> Array:
        """Start and period in units of their steps, (d+1,)."""
        import numpy as np

        return np.append(orbit.state, orbit.period) / self.units

    def orbit(self, place: Array, direction: Array) -> PeriodicOrbit:
        """The orbit on the plane through a place across a direction, both (d+1,).

        Raises:
            OrbitError: where there is none near.
        """
        one, system = self.branch.template, self.branch.template.system
        there = place * self.units
        state, period = there[:-1], float(there[-1])
        rows: list[Row] = [across(direction / self.units, state, period)]
        if one.symmetry in ("none", "odd"):
            phase = phase_of(system, state)
            rows.append(held(phase, float(state[phase])))
        closed = closed_orbit(system, one.closing, rows, state, period)
        recipe = {"state": closed.state.tolist(), "period": closed.period}
        return orbit_of(system, one.closing, closed, None, recipe)

    def between(self, before: PeriodicOrbit, after: PeriodicOrbit, share: float) -> PeriodicOrbit:
        """The orbit across the chord of two neighbours, at a share of it.

        Raises:
            OrbitError: where there is none near.
        """
        here, there = self.place(before), self.place(after)
        return self.orbit(here + share * (there - here), there - here)

    def where(
        self,
        before: PeriodicOrbit,
        after: PeriodicOrbit,
        function: Callable[[PeriodicOrbit], float],
    ) -> PeriodicOrbit:
        """The orbit between neighbours at which a function of orbits has its root.

        Raises:
            OrbitError: where there is none near.
        """
        known = {0.0: before, 1.0: after}

        def at(share: float) -> float:
            known[share] = self.between(before, after, share)
            return function(known[share])

        return known[root(at, 0.0, 1.0, function(before), function(after))]

    def follow(self, way: float, ends: tuple[float, float], most: int) -> Path:
        """The orbits that follow the first one, until their energy is beyond the ends.

        Args:
            way: how far apart in energy they may be; positive: more of it comes first [J].
            ends: the range of energies [J].
            most: how many orbits.
        """
        found, length = [self.branch.template], _FIRST
        try:
            found.append(self._second(way))
        except OrbitError:
            return Path([], "lost")
        while len(found) <= most:
            if not ends[0] <= found[-1].energy <= ends[1]:
                return Path(found[1:], "left")
            there = self._next(found[-2], found[-1], length, abs(way))
            if there is None or there.period > _PERIODS * found[0].period:
                break
            if abs(there.multiplier_sum) > _LARGEST:
                break
            length = min(_GROWTH * _distance(self.place(there), self.place(found[-1])), _LONGEST)
            found.append(there)
            if self._closed(found):
                return Path(found[1:-1], "closed")
        return Path(found[1:], "lost")

    def _second(self, way: float) -> PeriodicOrbit:
        """An orbit with a little more energy than the first, or less."""
        first, change = self.branch.template, 0.1 * way
        while True:
            try:
                found = self.branch.orbit(first.energy + change, first.state, first.period)
                if _distance(self.place(found), self.place(first)) < _LONGEST:
                    return found
            except OrbitError:
                if abs(change) < 1e-6 * abs(way):
                    raise
            change /= 4.0

    def _next(
        self, before: PeriodicOrbit, here: PeriodicOrbit, step: float, way: float
    ) -> PeriodicOrbit | None:
        """The orbit a step further on, or less; None: there is none."""
        start = self.place(here)
        direction = start - self.place(before)
        direction = direction / _distance(start, self.place(before))
        while step > _SHORTEST:
            place = start + step * direction
            try:
                found = self.orbit(place, direction)
            except OrbitError:
                step /= 2.0
                continue
            near = _distance(self.place(found), place) < min(_BEND, _TURN * step)
            if near and abs(found.energy - here.energy) < _STEEP * way:
                return None if _mirrored(here, found) else found
            step /= 2.0
        return None

    def _closed(self, found: Sequence[PeriodicOrbit]) -> bool:
        """Whether the last orbit's step went past the first."""
        if len(found) < 4:
            return False
        first, last, before = (self.place(each) for each in (found[0], found[-1], found[-2]))
        return max(_distance(first, last), _distance(first, before)) < _distance(last, before)


def energies_crossed(
    arc: Arc, path: Sequence[PeriodicOrbit], targets: Sequence[float]
) -> list[tuple[int, float, PeriodicOrbit]]:
    """The orbits of given energies along a path, as often as it has them.

    Args:
        arc: the family.
        path: neighbours, in order.
        targets: energies [J].

    Returns:
        Of each the place of its neighbour before in the path, its energy, and the orbit.
    """
    found = []
    for i, (before, after) in enumerate(pairwise(path)):
        low, high = sorted((before.energy, after.energy))
        inside = [each for each in targets if low < each < high]
        for target in inside if after.energy > before.energy else inside[::-1]:
            try:
                ends = [(before.energy, before), (after.energy, after)]
                found.append((i, target, arc.branch.between(ends, target)))
            except OrbitError:  # beside a fold, where the line between the two is far away
                found.append((i, target, arc.where(before, after, partial(_beyond, target))))
    found += [(i, each.energy, each) for i, each in enumerate(path) if each.energy in targets]
    return sorted(found, key=lambda each: (each[0], abs(each[1] - path[each[0]].energy)))


def _beyond(energy: float, orbit: PeriodicOrbit) -> float:
    return orbit.energy - energy


def _distance(place: Array, other: Array) -> float:
    import numpy as np

    return float(np.hypot.reduce(place - other))


def _mirrored(before: PeriodicOrbit, after: PeriodicOrbit) -> bool:
    """Whether the way between two led through an equilibrium, to mirror images of the family."""
    import numpy as np

    if before.symmetry not in ("odd", "brake, odd"):
        return False
    middle = np.zeros(before.state.size)
    if before.symmetry == "brake, odd":
        middle[: middle.size // 2] = before.closing.offset
    return float((before.state - middle) @ (after.state - middle)) < 0.0
