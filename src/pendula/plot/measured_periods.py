"""Figures of a table of periods: the law as a line, and how far the rows are from it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pendula.plot.labels import labels
from pendula.plot.style import line, panels, styled

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pendula.measured.periods import PeriodFit

_ROWS: dict[str, Any] = {
    "color": "#0072b2",
    "marker": "o",
    "markersize": 3.5,
    "linestyle": "none",
    "elinewidth": 1.0,
    "capsize": 2.0,
}


@styled
def period_table(fit: PeriodFit, *, language: str = "en") -> Figure:
    """T² against L, or T against θ0², with the fitted law; below the residuals.

    Args:
        fit: of a table of periods.
        language: "en" or "es".
    """
    words = labels(language)
    figure, axes = panels(2, 1, 4.2, words, sharex=True)
    top, below = axes[:, 0]
    period, errors = fit.fitted + fit.residuals, fit.errors
    if fit.law == "length":
        x = np.asarray(fit.table.length if fit.table.length is not None else fit.fitted)
        shown, fitted, bars = period**2, fit.fitted**2, 2.0 * period * errors
        names = ("length", "period_squared")
    else:
        x = np.degrees(np.asarray(fit.table.amplitude)) ** 2
        shown, fitted, bars = period, fit.fitted, errors
        names = ("amplitude_squared", "swing_period")
    order = np.argsort(x)
    top.errorbar(x, shown, bars, label=words.name("measured"), **_ROWS)
    top.plot(x[order], fitted[order], label=words.name("model"), **line("exact"))
    below.errorbar(x, fit.residuals, errors, **_ROWS)
    below.axhline(0.0, color=line("exact")["color"], linewidth=0.8)
    top.legend()
    top.set_ylabel(words.axis[names[1]])
    below.set_ylabel(words.axis["period_residual"])
    below.set_xlabel(words.axis[names[0]])
    return figure
