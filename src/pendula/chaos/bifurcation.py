"""Bifurcation pictures: where motions go in the end, over a parameter."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from pendula._checks import (
    checked_progress,
    extra,
    finite_array,
    flag,
    number_pair,
    one_of,
    whole_number,
)
from pendula._late_methods import with_promised
from pendula._messages import ArgumentError
from pendula._progress import with_bar
from pendula.chaos.attractor import Attractor, at_strobes, changes_over, on_section
from pendula.chaos.drive import is_driven
from pendula.run.request import checked_state
from pendula.systems import DoublePendulum, System, check_system

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    import xarray as xr
    from numpy.typing import ArrayLike, NDArray

    from pendula._progress import AskedProgress
    from pendula._types import Array
    from pendula.chaos.changes import Change

_MOST_VALUES, _MOST_POINTS, _LEAST_POINTS = 10**6, 10**6, 32
_MOST_TRANSIENT = 10**7


@with_promised
@dataclass(frozen=True, eq=False, repr=False)
class Bifurcation:
    """Where motions go in the end, over a parameter.

    Attributes:
        system: the pendulum, with a value of the parameter that was not used.
        parameter: its name.
        values: of it, in the order they were taken, (n,).
        points: of the motion after the transient, (n, m, 2): (θ, ω) of one bob at each period of
            its drive, (θ2, p2) of a double pendulum on its section; angles from −π to π.
        exponents: all Lyapunov exponents, falling, (n, d) [1/s].
        standard_errors: of the largest, from sixteen blocks, (n,) [1/s].
        periods: of the attractor, in those of the drive, (n,); 0: none up to 64 was found.
        changes: of stability between values, rising, located by multipliers.
        n_steps: steps at each value, (n,).
        recipe: the arguments that it was made with.
    """

    system: System
    parameter: str
    values: Array
    points: Array
    exponents: Array
    standard_errors: Array
    periods: NDArray[np.int64]
    changes: tuple[Change, ...]
    n_steps: NDArray[np.int64]
    recipe: Mapping[str, Any] = field(default_factory=dict)

    @property
    def doublings(self) -> tuple[Change, ...]:
        """The changes at which a multiplier passes −1: period doublings."""
        return tuple(each for each in self.changes if each.multiplier == -1)

    def __repr__(self) -> str:
        return (
            f"<Bifurcation of {self.system!r} over {self.values.size} values of {self.parameter}, "
            f"{self.points.shape[1]} points each, {len(self.doublings)} period doublings>"
        )

    if TYPE_CHECKING:  # attached by the module that defines it

        def plot(self, *, language: str = "en") -> Any:
            """See `pendula.plot.bifurcation`."""

    def to_xarray(self) -> xr.Dataset:
        """Points, exponents and periods over the parameter (extra: io)."""
        names = ("theta2", "p2") if self.exponents.shape[1] == 4 else ("theta", "omega")
        data: dict[str, Any] = {
            name: ((self.parameter, "point"), self.points[..., i]) for i, name in enumerate(names)
        }
        data["exponent"] = ((self.parameter, "order"), self.exponents, {"units": "1/s"})
        data["standard_error"] = (self.parameter, self.standard_errors, {"units": "1/s"})
        data["period"] = (self.parameter, self.periods)
        data["n_steps"] = (self.parameter, self.n_steps)
        data["multiplier"] = ("change", [each.multiplier for each in self.changes])
        changes = [each.value for each in self.changes]
        coordinates = {self.parameter: self.values, "change": changes}
        made: xr.Dataset = extra("xarray", "io").Dataset(data, coords=coordinates)
        return made


@with_bar("bifurcation")
def bifurcation(
    system: System,
    parameter: str,
    values: ArrayLike,
    *,
    state: ArrayLike | None = None,
    points: int = 200,
    transient: int = 300,
    follow: bool = True,
    energy: float | None = None,
    section: tuple[float, float] = (0.0, 0.0),
    changes: bool = True,
    progress: AskedProgress = None,
) -> Bifurcation:
    """Where motions go in the end, over values of a parameter.

    A driven pendulum is looked at once in each period of its drive. Its exponents come from the
    matrices of these periods; where the attractor is an orbit of up to 64 of them, changes of
    stability between neighbouring values are found as roots of the orbit's multipliers, in
    cascades where a value lies several doublings on. A double pendulum is looked at where θ1 = 0,
    ω1 > 0; it has no attractors, and the points are those of one motion at each value.

    Args:
        system: a driven or a double pendulum; its own value of the parameter is not used.
        parameter: its name, or "energy" for a double pendulum.
        values: in the order in which they are taken, (n,): a rising one and a falling one may
            follow different attractors.
        state: start at the first value, or with follow=False at each, (θ, ω) of a driven pendulum
            at phase 0 of its drive; None: at rest at the bottom [rad, rad/s].
        points: at each value, after the transient; at least 32.
        transient: periods that are left out before them; not with a double pendulum.
        follow: whether each value starts where the one before ended.
        energy: of a double pendulum's motions [J].
        section: (θ2, p2) where a double pendulum's motions start [rad, kg m²/s].
        changes: whether changes of stability are located.
        progress: called with the part of the values that is done, 0 to 1; True: a bar.

    Returns:
        Points, exponents, periods and changes of stability.

    Raises:
        ValueError: for another system, or an argument out of range.
    """
    check_system(system)
    report = checked_progress(progress)
    double = isinstance(system, DoublePendulum)
    one_of("parameter", parameter, (*(("energy",) if double else ()), *system.parameters))
    units = {"energy": "J", **{row.name: row.unit for row in system._rows()}}
    taken = _checked_values(values, units[parameter])
    count = _checked_points(points)
    left_out = 0 if transient == 0 else whole_number("transient", transient, _MOST_TRANSIENT)
    followed, located = flag("follow", follow), flag("changes", changes)
    recipe: dict[str, Any] = {"points": count, "transient": left_out, "follow": followed}
    if isinstance(system, DoublePendulum):
        start = number_pair("section", section, "must be (theta2, p2)", "")
        found = on_section(system, parameter, taken, energy, start, count, report)
        recipe = {"points": count, "energy": energy, "section": list(start)}
        return _collected(system, parameter, taken, found, (), recipe)
    first = checked_state([0.0, 0.0] if state is None else state, system)
    systems = [
        type(system).of_form(system.form, {**system.parameters, parameter: value})
        for value in taken.tolist()
    ]
    for each in systems:
        _check_driven(each)
    found = at_strobes(systems, first, left_out, count, followed, report)
    met = changes_over(found, parameter) if located else []
    return _collected(system, parameter, taken, found, met, {**recipe, "state": first.tolist()})


def _collected(
    system: System,
    parameter: str,
    values: Array,
    found: list[Attractor],
    changes: Any,
    recipe: dict[str, Any],
) -> Bifurcation:
    """The attractors at all values as arrays."""
    import numpy as np

    return Bifurcation(
        system,
        parameter,
        values,
        np.array([each.points for each in found]),
        np.array([each.exponents for each in found]),
        np.array([each.standard_error for each in found]),
        np.array([each.period for each in found], np.int64),
        tuple(changes),
        np.array([each.n_steps for each in found], np.int64),
        {"parameter": parameter, "values": values.tolist(), **recipe},
    )


def _check_driven(system: System) -> None:
    """Refuse a system that is not one bob with a drive."""
    if not is_driven(system):
        raise ArgumentError(
            "system",
            "must be a driven or a double pendulum at every value, got {value}",
            "give it a drive",
            value=system,
        )


def _checked_values(values: ArrayLike, unit: str) -> Array:
    """The values, (n,)."""
    taken = finite_array("values", values, unit)
    if taken.ndim != 1 or not 1 <= taken.size <= _MOST_VALUES:
        rule = f"must hold from 1 to {_MOST_VALUES} values, got shape {{value}}"
        raise ArgumentError("values", rule, value=taken.shape)
    return taken


def _checked_points(points: int) -> int:
    """How many points, enough for blocks of them."""
    count = whole_number("points", points, _MOST_POINTS)
    if count < _LEAST_POINTS:
        rule = f"must be at least {_LEAST_POINTS}, got {{value}}: the standard error takes blocks"
        raise ArgumentError("points", rule, value=count)
    return count
