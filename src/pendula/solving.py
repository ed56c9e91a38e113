"""Solutions step by step."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula import _engine
from pendula._checks import (
    finite_array,
    finite_number,
    one_of,
    positive_number,
    states_array,
    whole_number,
)
from pendula.systems import System, check_system
from pendula.trajectory import Request, Trajectory

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

MOST_STEPS = 2**53  # whole numbers are exact in a double up to here
MOST_OUTPUTS = 10**8  # of a run's own steps: 3 to 4 GB of states


def methods() -> tuple[_engine.Method, ...]:
    """The methods `solve` takes: name, order, kind, systems and source of each."""
    return _engine.methods()


def solve(
    system: System,
    state: ArrayLike,
    t: ArrayLike,
    method: str,
    *,
    t0: float = 0.0,
    step: float | None = None,
    max_steps: int | None = None,
    progress: Callable[[float], None] | None = None,
) -> Trajectory:
    """The motion step by step.

    Args:
        system: a pendulum.
        state: (θ, ω) or (θ1, θ2, ω1, ω2) at time t0, (d,) [rad, rad/s].
        t: one end time: the output is the method's own steps; or output times, rising from t0 or
            falling (backward), (n,) [s]. Times on the grid t0 + n·step are hit without shortening a
            step; others by one shortened step from the grid.
        method: a name that `methods()` lists.
        t0: time of the state [s].
        step: of a fixed-step method, positive [s].
        max_steps: most steps allowed; a run that needs more ends as "step_limit".
        progress: told the part of a long run that is done, 0 to 1, every few milliseconds.

    Returns:
        The trajectory; its `outcome` says how the run ended, and its times what was reached.

    Raises:
        ValueError: for an unknown method, or an argument out of range.
    """
    check_system(system)
    one_of("method", method, (each.name for each in methods()))
    start = states_array(state, system.components)
    if start.ndim != 1:
        raise ValueError(
            f"state must be one state of shape ({start.shape[-1]},), got {start.shape}"
        )
    origin = finite_number("t0", t0, "s")
    times, own_steps = _output_times(t, origin)
    size = _step_size(method, step, origin, float(times[-1]))
    limit = None if max_steps is None else whole_number("max_steps", max_steps, MOST_STEPS)
    asked = Request(start, float(times[0]) if own_steps else times, origin, size, limit)
    return _solve_fixed(system, method, times, asked, progress)


def _solve_fixed(
    system: System,
    method: str,
    times: Array,
    asked: Request,
    progress: Callable[[float], None] | None,
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
    t, states, reached, outcome, steps = _engine.solve_fixed(
        system._description(),
        method,
        asked.state.tolist(),
        asked.t0,
        math.copysign(size, span),
        asked.max_steps or MOST_STEPS,
        times,
        own_steps,
        None if progress is None else lambda steps: progress(steps / whole),
    )
    evaluations = {each.name: each.evaluations_per_step for each in methods()}[method]
    return Trajectory(
        system, method, t[:reached], states[:reached], asked, outcome, steps, steps * evaluations
    )


def _output_times(t: ArrayLike, t0: float) -> tuple[Array, bool]:
    """The times (n,), and whether the one of them is the end of a run's own steps."""
    import numpy as np

    times = finite_array("t", t, "s")
    if times.ndim == 0:
        if float(times) == t0:
            raise ValueError(f"t must differ from t0 = {t0!r} s, got {float(times)!r}")
        return times.reshape(1), True
    if times.ndim != 1 or times.size == 0:
        raise ValueError(
            f"t must be one end time or output times of shape (n,), got shape {times.shape}"
        )
    direction = np.sign(float(times[-1]) - t0)
    gaps = np.diff(times)
    if (gaps * direction <= 0).any() or (float(times[0]) - t0) * direction < 0:
        raise ValueError(
            f"t must rise (or fall) strictly from t0 = {t0!r} s or later, got {_shortened(times)}"
        )
    return times, False


def _shortened(times: Array) -> str:
    shown = ", ".join(f"{value:g}" for value in times[:4])
    return f"[{shown}{', …' if times.size > 4 else ''}]"


def _step_size(method: str, step: float | None, t0: float, end: float) -> float:
    span = end - t0
    if step is None:
        raise ValueError(
            f"step is needed by the fixed-step method {method!r}; give step=0.001 [s], say"
        )
    size = positive_number("step", step, "s")
    if span != 0.0 and size > abs(span):
        raise ValueError(
            f"step must not exceed the span of {abs(span)!r} s from t0 to the end, got {size!r} s"
        )
    if abs(span) / size > MOST_STEPS:
        raise ValueError(
            f"step = {size!r} s is too small for a span of {abs(span)!r} s: over 2^53 steps"
        )
    if t0 + size == t0 or end - math.copysign(size, span) == end:
        raise ValueError(
            f"step = {size!r} s is below the rounding of times near {max(abs(t0), abs(end))!r} s; "
            "let t0 be 0, or take a larger step"
        )
    return size
