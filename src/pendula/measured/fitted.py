"""What a fit gives: values with uncertainties that can be believed, residuals, and a verdict."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

from pendula._late_methods import with_promised
from pendula.measured.storable import Storable

if TYPE_CHECKING:
    from collections.abc import Mapping
    from os import PathLike
    from pathlib import Path

    from pendula._types import Array
    from pendula.measured.measurement import Measurement
    from pendula.measured.words import Note
    from pendula.run.trajectory import Trajectory
    from pendula.systems import System


class Quantity(NamedTuple):
    """A value with its standard error.

    Attributes:
        value: in `unit`.
        standard_error: in `unit`; NaN: not known.
        unit: SI; empty: none.
    """

    value: float
    standard_error: float
    unit: str


@dataclass(frozen=True, eq=False)
class FittedRecording:
    """One recording beside the motion that was fitted to it.

    Attributes:
        measurement: as it was given.
        t: times of the samples that were fitted, (n,) [s].
        measured: what was fitted, angles or rates or accelerations, (n, m); NaN: missing.
        fitted: the model's, (n, m).
        residuals: measured less fitted, (n, m).
        rates: angular rates of the fitted motion at the samples, (n,), or (n, 2) [rad/s].
        start: state (θ, ω) or (θ1, θ2, ω1, ω2) at the first of the times, (d,) [rad, rad/s].
        system: the pendulum with the fitted values; None: one of them is unphysical.
        autocorrelation: of the residuals' noise from one sample to the next, (m,).
        autocorrelation_time: integrated, in samples, 1: independent.
        quarters: the values of `Fit.names` fitted to each quarter of the record alone,
            (4, k) or (0, k): not fitted; NaN: one that is the whole record's.
    """

    measurement: Measurement
    t: Array
    measured: Array
    fitted: Array
    residuals: Array
    rates: Array
    start: Array
    system: System | None
    autocorrelation: Array
    autocorrelation_time: float
    quarters: Array

    @property
    def trajectory(self) -> Trajectory:
        """The fitted motion at the times of the samples; `.at(t)` gives it at others.

        Raises:
            ValueError: where the values are unphysical, so that no system has them.
        """
        from pendula._messages import ArgumentError
        from pendula.run.solve import solve

        if self.system is None:
            rule = "are unphysical: no pendulum of the catalogue has negative friction"
            raise ArgumentError("values", rule, 'fit with <signs="physical">')
        return solve(self.system, self.start, self.t, t0=float(self.t[0]))


@with_promised
@dataclass(frozen=True, eq=False)
class Fit(Storable):
    """A model of a pendulum fitted to one recording or to several.

    Frictions are those of θ̈ = −ω0² sin θ − b ω − c sgn ω − q |ω| ω − r ω³, torques over inertia.

    Attributes:
        model: names of its parts, such as "viscous + coulomb".
        names: names of what was fitted, k of them: "theta", "omega" (the state at the first
            sample), "omega0_squared", "viscous", "coulomb", "quadratic", "cubic", "angle_offset"
            ...; with several recordings those that are not shared carry the number of theirs,
            "theta[2]".
        values: of the parameters, (k,) [units].
        units: SI, of each parameter.
        standard_errors: with the noise's autocorrelation taken into account, (k,); twice as much
            to either side holds the true value with a probability of 95 %, if the model is true.
            Of frictions near zero what lies below it is left out.
        plain_standard_errors: as if the samples were independent, (k,).
        error_kinds: the others that were computed, by name: "autocorrelation", "blocks",
            "profile", "bootstrap", each (k,).
        covariance: that of `standard_errors`, (k, k).
        correlation: what the record alone says, as if there were no bounds, (k, k).
        recordings: each recording beside its motion, in the order in which they were given.
        rms: of all residuals, in the measured unit.
        n_samples: fitted numbers, those missing not counted.
        n_effective: how many independent samples carry as much.
        at_bounds: parameters that ended at a bound: friction of zero.
        unphysical: parameters whose value no pendulum has: negative friction.
        not_told_apart: parameters, or names, of what the data hold only together, such as
            ("gravity", "length").
        derived: what follows from the values: "gravity", "length", "damping_rate",
            "quality_factor", "period" of small swings ...
        aic: Akaike's criterion by the effective number of samples.
        bic: Schwarz's, likewise.
        notes: what has to be known about this fit: `note.sentence("es")` words one.
        flags: their keys: "damped" (an undamped fit of a damped record), "poor",
            "gravity_unlikely", "unphysical", "at_bound", "alike", "flat", "only_ratio",
            "structured", "correlated".
        recipe: the arguments of `fit` but for the measurements, as JSON has them: with them and
            the same measurements the fit has the same bits on the same machine.
        horizon: of a double pendulum, `Horizon`; None otherwise.
    """

    model: str
    names: tuple[str, ...]
    values: Array
    units: tuple[str, ...]
    standard_errors: Array
    plain_standard_errors: Array
    error_kinds: Mapping[str, Array]
    covariance: Array
    correlation: Array
    recordings: tuple[FittedRecording, ...]
    rms: float
    n_samples: int
    n_effective: float
    at_bounds: tuple[str, ...]
    unphysical: tuple[str, ...]
    not_told_apart: tuple[tuple[str, ...], ...]
    derived: Mapping[str, Quantity]
    aic: float
    bic: float
    notes: tuple[Note, ...]
    flags: tuple[str, ...]
    recipe: Mapping[str, Any] = field(default_factory=dict)
    horizon: Horizon | None = None

    def __getitem__(self, name: str) -> Quantity:
        """A parameter, or what is derived of them, by its name."""
        if name in self.names:
            i = self.names.index(name)
            value, error = float(self.values[i]), float(self.standard_errors[i])
            return Quantity(value, error, self.units[i])
        return self.derived[name]

    @property
    def measurement(self) -> Measurement:
        """The recording, the first of several."""
        return self.recordings[0].measurement

    @property
    def fitted(self) -> Array:
        """The model at the samples of the first recording, (n, m)."""
        return self.recordings[0].fitted

    @property
    def residuals(self) -> Array:
        """Measured less fitted, of the first recording, (n, m)."""
        return self.recordings[0].residuals

    @property
    def t(self) -> Array:
        """Times of the samples of the first recording that were fitted, (n,) [s]."""
        return self.recordings[0].t

    @property
    def system(self) -> System | None:
        """The fitted pendulum, that of the first recording; None: a value is unphysical."""
        return self.recordings[0].system

    @property
    def start(self) -> Array:
        """The fitted state at the first sample of the first recording, (d,)."""
        return self.recordings[0].start

    @property
    def trajectory(self) -> Trajectory:
        """The fitted motion of the first recording; see `FittedRecording.trajectory`."""
        return self.recordings[0].trajectory

    if TYPE_CHECKING:  # attached by the module that defines it

        def report(
            self,
            path: str | PathLike[str],
            lang: str = "en",
            *,
            title: str = "",
            author: str = "",
            overwrite: bool = False,
        ) -> Path:
            """See `pendula.study.measured.report.report`."""


class Horizon(NamedTuple):
    """How long the model follows a measured double pendulum, beside the computation's own limit.

    Attributes:
        tolerance: angle by which the two may differ [rad].
        followed: how long after the first sample the model is that close to the measurement [s].
        left: whether it leaves it within the record; otherwise `followed` is all of it.
        trust: how long after the first sample the computation itself is right [s]; infinite: all.
    """

    tolerance: float
    followed: float
    left: bool
    trust: float
