"""The energy error of a run at each of its steps, of which outputs show only some."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from pendula.run.request import checked_name
from pendula.run.solve import solve

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.run.trajectory import Trajectory


def step_energy_errors(run: Trajectory) -> tuple[Array, Array]:
    """|E − E0| / E0 at every step of a run and at every output.

    A run with output times of its own is made again with its steps as output. The closed form and
    runs with `digits` have no steps: theirs are at the outputs.

    Args:
        run: one motion, of `solve` or `exact`.

    Returns:
        Times [s] and errors, each (k,), in the order of the run; a step that is an output stands
        there twice.
    """
    asked = run.request
    t, errors = run.t, _errors(run)
    no_steps = run.method == "exact" or asked.digits is not None or asked.end == asked.t0
    if no_steps or isinstance(asked.t, float):
        return t, errors
    options = replace(asked, certify=None).options
    again = solve(
        run.system, asked.state, asked.end, checked_name(run.method), t0=asked.t0, **options
    )
    t, errors = np.concatenate([t, again.t]), np.concatenate([errors, _errors(again)])
    order = np.argsort(t if asked.end > asked.t0 else -t, kind="stable")
    return t[order], errors[order]


def largest_energy_errors(run: Trajectory) -> Array:
    """The largest |E − E0| / E0 of the steps since the output before, at each output, (n,).

    Where the run ended early, the last output has those of the steps after it too.
    """
    t, errors = step_energy_errors(run)
    if t is run.t or not run.t.size:
        return _errors(run)
    forward = 1.0 if run.request.end >= run.request.t0 else -1.0
    place = np.minimum(np.searchsorted(forward * run.t, forward * t), run.t.size - 1)
    largest = _errors(run)
    np.maximum.at(largest, place, errors)
    return largest


def _errors(run: Trajectory) -> Array:
    with np.errstate(over="ignore", invalid="ignore"):  # of a run that breaks down
        return np.abs(run.energy_error)
