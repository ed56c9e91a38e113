"""`pendula rerun`: a run again, from a file or from a link of the laboratory."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from pendula.cli.run import check_outcome, deliver, file_options, target

if TYPE_CHECKING:
    from pendula.run.trajectory import Trajectory


def _rerun(**given: Any) -> None:
    out = target(given["out"], force=given["force"])
    run = _again(given["start"])
    check_outcome(run, run.request.end)
    deliver(run, out, force=given["force"])


def _again(start: str) -> Trajectory:
    """The run that a file or a link describes."""
    from pendula.cli.progress import late_bar
    from pendula.io import rerun
    from pendula.lab.address import is_link
    from pendula.lab.recipe import read_link

    if not is_link(start):
        again: Trajectory = rerun(start)
        return again
    recipe = read_link(start)
    with late_bar(recipe.method) as progress:
        return recipe.run(progress)


command = click.Command(
    "rerun",
    params=[
        click.Argument(["start"], metavar="FILE|LINK"),
        *file_options(),
    ],
    callback=_rerun,
    help="Run again what a FILE of a trajectory or a LINK of the laboratory describes.",
)
