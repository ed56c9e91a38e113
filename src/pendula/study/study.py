"""The study from end to end: a recipe in, a folder with report, figures and numbers out."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._checks import checked_progress, installed, one_of
from pendula._messages import Message
from pendula._progress import with_bar
from pendula._version import __version__
from pendula._writing import replacing
from pendula.plot.labels import labels
from pendula.study.recipe import read_recipe

if TYPE_CHECKING:
    from collections.abc import Sequence
    from os import PathLike

    from pendula._progress import StepProgress
    from pendula._recipe_file import RecipeSource
    from pendula.measured.compare import Comparison
    from pendula.measured.fitted import Fit
    from pendula.measured.periods import PeriodFit
    from pendula.study.schema import Recipe

KINDS = ("pdf", "png")  # of figures, besides SVG

# What every finished study holds.
_MARKS = {"recipe.toml", "report.html", "report.pdf"}

# Share of the time that is over when each part begins, as measured with the default recipe.
_RUNS, _DATA, _FIGURES, _REPORT = 0.0, 0.25, 0.28, 0.9


@with_bar("study")
def run_study(
    recipe_path: RecipeSource | None,
    out: str | PathLike[str],
    language: str = "en",
    *,
    figures: str | Sequence[str] = (),
    measured: Fit | Comparison | PeriodFit | None = None,
    overwrite: bool = False,
    progress: StepProgress | bool | None = None,
) -> Path:
    """Run the study and write its report.

    Writes report.html (complete in itself), report.pdf, figures/*.svg, data/*.csv and recipe.toml,
    from which the same numbers come again bit for bit. Nothing stands at `out` before all is done.

    Args:
        recipe_path: a TOML file, or a dict of its tables, naming what differs from the study's own
            recipe; None: nothing.
        out: the folder to make.
        language: of the report, "en" or "es".
        figures: kinds to write each figure as besides SVG: "pdf", "png" or both.
        measured: a fitted recording, several models of one, or a fitted table of periods, which
            gets a chapter; None: none does.
        overwrite: replace what stands at `out`, once the new study is complete.
        progress: called with what is being done and the share that is done, from 0 to 1; True: a
            bar, in a notebook or a terminal.

    Returns:
        The folder.

    Raises:
        ValueError: for a broken recipe (its file and line are named), an unknown language or kind
            of figures.
        FileExistsError: where `out` exists and `overwrite` is not set.
        RuntimeError: if the reference run of the recipe breaks down.
        MissingExtraError: without the packages of the extra "report".
    """
    report: StepProgress = checked_progress(progress) or (lambda label, share: None)
    recipe = read_recipe(recipe_path)
    labels(language)
    kinds = (figures,) if isinstance(figures, str) else tuple(figures)
    for kind in kinds:
        one_of("figures", kind, KINDS)
    for package in ("matplotlib", "typst"):
        installed(package, "report")
    target = Path(out)
    _check_free(target, overwrite=overwrite)
    _make_parents(target)
    with replacing(target, overwrite=overwrite) as unfinished:
        _write(recipe, unfinished, language, kinds, measured, report)
        _check_free(target, overwrite=overwrite)
    return target


# A method that blows up overflows, which the report says better than a warning.
@np.errstate(over="ignore", invalid="ignore")
def _write(
    recipe: Recipe,
    folder: Path,
    language: str,
    kinds: Sequence[str],
    measured: Fit | Comparison | PeriodFit | None,
    progress: StepProgress,
) -> None:
    from pendula.study.data import write_data
    from pendula.study.facts import facts
    from pendula.study.figures import Figures
    from pendula.study.motions import motions
    from pendula.study.notation import Numbers
    from pendula.study.report import catalogue, write_report
    from pendula.study.runs import compute

    words, catalog = labels(language), catalogue(language)
    numbers, doing = Numbers(words), catalog["progress"]
    progress(doing["runs"], _RUNS)
    results = compute(recipe)
    progress(doing["data"], _DATA)
    folder.mkdir()
    (folder / "recipe.toml").write_text(recipe.text, encoding="utf-8", newline="\n")
    (folder / "data").mkdir()
    write_data(results, folder / "data")
    progress(doing["figures"], _FIGURES)
    (folder / "figures").mkdir()
    figures = Figures(results, language, catalog["systems"], numbers)
    for share in figures.write(folder / "figures", kinds):
        progress(doing["figures"], _FIGURES + share * (_REPORT - _FIGURES))
    data = facts(results, words, numbers, __version__) | {"words": catalog}
    if measured is not None:
        _add_chapter(measured, folder, kinds, data)
    progress(doing["report"], _REPORT)
    write_report(folder, data, motions(results, words, catalog["replay"]))
    progress(doing["report"], 1.0)


def _add_chapter(
    measured: Fit | Comparison | PeriodFit, folder: Path, kinds: Sequence[str], data: dict[str, Any]
) -> None:
    """Add what was measured: its figures and tables, and what the text reads."""
    from pendula.study.measured.report import content_of, write_pieces

    content = content_of(measured, data["language"], data["words"])
    write_pieces(folder, content, kinds)
    sections = data["report"]["sections"]
    before = sections.index("errata") if "errata" in sections else len(sections)
    sections.insert(before, content.text)
    data |= content.facts


def _check_free(target: Path, *, overwrite: bool) -> None:
    """Refuse what must not be replaced: anything at all, or anything but a study."""
    if not target.exists() and not target.is_symlink():
        return
    if not overwrite:
        way_out = "choose another folder, or pass <overwrite=True>"
        raise FileExistsError(Message("", "{path} exists already", way_out, path=target))
    contents = {entry.name for entry in target.iterdir()} if target.is_dir() else None
    if target.is_symlink() or contents is None or (contents and not contents >= _MARKS):
        raise FileExistsError(f"{target} is not a study, so it is not replaced; choose another")


def _make_parents(target: Path) -> None:
    try:
        target.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        reason = f"cannot write a study there: {error.strerror}"
        raise OSError(error.errno, reason, str(target.parent)) from None
