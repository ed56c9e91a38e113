"""`pendula compare`: what the errors of methods cost, in evaluations and in time."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from pendula import _engine
from pendula.cli.groups import one_each
from pendula.cli.options import start_of, start_options, system_of, system_options, value
from pendula.cli.pictures import checked_picture, file_and_picture, write_picture
from pendula.cli.progress import progress_bar
from pendula.cli.run import seconds, start_time
from pendula.cli.tables import paragraph, table
from pendula.run._times import span_of
from pendula.systems import systems_that

if TYPE_CHECKING:
    from pathlib import Path

    from pendula._engine import SystemEntry
    from pendula.analysis import MethodWork, WorkPrecision

_TARGETS = (1e-6, 1e-9, 1e-12)  # errors of the table [rad]
_NEVER = "not reached"
_POINTS = 12


def _options(entry: SystemEntry) -> list[click.Parameter]:
    names = [each.name for each in _engine.methods() if entry.name in each.systems]
    return [
        *system_options(entry),
        *start_options(entry),
        start_time(),
        value("t_max", "end time", required=True),
        click.Option(
            ["--methods"],
            metavar="NAMES",
            help=f"e.g. rk4,taylor; of {', '.join(names)} [default: all]",
        ),
        click.Option(
            ["--points"],
            type=int,
            default=_POINTS,
            show_default=True,
            metavar="N",
            help="runs of each method, 2 to 100",
        ),
        *file_and_picture(
            "every run to a .csv or .json file", "error against evaluations and time"
        ),
        click.Option(["--force"], is_flag=True, help="replace the files if they exist"),
    ]


def _compare(entry: SystemEntry, **given: Any) -> None:
    system, start = system_of(entry, given), start_of(entry, given)
    t0, t_max = seconds(given, "t0"), seconds(given, "t_max")
    span_of(t0, t_max)
    out, picture = _targets(given)
    from pendula.analysis import work_precision

    names = given["methods"]
    chosen = None if names is None else [each.strip() for each in names.split(",")]
    with progress_bar() as progress:
        found = work_precision(
            system, start, t_max, chosen, t0=t0, points=given["points"], progress=progress
        )
    if not any(math.isfinite(each.best) for each in found.methods):
        raise click.ClickException(
            "no method reached the end time with any step; take an earlier --t-max"
        )
    _write(found, out, picture, given)
    click.echo(_table(found))
    click.echo(paragraph(_summary(found)))
    for path in filter(None, (out, picture)):
        click.echo(path)


def _targets(given: dict[str, Any]) -> tuple[Path | None, Path | None]:
    """The files to write; refuses before long work what cannot be written."""
    from pathlib import Path

    from pendula.io.rows import check_rows_target

    out = None if given["out"] is None else Path(given["out"])
    if out is not None:
        check_rows_target(out, overwrite=given["force"])
    return out, checked_picture(given)


def _write(
    found: WorkPrecision, out: Path | None, picture: Path | None, given: dict[str, Any]
) -> None:
    """Draw first, so that a picture that fails leaves no data behind."""
    from pendula.io.rows import write_rows

    if picture is not None:
        from pendula import plot

        write_picture(plot.work_precision([found], language=given["lang"]), picture, given)
    if out is not None:
        write_rows(found.to_dict(), found.attributes(), out, overwrite=given["force"])


def _table(found: WorkPrecision) -> str:
    """One row per method: its best error, its error at equal work, and what the targets cost."""
    work = found.equal_work()
    costs = [f"evals, time\nto {target:g} rad" for target in _TARGETS]
    rows = [
        [each.method, _error(each.best), _error(each.error_at(work))]
        + [_cost(each, target) for target in _TARGETS]
        for each in found.methods
    ]
    return table(["method", "best\n[rad]", f"at {work}\nevals", *costs], rows)


def _error(error: float) -> str:
    return "-" if math.isnan(error) else "diverged" if math.isinf(error) else f"{error:.1e}"


def _cost(work: MethodWork, target: float) -> str:
    evaluations, taken = work.to_reach(target)
    return _NEVER if math.isnan(evaluations) else f"{_count(evaluations)}, {_duration(taken)}"


def _count(evaluations: float) -> str:
    """At most four characters up to 10^10 of them."""
    if evaluations < 1e4:
        return f"{evaluations:.0f}"
    return f"{evaluations / 1e3:.0f}k" if evaluations < 1e6 else f"{evaluations / 1e6:.3g}M"


def _duration(taken: float) -> str:
    scale, unit = (1e6, "us") if taken < 1e-3 else (1e3, "ms") if taken < 1.0 else (1.0, "s")
    return f"{taken * scale:.3g} {unit}"


def _summary(found: WorkPrecision) -> str:
    judge = "the exact solution"
    if found.digits is not None:
        judge = f"a run correct to {found.digits} digits, computed with {found.precision}"
    return (
        f"Largest error of any angle at {len(found.t)} times, compared with {judge} (its own "
        f"error: {found.reference_error:.1e} rad).\nCost in evaluations of the equations of motion "
        "and processor time; for "
        "the Taylor method each coefficient of its series is one evaluation."
    )


command = one_each(
    "compare",
    "Compare methods: error against cost, relative to the exact or a certified solution.",
    systems_that(),
    _options,
    _compare,
)
