"""`pendula study`: the paper's study, from a recipe to a report."""

from __future__ import annotations

import click

from pendula.cli.progress import progress_bar


@click.command("study")
@click.argument("recipe", required=False, type=click.Path(exists=True, dir_okay=False))
@click.option("--out", required=True, type=click.Path(), metavar="DIR", help="folder to create")
@click.option(
    "--lang",
    type=click.Choice(["en", "es"]),
    default="en",
    show_default=True,
    help="language of the report",
)
@click.option(
    "--figures",
    multiple=True,
    type=click.Choice(["pdf", "png"]),
    help="also write each figure as .pdf (LaTeX) or .png (Word), besides .svg; may be repeated",
)
@click.option("--force", is_flag=True, help="overwrite the folder if it holds a study")
def command(recipe: str | None, out: str, lang: str, figures: tuple[str, ...], force: bool) -> None:
    """Run the paper's study, or that of a RECIPE.toml, and write its report."""
    from pathlib import Path

    from pendula.study import run_study

    given = Path(recipe) if recipe else None
    above = next(folder for folder in Path(out).absolute().parents if folder.exists())
    if not above.is_dir():
        raise NotADirectoryError(f"cannot write {out}: {above} is not a folder")
    try:
        with progress_bar() as progress:
            folder = run_study(
                given, Path(out), lang, figures=figures, overwrite=force, progress=progress
            )
    except RuntimeError as error:
        raise click.ClickException(str(error)) from error
    click.echo(folder / "report.html")
