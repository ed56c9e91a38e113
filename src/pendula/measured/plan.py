"""What a fit is asked for, checked, and the problem that follows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from pendula._checks import flag, one_of, positive_number, whole
from pendula._messages import ArgumentError
from pendula.measured import asked
from pendula.measured.double_model import JOINTS, OFFSETS, SHAPE, STATE, DoubleModel
from pendula.measured.model import SingleModel
from pendula.measured.problem import Problem
from pendula.measured.system_asked import RESISTANCES, bounds_of, free_names, system_model
from pendula.measured.system_model import TIME_OFFSET, SystemModel
from pendula.systems import System

if TYPE_CHECKING:
    from pendula.measured.asked import Known
    from pendula.measured.measurement import Measurement
    from pendula.measured.problem import Sampled

_OWN = (  # what each recording has for itself
    *("theta", "omega", *STATE),
    *("angle_offset", "rate_offset", "acceleration_offset", *OFFSETS, TIME_OFFSET),
)


@dataclass(frozen=True, kw_only=True)
class Plan:
    """What `fit` was asked for, checked; its arguments say what each is."""

    model: SingleModel | DoubleModel | SystemModel
    frictions: tuple[str, ...]
    length: Known | None = None
    gravity: Known | None = None
    fixed: Mapping[str, float] = field(default_factory=dict)
    free: tuple[str, ...] = ()
    bounds: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    shared: tuple[str, ...] | None = None
    signs: str = "physical"
    start: Mapping[str, float] = field(default_factory=dict)
    t: tuple[float, float] | None = None
    robust: bool = False
    uncertainty: str = "corrected"
    seed: int = 0
    windows: float | None = None
    continuity: float = 1.0
    tolerance: float = 0.1

    @property
    def name(self) -> str:
        """The name of the model, or of the system by its class and form."""
        if isinstance(self.model, SystemModel):
            return repr(self.model.known).partition("(")[0]
        linear = isinstance(self.model, SingleModel) and self.model.linear
        kinds = dict.fromkeys(name.rstrip("12") for name in self.frictions)
        return asked.model_name(linear, kinds)

    @property
    def bodies(self) -> int:
        """How many angles the pendulum has."""
        return 1 if isinstance(self.model, SingleModel) else self.model.bodies

    def recipe(self) -> dict[str, Any]:
        """The arguments of `fit` that make this plan, as JSON has them."""
        given = {"length": self.length, "gravity": self.gravity}
        known = self.model.known.description() if isinstance(self.model, SystemModel) else None
        return {
            "system": known or self.name,
            **{name: (k.value, k.sigma) if k else None for name, k in given.items()},
            "fixed": dict(self.fixed),
            "free": self.free,
            "bounds": dict(self.bounds),
            "shared": self.shared,
            "signs": self.signs,
            "start": dict(self.start),
            "t": None if self.t is None else tuple(map(float, self.t)),
            "robust": self.robust,
            "uncertainty": self.uncertainty,
            "seed": self.seed,
            **self._double_recipe(),
        }

    def _double_recipe(self) -> dict[str, Any]:
        """The arguments that a double pendulum alone has."""
        names = ("windows", "continuity", "tolerance")
        return {} if self.bodies == 1 else {name: getattr(self, name) for name in names}

    def sensor(self, measurement: Measurement) -> dict[str, float]:
        """What is known of an accelerometer: whether it feels gravity, and how far out it is.

        Raises:
            ValueError: without gravity or a length the size of the swing is not told.
        """
        linear = bool(measurement.reading.get("linear", False))
        known = {"gravity_seen": 0.0 if linear else 1.0}
        if self.length is not None:
            return {**known, "sensor_radius": self.length.value}
        if linear and "sensor_radius" not in self.fixed:
            raise ArgumentError(
                "length",
                "is needed for an acceleration without gravity, L ω²",
                "give the distance of the sensor from the pivot [m]",
            )
        return known

    def problem(self, recordings: tuple[Sampled, ...]) -> Problem:
        """The least squares problem."""
        fixed = dict(self.fixed)
        if isinstance(self.model, SystemModel):
            names = self.free
            if self.model.quantity == "acceleration":
                fixed = {**self._seen_by_system(recordings[0].measurement), **fixed}
        elif isinstance(self.model, SingleModel):
            seen: tuple[str, ...] = (self.model.offset,)
            if self.model.quantity == "acceleration":
                known = self.sensor(recordings[0].measurement)
                seen = ("sensor_radius",) if "sensor_radius" not in known else seen
                seen = seen if known["gravity_seen"] else (*seen, "tilt")
                fixed = {**known, **fixed}
            names = ("theta", "omega", "omega0_squared", *self.frictions, *seen)
        else:
            names = (*STATE, *SHAPE, *self.frictions)
        free = tuple(dict.fromkeys(n for n in (*names, *self.free) if n not in fixed))
        shared = self.shared
        if shared is None:
            shared = tuple(name for name in free if name not in _OWN)
        signs = self.signs == "free"
        return Problem(self.model, recordings, free, shared, fixed, signs, self.bounds)

    def _seen_by_system(self, measurement: Measurement) -> dict[str, float]:
        """What is known of an accelerometer in a bob: it is as far out as the bob."""
        assert isinstance(self.model, SystemModel)
        own = self.model.known.parameters
        radius = own.get("length", own.get("centre", 1.0))
        known = asked.Known(radius) if "sensor_radius" not in self.free else None
        return replace(self, length=known).sensor(measurement)


def planned(measurement: Any, system: Any, **given: Any) -> tuple[Plan, tuple[Sampled, ...]]:
    """The checked arguments of `fit`, and the samples that are fitted.

    Raises:
        ValueError: for an argument out of range, or a recording that cannot be fitted.
    """
    measurements = tuple(
        each.as_angle() if each.quantity == "position" else each
        for each in asked.measurements_of(measurement)
    )
    made, frictions = _model(measurements, system, given)
    rows, t, shared = made.rows, given.get("t"), given.get("shared")
    fixed = asked.named_values("fixed", given.get("fixed"), rows)
    plan = Plan(
        model=made,
        frictions=frictions,
        length=asked.known("length", _length(given.get("length"), measurements[0], made), "m"),
        gravity=asked.known("gravity", given.get("gravity"), "m/s^2"),
        fixed=fixed,
        free=_free(made, given.get("free"), fixed),
        bounds=bounds_of(given.get("bounds"), made),
        shared=None if shared is None else asked.names_of("shared", shared, rows),
        signs=one_of("signs", given.get("signs", "physical"), asked.SIGNS),
        start=asked.named_values("start", given.get("start"), rows),
        t=t,
        robust=flag("robust", given.get("robust", False)),
        uncertainty=one_of(
            "uncertainty", given.get("uncertainty", "corrected"), asked.UNCERTAINTIES
        ),
        seed=whole("seed", given.get("seed", 0)),
        windows=_seconds(given.get("windows")),
        continuity=positive_number("continuity", given.get("continuity", 1.0), zero=True),
        tolerance=positive_number("tolerance", given.get("tolerance", 0.1), "rad"),
    )
    return plan, tuple(asked.sampled(each, t) for each in measurements)


def _model(
    measurements: Sequence[Measurement], system: Any, given: Mapping[str, Any]
) -> tuple[SingleModel | DoubleModel | SystemModel, tuple[str, ...]]:
    """The model of what was measured, and its frictions.

    Raises:
        ValueError: where there is none.
    """
    if isinstance(system, System):
        made = system_model(measurements, system, given)
        return made, tuple(name for name in RESISTANCES if system.parameters.get(name))
    linear, frictions = asked.model_parts(system)
    first = measurements[0]
    if first.bodies == 2 and first.quantity != "angle":
        rule = "must hold the angles of a double pendulum, got {value}"
        raise ArgumentError("measurement", rule, value=first.quantity)
    if first.bodies == 1:
        return SingleModel(first.quantity, linear), frictions
    if len(measurements) > 1:
        rule = "must be one recording of a double pendulum, got {value}"
        raise ArgumentError("measurement", rule, "fit each alone", value=len(measurements))
    if linear or not set(frictions) <= {"viscous", "coulomb"}:
        rule = 'must be "undamped", "viscous" or "viscous + coulomb" of a double pendulum'
        raise ArgumentError("system", rule)
    return DoubleModel(), tuple(name for name in JOINTS if name[:-1] in frictions)


def _free(
    made: SingleModel | DoubleModel | SystemModel, free: Any, fixed: Mapping[str, float]
) -> tuple[str, ...]:
    """Names of what is fitted: of a model besides its own, of a system all."""
    if isinstance(made, SystemModel):
        return free_names(made, free, fixed)
    return asked.names_of("free", () if free is None else free, made.rows)


def _seconds(given: object) -> float | None:
    return None if given is None else positive_number("windows", given, "s")


def _length(
    given: Any, measurement: Measurement, made: SingleModel | DoubleModel | SystemModel
) -> Any:
    """A length as given, or as the recording has it (of a double pendulum the first).

    That of a circle through positions is as uncertain as the circle. A system has its own.
    """
    if isinstance(made, SystemModel):
        return None
    known = measurement.geometry
    own = known.get("length" if measurement.bodies == 1 else "l1")
    if given is not None or own is None:
        return given
    return own, known.get("circle_error", 0.0)
