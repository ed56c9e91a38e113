"""All that the study computes: a recipe in, numbers out."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from pendula import elliptic
from pendula.analysis import (
    ConvergenceOrder,
    agm_iterations,
    angle_difference,
    convergence_order,
    largest_energy_errors,
    linear_model_error,
    parting_time,
    period_limit,
    series_terms,
    small_angle_limit,
    step_energy_errors,
)
from pendula.run._times import spaced
from pendula.run.exact import exact
from pendula.run.solve import solve
from pendula.study.chaos import Chaos, chaos
from pendula.study.work import work
from pendula.systems import DoublePendulum, LinearPendulum, SimplePendulum, System

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from pendula._types import Array, MethodName
    from pendula.analysis import WorkPrecision
    from pendula.run.trajectory import Trajectory
    from pendula.study.schema import Convergence, Double, Elliptic, LinearModel, Recipe


METHODS: tuple[MethodName, ...] = ("euler", "heun", "rk4")

# Repetitions of the double pendulum's reference: masses times, step times. Heavier rods move just
# the same, but every rounding is another one; one repetition alone may agree by chance.
REPETITIONS = ((1.0, 0.5), (3.0, 1.0), (5.0, 1.0), (7.0, 1.0))


# Keys that a reference run may break down by, after its step.
_START = tuple(
    ("double", key)
    for key in ("omega1", "omega2", "theta1", "theta2", "gravity", "l1", "l2", "m1", "m2", "t_max")
)


@dataclass(frozen=True)
class Comparison:
    """Runs of one system by each method, and what they are compared with."""

    system: System
    reference: Trajectory
    runs: dict[str, Trajectory]
    differences: dict[str, Array]
    """Largest angle difference from the reference by method [rad], (n,)."""
    energy_errors: dict[str, Array]
    """Largest |E − E0| / E0 over the steps since the output before, by method, (n,)."""


@dataclass(frozen=True)
class DoubleComparison(Comparison):
    """The same for the double pendulum, whose reference is a run itself."""

    own_difference: Array
    """Largest angle difference between the reference and any of its repetitions [rad], (n,)."""
    parting: dict[str, float]
    """When each method parted from the reference, to a step [s]; inf: not within the run."""
    horizon: float
    """When the first repetition parted from the reference, to a step [s]; inf: likewise."""

    def trusted_parting(self, method: str) -> float:
        """When a method parted from the trusted reference [s]; inf: not while it is trusted."""
        moment = self.parting[method]
        return moment if moment < self.horizon else math.inf

    def energy_until_parting(self, method: str) -> float:
        """The largest |E − E0| / E0 over the steps of a method until then."""
        t, errors = step_energy_errors(self.runs[method])
        return float(np.max(errors[t <= self.trusted_parting(method)]))


@dataclass(frozen=True)
class LinearErrors:
    """Where small angles stop being small."""

    amplitudes: Array
    errors: dict[int, Array]
    """By number of periods, as a part of the amplitude, (n,)."""
    limits: dict[int, dict[float, float]]
    """By number of periods and error, the amplitude [rad]."""
    period_limits: dict[float, float]
    """By error of the period, the amplitude [rad]."""


@dataclass(frozen=True)
class Periods:
    """Period against amplitude, all in seconds."""

    amplitudes: Array
    exact: Array
    small: float
    series: dict[int, Array]
    """By number of terms, (n,)."""


@dataclass(frozen=True)
class EllipticCost:
    """What K(k) costs, k = sin(amplitude/2)."""

    amplitudes: Array
    terms: Array
    iterations: NDArray[np.int64]


@dataclass(frozen=True)
class Orders:
    """Largest errors at each step, and the line through them, by system and method."""

    steps: Array
    cases: dict[str, dict[str, tuple[Array, ConvergenceOrder]]]


@dataclass(frozen=True)
class Results:
    """Everything the figures, tables and files are made of."""

    recipe: Recipe
    pendulum: SimplePendulum
    """The recipe's simple pendulum."""
    models: dict[str, tuple[Trajectory, Trajectory]]
    """The exact and the linear motion, for the "gentle" and the "large" release."""
    linear_errors: LinearErrors
    periods: Periods
    elliptic: EllipticCost
    linear: Comparison
    simple: Comparison
    orders: Orders
    work: dict[str, WorkPrecision]
    """What every method's errors cost, of the "simple" and of the "double" pendulum."""
    double: DoubleComparison
    chaos: Chaos


def compute(recipe: Recipe) -> Results:
    """Run the whole study."""
    part = recipe.simple
    linear = LinearPendulum(part.length, part.gravity, part.mass)
    simple = SimplePendulum(part.length, part.gravity, part.mass)
    t = spaced(0.0, part.t_max, part.output)
    releases = {"gentle": (part.gentle, 0.0), "large": (part.large, 0.0)}
    models = {n: (exact(simple, s, t), exact(linear, s, t)) for n, s in releases.items()}
    gentle, large = models["gentle"][1], models["large"][0]
    return Results(
        recipe=recipe,
        pendulum=simple,
        models=models,
        linear_errors=_linear_errors(recipe.linear_model),
        periods=periods(simple, np.array(sorted(recipe.period.amplitudes)), recipe.period.terms),
        elliptic=_elliptic_cost(recipe.elliptic),
        linear=_comparison(linear, releases["gentle"], gentle, part.step),
        simple=_comparison(simple, releases["large"], large, part.step),
        orders=_orders(recipe.convergence, linear, simple, recipe),
        work=work(recipe, simple, *double_pendulum(recipe.double)),
        double=_double(recipe),
        chaos=chaos(*double_pendulum(recipe.double)),
    )


def double_pendulum(part: Double) -> tuple[DoublePendulum, tuple[float, float, float, float]]:
    """The recipe's rods, and their state at the start."""
    system = DoublePendulum.rods(part.m1, part.m2, part.l1, part.l2, part.gravity)
    return system, (part.theta1, part.theta2, part.omega1, part.omega2)


def _comparison(
    system: System, state: tuple[float, ...], reference: Trajectory, step: float
) -> Comparison:
    runs = {str(m): solve(system, state, reference.t, m, step=step) for m in METHODS}
    differences = {m: angle_difference(run, reference) for m, run in runs.items()}
    energies = {m: largest_energy_errors(run) for m, run in runs.items()}
    return Comparison(system, reference, runs, differences, energies)


def _double(recipe: Recipe) -> DoubleComparison:
    part = recipe.double
    system, state = double_pendulum(part)
    reference, own = _reference(recipe, spaced(0.0, part.t_max, part.output))
    compared = _comparison(system, state, reference, part.step)
    parting, horizon = _partings(recipe)
    return DoubleComparison(**vars(compared), own_difference=own, parting=parting, horizon=horizon)


def _reference(recipe: Recipe, t: Array) -> tuple[Trajectory, Array]:
    """The double pendulum's reference, and its largest difference from a repetition [rad], (n,)."""
    part = recipe.double
    system, state = double_pendulum(part)
    place = recipe.place(("double", "reference_step"), *_START)
    reference = solve(system, state, t, "rk4", step=part.reference_step)
    own = np.zeros(t.size)
    for run in (reference, *_repeated(part, t)):
        _check_reached(run, f"{place}: double.reference_step", part.reference_step)
        np.maximum(own, angle_difference(run, reference), out=own)
    return reference, own


def _partings(recipe: Recipe) -> tuple[dict[str, float], float]:
    """When methods and repetitions part from the reference [s]: seen at every step or output."""
    part = recipe.double
    system, state = double_pendulum(part)
    t = spaced(0.0, part.t_max, min(part.step, part.output))
    reference, own = _reference(recipe, t)
    moments: dict[str, float] = {}
    for method in METHODS:
        run = solve(system, state, t, method, step=part.step)
        moments[method] = parting_time(t, angle_difference(run, reference), part.tolerance)
    return moments, parting_time(t, own, part.tolerance)


def _check_reached(run: Trajectory, key: str, step: float) -> None:
    """End the study where a run breaks down that others are compared with."""
    if run.outcome != "reached_end":
        raise RuntimeError(
            f"{key} must be short enough for the double pendulum's reference run to reach the end, "
            f"got {step:g} s, and it breaks down at {run.reached:g} s; take a smaller one than "
            f"{step:g} s, or a slower motion"
        )


def _repeated(part: Double, t: Array) -> Iterator[Trajectory]:
    for masses, steps in REPETITIONS:
        system, state = double_pendulum(replace(part, m1=part.m1 * masses, m2=part.m2 * masses))
        yield solve(system, state, t, "rk4", step=part.reference_step * steps)


def _linear_errors(part: LinearModel) -> LinearErrors:
    amplitudes = np.array(sorted(part.amplitudes))
    return LinearErrors(
        amplitudes,
        errors={n: linear_model_error(amplitudes, n) for n in part.swings},
        limits={n: {e: small_angle_limit(e, n) for e in part.errors} for n in part.swings},
        period_limits={e: period_limit(e) for e in part.errors},
    )


def periods(simple: SimplePendulum, amplitudes: Array, terms: tuple[int, ...]) -> Periods:
    """Periods of releases from rest, exact and by the first terms of the series [s]."""
    k = np.sin(amplitudes / 2)
    series = {n: 4 * elliptic.K_series(k, n) / simple.natural_frequency for n in terms}
    small = math.tau / simple.natural_frequency
    return Periods(amplitudes, simple.period(amplitudes), small, series)


def _elliptic_cost(part: Elliptic) -> EllipticCost:
    amplitudes = np.array(sorted(part.amplitudes))
    kc = np.cos(amplitudes / 2)
    terms = series_terms(kc, part.error, largest=part.largest_terms)
    return EllipticCost(amplitudes, terms, agm_iterations(kc, part.error))


def _orders(
    part: Convergence, linear: LinearPendulum, simple: SimplePendulum, recipe: Recipe
) -> Orders:
    steps = np.array(sorted(part.steps, reverse=True))
    t = spaced(0.0, part.t_max, float(steps[0]))
    rods, start = double_pendulum(recipe.double)
    gentle, large = (recipe.simple.gentle, 0.0), (recipe.simple.large, 0.0)
    # A quarter of the finest step makes RK4's own error there 4⁴ = 256 times smaller.
    finer = solve(rods, start, t, "rk4", step=float(steps[-1]) / 4)
    place = recipe.place(("convergence", "steps"), *_START)
    _check_reached(finer, f"{place}: the finest of convergence.steps", float(steps[-1]))
    cases = {
        "linear": _errors(linear, gentle, exact(linear, gentle, t), steps),
        "simple": _errors(simple, large, exact(simple, large, t), steps),
        "double": _errors(rods, start, finer, steps),
    }
    return Orders(steps, cases)


def _errors(
    system: System, state: tuple[float, ...], truth: Trajectory, steps: Array
) -> dict[str, tuple[Array, ConvergenceOrder]]:
    def largest(method: MethodName, step: float) -> float:
        run = solve(system, state, truth.t, method, step=step)
        return float(np.max(angle_difference(run, truth)))

    result: dict[str, tuple[Array, ConvergenceOrder]] = {}
    for method in METHODS:
        errors = np.array([largest(method, float(step)) for step in steps])
        result[method] = (errors, convergence_order(steps, errors))
    return result
