"""Families of periodic orbits, by energy or by a parameter, and where their stability changes."""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from pendula._checks import extra, number_pair, one_of, whole_number
from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula.chaos.branch import Branch
from pendula.chaos.multipliers import crossings
from pendula.chaos.newton import OrbitError
from pendula.chaos.orbit import PeriodicOrbit
from pendula.chaos.roots import root

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr

    from pendula._types import Array

_MOST_ORBITS = 10**5


@dataclass(frozen=True, eq=False, repr=False)
class Change:
    """Where a family's stability changes.

    Attributes:
        value: the energy [J] or the parameter there.
        multiplier: the value that one passes there, 1 or −1.
        orbit: the orbit there.
        below: its kind at smaller values.
        above: its kind at larger values.
    """

    value: float
    multiplier: int
    orbit: PeriodicOrbit
    below: str
    above: str

    def __repr__(self) -> str:
        return f"<Change at {self.value:.12g}: {self.below} → {self.above}>"


@with_promised
@dataclass(frozen=True, eq=False, repr=False)
class Family:
    """Periodic orbits that grow out of one another.

    Attributes:
        along: "energy", or the parameter's name.
        values: of it, rising, (n,) [J or the parameter's unit].
        orbits: one for each.
        changes: of stability between them, rising. Two between neighbours are not seen: take a
            larger n.
        outcome: "reached_end", or "lost": the family ends, or turns back, before an end asked for.
        recipe: the arguments that it was made with.
    """

    along: str
    values: Array
    orbits: tuple[PeriodicOrbit, ...]
    changes: tuple[Change, ...]
    outcome: str
    recipe: Mapping[str, Any] = field(default_factory=dict)

    @property
    def n_steps(self) -> int:
        """Steps of all runs that the orbits took."""
        return sum(each.n_steps for each in self.orbits)

    def __repr__(self) -> str:
        span = f"{self.values[0]:g} … {self.values[-1]:g}" if self.orbits else "nothing"
        changes = ", ".join(f"{each.value:.10g}" for each in self.changes) or "none"
        return (
            f"<Family of {len(self.orbits)} orbits, {self.along} {span}, {self.outcome}; stability "
            f"changes at: {changes}>"
        )

    if TYPE_CHECKING:  # attached by the module that defines it

        def plot(self, *, language: str = "en") -> Any:
            """See `pendula.plot.family`."""

    def to_xarray(self) -> xr.Dataset:
        """Starts, periods, energies and multipliers over the value (extra: io)."""
        import numpy as np

        names = self.orbits[0].system.components if self.orbits else ()
        states = np.array([each.state for each in self.orbits])
        every = np.array([each.multipliers for each in self.orbits])
        data: dict[str, Any] = {
            name: (self.along, states[:, i]) for i, name in enumerate(names) if len(states)
        }
        data["period"] = (self.along, np.array([each.period for each in self.orbits]))
        data["orbit_energy"] = (self.along, np.array([each.energy for each in self.orbits]))
        data["kind"] = (self.along, np.array([each.kind for each in self.orbits]))
        data["multiplier_real"] = ((self.along, "multiplier"), every.real)
        data["multiplier_imag"] = ((self.along, "multiplier"), every.imag)
        made: xr.Dataset = extra("xarray", "io").Dataset(
            data, coords={self.along: self.values}, attrs={"outcome": self.outcome}
        )
        return made


def family(orbit: PeriodicOrbit, n: int = 50, **along: tuple[float, float]) -> Family:
    """The orbits that an orbit grows into when its energy, or a parameter of its system, changes.

    Each is predicted from two before and corrected by Newton's method, with as many in between as
    that takes. Where a multiplier passes 1 or −1, which is where stability changes, the value is
    found as a root: of μ + 1/μ ∓ 2 without a drive, of the product of (1 ∓ μ) with one.

    Args:
        orbit: to start from; symmetries that it has are kept.
        n: how many orbits, at even values.
        **along: one range (lo, hi): energy [J], or with a drive a parameter of the system, such
            as family(orbit, a=(1.0, 1.08)). The orbit's own value may lie inside or outside.

    Returns:
        The orbits, as far as the family goes, and the changes of stability.

    Raises:
        ValueError: for an argument out of range, or a family that does not reach the range.
    """
    import numpy as np

    name, (low, high) = _checked_range(orbit, along)
    count = whole_number("n", n, _MOST_ORBITS)
    targets = np.linspace(low, high, count) if count > 1 else np.array([low])
    branch = Branch(orbit, name)
    here = branch.value_of(orbit)
    up = branch.follow(orbit, targets[targets >= here])
    down = branch.follow(orbit, targets[targets < here][::-1])
    every = sorted({**dict(down), here: orbit, **dict(up)}.items())
    kept = {float(each) for each in targets}
    chosen = [(value, each) for value, each in every if value in kept]
    if not chosen:
        rule = "must reach the family of the orbit, whose own is {text}; got {value}"
        raise ArgumentError(name, rule, value=(low, high), text=f"{here:.6g}")
    inside = [(value, each) for value, each in every if low <= value <= high]
    return Family(
        name,
        np.array([value for value, _ in chosen]),
        tuple(each for _, each in chosen),
        tuple(changes_between(branch, inside)),
        "reached_end" if len({value for value, _ in chosen}) == len(kept) else "lost",
        {name: [low, high], "n": count, "orbit": dict(orbit.recipe)},
    )


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


def _checked_range(
    orbit: object, along: Mapping[str, tuple[float, float]]
) -> tuple[str, tuple[float, float]]:
    """What the family goes along, and from where to where."""
    if not isinstance(orbit, PeriodicOrbit):
        rule = "must be a periodic orbit, got {value}"
        raise ArgumentError("orbit", rule, "use <call=periodic_orbit>", value=orbit)
    known = ("energy",) if orbit.conservative else tuple(orbit.system.parameters)
    if len(along) != 1:
        rule = "must be followed along one range, got {text}"
        way_out = f"give <{known[0]}=(lo, hi)>"
        raise ArgumentError("orbit", rule, way_out, text=", ".join(along) or "none")
    ((name, span),) = along.items()
    one_of("along", name, known)
    units = {"energy": "J", **{row.name: row.unit for row in orbit.system._rows()}}
    low, high = number_pair(name, span, "must be a range (lo, hi)", units[name])
    if low > high:
        raise ArgumentError(name, "must be a rising range, got {value}", value=(low, high))
    return name, (low, high)
