"""The figures of a recording, by the names that the text has for them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula.measured.words import worded
from pendula.plot.measured import (
    damping,
    measured_fit,
    measured_methods,
    measured_models,
    measured_portrait,
    period_of_amplitude,
    residual_autocorrelation,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.figure import Figure

    from pendula.measured.compare import Comparison
    from pendula.study.measured.results import MeasuredResults


def measured_figures(results: MeasuredResults, language: str) -> dict[str, Callable[[], Figure]]:
    """What draws each figure there is for a recording."""
    recording, found = results.fit.recordings[0], results.swings
    drawers: dict[str, Callable[[], Figure]] = {
        "measured-fit": lambda: measured_fit(recording, language=language),
        "measured-autocorrelation": lambda: residual_autocorrelation(recording, language=language),
    }
    models = results.models
    recorded, compared, own = results.recorded, results.compared, results.model_swings
    if found is not None and own is not None:
        square = results.fit["omega0_squared"].value
        drawers["measured-damping"] = lambda: damping(found, own, language=language)
        drawers["measured-period"] = lambda: period_of_amplitude(found, square, language=language)
    if recorded is not None and recorded.values.ndim == 1:
        drawers["measured-portrait"] = lambda: measured_portrait(recorded, language=language)
    if compared is not None:
        drawers["measured-methods"] = lambda: measured_methods(compared, language=language)
    if models is not None:
        drawers["measured-models"] = lambda: _models(models, language)
    return drawers


def _models(models: Comparison, language: str) -> Figure:
    names = [row.model for row in models.rows]
    in_degrees = models.best.measurement.unit == "rad"
    residuals = [math.degrees(row.rms) if in_degrees else row.rms for row in models.rows]
    return measured_models(
        [worded(name, language) for name in names],
        residuals,
        names.index(models.preferred),
        "°" if in_degrees else models.best.measurement.unit,
        language=language,
    )
