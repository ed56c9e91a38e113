"""From a first window to the whole record, and from one friction to several."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import combinations
from typing import TYPE_CHECKING

from pendula.measured.least_squares import CLOSE, ROUGH
from pendula.measured.model import FRICTIONS
from pendula.measured.problem import Optimum, Problem, minimise
from pendula.measured.starts import MOST, equivalents

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from pendula._types import Array

_GROWS = 3.0  # times as long is the next window
_NEARLY = 0.6  # of the record: a window beyond is as good as all of it


Rungs = dict[frozenset[str], Optimum]  # optima of fewer samples, by the frictions in them


def climbed(
    problem: Problem,
    first: Mapping[str, float],
    length: float,
    rungs: Rungs,
    *,
    robust: bool = False,
) -> Optimum:
    """The optimum of a problem, by way of smaller sets of its frictions.

    One friction alone is fitted to longer and longer windows, each from the one before: in a long
    record the phase has as many minima as there are swings. To the one that is best alone the
    others are added, each set fitted from the best set on the way with one friction fewer. All but
    the last are fitted to fewer samples.

    Args:
        problem: what is to be fitted.
        first: what describes the first window, with viscous friction, by the names of the problem.
        length: of that window [s].
        rungs: those that were found on the way to another model; what is found is added.
        robust: as for `minimise`.
    """
    frictions = [name for name in FRICTIONS if name in problem.free]
    found = rungs
    thin = problem.thinned(MOST)
    for name in frictions:
        alone = frozenset([name])
        if alone not in found:
            smaller = _only(problem, alone)
            start = _begun(smaller, first, length, name)
            found[alone] = grown(smaller, start, length, robust=robust)
    for chosen in _steps(frictions, found):
        if chosen not in found:
            smaller = _only(problem, chosen)
            found[chosen] = minimise(
                replace(smaller, recordings=thin.recordings, model=thin.model),
                _filled(smaller, _below(chosen, frictions, found)),
                robust=robust,
                search=CLOSE,
            )
    if not frictions:
        start = _begun(problem, first, length, "")
        return minimise(problem, grown(problem, start, length, robust=robust).x, robust=robust)
    return minimise(problem, _filled(problem, found[frozenset(frictions)]), robust=robust)


def _best(frictions: Iterable[str], found: Rungs) -> str:
    """The friction that fits best alone."""
    return min(frictions, key=lambda name: found[frozenset([name])].rms)


def _steps(frictions: list[str], found: Rungs) -> list[frozenset[str]]:
    """Sets of several frictions on the way to all of them, each with the one best alone."""
    best = _best(frictions, found) if frictions else ""
    others = [name for name in frictions if name != best]
    return [
        frozenset([best, *more])
        for count in range(1, len(frictions))
        for more in combinations(others, count)
    ]


def _below(chosen: frozenset[str], frictions: list[str], found: Rungs) -> Optimum:
    """The best of the sets on the way with one friction fewer, whatever else was found."""
    added = chosen - {_best(frictions, found)}
    return min((found[chosen - {name}] for name in added), key=_rms)


def _rms(optimum: Optimum) -> float:
    return optimum.rms


def _only(problem: Problem, frictions: frozenset[str]) -> Problem:
    """The problem with these frictions alone."""
    zero = [name for name in FRICTIONS if name in problem.free and name not in frictions]
    return replace(
        problem,
        free=tuple(name for name in problem.free if name not in zero),
        constants={**problem.constants, **dict.fromkeys(zero, 0.0)},
    )


def _filled(problem: Problem, smaller: Optimum) -> Array:
    """The optimum of a smaller problem as a start of this one: new frictions are zero."""
    import numpy as np

    known = dict(zip(smaller.names, smaller.x.tolist(), strict=True))
    return np.array([known.get(name, 0.0) for name in problem.names])


def _begun(problem: Problem, first: Mapping[str, float], length: float, friction: str) -> Array:
    """The first window's values with its viscous friction turned into another, as strong."""
    import numpy as np

    values = dict(first)
    for i in range(len(problem.recordings)):
        mark = f"[{i + 1}]" if len(problem.recordings) > 1 else ""
        own = {name: first.get(name, first.get(name + mark, 0.0)) for name in problem.free}
        square, viscous = (
            first.get(name, first.get(name + mark, problem.constants.get(name, 0.0)))
            for name in ("omega0_squared", "viscous")
        )
        frequency = math.sqrt(max(square, 1e-9))
        start = math.hypot(own.get("theta", 0.0), own.get("omega", 0.0) / frequency)
        halfway = start * math.exp(-0.25 * max(viscous, 0.0) * length)
        amplitude = first.get("amplitude", halfway)
        same = equivalents(viscous, max(amplitude, 1e-9), frequency)
        for name in FRICTIONS:
            values[name] = values[name + mark] = same[name] if name == friction else 0.0
    return np.array([values.get(name, 0.0) for name in problem.names])


def grown(problem: Problem, start: Array, length: float, *, robust: bool) -> Optimum:
    """The optimum over the whole record, roughly, by way of windows from its start."""
    span = max(float(each.t[-1] - each.t[0]) for each in problem.recordings)
    x = start
    while length < _NEARLY * span:
        window = problem.within(length).thinned(MOST)
        x = minimise(window, x, robust=robust, search=ROUGH).x
        length *= _GROWS
    return minimise(problem.thinned(MOST), x, robust=robust, search=ROUGH)
