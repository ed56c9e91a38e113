"""A branch of periodic orbits: followed along energy or a parameter."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pendula.chaos.closing import held, phase_of, with_energy
from pendula.chaos.drive import drive_period
from pendula.chaos.newton import OrbitError, closed_orbit
from pendula.chaos.orbit import PeriodicOrbit, orbit_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pendula._types import Array
    from pendula.chaos.closing import Row
    from pendula.systems import System

Known = tuple[float, PeriodicOrbit]

_FIRST = 0.1  # of the way to the first value: nothing is known yet of where the orbits go
_SHORTEST = 1e-5  # of the way to a value; the branch is lost there
_FURTHEST = -4.0  # times the way between two orbits, that the line through them is followed
_BEND = 0.05  # rad, or of the frequency: how far an orbit may be from where it is looked for


@dataclass(frozen=True)
class Branch:
    """A branch of orbits, all closed by the same conditions.

    Attributes:
        template: an orbit on it.
        along: "energy", or the name of a parameter.
    """

    template: PeriodicOrbit
    along: str

    def value_of(self, orbit: PeriodicOrbit) -> float:
        """The orbit's energy or parameter."""
        return orbit.energy if self.along == "energy" else orbit.system.parameters[self.along]

    def system_at(self, value: float) -> System:
        """The system there."""
        system = self.template.system
        if self.along == "energy":
            return system
        return type(system).of_form(system.form, {**system.parameters, self.along: value})

    def orbit(self, value: float, state: Array, period: float) -> PeriodicOrbit:
        """The branch's orbit at a value.

        Args:
            value: energy [J] or parameter.
            state: near it, (d,).
            period: about its own; with a drive that gives it [s].

        Raises:
            OrbitError: where there is none near.
        """
        one, system = self.template, self.system_at(value)
        rows: list[Row] = []
        driven = one.drive_periods is not None
        if one.drive_periods is not None:
            period = one.drive_periods * drive_period(system)
        else:
            rows.append(with_energy(system, value))
        if one.symmetry in ("none", "odd") and not driven:
            phase = phase_of(system, state)
            rows.append(held(phase, float(state[phase])))
        closed = closed_orbit(system, one.closing, rows, state, period, driven=driven)
        recipe = {"state": closed.state.tolist(), "period": closed.period}
        return orbit_of(system, one.closing, closed, one.drive_periods, recipe)

    def follow(self, start: PeriodicOrbit, targets: Iterable[float]) -> list[Known]:
        """Orbits at values further and further away, and at those in between that were needed.

        Args:
            start: the orbit to begin with.
            targets: in order.

        Returns:
            Values and orbits, without the start, up to where the branch is lost.
        """
        known: list[Known] = [(self.value_of(start), start)]
        for target in map(float, targets):
            known += self.follow_on(known, target)
            if known[-1][0] != target:
                break
        return known[1:]

    def follow_on(self, known: Sequence[Known], target: float) -> list[Known]:
        """Orbits further on, up to one at a value, unless the branch is lost before.

        Args:
            known: values and orbits so far, of which the last two say where it goes.
            target: a value beyond.
        """
        found, way = list(known[-2:]), target - known[-1][0]
        if way == 0.0:
            return [known[-1]]
        step = way if len(found) > 1 else _FIRST * way
        while found[-1][0] != target:
            left = target - found[-1][0]
            value = target if abs(step) >= abs(left) else found[-1][0] + step
            try:
                found.append((value, self.between(found[-2:], value)))
                step *= 2.0
            except OrbitError:
                step = 0.5 * (value - found[-1][0])
                if abs(step) < _SHORTEST * abs(way):
                    break
        return found[len(known[-2:]) :]

    def between(self, known: Sequence[Known], value: float) -> PeriodicOrbit:
        """The orbit at a value, looked for on the line through known ones, on either side of it.

        Raises:
            OrbitError: where there is none, or one that is elsewhere.
        """
        import numpy as np

        nearest = sorted(known, key=lambda each: abs(each[0] - value))
        first, one = nearest[0]
        across = [each for each in nearest[1:] if (each[0] - value) * (first - value) < 0.0]
        second, other = (across or nearest[1:] or nearest)[0]
        share = (value - first) / (second - first) if second != first else 0.0
        share = max(share, _FURTHEST)
        state = one.state + share * (other.state - one.state)
        found = self.orbit(value, state, one.period + share * (other.period - one.period))
        dof = state.size // 2
        off = abs(found.state - state) / np.repeat([1.0, math.tau / found.period], dof)
        if off.max() > _BEND:
            rule = "must be near the branch: Newton's method leads {value} rad away from it"
            raise OrbitError("state", rule, value=float(off.max()))
        return found
