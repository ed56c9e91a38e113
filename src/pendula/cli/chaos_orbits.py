"""`pendula chaos orbit` and `pendula chaos bifurcation`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from pendula.cli.chaos_files import check_targets, deliver, output_options
from pendula.cli.groups import ChoiceGroup, one_each
from pendula.cli.options import (
    range_of,
    start_of,
    start_options,
    system_of,
    system_options,
    value,
)
from pendula.cli.progress import late_bar
from pendula.cli.tables import table
from pendula.systems import systems_that

if TYPE_CHECKING:
    from pendula._engine import SystemEntry
    from pendula.chaos import Bifurcation, Change, Family, PeriodicOrbit

_RANGE = "1:20"
_WITHOUT = "the {system} pendulum {reason}; use pendula chaos {command} double, or driven"


# ---- periodic orbits ----


def _orbit_options(entry: SystemEntry) -> list[click.Parameter]:
    modes = [
        click.Option(
            ["--mode"],
            type=int,
            metavar="N",
            help="normal mode 1 or 2, with --amplitude or --energy, in place of a start",
        ),
        value("amplitude", "angle of rod 1 at rest, e.g. 60deg, with --mode"),
        value("energy", "energy of the orbit, e.g. 10J"),
    ]
    along = "energy" if entry.can.conservative else "parameter, e.g. a=1:1.08"
    return [
        *system_options(entry),
        *start_options(entry),
        value("period", "about the period [default: when the motion first comes back nearly]"),
        *(modes if entry.name == "double" else []),
        click.Option(
            ["--family"],
            metavar="LO:HI" if entry.can.conservative else "NAME=LO:HI",
            help=f"follow the family along a range of {along}",
        ),
        click.Option(
            ["--orbits"],
            type=int,
            metavar="N",
            default=50,
            show_default=True,
            help="how many of the family",
        ),
        *output_options("the orbits", "the orbit with its multipliers, or the family"),
    ]


def _orbit(entry: SystemEntry, **given: Any) -> None:
    from pendula.chaos import family

    along = _along(entry, given)
    targets = check_targets(given)
    found = _found_orbit(entry, given)
    if along is None:
        deliver(given, targets, found, _columns([found]), _orbit_table(found), _told(found))
        return
    with late_bar("family"):
        followed = family(found, given["orbits"], **along)
    columns = _columns(list(followed.orbits))
    printed = _changes_table(followed.changes, followed.along)
    deliver(given, targets, followed, columns, printed, _told_of_family(followed))


def _found_orbit(entry: SystemEntry, given: dict[str, Any]) -> PeriodicOrbit:
    from pendula.chaos import normal_mode, periodic_orbit
    from pendula.units import quantity

    system: Any = system_of(entry, given)
    units = {"amplitude": "rad", "energy": "J", "period": "s"}
    asked: dict[str, Any] = {
        name: None if given.get(name) is None else quantity(given[name], unit, name)
        for name, unit in units.items()
    }
    if given.get("mode") is not None:
        del asked["period"]
        return normal_mode(system, given["mode"], **asked)
    if asked.pop("amplitude") is not None:
        raise click.UsageError("--amplitude goes with --mode; give a start with --theta1, …")
    return periodic_orbit(system, start_of(entry, given), **asked)


def _along(entry: SystemEntry, given: dict[str, Any]) -> dict[str, tuple[float, float]] | None:
    """The range of --family, by what it goes along."""
    text = given["family"]
    if text is None:
        return None
    name, equals, ends = text.partition("=")
    if entry.can.conservative and not equals:
        return {"energy": range_of(ends or name, "family", "J", _RANGE)}
    units = {row.name: row.unit for form in entry.forms for row in form.parameters}
    if not equals or name not in units:
        known = ", ".join(units)
        raise ValueError(f"--family must be such as a=1:1.08, of {known}, got {text!r}")
    return {name: range_of(ends, "family", units[name], _RANGE)}


def _columns(orbits: list[PeriodicOrbit]) -> dict[str, Any]:
    """A row for each orbit."""
    columns: dict[str, Any] = {
        "energy [J]": [each.energy for each in orbits],
        "period [s]": [each.period for each in orbits],
    }
    for i, (name, unit) in enumerate(orbits[0].system.component_units.items()):
        columns[f"{name} [{unit}]"] = [float(each.state[i]) for each in orbits]
    for i in range(orbits[0].multipliers.size):
        columns[f"Re multiplier{i + 1}"] = [float(each.multipliers[i].real) for each in orbits]
        columns[f"Im multiplier{i + 1}"] = [float(each.multipliers[i].imag) for each in orbits]
    columns["kind"] = [each.kind for each in orbits]
    return columns


def _orbit_table(orbit: PeriodicOrbit) -> str:
    units = orbit.system.component_units
    rows = [
        [f"{name} [{unit}]", repr(float(x))]
        for (name, unit), x in zip(units.items(), orbit.state, strict=True)
    ]
    rows += [["period [s]", repr(float(orbit.period))], ["energy [J]", repr(orbit.energy)]]
    rows += [
        [f"multiplier {i}", f"{each.real:.13g}" + (f"{each.imag:+.13g}i" if each.imag else "")]
        for i, each in enumerate(map(complex, orbit.multipliers), 1)
    ]
    return table(["orbit", "value"], rows)


def _told(orbit: PeriodicOrbit) -> str:
    turns = f", turns {orbit.turns}" if any(orbit.turns) else ""
    return (
        f"{orbit.kind}, symmetry: {orbit.symmetry}{turns}; closes to {orbit.closure:.1e} after "
        f"{orbit.iterations} iterations, {orbit.n_steps} steps"
    )


def _changes_table(changes: tuple[Change, ...], along: str) -> str:
    """Where stability changes."""
    rows = [
        [
            f"{each.value:.12g}",
            str(each.multiplier),
            f"{each.orbit.period:.12g}",
            each.below,
            each.above,
        ]
        for each in changes
    ]
    name = "energy [J]" if along == "energy" else along
    if not rows:
        return f"no change of stability along {name}"
    return table([name, "multiplier", "period [s]", "below", "above"], rows)


def _told_of_family(found: Family) -> str:
    values = f"{found.values[0]:.6g} to {found.values[-1]:.6g}"
    stable = sum(each.stable for each in found.orbits)
    return (
        f"{len(found.orbits)} orbits, {found.along} {values}, {stable} stable, {found.outcome}; "
        f"{found.n_steps} steps"
    )


def orbit_command() -> ChoiceGroup:
    """The subcommand, of the systems that have periodic orbits."""
    chosen = [each for each in systems_that() if each.name in ("double", "driven", "simple")]
    reason = "has no isolated periodic orbits"
    return one_each(
        "orbit",
        "A periodic orbit near a start, its multipliers, and its family.",
        chosen,
        _orbit_options,
        _orbit,
        without=_WITHOUT.format(system="{system}", reason=reason, command="orbit"),
    )


# ---- bifurcations ----


def _bifurcation_options(entry: SystemEntry) -> list[click.Parameter]:
    double = entry.name == "double"
    return [
        *system_options(entry),
        *([] if double else start_options(entry)),
        click.Option(
            ["--along"],
            required=True,
            metavar="NAME=LO:HI",
            help=f"parameter and its range, e.g. {'energy=1:15' if double else 'a=1:1.15'}",
        ),
        click.Option(
            ["--values"], type=int, metavar="N", default=300, show_default=True, help="how many"
        ),
        *([value("energy", "energy, where another parameter is varied")] if double else []),
        click.Option(
            ["--points"], type=int, metavar="N", default=200, show_default=True, help="at each"
        ),
        click.Option(
            ["--transient"],
            type=int,
            metavar="N",
            default=300,
            show_default=True,
            help="periods left out before them",
        ),
        click.Option(
            ["--fresh"], is_flag=True, help="start each value anew, not where the last one ended"
        ),
        *output_options("every point", "the points, and the exponent below"),
    ]


def _bifurcation(entry: SystemEntry, **given: Any) -> None:
    import numpy as np

    from pendula.chaos import bifurcation
    from pendula.units import quantity

    system: Any = system_of(entry, given)
    name, low, high = _parameter(entry, given["along"])
    how: dict[str, Any] = {} if entry.name == "double" else {"state": start_of(entry, given)}
    if given.get("energy") is not None:
        how["energy"] = quantity(given["energy"], "J", "energy")
    targets = check_targets(given)
    values = np.linspace(low, high, max(given["values"], 1))
    with late_bar("bifurcation") as progress:
        found = bifurcation(
            system,
            name,
            values,
            points=given["points"],
            transient=given["transient"],
            follow=not given["fresh"],
            progress=progress,
            **how,
        )
    printed = _changes_table(found.changes, found.parameter)
    deliver(given, targets, found, _points(found), printed, _told_of_bifurcation(found))


def _parameter(entry: SystemEntry, text: str) -> tuple[str, float, float]:
    """Name and range of --along."""
    units = {row.name: row.unit for form in entry.forms for row in form.parameters}
    if entry.name == "double":
        units = {"energy": "J", **units}
    name, _, ends = text.partition("=")
    if name not in units:
        known = ", ".join(units)
        raise ValueError(f"--along must be NAME=LO:HI with one of {known}, got {text!r}")
    return (name, *range_of(ends, "along", units[name], _RANGE))


def _points(found: Bifurcation) -> dict[str, Any]:
    """A row for each point."""
    m = found.points.shape[1]
    names = ("theta2 [rad]", "p2 [J s]") if found.exponents.shape[1] == 4 else ("theta", "omega")
    return {
        found.parameter: [each for each in found.values.tolist() for _ in range(m)],
        **{name: found.points[..., i].ravel().tolist() for i, name in enumerate(names)},
        "exponent": [each for each in found.exponents[:, 0].tolist() for _ in range(m)],
        "period": [int(each) for each in found.periods for _ in range(m)],
    }


def _told_of_bifurcation(found: Bifurcation) -> str:
    errors = found.standard_errors
    chaotic = int((found.exponents[:, 0] > 3.0 * errors).sum())
    return (
        f"{found.values.size} values of {found.parameter}, {found.points.shape[1]} points each; "
        f"{chaotic} with a positive exponent, {len(found.doublings)} period doublings; "
        f"{int(found.n_steps.sum())} steps"
    )


def bifurcation_command() -> ChoiceGroup:
    """The subcommand, of driven and double pendulums."""
    chosen = [each for each in systems_that() if each.name in ("double", "driven")]
    return one_each(
        "bifurcation",
        "Where motions go in the end, over values of a parameter.",
        chosen,
        _bifurcation_options,
        _bifurcation,
        without=_WITHOUT.format(
            system="{system}", reason="has nothing to bifurcate", command="bifurcation"
        ),
    )
