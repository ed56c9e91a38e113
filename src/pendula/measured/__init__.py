"""Recordings of real pendulums: read, fitted, compared with models."""

from pendula.measured.compare import Compared, Comparison, compare_models
from pendula.measured.fit import fit
from pendula.measured.fitted import Fit, FittedRecording, Horizon, Quantity
from pendula.measured.words import Note

__all__ = [
    "Compared",
    "Comparison",
    "Fit",
    "FittedRecording",
    "Horizon",
    "Note",
    "Quantity",
    "compare_models",
    "fit",
]
