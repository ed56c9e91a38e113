"""Recordings of real pendulums: read, fitted, compared with models."""

from pendula.measured.fit import fit
from pendula.measured.fitted import Fit, FittedRecording, Horizon, Quantity
from pendula.measured.words import Note

__all__ = ["Fit", "FittedRecording", "Horizon", "Note", "Quantity", "fit"]
