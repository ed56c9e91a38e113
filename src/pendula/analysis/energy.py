"""A run at each of its steps, of which outputs show only some, and its energy error there."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from pendula._engine import ON_GRID
from pendula.run.request import checked_name
from pendula.run.solve import solve

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.run.trajectory import Trajectory


def at_steps(run: Trajectory) -> Trajectory:
    """The same motion with its steps as output; the run itself where it has none of its own.

    A run with output times is made again. The closed form and runs with `digits` have no steps.

    Args:
        run: one motion, of `solve` or `exact`.
    """
    asked = run.request
    no_steps = run.method == "exact" or asked.digits is not None or asked.end == asked.t0
    if no_steps or isinstance(asked.t, float):
        return run
    options = replace(asked, certify=None).options
    method = checked_name(run.method)
    return solve(run.system, asked.state, asked.end, method, t0=asked.t0, **options)


def step_energy_errors(run: Trajectory) -> tuple[Array, Array]:
    """|E − E0| / E0 at every step of a run and at every output.

    Those of the closed form and of runs with `digits`, which have no steps, are at the outputs.

    Args:
        run: one motion, of `solve` or `exact`.

    Returns:
        Times [s] and errors, each (k,), in the order of the run; a step that is an output stands
        there twice.
    """
    t, errors, again = run.t, _errors(run), at_steps(run)
    if again is run:
        return t, errors
    t, errors = np.concatenate([t, again.t]), np.concatenate([errors, _errors(again)])
    order = np.argsort(t if run.request.end > run.request.t0 else -t, kind="stable")
    return t[order], errors[order]


def largest_energy_errors(run: Trajectory) -> Array:
    """The largest |E − E0| / E0 of the steps since the output before, at each output, (n,).

    Where the run ended early, the last output has those of the steps after it too.
    """
    t, errors = step_energy_errors(run)
    if t is run.t or not run.t.size:
        return _errors(run)
    forward = 1.0 if run.request.end >= run.request.t0 else -1.0
    # A step that lies on an output is n h, which is off the output's own time by some roundings.
    slack = ON_GRID * (run.request.step or 0.0) + np.spacing(np.abs(run.t))
    place = np.minimum(np.searchsorted(forward * run.t + slack, forward * t), run.t.size - 1)
    largest = _errors(run)
    np.maximum.at(largest, place, errors)
    return largest


def _errors(run: Trajectory) -> Array:
    with np.errstate(over="ignore", invalid="ignore"):  # of a run that breaks down
        return np.abs(run.energy_error)
