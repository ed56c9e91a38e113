"""Whether a file without checksums holds all of its run: what its recipe says of the end tells."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula._engine import ON_GRID
from pendula.io.whole import damaged

if TYPE_CHECKING:
    from pathlib import Path

    from pendula.run.trajectory import Trajectory


def check_ends(run: Trajectory, source: Path) -> None:
    """Refuse what cannot be all of a run, in a file that has no checksums to tell it.

    Raises:
        NotATrajectoryError: saying what does not fit.
    """
    if run.method == "exact":
        return
    asked, count = run.request, run.t.size
    complete = run.outcome == "reached_end"
    if isinstance(asked.t, float):
        if complete:
            _check_own_steps(run, asked.t, source)
        elif asked.step is not None:
            _check_rows(run, source)
    elif run.t.tolist() != asked.t[:count].tolist() or (complete and count != asked.t.size):
        raise damaged(source, f"its {count} times are not the {asked.t.size} asked for")
    if count and run.t[0] == asked.t0 and run.states[0].tolist() != asked.state.tolist():
        raise damaged(source, "row 1 is not the state at the start")
    if asked.step is not None:
        _check_grid(run, asked.step, source)
    elif not complete:
        _check_stopped(run, source)
    if complete:
        _check_found(run, source)


def _check_own_steps(run: Trajectory, end: float, source: Path) -> None:
    """Of a run that reached its end: the first time, the last, and a row for each step."""
    times: list[float] = run.t.tolist()
    if not times or times[-1] != end:
        last = f"{times[-1]!r} s" if times else "nowhere"
        raise damaged(source, f"it ends at {last}, but the run at {end!r} s")
    if times[0] != run.request.t0:
        raise damaged(source, f"row 1 is at {times[0]!r} s, not at the start")
    if run.request.digits is None:
        _check_rows(run, source)


def _check_rows(run: Trajectory, source: Path) -> None:
    """Of own steps: a row for the start and each step; the one that broke down gave none."""
    if run.t.size != run.n_steps + (run.outcome != "not_finite"):
        raise damaged(source, f"it holds {run.t.size} times of {run.n_steps} steps")


def _check_grid(run: Trajectory, step: float, source: Path) -> None:
    """Of a run of fixed step: that it took the steps to its last output, and not to the next."""
    import numpy as np

    asked = run.request
    own_steps = isinstance(asked.t, float)
    position = abs(np.atleast_1d(asked.t) - asked.t0) / step
    whole = np.round(position)
    # an output off the grid takes one step more, from which the run does not go on
    shortened = abs(position - whole) > ON_GRID + np.spacing(whole)
    counts = np.where(shortened, np.floor(position), whole) + np.cumsum(shortened)
    given = counts[: 0 if own_steps and run.outcome != "reached_end" else run.t.size]
    lacking = counts[given.size :]
    # a run that broke down counts the step at which it did
    too_few = given.size and run.n_steps < given[-1]
    if too_few or (run.n_steps > lacking[0] if lacking.size else run.n_steps != counts[-1]):
        raise damaged(
            source, f"its {run.t.size} times do not fit {run.n_steps} steps of {step!r} s"
        )


def _check_stopped(run: Trajectory, source: Path) -> None:
    """Of a run that chose its steps and stopped: that no output is lacking before it did."""
    asked, last = run.request, float(run.t[-1]) if run.t.size else run.request.t0
    if isinstance(asked.t, float):  # by an event, the first versions ended at the step before
        lacking = run.outcome == "step_limit" and not math.isclose(last, run.reached)
    else:
        lacking = bool((abs(asked.t[run.t.size :] - asked.t0) < abs(run.reached - asked.t0)).any())
    if lacking:
        raise damaged(source, f"it ends at {last!r} s, but the run went to {run.reached!r} s")


def _check_found(run: Trajectory, source: Path) -> None:
    """That what a run found on its way to the end is not beyond."""
    asked = run.request
    found = [time for each in run.events for time in each.times.tolist()]
    if run.trust_horizon is not None and math.isfinite(run.trust_horizon):
        found.append(run.trust_horizon)
    for time in [run.reached, *found]:
        if abs(time - asked.t0) > abs(asked.end - asked.t0):
            raise damaged(source, f"it ends at {asked.end!r} s, but the run went to {time!r} s")
