"""Windows of one recording that are to join: each one's end beside the start of the next."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula._types import Array
    from pendula.measured.problem import Problem, Sampled


def run_times(recordings: Sequence[Sampled], *, joined: bool) -> list[Array]:
    """Of the runs: the times of the samples and, of windows that join, the next one's first."""
    import numpy as np

    times = [each.t for each in recordings]
    if not joined:
        return times
    return [*(np.append(t, after[0]) for t, after in pairwise(times)), times[-1]]


def gaps(problem: Problem, x: Array) -> Array:
    """States at the ends of windows less those at the starts of the next, (windows − 1, d)."""
    import numpy as np

    runs = pairwise(problem.runs(x))
    return np.array([before[-1] - after[0] for before, after in runs])


def gap_slopes(problem: Problem, x: Array) -> list[Array]:
    """Derivatives of the weighted gaps, (d, k) each."""
    import numpy as np

    found, model, free = [], problem.model, problem.free
    for i, t in enumerate(problem.times[:-1]):
        block = np.zeros((len(problem.joints), len(problem.names)))
        block[:, problem.places(i)] = model.state_slopes(t[[0, -1]], problem.values(i, x), free)[-1]
        for j, name in enumerate(model.components):
            if name in free:
                block[j, problem.places(i + 1)[free.index(name)]] -= 1.0
        found.append(block * np.array(problem.joints)[:, np.newaxis])
    return found


def gap_blocks(problem: Problem, begin: int) -> list[tuple[slice, list[int]]]:
    """Rows of the gaps' derivatives, from `begin` on, and the columns of each."""
    d = len(problem.joints)
    return [
        (
            slice(begin + d * i, begin + d * (i + 1)),
            sorted({*problem.places(i), *problem.places(i + 1)}),
        )
        for i in range(len(problem.recordings) - 1)
    ]
