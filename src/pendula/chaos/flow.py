"""Many motions at once through the kernels: their matrices, and their crossings."""

from __future__ import annotations

import math
import os
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NamedTuple

from pendula import _engine
from pendula._rules import refuse
from pendula.run.options import Options
from pendula.run.request import core_request

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import NDArray

    from pendula._progress import Progress
    from pendula._types import Array
    from pendula.run.events import Event
    from pendula.systems import System


class Steps(NamedTuple):
    """Motions over one span of time.

    Attributes:
        ends: their states, (n, d).
        matrices: derivatives of the ends by the starts, (n, d, d).
        n_steps: of all of them.
    """

    ends: Array
    matrices: Array
    n_steps: int


class CrossingsOfMany(NamedTuple):
    """The first crossings of a surface by each of n motions.

    Attributes:
        times: (n, m) [s]; NaN where a run ended before.
        states: (n, m, d).
        outcomes: how each run ended, (n,): "event" after all its crossings.
        n_steps: of each, (n,).
    """

    times: Array
    states: Array
    outcomes: NDArray[np.str_]
    n_steps: NDArray[np.int64]


def processors() -> int:
    """How many processors this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


def over_span(system: System, states: Array, span: float) -> Steps:
    """Motions from states (n, d), all at t = 0, over a span [s], with their matrices.

    Args:
        system: of all.
        states: (n, d).
        span: [s].
    """
    import numpy as np

    d = states.shape[1]
    starts = np.ascontiguousarray(states)
    request = _request(system, starts[0], np.array([span]), Options())
    result = _engine.ensemble(
        request, starts, _parameters(system), list(range(d)), processors(), None
    )
    refuse(result.refused)
    return Steps(
        result.states(1, d)[:, 0],
        result.derivatives(1, d, d)[:, 0],
        int(np.sum(result.n_steps)),
    )


def crossings_of_many(
    system: System,
    states: Array,
    event: Event,
    count: int,
    options: Mapping[str, Any],
    threads: int,
    progress: Progress,
) -> CrossingsOfMany:
    """The first `count` crossings of a surface by the motions from states (n, d).

    Args:
        system: of all.
        states: starts, (n, d).
        event: the surface.
        count: after how many a run ends.
        options: tolerance and most steps.
        threads: how many; the result does not depend on them.
        progress: called with the part of the motions that is done.
    """
    import numpy as np

    n, d = states.shape
    starts = np.ascontiguousarray(states)
    asked = Options(**{**options, "events": (replace(event, terminal=count),)})
    request = _request(system, starts[0], np.array([math.inf]), asked)
    refuse(_engine.check(request), digits=False)
    result = _engine.ensemble(request, starts, _parameters(system), [], threads, progress)
    refuse(result.refused)
    (found,) = result.events
    times, where = np.full((n, count), np.nan), np.full((n, count, d), np.nan)
    runs = np.asarray(found.trajectories, np.int64)
    order = np.arange(runs.size) - np.searchsorted(runs, runs)
    times[runs, order], where[runs, order] = found.times, found.states(d)
    return CrossingsOfMany(
        times, where, np.array(result.outcomes), np.asarray(result.n_steps, np.int64)
    )


def strobes_of_many(
    system: System,
    states: Array,
    period: float,
    count: int,
    options: Mapping[str, Any],
    threads: int,
    progress: Progress,
) -> CrossingsOfMany:
    """The motions from states (n, d) after one period, two, and so on.

    Args:
        system: of all.
        states: starts, (n, d).
        period: [s].
        count: of times.
        options: tolerance and most steps.
        threads: how many; the result does not depend on them.
        progress: called with the part of the motions that is done.
    """
    import numpy as np

    d = states.shape[1]
    starts = np.ascontiguousarray(states)
    times: Array = period * np.arange(1, count + 1, dtype=np.float64)
    request = _request(system, starts[0], times, Options(**options))
    refuse(_engine.check(request), digits=False)
    result = _engine.ensemble(request, starts, _parameters(system), [], threads, progress)
    refuse(result.refused)
    where = result.states(count, d)
    reached = np.where(np.isfinite(where[..., 0]), times, np.nan)
    return CrossingsOfMany(
        reached, where, np.array(result.outcomes), np.asarray(result.n_steps, np.int64)
    )


def _request(system: System, state: Array, times: Array, options: Options) -> _engine.Request:
    return core_request(system._description(), "taylor", state, 0.0, times, options)


def _parameters(system: System) -> Array:
    """One row for all, (1, p)."""
    import numpy as np

    return np.array([list(system.parameters.values())])
