"""Recordings of real pendulums: read, fitted, compared with models."""

from pendula.measured.compare import Compared, Comparison, compare_models
from pendula.measured.fit import fit
from pendula.measured.fitted import Fit, FittedRecording, Horizon, Quantity
from pendula.measured.measurement import Measurement, PeriodTable
from pendula.measured.reading import read, read_all
from pendula.measured.words import Note

__all__ = [
    "Compared",
    "Comparison",
    "Fit",
    "FittedRecording",
    "Horizon",
    "Measurement",
    "Note",
    "PeriodTable",
    "Quantity",
    "compare_models",
    "fit",
    "read",
    "read_all",
]
