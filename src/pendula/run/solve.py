"""Solutions step by step."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from pendula import _engine
from pendula._checks import LARGEST_COUNT, check_progress, finite_number
from pendula._progress import part
from pendula.run._arguments import (
    BEST_TOLERANCE,
    checked_method,
    checked_options,
    checked_state,
    output_times,
)
from pendula.run.events import crossings_of
from pendula.run.trajectory import Request, Trajectory, run_adaptive
from pendula.systems import System, check_system

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import ArrayLike

    from pendula._progress import Progress
    from pendula._types import Array
    from pendula.run.events import Event


MOST_OUTPUTS = 10**8  # of a run's own steps: 3 to 4 GB of states
_PLAIN_SHARE = 0.02  # of the work of a certified run: the run itself


def methods() -> tuple[_engine.Method, ...]:
    """The methods `solve` takes: name, order, kind, systems and source of each."""
    return _engine.methods()


def solve(
    system: System,
    state: ArrayLike,
    t: ArrayLike,
    method: str = "taylor",
    *,
    t0: float = 0.0,
    step: float | None = None,
    tolerance: float | None = None,
    max_steps: int | None = None,
    events: Event | Iterable[Event] = (),
    certify: float | None = None,
    digits: int | None = None,
    progress: Progress = None,
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
        step: of a fixed-step method, positive [s].
        tolerance: of an adaptive method: of the error of a step, in radians or, where less, parts
            of the swing; 1e-3 down to 2^-52. None: its best.
        max_steps: most steps allowed; a run that needs more ends as "step_limit". None: no limit,
            but 10^7 where the output is an adaptive method's own steps.
        events: what to look for inside the steps of an adaptive method: `pendula.events`.
        certify: also find the first time at which an angle is off by more than this [rad], up to
            1, beside a run with twice the digits: the trajectory's `trust_horizon`.
        digits: 1 to 15: compute with as many digits as it takes for these many to be right at
            every output time, however chaotic the motion; only with the Taylor method.
        progress: told the part of a long run that is done, 0 to 1, every few milliseconds.

    Returns:
        The trajectory; its `outcome` says how the run ended, and its times what was reached.

    Raises:
        ValueError: for an unknown method, or an argument out of range.
    """
    check_system(system)
    check_progress(progress)
    chosen = checked_method(method, system)
    start = checked_state(state, system)
    origin = finite_number("t0", t0, "s")
    times, own_steps = output_times(t, origin)
    given = {"step": step, "tolerance": tolerance, "certify": certify, "max_steps": max_steps}
    options = checked_options([system], chosen, origin, times, digits, events, **given)
    wanted = float(times[0]) if own_steps else times
    asked = Request(start, wanted, origin, **options, digits=digits)
    if asked.digits is not None:
        return _solve_digits(system, asked, times, progress)
    return _solve(system, chosen, times, asked, progress)


def _solve(
    system: System, method: _engine.Method, times: Array, asked: Request, progress: Progress
) -> Trajectory:
    """Run a checked request, and certify it if asked for."""
    run = _solve_adaptive if method.adaptive else _solve_fixed
    if asked.certify is None:
        return run(system, method, times, asked, progress)
    done = run(system, method, times, asked, part(progress, 0.0, _PLAIN_SHARE))
    return replace(done, trust_horizon=_horizon(done, part(progress, _PLAIN_SHARE, 1.0)))


def _solve_fixed(
    system: System, method: _engine.Method, times: Array, asked: Request, progress: Progress
) -> Trajectory:
    """Run a checked request on the grid of its step."""
    size, span = asked.step or 0.0, float(times[-1]) - asked.t0
    whole = abs(span) / size
    own_steps = isinstance(asked.t, float)
    if own_steps and whole > MOST_OUTPUTS:
        raise ValueError(
            f"step = {size!r} s makes {whole:.3g} outputs up to t = {float(times[0]):g} s; "
            "give output times, such as t=numpy.linspace(t0, t_end, 1001), or a larger step"
        )
    t, states, reached, outcome, steps, evaluations = _engine.solve_fixed(
        system._description(),
        method.name,
        asked.state.tolist(),
        asked.t0,
        math.copysign(size, span),
        asked.max_steps or LARGEST_COUNT,
        times,
        own_steps,
        None if progress is None else lambda steps: progress(steps / whole),
    )
    counts = outcome, steps, evaluations
    return Trajectory(system, method.name, t[:reached], states[:reached], asked, *counts)


def _solve_adaptive(
    system: System, method: _engine.Method, times: Array, asked: Request, progress: Progress
) -> Trajectory:
    """Run a checked request with steps of the method's choice."""
    t, states, outcome, steps, evaluations, crossings, dense = run_adaptive(
        system, method.name, asked, progress
    )
    counts = outcome, steps, evaluations
    return Trajectory(
        system,
        method.name,
        t,
        states,
        asked,
        *counts,
        events=crossings_of(crossings),
        dense=dense,
    )


def _solve_digits(system: System, asked: Request, times: Array, progress: Progress) -> Trajectory:
    """States right to so many digits; those of one end time at the steps of a plain run."""
    import numpy as np

    from pendula.run.trust import digits_states

    assert asked.digits is not None
    outcome = "reached_end"
    if isinstance(asked.t, float):
        plain = replace(asked, digits=None, tolerance=BEST_TOLERANCE)
        times, _, outcome, *_ = run_adaptive(system, "taylor", plain, None)
    at_start = times[0] == asked.t0
    late = times[1:] if at_start else times
    states, precision = np.empty((0, asked.state.size)), 0
    if late.size:
        told = system, asked.state, late, asked.t0, asked.digits
        states, precision = digits_states(*told, progress=progress)
    if at_start:
        states = np.concatenate([asked.state[np.newaxis], states])
    return Trajectory(system, "taylor", times, states, asked, outcome, precision=precision)


def _horizon(run: Trajectory, progress: Progress) -> float:
    """When a run parts from the motion by more than asked for."""
    from pendula.run.trust import horizon

    asked = run.request
    assert asked.certify is not None
    reached = _reached(run)
    # beyond its end a run that broke down is right about nothing
    beyond = reached if run.outcome == "not_finite" else math.inf
    if reached == asked.t0:
        return beyond
    found = horizon(
        run.system,
        asked.state,
        run.method,
        asked.t0,
        reached,
        step=asked.step,
        tolerance=asked.tolerance,
        certify=asked.certify,
        progress=progress,
    )
    return beyond if math.isinf(found) else found


def _reached(run: Trajectory) -> float:
    """The time up to which a run was made, whatever its outputs."""
    if run.dense is not None:
        return run.dense.reached
    asked = run.request
    end = asked.t if isinstance(asked.t, float) else float(asked.t[-1])
    if run.outcome == "reached_end":
        return end
    return asked.t0 + math.copysign(run.n_steps * (asked.step or 0.0), end - asked.t0)
