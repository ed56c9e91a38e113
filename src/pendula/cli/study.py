"""`pendula study`: the paper's study, from a recipe to a report."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from pendula.cli.fit_options import fitting_options, reading_options
from pendula.cli.progress import progress_bar

if TYPE_CHECKING:
    from pendula.measured.compare import Comparison
    from pendula.measured.fitted import Fit
    from pendula.measured.periods import PeriodFit


def _of_the_recording() -> list[click.Parameter]:
    """The options of `pendula fit`, which its help lists."""
    options = [*reading_options(), *fitting_options()]
    for each in options:
        each.hidden = True  # type: ignore[attr-defined]
    return options


_MEASURING = _of_the_recording()


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
@click.option(
    "--measured",
    type=click.Path(exists=True, dir_okay=False),
    metavar="FILE",
    help="give a recording a chapter; the options of pendula fit say how it is read and fitted",
)
@click.option("--force", is_flag=True, help="overwrite the folder if it holds a study")
def command(
    recipe: str | None,
    out: str,
    lang: str,
    figures: tuple[str, ...],
    measured: str | None,
    force: bool,
    **measuring: Any,
) -> None:
    """Run the paper's study, or that of a RECIPE.toml, and write its report."""
    from pathlib import Path

    from pendula.study import run_study

    given = Path(recipe) if recipe else None
    above = next(folder for folder in Path(out).absolute().parents if folder.exists())
    if not above.is_dir():
        raise NotADirectoryError(f"cannot write {out}: {above} is not a folder")
    fitted = _fitted(measured, measuring)
    try:
        with progress_bar() as progress:
            folder = run_study(
                given,
                Path(out),
                lang,
                figures=figures,
                measured=fitted,
                overwrite=force,
                progress=progress,
            )
    except RuntimeError as error:
        raise click.ClickException(str(error)) from error
    click.echo(folder / "report.html")


command.params.extend(_MEASURING)


def _fitted(measured: str | None, measuring: dict[str, Any]) -> Fit | Comparison | PeriodFit | None:
    """The recording that gets a chapter, fitted.

    Raises:
        click.UsageError: for options of a recording where there is none.
    """
    if measured is not None:
        from pendula.cli.fit import fit_of

        return fit_of([measured], measuring)
    context = click.get_current_context()
    for each in _MEASURING:
        source = context.get_parameter_source(str(each.name))
        if source is click.core.ParameterSource.COMMANDLINE:
            raise click.UsageError(f"{each.opts[-1]} goes with --measured; name the recording")
    return None
