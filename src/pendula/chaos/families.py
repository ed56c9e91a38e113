"""Families of periodic orbits, by energy or by a parameter, and where their stability changes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from pendula._checks import extra, number_pair, one_of, whole_number
from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula.chaos.branch import Branch
from pendula.chaos.changes import Change
from pendula.chaos.following import by_energy, by_parameter
from pendula.chaos.orbit import PeriodicOrbit

if TYPE_CHECKING:
    from collections.abc import Mapping

    import xarray as xr

    from pendula._types import Array

_MOST_ORBITS = 10**5


@with_promised
@dataclass(frozen=True, eq=False, repr=False)
class Family:
    """Periodic orbits that grow out of one another.

    Attributes:
        along: "energy", or the parameter's name.
        values: of it, (n,) [J or the parameter's unit]: rising, but behind a fold falling, and so
            on, in the order along the family.
        orbits: one for each.
        changes: of stability between them, in that order, the folds among them. Two between
            neighbours are not seen: take a larger n.
        outcome: "reached_end"; "turned": back before an end asked for, at a fold; or "lost": the
            family ends before, or cannot be followed.
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
    that takes. By energy that is done along the family's length, round folds (Keller 1977), and
    each energy is given as often as the family has it. Where a multiplier passes 1 or −1, which is
    where stability changes, the value is found as a root: of μ + 1/μ ∓ 2 without a drive, of the
    product of (1 ∓ μ) with one.

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
    made = by_energy if orbit.conservative else by_parameter
    chosen, changes, outcome = made(branch, [float(each) for each in targets])
    if not chosen:
        rule = "must reach the family of the orbit, whose own is {text}; got {value}"
        raise ArgumentError(name, rule, value=(low, high), text=f"{branch.value_of(orbit):.6g}")
    return Family(
        name,
        np.array([value for value, _ in chosen]),
        tuple(each for _, each in chosen),
        tuple(changes),
        outcome,
        {name: [low, high], "n": count, "orbit": dict(orbit.recipe)},
    )


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
