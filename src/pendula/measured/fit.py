"""Fits of models to recordings, with uncertainties that can be believed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from pendula._checks import flag, one_of, whole
from pendula._messages import ArgumentError
from pendula.measured import asked
from pendula.measured.ladder import Rungs, climbed
from pendula.measured.model import FRICTIONS, SingleModel
from pendula.measured.problem import Optimum, Problem
from pendula.measured.result import result_of
from pendula.measured.starts import first_window

if TYPE_CHECKING:
    from pendula.measured.asked import Known
    from pendula.measured.fitted import Fit
    from pendula.measured.measurement import Measurement
    from pendula.measured.problem import Sampled

_OWN = ("theta", "omega", "angle_offset", "rate_offset", "acceleration_offset")


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
    window: tuple[float, float] | None = None,
    robust: bool = False,
    uncertainty: str = "corrected",
    seed: int = 0,
) -> Fit:
    """Least squares on the motion itself, by a model of a pendulum.

    θ̈ = −ω0² sin θ − b ω − c sgn ω − q |ω| ω − r ω³ is run from a start that is fitted too, with
    the exact derivatives of the core. No start values are needed.

    Args:
        measurement: one recording, or several of the same pendulum that are fitted together.
        model: kinds of friction joined by +, or a sequence of them: "viscous", "coulomb",
            "quadratic", "cubic"; "undamped": none; "linear" among them: −ω0² θ.
        length: from the pivot to the bob, if known, or (value, sigma): then g is told [m].
            Otherwise that of the recording, if it has one.
        gravity: if known, or (value, sigma): then the length is told [m/s²].
        fixed: values of parameters that are not fitted, by name.
        free: names of parameters that are fitted besides: "scale", "torque", "drive_frequency",
            "drive_phase".
        shared: names of those that several recordings have in common; None: all but the start and
            the offset.
        signs: "physical": no friction is negative; "free": it may be, and the fit says so.
        start: values to start from, by name, where they are known better than the recording says.
        window: (from, to), the times that are fitted [s]; None: all.
        robust: outliers count less.
        uncertainty: "corrected": by the residuals' autocorrelation; "profile": by how the sum of
            squares grows when a parameter is held, the others fitted again; "bootstrap": by fits
            to recordings made again of blocks of residuals. Both take longer.
        seed: of the bootstrap.

    Returns:
        The fit; `flags` and `notes` say what has to be known about it.

    Raises:
        ValueError: for an argument out of range, or a recording that cannot be fitted.
    """
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
        window=window,
        robust=robust,
        uncertainty=uncertainty,
        seed=seed,
    )
    return fitted(plan, recordings, Begun(plan, recordings))


@dataclass(frozen=True, kw_only=True)
class Plan:
    """What `fit` was asked for, checked; its arguments say what each is."""

    model: SingleModel
    frictions: tuple[str, ...]
    length: Known | None = None
    gravity: Known | None = None
    fixed: Mapping[str, float] = field(default_factory=dict)
    free: tuple[str, ...] = ()
    shared: tuple[str, ...] | None = None
    signs: str = "physical"
    start: Mapping[str, float] = field(default_factory=dict)
    window: tuple[float, float] | None = None
    robust: bool = False
    uncertainty: str = "corrected"
    seed: int = 0

    @property
    def name(self) -> str:
        """The name of the model."""
        return asked.model_name(self.model.linear, self.frictions)

    def recipe(self) -> dict[str, Any]:
        """The arguments of `fit` that make this plan, as JSON has them."""
        given = {"length": self.length, "gravity": self.gravity}
        return {
            "model": self.name,
            **{name: [k.value, k.sigma] if k else None for name, k in given.items()},
            "fixed": dict(self.fixed),
            "free": list(self.free),
            "shared": None if self.shared is None else list(self.shared),
            "signs": self.signs,
            "start": dict(self.start),
            "window": None if self.window is None else list(map(float, self.window)),
            "robust": self.robust,
            "uncertainty": self.uncertainty,
            "seed": self.seed,
        }

    def problem(self, recordings: tuple[Sampled, ...]) -> Problem:
        """The least squares problem."""
        fixed = dict(self.fixed)
        names = ("theta", "omega", "omega0_squared", *self.frictions, self.model.offset)
        free = tuple(dict.fromkeys(n for n in (*names, *self.free) if n not in fixed))
        shared = self.shared
        if shared is None:
            shared = tuple(name for name in free if name not in _OWN)
        return Problem(self.model, recordings, free, shared, fixed, self.signs == "free")


def planned(measurement: Any, model: Any, **given: Any) -> tuple[Plan, tuple[Sampled, ...]]:
    """The checked arguments of `fit`, and the samples that are fitted.

    Raises:
        ValueError: for an argument out of range, or a recording that cannot be fitted.
    """
    measurements = asked.measurements_of(measurement)
    linear, frictions = asked.model_parts(model)
    made = SingleModel(_quantity(measurements[0]), linear)
    rows, window, shared = made.rows, given.get("window"), given.get("shared")
    plan = Plan(
        model=made,
        frictions=frictions,
        length=asked.known("length", _length(given.get("length"), measurements[0]), "m"),
        gravity=asked.known("gravity", given.get("gravity"), "m/s^2"),
        fixed=asked.named_values("fixed", given.get("fixed"), rows),
        free=asked.names_of("free", given.get("free", ()), rows),
        shared=None if shared is None else asked.names_of("shared", shared, rows),
        signs=one_of("signs", given.get("signs", "physical"), asked.SIGNS),
        start=asked.named_values("start", given.get("start"), rows),
        window=window,
        robust=flag("robust", given.get("robust", False)),
        uncertainty=one_of(
            "uncertainty", given.get("uncertainty", "corrected"), asked.UNCERTAINTIES
        ),
        seed=whole("seed", given.get("seed", 0)),
    )
    return plan, tuple(asked.sampled(each, window) for each in measurements)


class Begun:
    """What the first swings say, and rungs that were climbed: the same for all models of a plan."""

    def __init__(self, plan: Plan, recordings: tuple[Sampled, ...]) -> None:
        self.first: dict[str, float] = {}
        self.length = math.inf
        self.rungs: Rungs = {}
        for i, each in enumerate(recordings):
            own, length = first_window(each, plan.model, plan.fixed)
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


def _quantity(measurement: Measurement) -> str:
    if measurement.bodies != 1 or measurement.quantity == "position":
        raise ArgumentError(
            "measurement",
            "must hold the angle, rate or acceleration of one pendulum, got {value}",
            value=f"{measurement.quantity} of {measurement.bodies}",
        )
    return measurement.quantity


def _length(given: Any, measurement: Measurement) -> Any:
    """A length as given, or as the recording has it."""
    return measurement.geometry.get("length") if given is None else given
