"""Recordings of real pendulums: read, fitted, compared with models."""

from pendula.measured.compare import Compared, Comparison, compare_models
from pendula.measured.fit import fit
from pendula.measured.fitted import Fit, FittedRecording, Horizon, Quantity
from pendula.measured.measurement import Measurement, PeriodTable
from pendula.measured.period_arrays import g_from_periods
from pendula.measured.period_corrections import Apparatus
from pendula.measured.periods import PeriodFit, fit_periods
from pendula.measured.reading import read, read_all
from pendula.measured.rounding import with_uncertainty
from pendula.measured.words import Note

__all__ = [
    "Apparatus",
    "Compared",
    "Comparison",
    "Fit",
    "FittedRecording",
    "Horizon",
    "Measurement",
    "Note",
    "PeriodFit",
    "PeriodTable",
    "Quantity",
    "compare_models",
    "fit",
    "fit_periods",
    "g_from_periods",
    "read",
    "read_all",
    "with_uncertainty",
]
