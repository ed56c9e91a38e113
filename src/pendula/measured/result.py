"""The optimum of a fit with its uncertainties, and what has to be said about it."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING

from pendula.measured.bounded import within_bounds
from pendula.measured.derived import derived_of
from pendula.measured.errors import Errors, errors_of
from pendula.measured.fitted import Fit, FittedRecording
from pendula.measured.least_squares import CLOSE
from pendula.measured.problem import Optimum, Problem, minimise
from pendula.measured.resampling import with_other_errors
from pendula.measured.starts import MOST
from pendula.measured.words import Note

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.measured.fitted import Quantity
    from pendula.measured.plan import Plan

ALIKE = 0.98  # correlation beyond which two parameters are not told apart
_SWINGS = 2.0  # in a quarter of a record that is fitted alone
_EARTH = (9.5, 10.1)  # m/s²: g beyond is not the Earth's
_STRONG = 10.0  # of BIC: very strong evidence (Kass & Raftery, J. Am. Stat. Assoc. 90 (1995) 773)
_MOST_NAMED = 4  # starts of windows
_POOR = 0.3  # of the spread: residuals of a model that does not describe the record


def result_of(plan: Plan, problem: Problem, best: Optimum, viscous: float) -> Fit:
    """The fit, told.

    Args:
        plan: what was asked for.
        problem: that was solved.
        best: its optimum.
        viscous: residuals that viscous friction leaves, beside a model without friction; otherwise
            those of the model itself [rms].
    """
    errors = errors_of(problem, best.x)
    errors = with_other_errors(problem, best, errors, plan.uncertainty, plan.seed)
    if plan.uncertainty == "corrected" and not plan.robust:
        errors = within_bounds(problem, best.x, errors)
    derived = _derived(plan, problem, best.x, errors.covariance)
    samples = sum(int(each.there.sum()) for each in problem.recordings)
    worth = errors.effective * math.log(best.rms**2)
    bounds, unphysical = _at_bounds(problem, best)
    made = Fit(
        model=plan.name,
        names=best.names,
        values=best.x,
        units=tuple(row.unit for row in problem.rows()),
        standard_errors=errors.standard,
        plain_standard_errors=errors.plain,
        error_kinds=errors.kinds,
        covariance=errors.covariance,
        correlation=errors.correlation,
        recordings=tuple(_recordings(problem, best, errors)),
        rms=best.rms,
        n_samples=samples,
        n_effective=errors.effective,
        at_bounds=bounds,
        unphysical=unphysical,
        not_told_apart=_alike(best.names, errors.correlation, derived, errors),
        derived=derived,
        aic=worth + 2.0 * len(best.x),
        bic=worth + math.log(errors.effective) * len(best.x),
        notes=(),
        flags=(),
        recipe=plan.recipe(),
    )
    notes = tuple(_notes(made, errors, viscous))
    return replace(made, notes=notes, flags=tuple(dict.fromkeys(each.key for each in notes)))


def _derived(plan: Plan, problem: Problem, x: Array, covariance: Array) -> dict[str, Quantity]:
    """What follows from the values of the first recording."""
    import numpy as np

    places = problem.places(0)
    own = covariance[np.ix_(places, places)]
    values = problem.values(0, x)
    return derived_of(problem.free, values, own, plan.length, plan.gravity)


def _at_bounds(problem: Problem, best: Optimum) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Parameters that ended at a bound, and frictions that no pendulum has, negative ones."""
    rows = zip(best.names, best.x.tolist(), problem.rows(), strict=True)
    at = (best.x == each for each in problem.bounds())
    bounds = tuple(name for name, *those in zip(best.names, *at, strict=True) if any(those))
    return bounds, tuple(name for name, x, row in rows if row.lower == 0.0 and x < 0.0)


def _recordings(problem: Problem, best: Optimum, errors: Errors) -> list[FittedRecording]:
    import numpy as np

    found, column = [], 0
    states = problem.states(best.x)
    for i, each in enumerate(problem.recordings):
        columns = range(column, column + each.values.shape[1])
        column = columns.stop
        values = problem.values(i, best.x)
        made = problem.model.seen(states[i], values)
        found.append(
            FittedRecording(
                measurement=each.measurement,
                t=each.t,
                measured=each.values,
                fitted=made,
                residuals=each.values - made,
                rates=_rates(states[i]),
                start=states[i][0].copy(),
                system=problem.model.system(values),
                autocorrelation=np.array([errors.noises[j].correlation for j in columns]),
                autocorrelation_time=float(np.mean([errors.times[j] for j in columns])),
                quarters=_quarters(problem, best, i, states[i]),
            )
        )
    return found


def _rates(states: Array) -> Array:
    """Angular rates of states (n, d): (n,) of one pendulum, (n, 2) of a double one."""
    return states[:, 1] if states.shape[1] == 2 else states[:, 2:]


def _quarters(problem: Problem, best: Optimum, i: int, states: Array) -> Array:
    """The parameters fitted to each quarter of recording i alone, (4, k) or (0, k)."""
    import numpy as np

    recording, values = problem.recordings[i], problem.values(i, best.x)
    whole = np.full((4, len(best.x)), np.nan)
    if "omega0_squared" not in values:
        return whole[:0]
    span = float(recording.t[-1] - recording.t[0])
    swings = math.sqrt(values["omega0_squared"]) * span / (2.0 * math.pi)
    if swings < 4.0 * _SWINGS or len(recording.t) < 16 * len(best.x):
        return whole[:0]
    edges = np.linspace(0, len(recording.t), 5).astype(int)
    names, alone = problem.names, problem.of([recording]).names
    places = [names.index(n if n in names else f"{n}[{i + 1}]") for n in alone]
    for quarter, (begin, end) in enumerate(pairwise(edges.tolist())):
        part = problem.of([recording.taken(slice(begin, end))]).thinned(MOST)
        begun = {**values, "theta": states[begin, 0], "omega": states[begin, 1]}
        found = minimise(part, np.array([begun[name] for name in part.names]), search=CLOSE)
        whole[quarter, places] = found.x
    return whole


def _alike(
    names: tuple[str, ...], correlation: Array, derived: dict[str, Quantity], errors: Errors
) -> tuple[tuple[str, ...], ...]:
    """Names of what the data hold only together."""
    groups = [each for each in errors.untold(names) if len(each) > 1]
    pairs = [
        (names[i], names[j])
        for i in range(len(names))
        for j in range(i)
        if abs(correlation[i, j]) > ALIKE
        and "[" not in names[i] + names[j]  # the start of one of several is no result
        and not any({names[i], names[j]} <= set(each) for each in groups)
    ]
    known = {"gravity", "length"} & {*derived, *names} or "omega0_squared" in derived
    if "natural_frequency" in derived and not known:
        pairs.append(("gravity", "length"))
    return (*groups, *pairs)


def _notes(made: Fit, errors: Errors, viscous: float) -> list[Note]:
    """What has to be known about the fit."""
    import numpy as np

    notes, unit = [], made.measurement.unit
    largest = max(float(np.max(each.autocorrelation)) for each in made.recordings)
    if made.n_effective < 0.5 * made.n_samples:
        notes.append(
            Note(
                "correlated",
                {
                    "correlation": largest,
                    "samples": str(made.n_samples),
                    "effective": f"{made.n_effective:.0f}",
                },
            )
        )
    if errors.structured:
        notes.append(Note("structured", {"rms": made.rms, "unit": unit}))
    worth = made.n_effective
    if 2.0 * worth * math.log(made.rms / viscous) - math.log(worth) > _STRONG:
        notes.append(Note("damped", {"rms": made.rms, "unit": unit, "other": viscous}))
    spread = np.nanstd(np.concatenate([each.measured for each in made.recordings]))
    if made.rms > _POOR * spread:
        notes.append(Note("poor", {"share": float(made.rms / spread)}))
    notes += [Note("at_bound", {"name": n, "bound": made[n].value}) for n in made.at_bounds]
    notes += [Note("unphysical", {"name": name}) for name in made.unphysical]
    notes += [*_by_quarters(made), *_untold(made, errors)]
    return [*notes, *_of_gravity(made)]


def _of_gravity(made: Fit) -> list[Note]:
    """That g is none of the Earth's, which a wrong frame rate or scale makes it."""
    if "gravity" not in {*made.derived, *made.names}:
        return []
    g = made["gravity"]
    beyond = min(abs(g.value - each) for each in _EARTH)
    if _EARTH[0] < g.value < _EARTH[1] or beyond <= 2.0 * g.standard_error:
        return []
    ratio = 9.81 / g.value
    told = {"gravity": g.value, "times": math.sqrt(1.0 / ratio), "lengths": ratio}
    return [Note("gravity_unlikely", told)]


def _by_quarters(made: Fit) -> list[Note]:
    """How ω0² scatters over quarters of the first recording, which says what the model misses."""
    quarters = made.recordings[0].quarters
    if not len(quarters) or "omega0_squared" not in made.names:
        return []
    values = quarters[:, made.names.index("omega0_squared")].tolist()
    return [Note("quarters", {"values": tuple(f"{each:.6g}" for each in values)})]


def _untold(made: Fit, errors: Errors) -> list[Note]:
    """Parameters that the data do not tell, or not apart."""
    flat = dict.fromkeys(name for names in errors.untold(made.names) for name in names)
    shared = tuple(name for name in flat if "[" not in name) or tuple(flat)[:_MOST_NAMED]
    notes = [Note("flat", {"names": shared})] if flat else []
    for names in made.not_told_apart:
        if names == ("gravity", "length") and "gravity" not in made.names:
            notes.append(Note("only_ratio"))
        elif names not in errors.untold(made.names):
            i, j = (made.names.index(each) for each in names)
            told = {"first": names[0], "second": names[1]}
            notes.append(Note("alike", {**told, "correlation": float(made.correlation[i, j])}))
    return notes
