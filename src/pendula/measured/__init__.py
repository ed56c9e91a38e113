"""Recordings of real pendulums: read, fitted, compared with models."""

from pendula.measured.measurement import Measurement, PeriodTable
from pendula.measured.reading import read, read_all

__all__ = ["Measurement", "PeriodTable", "read", "read_all"]
