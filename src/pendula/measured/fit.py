"""Fits of models to recordings, with uncertainties that can be believed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from pendula._checks import flag, one_of, positive_number, whole
from pendula._messages import ArgumentError
from pendula.measured import asked
from pendula.measured.double_model import JOINTS, SHAPE, STATE, DoubleModel, shape_of
from pendula.measured.ladder import Rungs, climbed
from pendula.measured.model import FRICTIONS, SingleModel
from pendula.measured.problem import Optimum, Problem
from pendula.measured.result import result_of
from pendula.measured.starts import first_window
from pendula.measured.windows import cut, horizon_of, shot
from pendula.systems import DampedDoublePendulum, DoublePendulum

if TYPE_CHECKING:
    from pendula.measured.asked import Known
    from pendula.measured.fitted import Fit
    from pendula.measured.measurement import Measurement
    from pendula.measured.problem import Sampled
    from pendula.systems import System

_OWN = ("theta", "omega", *STATE, "angle_offset", "rate_offset", "acceleration_offset")


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
        geometry=geometry,
        windows=windows,
        tolerance=tolerance,
    )
    if isinstance(plan.model, DoubleModel):
        return fitted_double(plan, recordings[0])
    return fitted(plan, recordings, Begun(plan, recordings))


@dataclass(frozen=True, kw_only=True)
class Plan:
    """What `fit` was asked for, checked; its arguments say what each is."""

    model: SingleModel | DoubleModel
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
    geometry: System | None = None
    windows: float | None = None
    tolerance: float = 0.1

    @property
    def name(self) -> str:
        """The name of the model."""
        linear = isinstance(self.model, SingleModel) and self.model.linear
        kinds = dict.fromkeys(name.rstrip("12") for name in self.frictions)
        return asked.model_name(linear, kinds)

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
            **self._double_recipe(),
        }

    def _double_recipe(self) -> dict[str, Any]:
        """The arguments that a double pendulum alone has."""
        if isinstance(self.model, SingleModel):
            return {}
        known = self.geometry
        return {
            "geometry": None if known is None else {"form": known.form, **known.parameters},
            "windows": self.windows,
            "tolerance": self.tolerance,
        }

    def problem(self, recordings: tuple[Sampled, ...]) -> Problem:
        """The least squares problem."""
        fixed = dict(self.fixed)
        if isinstance(self.model, SingleModel):
            names = ("theta", "omega", "omega0_squared", *self.frictions, self.model.offset)
        elif self.geometry is None:
            names = (*STATE, *SHAPE, *self.frictions)
        else:
            names = (*STATE, *self.frictions)
            known = shape_of(self.geometry)
            fixed = {**{k: v for k, v in known.items() if k not in names}, **fixed}
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
    made = _model(measurements, linear, frictions)
    rows, window, shared = made.rows, given.get("window"), given.get("shared")
    if isinstance(made, DoubleModel):
        frictions = tuple(name for name in JOINTS if name[:-1] in frictions)
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
        geometry=_geometry(given.get("geometry"), made),
        windows=_seconds(given.get("windows")),
        tolerance=positive_number("tolerance", given.get("tolerance", 0.1), "rad"),
    )
    return plan, tuple(asked.sampled(each, window) for each in measurements)


class Begun:
    """What the first swings say, and rungs that were climbed: the same for all models of a plan."""

    def __init__(self, plan: Plan, recordings: tuple[Sampled, ...]) -> None:
        self.first: dict[str, float] = {}
        self.length = math.inf
        self.rungs: Rungs = {}
        assert isinstance(plan.model, SingleModel)
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


def fitted_double(plan: Plan, recording: Sampled) -> Fit:
    """The fit of a double pendulum that was planned."""
    parts = [recording] if plan.windows is None else cut(recording, plan.windows)
    problem, best = shot(plan.problem(tuple(parts)), robust=plan.robust)
    made = result_of(plan, problem, best, best.rms)
    return replace(made, horizon=horizon_of(made, recording, plan.tolerance))


def _model(
    measurements: Sequence[Measurement], linear: bool, frictions: Sequence[str]
) -> SingleModel | DoubleModel:
    """The model of what was measured.

    Raises:
        ValueError: where there is none.
    """
    first = measurements[0]
    if first.quantity == "position" or (first.bodies == 2 and first.quantity != "angle"):
        raise ArgumentError(
            "measurement",
            "must hold angles, or the rate or acceleration of one pendulum, got {value}",
            "read it as an angle",
            value=first.quantity,
        )
    if first.bodies == 1:
        return SingleModel(first.quantity, linear)
    if len(measurements) > 1:
        rule = "must be one recording of a double pendulum, got {value}"
        raise ArgumentError("measurement", rule, "fit each alone", value=len(measurements))
    if linear or not set(frictions) <= {"viscous", "coulomb"}:
        rule = 'must be "undamped", "viscous" or "viscous + coulomb" of a double pendulum'
        raise ArgumentError("model", rule)
    return DoubleModel()


def _geometry(given: object, model: SingleModel | DoubleModel) -> System | None:
    """A known double pendulum.

    Raises:
        ValueError: for anything else.
    """
    if given is None:
        return None
    if not isinstance(given, DoublePendulum | DampedDoublePendulum) or not isinstance(
        model, DoubleModel
    ):
        rule = "must be a double pendulum, beside a recording of one, got {value}"
        raise ArgumentError("geometry", rule, value=given)
    return given


def _seconds(given: object) -> float | None:
    return None if given is None else positive_number("windows", given, "s")


def _length(given: Any, measurement: Measurement) -> Any:
    """A length as given, or as the recording has it."""
    return measurement.geometry.get("length") if given is None else given
