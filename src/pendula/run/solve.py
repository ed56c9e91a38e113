"""Solutions step by step."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from pendula import _engine
from pendula._angles import warn_of_degrees
from pendula._checks import checked_progress
from pendula._progress import part, with_bar
from pendula.run.derivatives import (
    check_method,
    checked_derivatives,
    derived_run,
    with_derivatives,
)
from pendula.run.events import crossings_of
from pendula.run.options import BEST_TOLERANCE, STANDARD_METHOD, takes_options
from pendula.run.request import Request, checked_name, request_of
from pendula.run.stiffness import warn_of_stiffness
from pendula.run.trajectory import Trajectory
from pendula.systems import System, check_system

if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Unpack

    from numpy.typing import ArrayLike

    from pendula._progress import AskedProgress, Progress
    from pendula._types import MethodName
    from pendula.run.options import RunOptions


def methods() -> tuple[_engine.Method, ...]:
    """The methods `solve` takes: name, order, kind, systems and source of each."""
    return _engine.methods()


@with_bar("solve")
@takes_options()
def solve(
    system: System,
    state: ArrayLike,
    t: ArrayLike,
    method: MethodName = STANDARD_METHOD,
    *,
    t0: float = 0.0,
    derivatives: str | Iterable[str] | None = None,
    progress: AskedProgress = None,
    **options: Unpack[RunOptions],
) -> Trajectory:
    """The motion step by step.

    Args:
        system: a pendulum.
        state: (θ, ω) or (θ1, θ2, ω1, ω2) at time t0, (d,) [rad, rad/s].
        t: one end time: the output is the method's own steps; or output times, rising from t0 or
            falling (backward), (n,) [s]. An adaptive method takes no step for them. With a fixed
            step, times on the grid t0 + n·step are hit without shortening a step; others by one
            shortened step from the grid.
        method: a name that `methods()` lists.
        t0: time of the state [s].
        derivatives: names of components of the start and of parameters to derive the states and
            the events by, or "state", "parameters" or "all"; the Taylor method alone has them.
        progress: called with the part of a long run that is done, 0 to 1, every few milliseconds;
            True: a bar, in a notebook or a terminal.
        **options: see `RunOptions`.

    Returns:
        The trajectory; `outcome` says how the run ended, `reached` how far it came.

    Raises:
        TypeError: for an option that there is none of.
        ValueError: for an unknown method, or an argument out of range.
    """
    check_system(system)
    report: Progress = checked_progress(progress)
    name = checked_name(method)
    asked, for_core = request_of(system, state, t, name, t0, **options)
    derived_by = checked_derivatives(derivatives, system)
    if derived_by:
        check_method(name, asked.digits)
    warn_of_degrees("state", state, asked.state[: system.can.degrees_of_freedom])
    warn_of_stiffness([system], abs(asked.end - asked.t0))
    if asked.digits is not None:
        return _solve_digits(system, asked, report)
    if derived_by:
        return _solve_derived(system, asked, for_core, derived_by, report)
    return trajectory_of(system, name, asked, _engine.solve(for_core, report))


def _solve_derived(
    system: System,
    asked: Request,
    for_core: _engine.Request,
    names: tuple[str, ...],
    progress: Progress,
) -> Trajectory:
    """The run with its derivatives: both at once, but where a plain run says what only it knows."""
    if isinstance(asked.t, float) or asked.certify is not None:
        result = _engine.solve(for_core, part(progress, 0.0, 0.2))
        run = trajectory_of(system, "taylor", asked, result)
        found = derived_run(system, for_core, run.t, names, part(progress, 0.2, 1.0))
    else:
        found = derived_run(system, for_core, asked.t, names, progress)
        run = replace(trajectory_of(system, "taylor", asked, found.run), changes=None)
    return with_derivatives(run, names, found)


def trajectory_of(
    system: System, method: str, asked: Request, result: _engine.RunResult
) -> Trajectory:
    """The trajectory of what the core gave."""
    dimension = asked.state.size
    return Trajectory(
        system,
        method,
        result.t,
        result.states(dimension),
        asked,
        result.outcome,
        result.n_steps,
        result.n_evaluations,
        result.reached,
        events=crossings_of(result.events, dimension),
        trust_horizon=result.trust_horizon,
        changes=result.pieces,
        dense=result.dense,
    )


def _solve_digits(system: System, asked: Request, progress: Progress) -> Trajectory:
    """States right to so many digits; those of one end time at the steps of a plain run."""
    import numpy as np

    from pendula.run.trust import digits_states

    assert asked.digits is not None
    outcome = "reached_end"
    if isinstance(asked.t, float):
        plain = replace(asked, digits=None, tolerance=BEST_TOLERANCE)
        result = _engine.solve(plain.for_core(system, "taylor"), None)
        times, outcome = result.t, result.outcome
    else:
        times = asked.t
    at_start = times[0] == asked.t0
    late = times[1:] if at_start else times
    states, precision = np.empty((0, asked.state.size)), 0
    if late.size:
        states, precision = digits_states(
            system, asked.state, late, asked.t0, asked.digits, progress
        )
    if at_start:
        states = np.concatenate([asked.state[np.newaxis], states])
    reached = float(times[-1])
    return Trajectory(
        system, "taylor", times, states, asked, outcome, reached=reached, precision=precision
    )
