"""`pendula chaos orbit`: a periodic orbit, and its family."""

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
    from pendula.chaos import Change, Family, PeriodicOrbit
    from pendula.systems import System

_RANGE = "1:20"
_WITHOUT = (
    "the {system} pendulum has no periodic orbits of its own kind; "
    "use pendula chaos orbit double, driven or simple"
)


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

    system = system_of(entry, given)
    along = _along(system, given["family"])
    targets = check_targets(given)
    found = _found_orbit(entry, system, given)
    if along is None:
        deliver(given, targets, found, _columns([found]), _orbit_table(found), _told(found))
        return
    with late_bar("family"):
        followed = family(found, given["orbits"], **along)
    columns = _columns(list(followed.orbits))
    printed = changes_table(followed.changes, followed.along)
    deliver(given, targets, followed, columns, printed, _told_of_family(followed))


def _found_orbit(entry: SystemEntry, system: Any, given: dict[str, Any]) -> PeriodicOrbit:
    from pendula.chaos import normal_mode, periodic_orbit
    from pendula.units import quantity

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


def _along(system: System, text: str | None) -> dict[str, tuple[float, float]] | None:
    """The range of --family, by what it goes along."""
    if text is None:
        return None
    name, equals, ends = text.partition("=")
    if system.can.conservative and not equals:
        return {"energy": range_of(name, "family", "J", _RANGE)}
    units = {row.name: row.unit for row in system._rows()}
    if name not in units:
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


def changes_table(changes: tuple[Change, ...], along: str) -> str:
    """Where stability changes."""
    rows = [
        [
            f"{each.value:.12g}",
            str(each.multiplier),
            f"{each.orbit.period:.12g}",
            each.below,
            each.above,
            "fold" if each.fold else "",
        ]
        for each in changes
    ]
    name = "energy [J]" if along == "energy" else along
    if not rows:
        return f"no change of stability along {name}"
    headings = [name, "multiplier", "period [s]", "below", "above", ""]
    if not any(each.fold for each in changes):
        headings, rows = headings[:-1], [row[:-1] for row in rows]
    return table(headings, rows)


def _told_of_family(found: Family) -> str:
    values = f"{found.values.min():.6g} to {found.values.max():.6g}"
    stable = sum(each.stable for each in found.orbits)
    return (
        f"{len(found.orbits)} orbits, {found.along} {values}, {stable} stable, {found.outcome}; "
        f"{found.n_steps} steps"
    )


def orbit_command() -> ChoiceGroup:
    """The subcommand, of the systems that have periodic orbits."""
    chosen = [each for each in systems_that() if each.name in ("double", "driven", "simple")]
    return one_each(
        "orbit",
        "A periodic orbit near a start, its multipliers, and its family.",
        chosen,
        _orbit_options,
        _orbit,
        without=_WITHOUT,
    )
