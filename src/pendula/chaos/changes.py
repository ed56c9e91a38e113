"""Where the stability of a family of periodic orbits changes."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

from pendula.chaos.branch import Branch
from pendula.chaos.multipliers import crossings
from pendula.chaos.newton import OrbitError
from pendula.chaos.orbit import PeriodicOrbit
from pendula.chaos.roots import root


@dataclass(frozen=True, eq=False, repr=False)
class Change:
    """Where a family's stability changes.

    Attributes:
        value: the energy [J] or the parameter there.
        multiplier: the value that one passes there, 1 or −1.
        orbit: the orbit there.
        below: its kind at smaller values; at a fold, before it along the family.
        above: its kind at larger values; at a fold, behind it.
        fold: whether the family turns there, and has no orbits beyond.
        place: how many of the family's orbits come before it.
    """

    value: float
    multiplier: int
    orbit: PeriodicOrbit
    below: str
    above: str
    fold: bool = False
    place: int = 0

    def __repr__(self) -> str:
        what = "Fold" if self.fold else "Change"
        return f"<{what} at {self.value:.12g}: {self.below} → {self.above}>"


def changes_between(branch: Branch, known: list[tuple[float, PeriodicOrbit]]) -> list[Change]:
    """Changes of stability between neighbours on a branch, located.

    Args:
        branch: that they are on.
        known: values, rising, and orbits.
    """
    found = []
    for (low, before), (high, after) in pairwise(known):
        at_low = crossings(before.monodromy, conservative=before.conservative)
        at_high = crossings(after.monodromy, conservative=after.conservative)
        for name, value in at_low.items():
            if value * at_high[name] < 0.0 and low < high:
                ends = (low, before), (high, after)
                found.append(_located(branch, name, ends, (value, at_high[name])))
    return sorted((each for each in found if each is not None), key=lambda each: each.value)


def _located(
    branch: Branch,
    name: str,
    ends: tuple[tuple[float, PeriodicOrbit], tuple[float, PeriodicOrbit]],
    values: tuple[float, float],
) -> Change | None:
    """The change where a function of the multipliers has its root; None: no orbit leads there."""
    known = dict(ends)
    (low, before), (high, after) = ends

    def function(value: float) -> float:
        orbit = branch.between(sorted(known.items()), value)
        known[value] = orbit
        return crossings(orbit.monodromy, conservative=orbit.conservative)[name]

    try:
        place = root(function, low, high, *values)
    except OrbitError:
        return None
    return Change(place, int(name), known[place], before.kind, after.kind)
