"""`pendula chaos section`: Poincaré sections, and stroboscopic ones, in the colours of chaos."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from pendula.cli.chaos_files import check_targets, deliver, output_options
from pendula.cli.groups import ChoiceGroup, one_each
from pendula.cli.map import INDICATORS
from pendula.cli.options import (
    run_options,
    run_options_of,
    start_of,
    start_options,
    system_of,
    system_options,
    value,
)
from pendula.cli.progress import late_bar
from pendula.cli.run import seconds
from pendula.cli.tables import digits_of, table
from pendula.systems import systems_that

if TYPE_CHECKING:
    from pendula._engine import SystemEntry
    from pendula._types import Array
    from pendula.chaos import Section

_ROWS = 11  # of the table
_TIME = 400.0  # s, of the runs that tell motions apart
_WITHOUT = (
    "the {system} pendulum has no section that is drawn; "
    "use pendula chaos section double, or driven"
)


def _section_options(entry: SystemEntry) -> list[click.Parameter]:
    of_energy = [
        value("energy", "energy of many starts, e.g. 10J, in place of one"),
        click.Option(
            ["--starts"],
            type=int,
            metavar="N",
            default=24,
            show_default=True,
            help="how many, with --energy",
        ),
    ]
    return [
        *system_options(entry),
        *start_options(entry),
        *(of_energy if entry.name == "double" else []),
        click.Option(
            ["--crossings"],
            type=int,
            metavar="N",
            default=500,
            show_default=True,
            help="of each motion; of a driven pendulum one in each period",
        ),
        click.Option(
            ["--indicator"],
            type=click.Choice(list(INDICATORS)),
            help="of chaos, which tells the motions apart and colors them [default: megno; none "
            "with friction]",
        ),
        value("t_max", f"length of the runs for the indicator [default: {_TIME:g} s]"),
        *run_options("tolerance", "max_steps"),
        *output_options("every crossing", "the section, in the colors of the indicator"),
    ]


def _section(entry: SystemEntry, **given: Any) -> None:
    from pendula.chaos import section
    from pendula.units import quantity

    system: Any = system_of(entry, given)
    how: dict[str, Any] = {"states": start_of(entry, given)}
    if given.get("energy") is not None:
        _refuse_start(entry, given)
        how = {"energy": quantity(given["energy"], "J", "energy"), "starts": given["starts"]}
    if given["indicator"] is None and system.can.conservative:
        given["indicator"] = "megno"
    if given["indicator"] is None and given["t_max"] is not None:
        raise click.UsageError("--t-max goes with --indicator")
    targets = check_targets(given)
    with late_bar("section") as progress:
        found = section(
            system,
            crossings=given["crossings"],
            indicator=given["indicator"],
            t_max=seconds(given, "t_max", _TIME),
            progress=progress,
            **how,
            **run_options_of(given),
        )
    printed, told = _told_of_section(found)
    deliver(given, targets, found, _crossings(found), printed, told)


def _refuse_start(entry: SystemEntry, given: dict[str, Any]) -> None:
    """Of a start and an energy one is enough."""
    named = [row.name for row in entry.components if given[row.name] is not None]
    if named:
        raise click.UsageError(f"--energy and --{named[0]} exclude one another; name one of them")


def _crossings(found: Section) -> dict[str, Any]:
    """A row for each crossing."""
    from pendula.chaos.indicators import INDICATORS as MEANINGS

    n, m = found.times.shape
    columns: dict[str, Any] = {
        "start": [i for i in range(1, n + 1) for _ in range(m)],
        "t [s]": found.times.ravel().tolist(),
    }
    for i, (name, unit) in enumerate(found.system.component_units.items()):
        columns[f"{name} [{unit}]"] = found.states[..., i].ravel().tolist()
    if found.states.shape[-1] == 4:
        columns["p2 [J s]"] = found.points[..., 1].ravel().tolist()
    if found.values is not None:
        name = found.recipe["indicator"]
        unit = MEANINGS[name][0]
        columns[name if unit == "1" else f"{name} [{unit}]"] = found.values.repeat(m).tolist()
    return columns


def _told_of_section(found: Section) -> tuple[str, str]:
    """The first points, and what the indicator says of the motions."""
    n, m = found.times.shape
    names = ("theta2 [rad]", "p2 [J s]") if found.states.shape[-1] == 4 else ("theta", "omega")
    digits = digits_of(2)
    rows = [
        [str(i + 1), *(f"{each:.{digits}g}" for each in points[0])]
        for i, points in enumerate(found.points[:_ROWS])
    ]
    printed = table(["start", *(f"first {each}" for each in names)], rows)
    told = [f"{n} motions, {m} crossings each"]
    if found.values is not None:
        told.append(
            _told_of_motions(found.recipe["indicator"], found.recipe["t_max"], found.values)
        )
    return printed, "; ".join([*told, f"{int(found.n_steps.sum())} steps"])


def _told_of_motions(indicator: str, t_max: float, values: Array) -> str:
    """How many motions an indicator calls chaotic, or between what values they lie."""
    from pendula.chaos.alignment import ALIGNED
    from pendula.chaos.verdict import VERDICTS, verdict_of

    if indicator == "sali":
        return f"{int((values < ALIGNED).sum())} of SALI below {ALIGNED:g} at {t_max:g} s: chaotic"
    if indicator == "lyapunov":
        low, high = float(values.min()), float(values.max())
        return f"Lyapunov exponents at {t_max:g} s from {low:.3g} to {high:.3g} 1/s"
    found = verdict_of(values)
    told = [f"{int((found == each).sum())} {each}" for each in VERDICTS]
    return f"{', '.join(told)} by mean MEGNO at {t_max:g} s"


def section_command() -> ChoiceGroup:
    """The subcommand, of the systems with a second angle or a drive."""
    return one_each(
        "section",
        "The Poincaré section of one motion, or of many of an energy.",
        [each for each in systems_that() if each.name in ("double", "driven")],
        _section_options,
        _section,
        without=_WITHOUT,
    )
