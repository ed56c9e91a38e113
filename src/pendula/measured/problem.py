"""A least squares problem: which parameters of which recordings, their bounds, and its solution."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

from pendula.measured.joints import gap_blocks, gap_slopes, gaps, run_times
from pendula.measured.least_squares import FINE, Search, least_squares

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    import numpy as np
    from numpy.typing import NDArray

    from pendula._types import Array
    from pendula.measured.measurement import Measurement
    from pendula.measured.model import Row
    from pendula.measured.models import Model

_LOST = 1e6  # a residual where the motion is not finite


@dataclass(frozen=True, eq=False)
class Sampled:
    """The samples of a recording that are fitted.

    Attributes:
        measurement: where they come from.
        t: rising, (n,) [s].
        values: (n, m); NaN: missing.
    """

    measurement: Measurement
    t: Array
    values: Array

    @cached_property
    def there(self) -> NDArray[np.bool_]:
        """Which values are there, (n, m)."""
        import numpy as np

        return np.isfinite(self.values)

    def taken(self, which: slice | NDArray[np.intp]) -> Sampled:
        """Some of the samples."""
        return replace(self, t=self.t[which].copy(), values=self.values[which])


@dataclass(frozen=True, eq=False)
class Problem:
    """Parameters to be found, and what they have to predict.

    Attributes:
        model: of each recording.
        recordings: fitted together.
        free: names of the model's parameters that are fitted.
        shared: those of them that all recordings have in common.
        constants: values of those that are not fitted.
        free_signs: friction may be negative.
        limits: least and largest values by name, in place of what is physical.
        joints: weights of a gap's components, (d,), where the recordings are windows that join.
        kept: states of the last parameters, by their bytes.
        slopes_kept: derivatives of the residuals by the last ones that they were asked for.
    """

    model: Model
    recordings: tuple[Sampled, ...]
    free: tuple[str, ...]
    shared: tuple[str, ...]
    constants: Mapping[str, float]
    free_signs: bool = False
    limits: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    joints: tuple[float, ...] = ()
    kept: dict[bytes, list[Array]] = field(default_factory=dict, init=False, repr=False)
    slopes_kept: dict[bytes, Array] = field(default_factory=dict, init=False, repr=False)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of what is fitted, (k,); with the recording's number where it is its own."""
        several = len(self.recordings) > 1
        own = [name for name in self.free if name not in self.shared]
        return (
            *(name for name in self.free if name in self.shared),
            *(
                f"{name}[{i + 1}]" if several else name
                for i in range(len(self.recordings))
                for name in own
            ),
        )

    def rows(self) -> list[Row]:
        """The model's row of each of the names."""
        known = {row.name: row for row in self.model.rows}
        return [known[name.partition("[")[0]] for name in self.names]

    def places(self, i: int) -> list[int]:
        """Where the free parameters of recording i stand among the names."""
        return self._places[i]

    @cached_property
    def _places(self) -> list[list[int]]:
        at = {name: j for j, name in enumerate(self.names)}
        return [
            [at[name] if name in at else at[f"{name}[{i + 1}]"] for name in self.free]
            for i in range(len(self.recordings))
        ]

    def bounds(self) -> tuple[Array, Array]:
        """Least and largest values, (k,) each."""
        import numpy as np

        pairs = [
            self.limits.get(
                row.name,
                (row.lower if row.lower != 0.0 or not self.free_signs else -math.inf, math.inf),
            )
            for row in self.rows()
        ]
        lower, upper = zip(*pairs, strict=True)
        return np.array(lower), np.array(upper)

    def values(self, i: int, x: Array) -> dict[str, float]:
        """All parameters of recording i by name."""
        fitted = {name: float(x[j]) for name, j in zip(self.free, self.places(i), strict=True)}
        return {**self._held, **fitted}

    @cached_property
    def _held(self) -> dict[str, float]:
        return {**{row.name: row.standard for row in self.model.rows}, **self.constants}

    def states(self, x: Array) -> list[Array]:
        """Of the motion of each recording, (n, d); NaN where it is not finite."""
        runs = zip(self.runs(x), self.recordings, strict=True)
        return [run[: len(each.t)] for run, each in runs]

    def runs(self, x: Array) -> list[Array]:
        """The same, of windows that join to the start of the next, (n + 1, d).

        Those of the last parameters are kept: the derivatives are asked for next.
        """
        key = x.tobytes()
        if key not in self.kept:
            self.kept.clear()
            self.kept[key] = [
                self.model.states(t, self.values(i, x)) for i, t in enumerate(self.times)
            ]
        return self.kept[key]

    @cached_property
    def times(self) -> list[Array]:
        """Of the runs, (n,) or (n + 1,) each."""
        return run_times(self.recordings, joined=bool(self.joints))

    def predicted(self, x: Array) -> list[Array]:
        """Of each recording, (n, m)."""
        return [
            self.model.seen(states, self.values(i, x)) for i, states in enumerate(self.states(x))
        ]

    def residuals(self, x: Array) -> Array:
        """Predicted less measured, one recording and column after the other, (N,)."""
        import numpy as np

        parts = zip(self.predicted(x), self.recordings, strict=True)
        found = [(p - r.values).T[r.there.T] for p, r in parts]
        if self.joints:
            found += list(gaps(self, x) * np.array(self.joints))
        return np.nan_to_num(np.concatenate(found), nan=_LOST, posinf=_LOST, neginf=_LOST)

    def jacobian(self, x: Array) -> Array:
        """Derivatives of the residuals, (N, k).

        Those of the last parameters are kept: where least squares ended, the uncertainties ask for
        them again.
        """
        key = x.tobytes()
        if key not in self.slopes_kept:
            self.slopes_kept.clear()
            self.slopes_kept[key] = self._slopes(x)
        return self.slopes_kept[key]

    def _slopes(self, x: Array) -> Array:
        """Derivatives of the residuals, (N, k)."""
        import numpy as np

        blocks = []
        for i, (each, states) in enumerate(zip(self.recordings, self.states(x), strict=True)):
            block = np.zeros((int(each.there.sum()), len(self.names)))
            slopes = self.model.slopes(each.t, states, self.values(i, x), self.free)
            block[:, self.places(i)] = slopes.transpose(1, 0, 2)[each.there.T]
            blocks.append(block)
        found = np.concatenate([*blocks, *(gap_slopes(self, x) if self.joints else [])])
        found[~np.isfinite(found).all(axis=1)] = 0.0
        return found

    def blocks(self) -> list[tuple[slice, list[int]]]:
        """Rows of the derivatives that belong to each recording, and its columns."""
        found, begin = [], 0
        for i, each in enumerate(self.recordings):
            end = begin + int(each.there.sum())
            found.append((slice(begin, end), self.places(i)))
            begin = end
        return [*found, *(gap_blocks(self, begin) if self.joints else [])]

    def of(self, recordings: Sequence[Sampled]) -> Problem:
        """The same of other samples."""
        return replace(self, recordings=tuple(recordings))

    def within(self, length: float) -> Problem:
        """The same of the first seconds of each recording, but of no fewer samples than needed."""
        import numpy as np

        parts = []
        for each in self.recordings:
            last = int(np.searchsorted(each.t, each.t[0] + length, side="right"))
            parts.append(each.taken(slice(0, max(last, 2 * len(self.free)))))
        return self.of(parts)

    def thinned(self, most: int) -> Problem:
        """The same of about so many samples a recording at most, computed roughly."""
        return replace(self.sparser(most), model=self.model.roughly())

    def sparser(self, most: int) -> Problem:
        """The same of about so many samples a recording at most."""
        return self.of(
            [each.taken(slice(None, None, -(-len(each.t) // most))) for each in self.recordings]
        )


@dataclass(frozen=True, eq=False)
class Optimum:
    """Where least squares came to.

    Attributes:
        names: of the parameters, (k,).
        x: the parameters, (k,).
        rms: of the residuals.
    """

    names: tuple[str, ...]
    x: Array
    rms: float


def minimise(
    problem: Problem, start: Array, *, robust: bool = False, search: Search = FINE
) -> Optimum:
    """Least squares from a start, within the bounds.

    Args:
        problem: what is to be fitted.
        start: (k,), moved into the bounds where it lies outside.
        robust: residuals beyond two standard deviations count less (soft_l1).
        search: how the optimum is looked for.
    """
    import numpy as np

    lower, upper = problem.bounds()
    x = np.clip(start, lower, upper)
    scale = _spread(problem.residuals(x)) if robust else 0.0
    x, cost = least_squares(problem, x, lower, upper, search, scale)
    count = sum(int(each.there.sum()) for each in problem.recordings)
    if problem.joints:
        cost = float(np.sum(problem.residuals(x)[:count] ** 2))
    return Optimum(problem.names, x, math.sqrt(cost / count))


def _spread(residuals: Array) -> float:
    """Two standard deviations, from the median, which outliers do not move."""
    import numpy as np

    return float(2.0 * 1.4826 * np.median(np.abs(residuals)))
