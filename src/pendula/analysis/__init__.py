"""Measures of runs: how wrong, of what order, until when. Trajectories or arrays in, arrays out."""

from pendula.analysis.convergence import ConvergenceOrder, convergence_order
from pendula.analysis.difference import angle_difference, parting_time
from pendula.analysis.elliptic_cost import agm_iterations, series_terms
from pendula.analysis.energy import at_steps, largest_energy_errors, step_energy_errors
from pendula.analysis.linear_model import linear_model_error, period_limit, small_angle_limit
from pendula.analysis.method_work import MethodWork, WorkPrecision
from pendula.analysis.work_precision import time_scale, work_precision

__all__ = [
    "ConvergenceOrder",
    "MethodWork",
    "WorkPrecision",
    "agm_iterations",
    "angle_difference",
    "at_steps",
    "convergence_order",
    "largest_energy_errors",
    "linear_model_error",
    "parting_time",
    "period_limit",
    "series_terms",
    "small_angle_limit",
    "step_energy_errors",
    "time_scale",
    "work_precision",
]
