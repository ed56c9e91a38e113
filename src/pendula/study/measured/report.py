"""A report of a recording, or of a table of periods: HTML and PDF, with figures and numbers."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from pendula._checks import installed, one_of
from pendula._late_methods import method_of
from pendula._version import __version__
from pendula._writing import replacing
from pendula.measured.compare import Comparison
from pendula.measured.fitted import Fit
from pendula.measured.periods import PeriodFit
from pendula.measured.words import LANGUAGES
from pendula.plot.labels import labels

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from os import PathLike

    from matplotlib.figure import Figure

    from pendula.study.data import Columns

_MAIN = "measured-report.typ"


class Content(NamedTuple):
    """What a report is made of.

    Attributes:
        title: of the report.
        text: name of its text, in the folder of each language.
        facts: what the text reads.
        figures: what draws each, by name.
        tables: columns of numbers, by name.
    """

    title: str
    text: str
    facts: dict[str, Any]
    figures: Mapping[str, Callable[[], Figure]]
    tables: Mapping[str, Columns]


@method_of(Comparison)
@method_of(Fit)
@method_of(PeriodFit)
def report(
    fit: Fit | Comparison | PeriodFit,
    path: str | PathLike[str],
    lang: str = "en",
    *,
    title: str = "",
    author: str = "",
    overwrite: bool = False,
) -> Path:
    """Write what a fit says as a report that a student can hand in.

    Writes report.html (complete in itself), report.pdf, figures/*.svg and data/*.csv. Nothing
    stands at `path` before all is done.

    Args:
        fit: of a recording, several models of one, or of a table of periods.
        path: the folder to make.
        lang: "en" or "es".
        title: of the report; empty: one that says what it is.
        author: who hands it in; empty: nobody is named.
        overwrite: replace what stands at `path`, once the new report is complete.

    Returns:
        The folder.

    Raises:
        ValueError: for an unknown language.
        FileExistsError: where `path` exists and `overwrite` is not set.
        MissingExtraError: without the packages of the extra "report".
    """
    words = labels(one_of("lang", lang, LANGUAGES))
    for package in ("matplotlib", "typst"):
        installed(package, "report")
    with replacing(Path(path), overwrite=overwrite) as folder:
        from pendula.study.report import catalogue, write_report

        catalog = catalogue(words.language)
        content = content_of(fit, words.language, catalog)
        named = {"title": title or content.title, "author": author, "text": content.text}
        facts = {
            "version": __version__,
            "language": words.language,
            "report": named | {"sections": []},
            "words": catalog,
            **content.facts,
        }
        folder.mkdir()
        write_pieces(folder, content)
        write_report(folder, facts, {}, main=_MAIN)
    return Path(path)


def content_of(
    fit: Fit | Comparison | PeriodFit, language: str, catalog: Mapping[str, Any]
) -> Content:
    """What a report says of a fit of either kind."""
    if isinstance(fit, PeriodFit):
        return _of_periods(fit, language, catalog)
    return _of_motion(fit, language, catalog)


def write_pieces(folder: Path, content: Content, kinds: Sequence[str] = ()) -> None:
    """Write figures and tables into their folders, which are made where they are missing.

    Args:
        folder: of the report.
        content: what it is made of.
        kinds: of figures, besides SVG.
    """
    from pendula.study.data import write_table
    from pendula.study.figures import write_figure

    for name in ("figures", "data"):
        (folder / name).mkdir(exist_ok=True)
    for name, draw in content.figures.items():
        write_figure(draw(), folder / "figures", name, kinds)
    for name, columns in content.tables.items():
        write_table(folder / "data" / f"{name}.csv", columns)


def _of_motion(fit: Fit | Comparison, language: str, catalog: Mapping[str, Any]) -> Content:
    from pendula.study.measured.facts import measured_facts
    from pendula.study.measured.figures import measured_figures
    from pendula.study.measured.results import measured_results
    from pendula.study.measured.tables import measured_tables
    from pendula.study.notation import Numbers

    words, results = labels(language), measured_results(fit)
    facts = measured_facts(results, words, catalog, Numbers(words))
    return Content(
        catalog["measured"]["title"],
        "measured",
        {"measured": facts},
        measured_figures(results, language),
        measured_tables(results),
    )


def _of_periods(fit: PeriodFit, language: str, catalog: Mapping[str, Any]) -> Content:
    from pendula.plot.measured_periods import period_table
    from pendula.study.measured.facts import period_facts
    from pendula.study.measured.tables import period_tables
    from pendula.study.notation import Numbers

    facts = period_facts(fit, language, catalog, Numbers(labels(language)))
    return Content(
        catalog["measured"]["title_periods"],
        "period-table",
        {"periods_measured": facts},
        {"measured-periods": lambda: period_table(fit, language=language)},
        period_tables(fit),
    )
