"""Sweeps: sets of systems and starts from one recipe."""

from pendula.many.sweep import SweepRecipe, read_sweep, sweep, sweep_from

__all__ = ["SweepRecipe", "read_sweep", "sweep", "sweep_from"]
