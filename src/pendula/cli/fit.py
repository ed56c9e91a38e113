"""`pendula fit`: from the file of a recording to values with their uncertainty, and a report."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from pendula.cli.fit_options import (
    APPARATUS,
    ERRORS,
    fitting_options,
    quantity_of,
    reading_of,
    reading_options,
)
from pendula.cli.naming import renaming
from pendula.cli.pictures import language_option
from pendula.cli.tables import can_print, paragraph, table

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from pendula.measured.compare import Comparison
    from pendula.measured.fitted import Fit
    from pendula.measured.measurement import Measurement, PeriodTable
    from pendula.measured.periods import PeriodFit

_PLAIN = str.maketrans({"±": "+-", "−": "-", "×": "x", "²": "^2", "₀": "0", "\u00a0": " "})


def _fit(**given: Any) -> None:
    report = _checked_report(given)
    found = fit_of(given["files"], given)
    for line in told(found, given["lang"]):
        click.echo(line)
    if report is not None:
        named = {"title": given["title"], "author": given["author"], "overwrite": given["force"]}
        click.echo(found.report(report, given["lang"], **named) / "report.html")


def told(found: Fit | Comparison | PeriodFit, language: str) -> list[str]:
    """Values with their uncertainty and what has to be known, as the terminal can print them."""
    from pendula.measured.periods import PeriodFit

    if isinstance(found, PeriodFit):
        lines = _periods_told(found, language)
    else:
        lines = _motion_told(found, language)
    return [line if can_print(line) else line.translate(_PLAIN) for line in lines]


def fit_of(files: Sequence[str], given: dict[str, Any]) -> Fit | Comparison | PeriodFit:
    """What the options make of recordings of one pendulum, or of a table of periods."""
    from pendula.measured import read
    from pendula.measured.measurement import PeriodTable

    with renaming(length="length_column", amplitude="amplitude_column", t="kept"):
        measured = [read(file, **reading_of(given)) for file in files]
    tables = [each for each in measured if isinstance(each, PeriodTable)]
    if not tables:
        return _fit_motion([each for each in measured if not isinstance(each, PeriodTable)], given)
    if len(measured) > 1:
        raise ValueError(f"{tables[0].source} is a table of periods; give it alone")
    return _fit_periods(tables[0], given)


def _checked_report(given: dict[str, Any]) -> Path | None:
    """The folder of the report; refuses before long work what cannot be written."""
    from pathlib import Path

    from pendula._checks import installed
    from pendula._writing import refuse_existing

    if given["report"] is None:
        return None
    for package in ("matplotlib", "typst"):
        installed(package, "report")
    folder = Path(given["report"])
    refuse_existing(folder, overwrite=given["force"])
    return folder


def _fit_motion(measured: Sequence[Measurement], given: dict[str, Any]) -> Fit | Comparison:
    from pendula.measured import compare_models, fit

    angles = [each.as_angle() if each.quantity == "position" else each for each in measured]
    length, error = quantity_of(given, "length"), quantity_of(given, "length_error")
    options: dict[str, Any] = {
        "length": length if length is None or error is None else (length, error),
        "gravity": quantity_of(given, "gravity"),
        **{name: given[name] for name in ("signs", "robust", "uncertainty")},
    }
    if given["model"] is None and angles[0].bodies == 1:
        return compare_models(angles, **options)
    with renaming(system="model"):
        return fit(angles, given["model"] or "viscous", **options)


def _fit_periods(measured: PeriodTable, given: dict[str, Any]) -> PeriodFit:
    from pendula.measured.period_corrections import Apparatus
    from pendula.measured.periods import fit_periods

    known = {name: quantity_of(given, name) for name in APPARATUS}
    named = given["corrections"]
    errors = {name: quantity_of(given, name) for name in (*ERRORS, "length_error")}
    return fit_periods(
        measured,
        apparatus=Apparatus(**{name: each for name, each in known.items() if each is not None}),
        corrections=None if named is None else [each.strip() for each in named.split(",")],
        length=quantity_of(given, "length"),
        **{name: each for name, each in errors.items() if each is not None},
    )


def _motion_told(found: Fit | Comparison, language: str) -> list[str]:
    from pendula.measured.compare import Comparison
    from pendula.measured.words import worded
    from pendula.measured.words.reading import reading_note
    from pendula.study.measured.facts import value_rows
    from pendula.study.report import catalogue

    catalog, lines = catalogue(language), []
    if isinstance(found, Comparison):
        lines = _models_told(found, language, catalog["measured"])
        found = found.best
    rows = value_rows(found, language, catalog)
    read = dict.fromkeys(note for each in found.recordings for note in each.measurement.notes)
    notes = [
        *(reading_note(each, language) for each in read),
        *(note.sentence(language) for note in found.notes),
    ]
    lines += [worded(found.model, language), table(_header(catalog), rows)]
    return [*lines, *map(paragraph, notes)]


def _models_told(found: Comparison, language: str, words: dict[str, str]) -> list[str]:
    from pendula.plot.labels import labels
    from pendula.study.measured.facts import model_rows
    from pendula.study.notation import Numbers

    header = [words[name] for name in ("model", "residuals", "above")]
    rows = model_rows(found, language, Numbers(labels(language)))
    return [table(header, rows), paragraph(found.verdict(language)), ""]


def _periods_told(found: PeriodFit, language: str) -> list[str]:
    from pendula.measured.words.reading import reading_note
    from pendula.plot.labels import labels
    from pendula.study.measured.facts import correction_rows, period_rows, period_verdict
    from pendula.study.notation import Numbers
    from pendula.study.report import catalogue

    catalog, numbers = catalogue(language), Numbers(labels(language))
    rows = period_rows(found, language, catalog)
    lines = [table(_header(catalog), rows)]
    if found.corrections:
        header = [catalog["measured"]["correction"], catalog["measured"]["change"]]
        lines.append(table(header, correction_rows(found, catalog, numbers)))
    read = (reading_note(each, language) for each in found.table.notes)
    said = [*read, *period_verdict(found, catalog, numbers)]
    return [*lines, *map(paragraph, said)]


def _header(catalog: dict[str, Any]) -> list[str]:
    return [catalog["measured"]["quantity"], catalog["measured"]["value"]]


command = click.Command(
    "fit",
    params=[
        click.Argument(
            ["files"],
            nargs=-1,
            required=True,
            metavar="FILE…",
            type=click.Path(exists=True, dir_okay=False),
        ),
        *reading_options(),
        *fitting_options(),
        click.Option(
            ["--report"], type=click.Path(), metavar="DIR", help="write a report into a new folder"
        ),
        click.Option(["--title"], default="", metavar="TEXT", help="of the report"),
        click.Option(["--author"], default="", metavar="TEXT", help="of the report"),
        language_option("the results and the report"),
        click.Option(["--force"], is_flag=True, help="replace the folder if it exists"),
    ],
    callback=_fit,
    help="Fit a pendulum to its recordings, each in a FILE, or to a table of periods.",
)
