"""Sweeps: sets of systems and starts from one recipe."""

from pendula.sweeping.reading import read_sweep
from pendula.sweeping.recipe import SweepRecipe, sweep_from
from pendula.sweeping.running import sweep

__all__ = ["SweepRecipe", "read_sweep", "sweep", "sweep_from"]
