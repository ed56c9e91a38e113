"""Figures: trajectories or arrays in, a matplotlib figure out; animations into files.

matplotlib is imported by the first figure drawn.
"""

from pendula.plot.animation import animate
from pendula.plot.bifurcations import bifurcation
from pendula.plot.comparison import angles, convergence, parting, series, tip_paths
from pendula.plot.indicator_maps import indicator_map
from pendula.plot.maps import divergence_map, flip_map, stored_map
from pendula.plot.measured import (
    damping,
    measured_fit,
    measured_methods,
    measured_models,
    measured_portrait,
    period_of_amplitude,
    residual_autocorrelation,
)
from pendula.plot.measured_periods import period_table
from pendula.plot.orbits import family, periodic_orbit
from pendula.plot.overview import trajectory
from pendula.plot.pendulum import elliptic_cost, linear_error, periods, phase_portrait
from pendula.plot.running import running
from pendula.plot.sections import section
from pendula.plot.shares import chaotic_share
from pendula.plot.spectra import spectrum
from pendula.plot.style import picture, svg
from pendula.plot.work_precision import work_precision

__all__ = [
    "angles",
    "animate",
    "bifurcation",
    "chaotic_share",
    "convergence",
    "damping",
    "divergence_map",
    "elliptic_cost",
    "family",
    "flip_map",
    "indicator_map",
    "linear_error",
    "measured_fit",
    "measured_methods",
    "measured_models",
    "measured_portrait",
    "parting",
    "period_of_amplitude",
    "period_table",
    "periodic_orbit",
    "periods",
    "phase_portrait",
    "picture",
    "residual_autocorrelation",
    "running",
    "section",
    "series",
    "spectrum",
    "stored_map",
    "svg",
    "tip_paths",
    "trajectory",
    "work_precision",
]
