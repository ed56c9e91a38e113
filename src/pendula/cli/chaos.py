"""`pendula chaos`: exponents and MEGNO, sections, periodic orbits and bifurcations."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from pendula.cli.chaos_bifurcation import bifurcation_command
from pendula.cli.chaos_files import check_targets, deliver, output_options
from pendula.cli.chaos_orbits import orbit_command
from pendula.cli.chaos_sections import section_command
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
from pendula.cli.tables import table
from pendula.systems import systems_that

if TYPE_CHECKING:
    from pendula._engine import SystemEntry
    from pendula.chaos import Lyapunov, Megno

_ROWS = 10  # of a table


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
    chosen = sorted({math.ceil(i * count / _ROWS) - 1 for i in range(1, _ROWS + 1)})
    rows = [
        [f"{found.t[i]:.6g}"]
        + [f"{float(each[i]):.6g}" for each in (found.megno, found.mean, found.rate, found.growth)]
        for i in chosen
    ]
    return table(["t [s]", "MEGNO", "mean", "rate [1/s]", "ln growth"], rows)


def _command() -> ChoiceGroup:
    group = ChoiceGroup(
        "chaos", kind="measure", help="Measure how chaotic a motion is, and draw what it does."
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
        section_command(),
        orbit_command(),
        bifurcation_command(),
    ):
        group.add_command(made)
    return group


command = _command()
