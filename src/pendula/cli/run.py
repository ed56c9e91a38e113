"""What `solve` and `exact` share: the times of the outputs, the file, and how a run ends."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from pendula import _engine
from pendula.cli.options import value

if TYPE_CHECKING:
    from pathlib import Path

    from pendula.run.trajectory import Trajectory

_BEYOND = "the numbers grew beyond all bounds"
_GREW = f"{_BEYOND}; take a smaller --step or a higher order"
_DID_NOT_SETTLE = "the iteration of a step did not converge; take a smaller --step"
_TOO_MANY = "too many steps to output them all; set the time between outputs with --every"
_OUT_OF_RANGE = "an angle left the range of the sine (2^26 rad)"


def start_time() -> click.Option:
    """The time of the state at the start."""
    return value("t0", "start time [default: 0 s]")


def file_options() -> list[click.Parameter]:
    """The options for the file to write."""
    return [
        click.Option(
            ["out", "-o", "--output"],
            type=click.Path(),
            metavar="FILE",
            help="write all outputs to a .csv, .nc, .parquet or .zarr file; print none",
        ),
        click.Option(["--force"], is_flag=True, help="replace the file if it exists"),
    ]


def seconds(given: dict[str, Any], name: str, standard: float = 0.0) -> float:
    """The value of an option that takes a time."""
    from pendula.units import quantity

    return standard if given[name] is None else quantity(given[name], "s", name)


def target(out: str | None, *, force: bool) -> Path | None:
    """The file to write; refuses before a long run what cannot be written.

    Raises:
        ValueError: for an unknown ending.
        OSError: where the file exists without --force, or cannot be written.
    """
    if out is None:
        return None
    from pathlib import Path

    from pendula.io import check_target

    path = Path(out)
    check_target(path, overwrite=force)
    return path


def check_outcome(run: Trajectory, t_max: float) -> None:
    """Refuse a run that stopped before its end.

    Raises:
        click.ClickException: saying when, why, and what to do.
    """
    if run.outcome not in ("reached_end", "event"):
        asked = run.request
        step = f" with step {asked.step:g} s" if asked.step else ""
        raise click.ClickException(
            f"{run.method} stopped at t = {run.reached:.6g} s of {t_max:g} s{step}: "
            f"{_why(run, t_max)}"
        )


def _why(run: Trajectory, t_max: float) -> str:
    """What ended a run: its limit, a method that blew up, or an angle grown with speed."""
    if run.outcome != "not_finite":
        limit = run.request.max_steps
        return _TOO_MANY if limit is None else f"it took the {limit} steps that were allowed"
    import numpy as np

    last, t = (run.states[-1], run.t[-1]) if run.t.size else (run.request.state, run.request.t0)
    angles, speeds = np.split(np.abs(last), 2)
    with np.errstate(over="ignore", invalid="ignore"):
        turned = (angles + speeds * abs(t_max - t) >= _engine.LARGEST_ANGLE).any()
        grew = (np.abs(run.energy_error) > 1.0).any()
    if turned and not grew and run.system.can.periodic:  # its equations take the sine
        return _OUT_OF_RANGE
    if run.request.step is None:
        return _BEYOND
    if grew:
        return _GREW
    iterated = {each.name for each in _engine.methods() if each.evaluations_per_step is None}
    return _DID_NOT_SETTLE if run.method in iterated else _GREW


def deliver(run: Trajectory, out: Path | None, *, force: bool, **shown: Any) -> None:
    """Write a run, or print some of its rows; `shown` are options of `tables.show`."""
    import numpy as np

    from pendula.cli.events import found
    from pendula.cli.tables import paragraph, show, summary, times_of

    with np.errstate(over="ignore", invalid="ignore"):  # of energies: the numbers show it
        if out is None:
            show(run, **shown)
        else:
            run.save(out, overwrite=force)
        written = "" if out is None else f"{out}: {times_of(run)}; "
        click.echo(paragraph(f"{written}{summary(run)}"))
        if run.request.events:
            click.echo(f"\n{found(run)}")
