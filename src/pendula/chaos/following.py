"""A family's orbits at given values, with its changes of stability: by energy, by a parameter."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from pendula.chaos.arc import Arc, energies_crossed
from pendula.chaos.changes import Change, changes_between
from pendula.chaos.multipliers import crossings
from pendula.chaos.newton import OrbitError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula.chaos.branch import Branch, Known
    from pendula.chaos.orbit import PeriodicOrbit

_MOST_STEPS = 4000  # of a family along its length, and as many as orbits are asked for
_ALIKE = 1e-12  # of an energy: a fold's is beyond those of its neighbours by more


class Followed(NamedTuple):
    """Values with orbits and changes, in the order along the family, and how it ended."""

    orbits: list[Known]
    changes: list[Change]
    outcome: str


def by_parameter(branch: Branch, targets: Sequence[float]) -> Followed:
    """The orbits at rising values of a parameter, from that of the branch's own on both ways."""
    orbit = branch.template
    here = branch.value_of(orbit)
    up = branch.follow(orbit, [each for each in targets if each >= here])
    down = branch.follow(orbit, [each for each in targets if each < here][::-1])
    every = sorted({**dict(down), here: orbit, **dict(up)}.items())
    chosen = [(value, each) for value, each in every if value in targets]
    inside = [(value, each) for value, each in every if targets[0] <= value <= targets[-1]]
    changes = [
        replace(each, place=sum(value < each.value for value, _ in chosen))
        for each in changes_between(branch, inside)
    ]
    whole = len({value for value, _ in chosen}) == len(set(targets))
    return Followed(chosen, changes, "reached_end" if whole else "lost")


def by_energy(branch: Branch, targets: Sequence[float]) -> Followed:
    """The orbits at rising energies, as often as the family has each, by its length."""
    orbit, arc = branch.template, Arc(branch)
    low, high, here = targets[0], targets[-1], orbit.energy
    way = (high - low) / max(1, len(targets) - 1) or abs(high - here) or here
    most = _MOST_STEPS + len(targets)
    ends = min(low, here), max(high, here)
    ways, path = [], [orbit]
    if here <= high:
        ways.append(arc.follow(way, ends, most))
        path = [*path, *ways[-1].orbits]
    if here > low and not (ways and ways[-1].ended == "closed"):
        ways.append(arc.follow(-way, ends, most))
        path = [*ways[-1].orbits[::-1], *path]
    changes = _changes(arc, path)
    whole = [*path]
    for i, change in reversed(changes):
        whole.insert(i + 1, change.orbit)
    found = energies_crossed(arc, whole, targets)
    placed = [
        replace(change, place=sum(at < i + 1 + before for at, _, _ in found))
        for before, (i, change) in enumerate(changes)
        if low <= change.value <= high
    ]
    outcome = "reached_end"
    if {value for _, value, _ in found} != set(targets):
        outcome = "lost" if "lost" in [each.ended for each in ways] else "turned"
    return Followed([(value, each) for _, value, each in found], placed, outcome)


def _changes(arc: Arc, path: Sequence[PeriodicOrbit]) -> list[tuple[int, Change]]:
    """The changes of stability along a path, each with the place of its neighbour before."""
    found = []
    for i, (before, after) in enumerate(pairwise(path)):
        for name in ("+1", "-1"):
            if _crossing(name, before) * _crossing(name, after) >= 0.0:
                continue
            try:
                there = arc.where(before, after, partial(_crossing, name))
            except OrbitError:
                continue
            low, high = sorted([before, after], key=lambda each: each.energy)
            fold = not low.energy * (1.0 - _ALIKE) <= there.energy <= high.energy * (1.0 + _ALIKE)
            first, last = (before, after) if fold else (low, high)
            found.append((i, Change(there.energy, int(name), there, first.kind, last.kind, fold)))
    return found


def _crossing(name: str, orbit: PeriodicOrbit) -> float:
    return crossings(orbit.monodromy, conservative=True)[name]
