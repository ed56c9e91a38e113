"""How far a measured period may be off: from how repeats scatter, and from who timed it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.measured.measurement import PeriodTable


class Scatter(NamedTuple):
    """The standard deviation of each row's period.

    Attributes:
        errors: (n,) [s]; all 1: not known, only that they are alike.
        degrees_of_freedom: of that estimate; infinite: it was given; 0: not known.
        grows: whether it is taken to grow with the period.
    """

    errors: Array
    degrees_of_freedom: float
    grows: bool


def scatter_of(table: PeriodTable, periods: Array, timing_error: float | None) -> Scatter:
    """The errors of the periods, which are means of as many timings as the table has.

    Few repeats tell their own row's error badly: those of all rows are pooled, into one error for
    all or one that grows with the period, whichever makes the repeats likelier.

    Args:
        table: with repeats, or without.
        periods: about the true ones, (n,) [s].
        timing_error: of one timing of a period [s]; where repeats scatter less than that, it is
            what counts: they may share it. None: not given.
    """
    import numpy as np

    counts = _counts(table)
    given = 0.0 if timing_error is None else timing_error
    pooled, freedom, grows = _pooled(table, periods, counts)
    if freedom == 0 and timing_error is None:
        return Scatter(np.ones_like(periods), 0.0, False)
    single = np.maximum(pooled, given)
    told = math.inf if (single == given).all() else float(freedom)
    return Scatter(single / np.sqrt(counts), told, grows)


def _counts(table: PeriodTable) -> Array:
    """How many timings each row has."""
    import numpy as np

    if table.repeats is None:
        return np.ones_like(table.period)
    found: Array = np.maximum(1.0, np.isfinite(table.repeats).sum(axis=1))
    return found


def _means(table: PeriodTable) -> Array:
    import numpy as np

    assert table.repeats is not None
    means: Array = np.nansum(table.repeats, axis=1) / _counts(table)
    return means


def _pooled(table: PeriodTable, periods: Array, counts: Array) -> tuple[Array, int, bool]:
    """The standard deviation of one timing in each row, its degrees of freedom, if it grows."""
    import numpy as np

    freedom = int((counts - 1).sum())
    if table.repeats is None or freedom == 0:
        return np.zeros_like(periods), 0, False
    squares = np.nansum((table.repeats - _means(table)[:, None]) ** 2, axis=1)
    alike = math.sqrt(squares.sum() / freedom)
    relative = math.sqrt((squares / periods**2).sum() / freedom)
    if relative == 0.0:
        return np.zeros_like(periods), 0, False  # repeats that never differ were not measured
    # the logarithms of both Gaussian likelihoods, without what they share
    grows = freedom * math.log(relative) + ((counts - 1) * np.log(periods)).sum() < (
        freedom * math.log(alike)
    )
    return (relative * periods if grows else np.full_like(periods, alike)), freedom, bool(grows)
