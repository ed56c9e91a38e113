"""The part of a record that is a free swing, where a hand still holds the pendulum at its ends."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from pendula.measured.begun import Begun
from pendula.measured.least_squares import CLOSE
from pendula.measured.model import DRIVE, FRICTIONS, SingleModel
from pendula.measured.problem import minimise
from pendula.measured.system_model import TIME_OFFSET, SystemModel
from pendula.systems import DrivenPendulum

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import NDArray

    from pendula._types import Array
    from pendula.measured.fitted import Fit
    from pendula.measured.plan import Plan
    from pendula.measured.problem import Sampled

_MOST = 1500  # samples that are looked at
_ROUNDS = 5  # in which the part grows
_FEWEST = 3.0  # periods that it begins with, at least
_FAR = 3.0  # times the residuals within: the pendulum does not swing freely there
_ABRUPT = 10.0  # times them, soon: a hand, and not friction that the model does not have
_BESIDE = 2.0  # periods: soon
_BETTER = 0.6  # of the whole record's residuals: otherwise the part is nothing of its own


def ends_stick_out(made: Fit) -> bool:
    """Whether residuals are larger at an end of the record than in most of it, or everywhere."""
    import numpy as np

    recording = made.recordings[0]
    if "poor" in made.flags:
        return True
    period = made.derived["period"].value
    running = _running(recording.residuals[:, 0], recording.t, period)
    return bool(max(running[0], running[-1]) > _FAR * np.median(running))


def free_swing(plan: Plan, recording: Sampled, rms: float) -> tuple[float, float, float] | None:
    """From when to when the model describes a record much better than all of it.

    The middle half is fitted with viscous friction, and the part grows to either side for as long
    as its motion, run on and back, is near the record.

    Args:
        plan: of one pendulum without a drive.
        recording: all of it.
        rms: of the residuals of the fit to all of it.

    Returns:
        Both times [s] and the residuals between [rms]; None: no part stands out.
    """
    import numpy as np

    model = plan.model
    if not isinstance(model, SingleModel) or model.linear or set(plan.free) & {*DRIVE}:
        return None
    plan = replace(plan, frictions=("viscous",), fixed=_without_friction(plan.fixed))
    thin = recording.taken(slice(None, None, -(-len(recording.t) // _MOST)))
    n = len(thin.t)
    first, last = n // 4, n - n // 4
    part = thin.taken(slice(first, last))
    best = Begun(plan, (part,)).best(plan, plan.problem((part,)))
    for _ in range(_ROUNDS):
        problem = plan.problem((part,))
        values, inside = problem.values(0, best.x), best.rms
        period = 2.0 * math.pi / math.sqrt(values["omega0_squared"])
        if part.t[-1] - part.t[0] < _FEWEST * period:
            return None
        away, states = _away(model, thin, first, values)
        running = _running(away, thin.t, period)
        grown = _grown(running < _FAR * inside, first, last)
        if grown == (first, last):
            break
        first, last = grown
        part = thin.taken(slice(first, last))
        start = {**values, "theta": states[first, 0], "omega": states[first, 1]}
        begun = np.array([start[name] for name in problem.names])
        best = minimise(plan.problem((part,)), begun, search=CLOSE)
    if (first, last) == (0, n) or inside > _BETTER * rms:
        return None
    beside = np.abs(thin.t - 0.5 * (thin.t[first] + thin.t[last - 1]))
    beside = beside < 0.5 * (thin.t[last - 1] - thin.t[first]) + _BESIDE * period
    if running[beside].max() < _ABRUPT * inside:
        return None
    return float(thin.t[first]), float(thin.t[last - 1]), inside


def _without_friction(fixed: Mapping[str, float]) -> dict[str, float]:
    return {name: each for name, each in fixed.items() if name not in FRICTIONS}


def _grown(near: NDArray[np.bool_], first: int, last: int) -> tuple[int, int]:
    """A part, as far to either side as the record is near the motion."""
    import numpy as np

    before, after = np.flatnonzero(~near[:first]), np.flatnonzero(~near[last:])
    begin = int(before[-1]) + 1 if before.size else 0
    return begin, last + int(after[0]) if after.size else len(near)


def _away(
    model: SingleModel, recording: Sampled, first: int, values: dict[str, float]
) -> tuple[Array, Array]:
    """How far the record is from the motion with these values at sample `first`, and its states.

    Returns:
        Measured less seen (n,), and states (n, 2).
    """
    import numpy as np

    square = values["omega0_squared"]
    made = SystemModel(DrivenPendulum.body(1.0, 1.0, 1.0, square), model.quantity)
    known = {row.name: row.standard for row in made.rows} | {**values, "gravity": square}
    known[TIME_OFFSET] = float(recording.t[first] - recording.t[0])
    states = made.states(recording.t, known)
    return np.asarray((recording.values - model.seen(states, values))[:, 0]), states


def _running(away: Array, t: Array, period: float) -> Array:
    """Root of the mean square over half a period to either side, (n,); NaN counts as nothing."""
    import numpy as np

    square = np.where(np.isfinite(away), np.minimum(away**2, 1e12), 0.0)
    total = np.concatenate([[0.0], np.cumsum(square)])
    begin = np.searchsorted(t, t - 0.5 * period)
    end = np.searchsorted(t, t + 0.5 * period, side="right")
    return np.asarray(np.sqrt((total[end] - total[begin]) / (end - begin)))
