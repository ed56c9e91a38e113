"""Fits of models to recordings, with uncertainties that can be believed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from pendula.measured.double_model import DoubleModel
from pendula.measured.ladder import Rungs, climbed
from pendula.measured.model import FRICTIONS, SingleModel
from pendula.measured.plan import Plan, planned
from pendula.measured.result import result_of
from pendula.measured.starts import first_window
from pendula.measured.windows import cut, horizon_of, shot
from pendula.measured.words import Note

if TYPE_CHECKING:
    from pendula.measured.fitted import Fit
    from pendula.measured.measurement import Measurement
    from pendula.measured.problem import Optimum, Problem, Sampled
    from pendula.systems import System


def fit(
    measurement: Measurement | Iterable[Measurement],
    model: str | Sequence[str] = "viscous",
    *,
    length: float | tuple[float, float] | None = None,
    gravity: float | tuple[float, float] | None = None,
    fixed: Mapping[str, float] | None = None,
    free: str | Sequence[str] = (),
    shared: str | Sequence[str] | None = None,
    signs: str = "physical",
    start: Mapping[str, float] | None = None,
    t: tuple[float, float] | None = None,
    robust: bool = False,
    uncertainty: str = "corrected",
    seed: int = 0,
    geometry: System | None = None,
    windows: float | None = None,
    tolerance: float = 0.1,
) -> Fit:
    """Least squares on the motion itself, by a model of a pendulum.

    θ̈ = −ω0² sin θ − b ω − c sgn ω − q |ω| ω − r ω³ is run from a start that is fitted too, with
    the exact derivatives of the core. No start values are needed.

    Args:
        measurement: one recording, or several of the same pendulum that are fitted together.
        model: kinds of friction joined by +, or a sequence of them: "viscous", "coulomb",
            "quadratic", "cubic"; "undamped": none; "linear" among them: −ω0² θ.
        length: from the pivot to the bob, or from pivot to joint, if known, or (value, sigma): then
            g is told [m]. Otherwise that of the recording, if it has one.
        gravity: if known, or (value, sigma): then the length is told [m/s²].
        fixed: values of parameters that are not fitted, by name.
        free: names of parameters that are fitted besides: "scale", "torque", "drive_frequency",
            "drive_phase".
        shared: names of those that several recordings have in common; None: all but the start and
            the offset.
        signs: "physical": no friction is negative; "free": it may be, and the fit says so.
        start: values to start from, by name, where they are known better than the recording says.
        t: (from, to), the times that are fitted [s]; None: all.
        robust: outliers count less.
        uncertainty: "corrected": by the residuals' autocorrelation; "profile": by how the sum of
            squares grows when a parameter is held, the others fitted again; "bootstrap": by fits
            to recordings made again of blocks of residuals. Both take longer.
        seed: of the bootstrap.
        geometry: of a double pendulum, if known: a `DampedDoublePendulum`. Then its shape, and
            friction that the model does not name, are not fitted; otherwise B, C, D and E over A
            are, which is all that a motion tells.
        windows: of a double pendulum: length of the windows, which each have a start of their own
            [s]; None: one window, or several where the motion cannot be followed in one.
        tolerance: of a double pendulum: angle by which model and measurement may differ where
            `horizon` says how long they agree [rad].

    Returns:
        The fit; `flags` and `notes` say what has to be known about it.

    Raises:
        ValueError: for an argument out of range, or a recording that cannot be fitted.
    """
    double = {"geometry": geometry, "windows": windows, "tolerance": tolerance}
    plan, recordings = planned(
        measurement,
        model,
        length=length,
        gravity=gravity,
        fixed=fixed,
        free=free,
        shared=shared,
        signs=signs,
        start=start,
        t=t,
        robust=robust,
        uncertainty=uncertainty,
        seed=seed,
        **double,
    )
    if isinstance(plan.model, DoubleModel):
        return fitted_double(plan, recordings[0])
    return fitted(plan, recordings, Begun(plan, recordings))


class Begun:
    """What the first swings say, and rungs that were climbed: the same for all models of a plan."""

    def __init__(self, plan: Plan, recordings: tuple[Sampled, ...]) -> None:
        self.first: dict[str, float] = {}
        self.length = math.inf
        self.rungs: Rungs = {}
        assert isinstance(plan.model, SingleModel)
        constants = plan.problem(recordings).constants
        for i, each in enumerate(recordings):
            own, length = first_window(each, plan.model, constants)
            self.length = min(self.length, length)
            for name, value in {**own, **plan.start}.items():
                if len(recordings) > 1:
                    self.first[f"{name}[{i + 1}]"] = value
                self.first.setdefault(name, value)  # what is shared: as of the first recording

    def best(self, plan: Plan, problem: Problem) -> Optimum:
        """The optimum of a problem."""
        return climbed(problem, self.first, self.length, self.rungs, robust=plan.robust)


def fitted(plan: Plan, recordings: tuple[Sampled, ...], begun: Begun) -> Fit:
    """The fit that was planned."""
    problem = plan.problem(recordings)
    best = begun.best(plan, problem)
    viscous = best.rms  # what an undamped model is to be compared with
    if not plan.frictions and not any(plan.fixed.get(name) for name in FRICTIONS):
        damped = replace(plan, frictions=("viscous",))
        viscous = begun.best(damped, damped.problem(recordings)).rms
    return result_of(plan, problem, best, viscous)


def fitted_double(plan: Plan, recording: Sampled) -> Fit:
    """The fit of a double pendulum that was planned."""
    parts = [recording] if plan.windows is None else cut(recording, plan.windows)
    problem, best = shot(plan.problem(tuple(parts)), robust=plan.robust)
    made = result_of(plan, problem, best, best.rms)
    horizon = horizon_of(made, recording, plan.tolerance)
    if horizon is None:
        return made
    key = "lost" if horizon.trust < horizon.followed else "left" if horizon.left else "followed"
    note = Note(key, {name: float(x) for name, x in horizon._asdict().items() if name != "left"})
    return replace(made, horizon=horizon, notes=(*made.notes, note), flags=(*made.flags, note.key))
