"""Recordings of real pendulums: read, fitted, compared with models."""

from pendula.measured.fitted import Fit, FittedRecording, Horizon, Quantity

__all__ = ["Fit", "FittedRecording", "Horizon", "Quantity"]
