"""What the text of the report says in numbers: results in, words of one language out.

No number stands in the text itself; each comes from here, and what depends on how a run went
(a bob thrown over the top, a run that broke down) is said by a list that may be empty.
"""

from __future__ import annotations

import math
from dataclasses import asdict
from fractions import Fraction
from itertools import product
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._engine import ON_GRID, method_named
from pendula.analysis import at_steps
from pendula.run.solve import methods
from pendula.study.chaos import chaos_facts
from pendula.study.errata import errata
from pendula.study.runs import METHODS, REPETITIONS
from pendula.study.schema import REPORT
from pendula.study.work import work_facts

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula.plot.labels import Labels
    from pendula.run.trajectory import Trajectory
    from pendula.study.notation import Numbers
    from pendula.study.runs import Comparison, Results


def facts(results: Results, words: Labels, numbers: Numbers, version: str) -> dict[str, Any]:
    """Everything the template reads, as JSON-able data."""
    return {
        "version": version,
        "language": words.language,
        "report": _report(results),
        "simple": _simple(results, numbers),
        "models": {name: _model(results, name, numbers) for name in results.models},
        "limits": _limits(results, numbers),
        "periods": _periods(results, numbers),
        "elliptic": _elliptic(results, numbers),
        "methods": [_method(results, name, words, numbers) for name in METHODS],
        "orders": _orders(results, words, numbers),
        "work": work_facts(results.work, results.recipe.work.swings, words, numbers),
        "double": _double(results, words, numbers),
        "chaos": chaos_facts(results.chaos, results.recipe.double.tolerance, words, numbers),
        "errata": _errata(words.language),
    }


def _report(results: Results) -> dict[str, Any]:
    part = results.recipe.report
    sections = [name for name in REPORT if name in part.sections]
    return asdict(part) | {"sections": sections, "own": results.recipe.own}


def _simple(results: Results, numbers: Numbers) -> dict[str, Any]:
    part = results.recipe.simple
    frequency = results.pendulum.natural_frequency
    return {
        "length": numbers.short(part.length),
        "mass": numbers.short(part.mass),
        "gravity": numbers.short(part.gravity, 7),
        "frequency": numbers.plain(frequency, 5),
        "small_period": numbers.plain(math.tau / frequency, 5),
        "gentle": numbers.chosen_degrees(part.gentle),
        "large": numbers.chosen_degrees(part.large),
        "until": numbers.short(part.t_max),
        "step": numbers.duration(part.step),
        "output": numbers.duration(part.output),
        "steps_a_period": numbers.plain(math.tau / frequency / part.step),
    }


def _model(results: Results, name: str, numbers: Numbers) -> dict[str, str]:
    exact, linear = results.models[name]
    amplitude = getattr(results.recipe.simple, name)
    apart = float(np.max(np.abs(exact.theta - linear.theta)))
    period = float(results.pendulum.period([amplitude])[0])
    return {
        "amplitude": numbers.chosen_degrees(amplitude),
        "period": numbers.plain(period, 5),
        "ratio": numbers.plain(period / results.periods.small, 6),
        "difference": numbers.degrees(apart),
    }


def _limits(results: Results, numbers: Numbers) -> dict[str, Any]:
    part = results.linear_errors
    rows = {
        error: [numbers.percent(error), numbers.degrees(part.period_limits[error])]
        + [numbers.degrees(limits[error]) for limits in part.limits.values()]
        for error in sorted(part.period_limits)
    }
    usual = min(rows, key=lambda error: abs(math.log(error / 0.01)))
    swings = list(part.limits)
    return {
        "swings": swings,
        "rows": list(rows.values()),
        "error": numbers.percent(usual),
        "period": numbers.degrees(part.period_limits[usual]),
        "most": {"swings": max(swings), "limit": numbers.degrees(part.limits[max(swings)][usual])},
    }


def _periods(results: Results, numbers: Numbers) -> dict[str, Any]:
    part = results.periods
    columns = [part.exact / part.small, *(each / part.small for each in part.series.values())]
    rows = [
        [
            numbers.chosen_degrees(float(amplitude)),
            *(numbers.fixed(float(c[i]), 6) for c in columns),
        ]
        for i, amplitude in enumerate(part.amplitudes)
    ]
    return {"terms": list(part.series), "rows": rows}


def _elliptic(results: Results, numbers: Numbers) -> dict[str, Any]:
    part, recipe = results.elliptic, results.recipe.elliptic
    rows = []
    for amplitude, terms, iterations in zip(
        part.amplitudes, part.terms, part.iterations, strict=True
    ):
        # 1 − sin x = 2 sin²(π/4 − x/2), without the cancellation.
        distance = 2 * math.sin(math.pi / 4 - float(amplitude) / 4) ** 2
        rows.append(
            {
                "amplitude": numbers.chosen_degrees(float(amplitude)),
                "distance": numbers.plain(distance),
                "terms": numbers.fixed(float(terms), 0) if math.isfinite(terms) else None,
                "iterations": str(int(iterations)),
            }
        )
    return {
        "rows": rows,
        "error": numbers.plain(recipe.error, 1),
        "largest_terms": numbers.fixed(recipe.largest_terms, 0),
        "last": rows[-1],
    }


def _method(results: Results, name: str, words: Labels, numbers: Numbers) -> dict[str, Any]:
    linear, simple = results.linear, results.simple
    run = simple.runs[name]
    return {
        "name": words.name(name),
        "evaluations": method_named(name).evaluations_per_step,
        "linear_error": numbers.degrees(_largest(linear, name)),
        "simple_error": numbers.degrees(_largest(simple, name)),
        "linear_energy": numbers.plain(_final_energy_error(linear.runs[name])),
        "linear_energy_theory": numbers.plain(_energy_growth(results, name)),
        "simple_energy": numbers.plain(_final_energy_error(run)),
        "over_top": _over_top(run, numbers),
        "broke_down": [_end(each.runs[name], numbers) for each in (linear, simple)],
    }


def _over_top(run: Trajectory, numbers: Numbers) -> str | None:
    """The first step after which the bob has passed the top; None: it has not."""
    steps = at_steps(run)
    over = np.flatnonzero(np.abs(steps.theta) > math.pi)
    return numbers.plain(float(steps.t[over[0]])) if len(over) else None


def _final_energy_error(run: Trajectory) -> float:
    """At the end; nan: the run broke down before."""
    return float(run.energy_error[-1]) if run.outcome == "reached_end" else math.nan


def _energy_growth(results: Results, name: str) -> float:
    """Energy error at the end that theory gives for the linear pendulum.

    A step multiplies the energy by |R(i ωn h)|², R the method's stability function (Hairer & Wanner
    1996, IV.3). The last step is shortened where the end is no multiple of the step.
    """
    end, step = results.recipe.simple.t_max, results.recipe.simple.step
    full = math.floor(end / step + ON_GRID)
    frequency = results.pendulum.natural_frequency
    growth = growth_polynomial(method_named(name).stability_polynomial)

    def logarithm(h: float) -> float:
        z = frequency * h
        return math.log1p(sum(z**k * c.numerator / c.denominator for k, c in growth.items()))

    exponent = full * logarithm(step) + logarithm(max(end - full * step, 0.0))
    return math.expm1(exponent) if exponent < 700 else math.inf  # e⁷¹⁰ is past all doubles


def growth_polynomial(stability: Sequence[float]) -> dict[int, Fraction]:
    """|R(i z)|² − 1 of a stability polynomial R: the coefficients by powers of z, without zeros.

    They are exact, as those of R are fractions: in doubles the lowest powers would not vanish.
    """
    exact = [Fraction(each).limit_denominator(10**6) for each in stability]
    found: dict[int, Fraction] = {0: Fraction(-1)}
    for (j, a), (k, b) in product(enumerate(exact), repeat=2):
        if (j - k) % 2 == 0:  # the other products are imaginary, and cancel
            found[j + k] = found.get(j + k, Fraction(0)) + a * b * (-1) ** (abs(j - k) // 2)
    return {power: each for power, each in found.items() if each}


def _largest(compared: Comparison, name: str) -> float:
    return float(np.nanmax(compared.differences[name]))


def _end(run: Trajectory, numbers: Numbers) -> str | None:
    """When a run broke down; None if it did not."""
    return None if run.outcome == "reached_end" else numbers.plain(run.reached)


def _orders(results: Results, words: Labels, numbers: Numbers) -> dict[str, Any]:
    part, recipe = results.orders, results.recipe.convergence
    theory: dict[str, int] = {each.name: each.order for each in methods()}
    rows = [
        [words.name(name), str(theory[name])]
        + [numbers.fixed(case[name][1].order, 3) for case in part.cases.values()]
        for name in METHODS
    ]
    return {
        "rows": rows,
        "all_measured": not any("—" in row for row in rows),
        "until": numbers.short(recipe.t_max),
        "coarsest": numbers.duration(max(recipe.steps)),
        "finest": numbers.duration(min(recipe.steps)),
    }


def _double(results: Results, words: Labels, numbers: Numbers) -> dict[str, Any]:
    part, double = results.recipe.double, results.double
    given = {name: numbers.short(getattr(part, name)) for name in ("m1", "m2", "l1", "l2")}
    rows = [_parting(results, name, words, numbers) for name in METHODS]
    parted = [row for row in rows if row["time"]]
    return given | {
        "theta1": numbers.chosen_degrees(part.theta1),
        "theta2": numbers.chosen_degrees(part.theta2),
        "omega1": numbers.short(part.omega1),
        "omega2": numbers.short(part.omega2),
        "gravity": numbers.short(part.gravity, 7),
        "until": numbers.short(part.t_max),
        "path_until": numbers.short(min(part.path_until, part.t_max)),
        "step": numbers.duration(part.step),
        "output": numbers.duration(part.output),
        "reference_step": numbers.duration(part.reference_step),
        "half_step": numbers.duration(part.reference_step / 2),
        "masses": [numbers.short(masses) for masses, _ in REPETITIONS if masses != 1],
        "tolerance": numbers.chosen_degrees(part.tolerance),
        "horizon": _moment(double.horizon, numbers),
        "agreement": _agreement(results, numbers),
        "rows": rows,
        "at_rest": not any((part.theta1, part.theta2, part.omega1, part.omega2)),
        "all_parted": len(parted) == len(rows),
        "latest": max(parted, key=lambda row: row["seconds"]) if parted else None,
    }


def _parting(results: Results, name: str, words: Labels, numbers: Numbers) -> dict[str, Any]:
    """When a method parted from the reference, as far as the reference can be trusted."""
    double = results.double
    parted = double.trusted_parting(name)
    largest = float(np.max(double.energy_errors[name]))
    trusted = double.reference.t <= double.horizon
    return {
        "name": words.name(name),
        "time": _moment(parted, numbers),
        "seconds": parted if math.isfinite(parted) else None,
        "energy_before": numbers.plain(double.energy_until_parting(name)),
        "energy_largest": numbers.plain(largest),
        "difference": numbers.degrees(float(np.nanmax(double.differences[name][trusted]))),
        "broke_down": _end(double.runs[name], numbers),
    }


def _agreement(results: Results, numbers: Numbers) -> list[dict[str, str]]:
    """The reference against its repetitions, at each fifth of the run."""
    t, apart = results.double.reference.t, results.double.own_difference
    # of few points each once
    places = sorted({math.ceil(fifth * (len(t) - 1) / 5) for fifth in range(1, 6)})
    return [
        {"time": numbers.short(float(t[i])), "difference": numbers.degrees(float(apart[i]), 2)}
        for i in places
    ]


def _moment(moment: float, numbers: Numbers) -> str | None:
    return numbers.plain(moment) if math.isfinite(moment) else None


def _errata(language: str) -> list[list[str]]:
    code: Any = language
    return [
        [each.typst(code) for each in (row.equation, row.printed, row.correct, row.why)]
        for row in errata()
    ]
