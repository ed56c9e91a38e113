"""Experiment against formula against method: what the paper was after, with absolute errors."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from pendula.run.exact import exact
from pendula.run.solve import solve
from pendula.study.runs import METHODS
from pendula.systems import LinearPendulum, SimplePendulum

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.measured.fitted import Fit
    from pendula.measured.whole_swings import Seen
    from pendula.run.trajectory import Trajectory

_SWINGS = 10  # how long the experiment is followed, in periods of small swings
_STEPS_A_PERIOD = 100  # about; the step is a round number
_FEWEST = 20  # samples, in the first swings
_ROUND = (1.0, 2.0, 5.0)


class Errors(NamedTuple):
    """How far one solution is from the experiment, and from the fitted model's exact motion.

    Angles [rad], or where the rate was measured rates [rad/s].

    Attributes:
        largest: from the experiment; NaN: the run broke down.
        rms: from the experiment.
        of_the_method: largest from the fitted model; NaN for the model itself.
    """

    largest: float
    rms: float
    of_the_method: float


@dataclass(frozen=True, eq=False)
class MethodComparison:
    """The experiment beside formulas and methods, over its first swings.

    Attributes:
        t: times of the samples, (n,) [s].
        measured: angles [rad] or rates [rad/s], (n,), of a double pendulum (n, 2); NaN: missing.
        is_angle: which of both.
        runs: of one pendulum "undamped" (the closed form without friction) and "damped-linear" (the
            closed form of the linear pendulum with viscous friction); "model" (the fitted model
            without error of a method), and the methods that solve the fitted model with the step.
        step: of the methods [s].
    """

    t: Array
    measured: Array
    is_angle: bool
    runs: dict[str, Trajectory]
    step: float

    def values(self, name: str) -> Array:
        """What was measured, as one run has it, shaped alike; NaN from where the run ended."""
        run = self.runs[name]
        found = run.theta if self.is_angle else run.omega
        missing = [(0, len(self.t) - len(found)), (0, 0)][: found.ndim]
        return np.pad(found, missing, constant_values=np.nan)

    def difference(self, name: str) -> Array:
        """How far one run is from the experiment, shaped alike; NaN where either is missing."""
        return np.abs(self.values(name) - self.measured)

    def errors(self, name: str) -> Errors:
        """The errors of one run."""
        run = self.runs[name]
        if run.outcome != "reached_end":
            return Errors(math.nan, math.nan, math.nan)
        away = self.difference(name)
        own = math.nan
        if name != "model":
            own = float(np.abs(self.values(name) - self.values("model")).max())
        return Errors(float(np.nanmax(away)), math.sqrt(float(np.nanmean(away**2))), own)


def compare_methods(fit: Fit, recorded: Seen) -> MethodComparison | None:
    """The first swings of a recording by formula and by each method of the paper.

    All start from the fitted state, with the fitted values. None: the fitted pendulum is so fast
    that the record has next to no samples of its first swings, as one of a failed fit may be.
    """
    recording = fit.recordings[0]
    period = math.tau / recorded.model.system.slowest_frequency
    early = recorded.t <= recorded.t[0] + _SWINGS * period
    if np.count_nonzero(early) < _FEWEST:
        return None
    t, start = recorded.t[early], recording.start
    step, t0 = _round_step(period / _STEPS_A_PERIOD), float(t[0])
    runs = {} if recorded.values.ndim > 1 else _closed_forms(fit, recorded, t)
    system = recorded.model.system
    runs["model"] = solve(system, start, t, t0=t0)
    with np.errstate(over="ignore", invalid="ignore"):
        runs |= {name: solve(system, start, t, name, t0=t0, step=step) for name in METHODS}
    return MethodComparison(t, recorded.values[early], recorded.is_angle, runs, step)


def _closed_forms(fit: Fit, recorded: Seen, t: Array) -> dict[str, Trajectory]:
    """One pendulum without friction, and the linear one with viscous friction."""
    square, start, t0 = fit["omega0_squared"].value, fit.start, float(t[0])
    linear = LinearPendulum(1.0, square, 1.0, viscous=_damping(recorded))
    return {
        "undamped": exact(SimplePendulum(1.0, square), start, t, t0=t0),
        "damped-linear": exact(linear, start, t, t0=t0),
    }


def _damping(recorded: Seen) -> float:
    """Friction over inertia of the linear pendulum that loses as much energy in the record [1/s].

    Of E ∝ exp(−b t) for viscous friction b over the inertia.
    """
    energy = recorded.model.energy
    span = float(recorded.t[-1] - recorded.t[0])
    left = max(float(energy[-1] / energy[0]), 1e-6)
    return max(-math.log(left) / span, 0.0) if left < 1.0 else 0.0


def _round_step(about: float) -> float:
    """The largest of 1, 2, 5, 10 … that is not above."""
    ten = 10.0 ** math.floor(math.log10(about))
    return max(each * ten for each in _ROUND if each * ten <= about * (1.0 + 1e-9))
