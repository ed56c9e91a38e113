"""Newton's method for closed orbits, with the derivatives of the motion by its start."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

from pendula._messages import ArgumentError
from pendula.run.solve import solve

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula._types import Array
    from pendula.chaos.closing import Closing, Row
    from pendula.systems import System

_MOST_ITERATIONS = 40
_LARGEST_STEP = 0.3  # rad, or that part of the frequency in velocities
_CLOSE = 1e-9  # a correction below is of rounding if it does not fall any more
_ROUNDING = 4e-16
_OPEN = 1e-6  # of the conditions: no step changes them, as motions part too fast to come back
_CLOSED = 2e-14  # of the conditions: they hold, and where a family branches no step is better


class OrbitError(ArgumentError):
    """Newton's method found no closed orbit near the start."""


class Closed(NamedTuple):
    """A start and a period that close.

    Attributes:
        state: (d,).
        period: [s].
        correction: the last of Newton's method, angles in radians, velocities over 2π/T.
        iterations: of Newton's method.
        n_steps: of all runs.
    """

    state: Array
    period: float
    correction: float
    iterations: int
    n_steps: int


def closed_orbit(
    system: System,
    closing: Closing,
    rows: Sequence[Row],
    state: Array,
    period: float,
    *,
    driven: bool = False,
) -> Closed:
    """The closed orbit near a start, by Newton's method.

    Steps are those of least squares: the energy's constancy makes one of the conditions follow
    from the others.

    Args:
        system: of the orbit.
        closing: what has to hold for it to be closed.
        rows: what else has to hold.
        state: near it, (d,).
        period: about its own [s].
        driven: whether the period is the drive's, and stays.

    Raises:
        OrbitError: where the method does not converge.
    """
    import numpy as np

    x, t = np.array(state, float), float(period)
    dof = x.size // 2
    scales = np.concatenate([np.ones(dof), np.full(dof, math.tau / t), [t / math.tau]])
    columns = [*closing.free, *(() if driven else (x.size,))]
    last, total = math.inf, 0
    for iteration in range(1, _MOST_ITERATIONS + 1):
        value, slope, steps = _linearised(system, closing, rows, x, t, scales)
        total += steps
        step = np.zeros(x.size + 1)
        step[columns] = np.linalg.lstsq(slope[:, columns], -value, rcond=1e-13)[0]
        size = float(abs(step).max())
        if not math.isfinite(size) or size > 1e6:
            break
        missed = abs(value).max()
        if size >= 0.5 * last and last < 1e-4 and missed < _CLOSED:
            return Closed(x, t, size, iteration, total)
        change = step * scales * min(1.0, _LARGEST_STEP / size if size else 1.0)
        x, t = x + change[:-1], t + change[-1]
        settled = size <= _ROUNDING * max(1.0, abs(x).max()) or (_CLOSE > size >= 0.5 * last)
        if settled and missed > _OPEN:
            break
        if settled:
            return Closed(x, t, size, iteration, total)
        if t <= 0.0:
            break
        last = size
    raise _lost(state, period)


def _lost(state: Array, period: float) -> OrbitError:
    return OrbitError(
        "state",
        "must be near a periodic orbit: Newton's method does not converge from {value} with a "
        "period of {other} s",
        "start nearer, or give <period>",
        value=[round(each, 6) for each in state.tolist()],
        other=f"{period:.6g}",
    )


def _linearised(
    system: System, closing: Closing, rows: Sequence[Row], x: Array, t: float, scales: Array
) -> tuple[Array, Array, int]:
    """Values of the conditions, their derivatives by scaled start and period, steps of the run."""
    import numpy as np

    span = closing.part * t
    end, matrix, steps = with_matrix(system, x, span)
    value = closing.L @ end + closing.R @ x - closing.offset
    by_start = closing.L @ matrix + closing.R
    by_period = closing.part * (closing.L @ system.rhs(end, span))
    slope = np.column_stack([by_start, by_period])
    # velocities over the frequency: all conditions are then of the size of an angle
    velocities = np.arange(x.size) >= x.size // 2
    weight = np.where(abs(closing.L[:, velocities]).any(axis=1), 1.0 / scales[x.size // 2], 1.0)
    value, slope = value * weight, slope * weight[:, np.newaxis]
    for row in rows:
        more, by = row(x, t)
        value, slope = np.append(value, more), np.vstack([slope, by])
    return value, slope * scales, steps


def with_matrix(system: System, state: Array, span: float) -> tuple[Array, Array, int]:
    """The state after a time, its derivatives by the start (d, d), and the steps taken.

    Raises:
        OrbitError: where the run does not come so far.
    """
    run = solve(system, state, [span], derivatives="state")
    if run.outcome != "reached_end" or run.derivatives is None or not run.t.size:
        rule = "must be near a periodic orbit: the run from {value} ended with {other}"
        raise OrbitError("state", rule, value=state.tolist(), other=run.outcome)
    return run.states[-1], run.derivatives[-1], run.n_steps
