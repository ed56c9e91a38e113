"""What the text about a recording says in numbers and words of one language."""

from __future__ import annotations

import math
from pathlib import PurePath
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula.measured.rounding import with_uncertainty
from pendula.measured.whole_swings import periods_at
from pendula.measured.words import worded
from pendula.measured.words.reading import reading_note

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import Array
    from pendula.measured.compare import Comparison
    from pendula.measured.fitted import Fit
    from pendula.measured.measurement import Measurement, PeriodTable
    from pendula.measured.periods import PeriodFit
    from pendula.plot.labels import Labels
    from pendula.study.measured.results import MeasuredResults
    from pendula.study.notation import Numbers

_RARE = 1e-6  # what is less likely than that is told as less likely
_SHORT = 12  # digits of a checksum that tell files apart


def measured_facts(
    results: MeasuredResults, words: Labels, catalog: Mapping[str, Any], numbers: Numbers
) -> dict[str, Any]:
    """Everything the text about a recording reads, as JSON-able data."""
    fit = results.fit
    measurement = fit.measurement
    times = fit.t
    end = fit.recordings[-1 if measurement.bodies == 2 else 0].t[-1]  # windows of one recording
    return {
        "source": _source(measurement, words.language),
        "further": _further(fit),
        "quantity": catalog["measured"].get(measurement.quantity, measurement.quantity),
        "bodies": measurement.bodies,
        "samples": numbers.fixed(fit.n_samples / measurement.bodies, 0),
        "numbers": numbers.fixed(fit.n_samples, 0),
        "effective": numbers.plain(fit.n_effective, 3),
        "span": numbers.plain(float(end - times[0])),
        "spacing": _spacing(times, numbers),
        "model": worded(fit.model, words.language),
        "values": value_rows(fit, words.language, catalog),
        "plain_factor": _plain_factor(fit, numbers),
        "rms": _in_degrees(fit.rms, measurement.unit, numbers),
        "notes": [note.sentence(words.language) for note in fit.notes],
        "swings": _swings(results, numbers),
        "methods": _methods(results, words, numbers),
        "horizon": _horizon(fit, numbers),
        "models": None
        if results.models is None
        else {
            "rows": model_rows(results.models, words.language, numbers),
            "verdict": results.models.verdict(words.language),
        },
    }


def period_facts(
    fit: PeriodFit, language: str, catalog: Mapping[str, Any], numbers: Numbers
) -> dict[str, Any]:
    """Everything the text about a table of periods reads, as JSON-able data."""
    return {
        "source": _source(fit.table, language),
        "law": fit.law,
        "rows": len(fit.fitted),
        "values": period_rows(fit, language, catalog),
        "freedom": "∞"
        if math.isinf(fit.degrees_of_freedom)
        else numbers.short(fit.degrees_of_freedom),
        "corrections": correction_rows(fit, catalog, numbers),
        "verdict": period_verdict(fit, catalog, numbers),
    }


def value_rows(fit: Fit, language: str, catalog: Mapping[str, Any]) -> list[list[str]]:
    """Name and rounded value of what was fitted, and of what follows from it.

    Of a double pendulum's windows the first one's start alone.
    """
    windows = fit.measurement.bodies == 2 and len(fit.recordings) > 1
    own = [name for name in fit.names if windows and "[" in name and not name.endswith("[1]")]
    fitted = [(name, fit[name]) for name in fit.names if name not in own]
    if not isinstance(fit.recipe.get("system", ""), str):  # of a system, by its own parameters
        catalog = {**catalog, "quantities": catalog["quantities"] | catalog["parameters"]}
    return [
        [_named(name, catalog), with_uncertainty(*each, language=language)]
        for name, each in (*fit.derived.items(), *fitted)
    ]


def model_rows(models: Comparison, language: str, numbers: Numbers) -> list[list[str]]:
    """Name, residuals and BIC above that of the best of each model."""
    unit = models.best.measurement.unit
    return [
        [
            worded(row.model, language),
            _in_degrees(row.rms, unit, numbers),
            numbers.fixed(row.bic, 0),
        ]
        for row in models.rows
    ]


def period_rows(fit: PeriodFit, language: str, catalog: Mapping[str, Any]) -> list[list[str]]:
    """Name and rounded value of everything that was fitted."""
    return [
        [_named(name, catalog), with_uncertainty(*fit[name], language=language)]
        for name in fit.names
    ]


def correction_rows(
    fit: PeriodFit, catalog: Mapping[str, Any], numbers: Numbers
) -> list[list[str]]:
    """Name of each correction and what it changes g by."""
    return [
        [catalog["corrections"][each.name], numbers.plain(100.0 * each.change, 2) + "\u00a0%"]
        for each in fit.corrections
    ]


def period_verdict(fit: PeriodFit, catalog: Mapping[str, Any], numbers: Numbers) -> list[str]:
    """Sentences on how well the law holds."""
    words, found = catalog["measured"], []
    if not math.isnan(fit.birge_ratio):
        found.append(words["birge"].format(ratio=numbers.plain(fit.birge_ratio, 2)))
    if not math.isnan(fit.chance):
        sentence = words["rejected" if fit.rejects_the_law else "kept"]
        chance = numbers.plain(max(fit.chance, _RARE), 2)
        found.append(sentence.format(chance=f"< {chance}" if fit.chance < _RARE else chance))
    return found


def _named(name: str, catalog: Mapping[str, Any]) -> str:
    """A quantity's name; that of several recordings carries its number, theta[2]."""
    bare, bracket, number = name.partition("[")
    return f"{catalog['quantities'].get(bare, bare)}{bracket}{number}"


def _source(measured: Measurement | PeriodTable, language: str) -> dict[str, Any]:
    return {
        "name": PurePath(measured.source).name,
        "checksum": measured.checksum[:_SHORT],
        "notes": [reading_note(each, language) for each in measured.notes],
    }


def _further(fit: Fit) -> list[str]:
    """Names of the other files that were fitted together with the first."""
    names = dict.fromkeys(PurePath(each.measurement.source).name for each in fit.recordings)
    return list(names)[1:]


def _spacing(times: Array, numbers: Numbers) -> str:
    """The usual step between samples."""
    step = float(np.median(np.diff(times)))
    return f"{numbers.plain(1e3 * step)}\u00a0ms" if step < 1.0 else f"{numbers.plain(step)}\u00a0s"


def _plain_factor(fit: Fit, numbers: Numbers) -> str | None:
    """How much larger the errors are than those of independent samples; None: as large."""
    known = np.isfinite(fit.plain_standard_errors) & (fit.plain_standard_errors > 0)
    if not known.any():
        return None
    factor = float(np.median(fit.standard_errors[known] / fit.plain_standard_errors[known]))
    return numbers.plain(factor, 2) if factor > 1.1 else None


def _in_degrees(value: float, unit: str, numbers: Numbers) -> str:
    if unit == "rad":
        return numbers.degrees(value)
    return f"{numbers.plain(value)}\u00a0{unit}"


def _swings(results: MeasuredResults, numbers: Numbers) -> dict[str, Any] | None:
    found = results.swings
    if found is None:
        return None
    away = found.period - periods_at(results.fit["omega0_squared"].value, found.amplitude)
    return {
        "count": len(found.t),
        "first": numbers.degrees(float(found.amplitude[0])),
        "last": numbers.degrees(float(found.amplitude[-1])),
        "longest": numbers.plain(float(found.period.max()), 4),
        "shortest": numbers.plain(float(found.period.min()), 4),
        "away": numbers.plain(1e3 * float(np.sqrt((away**2).mean())), 2),
        "relative": numbers.plain(100.0 * float(np.sqrt(((away / found.period) ** 2).mean())), 2),
    }


def _methods(results: MeasuredResults, words: Labels, numbers: Numbers) -> dict[str, Any] | None:
    compared = results.compared
    if compared is None:
        return None

    def shown(error: float) -> str:
        if math.isnan(error):
            return "—"
        return numbers.degrees(error) + ("" if compared.is_angle else "/s")

    rows = []
    for name in compared.runs:
        errors = compared.errors(name)
        rows.append([words.name(name), *map(shown, errors)])
    return {
        "rows": rows,
        "step": numbers.duration(compared.step),
        "span": numbers.plain(float(compared.t[-1] - compared.t[0])),
    }


def _horizon(fit: Fit, numbers: Numbers) -> dict[str, Any] | None:
    if fit.horizon is None:
        return None
    trust = fit.horizon.trust
    return {
        "tolerance": numbers.degrees(fit.horizon.tolerance),
        "followed": numbers.plain(fit.horizon.followed),
        "left": fit.horizon.left,
        "trust": None if math.isinf(trust) else numbers.plain(trust),
    }
