"""What the errors of all methods cost: the study's runs, and what its text says of them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from pendula.analysis import time_scale, work_precision
from pendula.run.solve import methods

if TYPE_CHECKING:
    from pendula.analysis import WorkPrecision
    from pendula.plot.labels import Labels
    from pendula.study.notation import Numbers
    from pendula.study.schema import Recipe
    from pendula.systems import DoublePendulum, SimplePendulum

    State = tuple[float, float, float, float]

_TARGET = 1e-9  # the error that the table and the text speak of [rad]
_KEYS = ("swings", "points")


def work(
    recipe: Recipe, simple: SimplePendulum, rods: DoublePendulum, start: State
) -> dict[str, WorkPrecision]:
    """Run all methods, by system; without times, which would not be the same again.

    Raises:
        RuntimeError: where the rods' motion is not to be had to all digits.
    """
    part, found = recipe.work, {}
    cases: tuple[tuple[SimplePendulum | DoublePendulum, tuple[float, ...]], ...] = (
        (simple, (recipe.simple.large, 0.0)),
        (rods, start),
    )
    for system, state in cases:
        t_max = part.swings * time_scale(system, state)
        try:
            found[system.name] = work_precision(
                system, state, t_max, points=part.points, timed=False
            )
        except ValueError as error:
            place = recipe.place(*(("work", key) for key in _KEYS))
            rule = "work.swings must be few enough for a certified reference"
            raise RuntimeError(f"{place}: {rule}, got {part.swings}: {error}") from None
    return found


def work_facts(
    found: dict[str, WorkPrecision], swings: int, words: Labels, numbers: Numbers
) -> dict[str, Any]:
    """What the text says: of each system, and a row for each method."""
    by_name = {
        system: {each.method: each for each in part.methods} for system, part in found.items()
    }
    rows = []
    for method in methods():
        if not any(method.name in each for each in by_name.values()):
            continue
        row = [words.name(method.name), str(method.order)]
        for runs in by_name.values():
            run = runs.get(method.name)
            best = run.best if run else math.nan
            cost = run.to_reach(_TARGET)[0] if run else math.nan
            row += [numbers.plain(best, 2), _count(cost, numbers)]
        rows.append(row)
    return {
        "target": numbers.plain(_TARGET, 1),
        "swings": swings,
        "rows": rows,
        "simple": _system(found["simple"], words, numbers),
        "double": _system(found["double"], words, numbers),
    }


def _system(part: WorkPrecision, words: Labels, numbers: Numbers) -> dict[str, Any]:
    """The cheapest and the dearest way to the target, and who never gets there."""
    costs = {words.name(each.method): each.to_reach(_TARGET)[0] for each in part.methods}
    reached = sorted((cost, name) for name, cost in costs.items() if math.isfinite(cost))
    ends = [{"name": name, "evaluations": _count(cost, numbers)} for cost, name in reached]
    return {
        "until": numbers.plain(float(part.t[-1])),
        "times": len(part.t),
        "digits": part.digits,
        "precision": part.precision,
        "cheapest": ends[0] if ends else None,
        "dearest": ends[-1] if len(ends) > 1 else None,
        "never": [name for name, cost in costs.items() if not math.isfinite(cost)],
    }


def _count(evaluations: float, numbers: Numbers) -> str:
    """Evaluations that are interpolated, to two digits."""
    if not math.isfinite(evaluations):
        return numbers.plain(evaluations)
    return numbers.fixed(float(f"{evaluations:.2g}"), 0)
