"""`pendula study`: the paper's study, from a recipe to a report."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@click.command("study")
@click.argument("recipe", required=False, type=click.Path(exists=True, dir_okay=False))
@click.option("--out", required=True, type=click.Path(), metavar="DIR", help="folder to make")
@click.option(
    "--lang",
    type=click.Choice(["en", "es"]),
    default="en",
    show_default=True,
    help="language of the report",
)
@click.option("--force", is_flag=True, help="replace the folder if it exists")
def command(recipe: str | None, out: str, lang: str, force: bool) -> None:
    """Compute the paper's study, or that of a RECIPE.toml, and write its report."""
    from pathlib import Path

    from pendula.study import run_study

    given = Path(recipe) if recipe else None
    above = next(folder for folder in Path(out).absolute().parents if folder.exists())
    if not above.is_dir():
        raise NotADirectoryError(f"cannot write {out}: {above} is not a folder")
    try:
        with _progress() as progress:
            folder = run_study(given, Path(out), lang, overwrite=force, progress=progress)
    except RuntimeError as error:
        raise click.ClickException(str(error)) from error
    click.echo(folder / "report.html")


@contextmanager
def _progress() -> Iterator[Callable[[str, float], None]]:
    """A bar with the remaining time on a terminal, a line for each part of the work otherwise."""
    if not sys.stderr.isatty():
        yield _lines()
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

    columns = (TextColumn("{task.description}"), BarColumn(), TimeRemainingColumn())
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("", total=1.0)
        yield lambda label, share: bar.update(task, description=label, completed=share)


def _lines() -> Callable[[str, float], None]:
    told = ""

    def progress(label: str, share: float) -> None:
        nonlocal told
        if label != told:
            click.echo(f"{share:4.0%} {label}", err=True)
        told = label

    return progress
