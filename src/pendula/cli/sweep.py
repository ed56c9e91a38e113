"""`pendula sweep`: the trajectories of many systems and starts, from a recipe into a file."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

import click

from pendula.cli.progress import work_bar
from pendula.cli.stores import check_store_options, cluster, store_options, telling_how_to_resume
from pendula.cli.tables import paragraph

if TYPE_CHECKING:
    from collections.abc import Iterable


def _sweep(**given: Any) -> None:
    check_store_options(given)
    with telling_how_to_resume(given):
        _compute(given)


def _compute(given: dict[str, Any]) -> None:
    from pendula.many.sweep import read_sweep
    from pendula.many.sweep.running import ending_of, sweep

    recipe, out = given["recipe"], given["out"]
    read, ending = read_sweep(recipe), ending_of(out)
    if given["resume"] and ending == ".parquet":
        raise click.UsageError(
            "--resume needs a .zarr store; a .parquet file is written in one go, or not at all"
        )
    count = read.sampler.count
    with (
        cluster(given["scheduler"]) as client,
        work_bar("sweep", count, "rows") as progress,
    ):
        try:
            found = sweep(
                read,
                out,
                client=client,
                threads=given["threads"],
                progress=progress,
                resume=given["resume"],
                overwrite=given["force"],
            )
        except MemoryError:
            raise click.ClickException(
                "not enough memory; take fewer rows a chunk in the recipe: [run] chunk"
            ) from None
        ends = ends_of(found["outcome"].values.tolist())
    click.echo(paragraph(f"{out}: {count} rows of {len(read.times)} times; {ends}"))


def ends_of(outcomes: Iterable[str]) -> str:
    """How many runs had each outcome."""
    counts = Counter(outcomes)
    return ", ".join(f"{count} {name}" for name, count in counts.most_common() if name)


command = click.Command(
    "sweep",
    params=[
        click.Argument(["recipe"], type=click.Path(exists=True, dir_okay=False)),
        click.Option(
            ["out", "-o", "--output"],
            type=click.Path(),
            metavar="FILE",
            required=True,
            help="write a resumable .zarr store or a .parquet file",
        ),
        *store_options(),
    ],
    callback=_sweep,
    help="Run the systems and initial states of a RECIPE.toml and write every trajectory.",
)
