"""`pendula chaos bifurcation`: where motions go in the end, over a parameter."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from pendula.cli.chaos_files import check_targets, deliver, output_options
from pendula.cli.chaos_orbits import changes_table
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
from pendula.systems import systems_that

if TYPE_CHECKING:
    from pendula._engine import SystemEntry
    from pendula.chaos import Bifurcation
    from pendula.systems import System

_RANGE = "1:20"
_WITHOUT = (
    "the {system} pendulum has nothing to bifurcate; "
    "use pendula chaos bifurcation double, or driven"
)


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
    name, low, high = _parameter(system, given["along"])
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
    printed = changes_table(found.changes, found.parameter)
    deliver(given, targets, found, _points(found), printed, _told_of_bifurcation(found))


def _parameter(system: System, text: str) -> tuple[str, float, float]:
    """Name and range of --along."""
    units = {row.name: row.unit for row in system._rows()}
    if system.name == "double":
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
        without=_WITHOUT,
    )
