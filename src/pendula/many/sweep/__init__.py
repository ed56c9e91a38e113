"""Sweeps: sets of systems and starts from one recipe."""

from pendula.many.sweep.reading import read_sweep
from pendula.many.sweep.recipe import SweepRecipe, sweep_from
from pendula.many.sweep.running import sweep

__all__ = ["SweepRecipe", "read_sweep", "sweep", "sweep_from"]
