"""`pendula chaos`: exponents and MEGNO, sections, periodic orbits and bifurcations."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from pendula.cli.chaos_bifurcation import bifurcation_command
from pendula.cli.chaos_files import check_targets, deliver, output_options
from pendula.cli.chaos_orbits import orbit_command
from pendula.cli.groups import ChoiceGroup, one_each
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
from pendula.cli.run import seconds, start_time
from pendula.cli.tables import digits_of, table
from pendula.systems import systems_that

if TYPE_CHECKING:
    from pendula._engine import SystemEntry
    from pendula.chaos import Lyapunov, Megno, Section

_ROWS = 11  # of a table: ten intervals
_MEGNO_TIME = 400.0  # s, to tell the motions of a section


# ---- exponents ----


def _lyapunov_options(entry: SystemEntry) -> list[click.Parameter]:
    return [
        *system_options(entry),
        *start_options(entry),
        start_time(),
        value("t_max", "length of the run after the transient", required=True),
        click.Option(
            ["--exponents"],
            type=int,
            metavar="N",
            default=1,
            show_default=True,
            help=f"how many, the largest first, 1 to {len(entry.components)}",
        ),
        value("transient", "time that is left out at the start [default: 0 s]"),
        *run_options("tolerance", "max_steps", "certify"),
        *output_options("the running estimates", "them with the band of their error"),
    ]


def _lyapunov(entry: SystemEntry, **given: Any) -> None:
    from pendula.chaos import lyapunov

    system, start = system_of(entry, given), start_of(entry, given)
    targets = check_targets(given)
    with late_bar("exponents") as progress:
        found = lyapunov(
            system,
            start,
            seconds(given, "t_max"),
            exponents=given["exponents"],
            transient=seconds(given, "transient"),
            t0=seconds(given, "t0"),
            progress=progress,
            **run_options_of(given),
        )
    columns: dict[str, Any] = {"t [s]": found.t.tolist()}
    for i, estimates in enumerate(found.running.T, 1):
        columns[f"exponent{i} [1/s]"] = estimates.tolist()
    rows = [
        [f"lambda{i}", f"{each:.6g}", _error(error)]
        for i, (each, error) in enumerate(
            zip(found.exponents, found.standard_error, strict=True), 1
        )
    ]
    printed = table(["exponent", "[1/s]", "standard error"], rows)
    deliver(given, targets, found, columns, printed, _told_of_exponents(found))


def _error(error: float) -> str:
    return "-" if math.isnan(error) else f"{error:.2g}"


def _told_of_exponents(found: Lyapunov) -> str:
    """The verdict, what it means for a forecast, and the checks of a spectrum."""
    largest, lines = float(found.exponents[0]), []
    if found.exponents.size == 1:
        lines.append(f"{found.verdict}: mean MEGNO {found.mean_megno:.4g}")
    if largest > 3.0 * float(found.standard_error[0]):
        lines.append(
            f"Lyapunov time {1.0 / largest:.4g} s: an error grows tenfold in "
            f"{math.log(10.0) / largest:.4g} s"
        )
    if found.exponents.size == len(found.system.components):
        lines.append(f"sum {float(found.sum):.2g} 1/s")
        if found.system.can.conservative:
            pairs = ", ".join(f"{each:.2g}" for each in found.pairing_error)
            lines[-1] += f", errors of the pairs {pairs} 1/s"
    if found.trust_horizon is not None:
        lines.append(_certified(found))
    return "\n".join([*lines, f"{int(found.n_steps)} steps, {found.outcome}"])


def _certified(found: Lyapunov) -> str:
    """The finite-time exponents with the decimals that are right."""
    until = "to the end" if math.isinf(found.trust_horizon) else f"to {found.trust_horizon:g} s"
    assert found.finite_time is not None
    assert found.finite_time_error is not None
    if math.isnan(found.finite_time[0]):
        return f"states are certified {until} only, which is in the transient"
    each = zip(found.finite_time, found.digits, found.finite_time_error, strict=True)
    told = ", ".join(f"{value:.{n}f} (±{error:.1g})" for value, n, error in each)
    return f"states are certified {until}, exponents up to there are {told} 1/s"


# ---- MEGNO ----


def _megno_options(entry: SystemEntry) -> list[click.Parameter]:
    return [
        *system_options(entry),
        *start_options(entry),
        start_time(),
        value("t_max", "end time", required=True),
        value("every", "time between outputs [default: a hundredth of the run]"),
        *run_options("tolerance", "max_steps"),
        *output_options("MEGNO, its mean and the growth", "MEGNO and its mean"),
    ]


def _megno(entry: SystemEntry, **given: Any) -> None:
    from pendula.chaos import megno
    from pendula.run._times import span_of, times_apart

    system, start = system_of(entry, given), start_of(entry, given)
    t0, t_max = seconds(given, "t0"), seconds(given, "t_max")
    every = seconds(given, "every", span_of(t0, t_max) / 100.0)
    times = times_apart(t0, t_max, every)[1:]  # at the start there is nothing yet
    targets = check_targets(given)
    with late_bar("MEGNO") as progress:
        found = megno(system, start, times, t0=t0, progress=progress, **run_options_of(given))
    columns = {
        "t [s]": found.t.tolist(),
        "MEGNO": found.megno.tolist(),
        "mean MEGNO": found.mean.tolist(),
        "rate [1/s]": found.rate.tolist(),
        "ln growth": found.growth.tolist(),
    }
    last = f"{found.verdict}: mean MEGNO {found.mean[-1]:.4g} (2: regular)"
    steps = f"{int(found.n_steps)} steps, {found.outcome}"
    deliver(given, targets, found, columns, _megno_table(found), f"{last}\n{steps}")


def _megno_table(found: Megno) -> str:
    count = found.t.size
    chosen = sorted({round(i * (count - 1) / (_ROWS - 1)) for i in range(_ROWS)})
    rows = [
        [f"{found.t[i]:.6g}"]
        + [f"{float(each[i]):.6g}" for each in (found.megno, found.mean, found.rate, found.growth)]
        for i in chosen
    ]
    return table(["t [s]", "MEGNO", "mean", "rate [1/s]", "ln growth"], rows)


# ---- sections ----


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
        *run_options("tolerance", "max_steps"),
        *output_options("every crossing", "the section, in the colors of MEGNO"),
    ]


def _section(entry: SystemEntry, **given: Any) -> None:
    from pendula.chaos import section
    from pendula.units import quantity

    system: Any = system_of(entry, given)
    how: dict[str, Any] = {"states": start_of(entry, given)}
    if given.get("energy") is not None:
        _refuse_start(entry, given)
        how = {"energy": quantity(given["energy"], "J", "energy"), "starts": given["starts"]}
    targets = check_targets(given)
    with late_bar("section") as progress:
        found = section(
            system,
            crossings=given["crossings"],
            progress=progress,
            **how,
            **run_options_of(given),
        )
    printed, told, drawing = _told_of_section(found)
    deliver(given, targets, found, _crossings(found), printed, told, **drawing)


def _refuse_start(entry: SystemEntry, given: dict[str, Any]) -> None:
    """Of a start and an energy one is enough."""
    named = [row.name for row in entry.components if given[row.name] is not None]
    if named:
        raise click.UsageError(f"--energy and --{named[0]} exclude one another; name one of them")


def _crossings(found: Section) -> dict[str, Any]:
    """A row for each crossing."""
    n, m = found.times.shape
    columns: dict[str, Any] = {
        "start": [i for i in range(1, n + 1) for _ in range(m)],
        "t [s]": found.times.ravel().tolist(),
    }
    for i, (name, unit) in enumerate(found.system.component_units.items()):
        columns[f"{name} [{unit}]"] = found.states[..., i].ravel().tolist()
    if found.states.shape[-1] == 4:
        columns["p2 [J s]"] = found.points[..., 1].ravel().tolist()
    return columns


def _told_of_section(found: Section) -> tuple[str, str, dict[str, Any]]:
    """The first points, how many motions are chaotic, and what colours the picture."""
    from pendula.chaos import megno

    n, m = found.times.shape
    names = ("theta2 [rad]", "p2 [J s]") if found.states.shape[-1] == 4 else ("theta", "omega")
    digits = digits_of(2)
    rows = [
        [str(i + 1), *(f"{each:.{digits}g}" for each in points[0])]
        for i, points in enumerate(found.points[:_ROWS])
    ]
    printed = table(["start", *(f"first {each}" for each in names)], rows)
    told, drawing = f"{n} motions, {m} crossings each", {}
    if found.system.can.conservative:
        mean = megno(found.system, found.starts, [_MEGNO_TIME])
        counts = [f"{(mean.verdict == each).sum()} {each}" for each in ("chaotic", "regular")]
        counts.append(f"{(mean.verdict == 'undecided').sum()} undecided")
        told += f"; {', '.join(counts)} by MEGNO at {_MEGNO_TIME:g} s"
        drawing = {"indicator": mean.mean[:, -1]}
    return printed, f"{told}; {int(found.n_steps.sum())} steps", drawing


def _command() -> ChoiceGroup:
    group = ChoiceGroup(
        "chaos", kind="measure", help="Measure how chaotic a motion is, and draw what it does."
    )
    # a section needs a second angle or a drive
    sections = [each for each in systems_that() if each.name in ("double", "driven")]
    without = (
        "the {system} pendulum has no section that is drawn; "
        "use pendula chaos section double, or driven"
    )
    for made in (
        one_each(
            "lyapunov",
            "Lyapunov exponents with their standard errors.",
            systems_that(),
            _lyapunov_options,
            _lyapunov,
        ),
        one_each(
            "megno",
            "MEGNO, the mean exponential growth of nearby orbits.",
            systems_that(),
            _megno_options,
            _megno,
        ),
        one_each(
            "section",
            "The Poincaré section of one motion, or of many of an energy.",
            sections,
            _section_options,
            _section,
            without=without,
        ),
        orbit_command(),
        bifurcation_command(),
    ):
        group.add_command(made)
    return group


command = _command()
