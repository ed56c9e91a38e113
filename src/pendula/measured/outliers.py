"""Samples that do not fit between their neighbours."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pendula._types import Array

_ROUNDS = 20
_MAD = 1.4826  # of a normal distribution: its standard deviation over its median deviation
_STEPS = 3.0  # steps from sample to sample, below which none is an outlier
_IN_A_ROW = 3  # samples, at most, that are outliers together
_SHARE = 0.01  # of the range of the motion, below which none is seen
_AROUND = 51  # samples whose deviations a sample's is compared with
_HELD = 0.8  # of the samples differ from the one before, or values are held


def outliers_of(t: Array, values: Array, threshold: float) -> NDArray[Any]:
    """Which samples deviate robustly from what their neighbours say, (n,).

    The deviation's scale is its median (Hampel, J. Am. Stat. Assoc. 69 (1974) 383); the largest of
    each neighbourhood goes first, so that it does not take its neighbours with it.

    Args:
        t: times, (n,).
        values: (n, m); NaN: missing.
        threshold: standard deviations beyond which a sample is one.
    """
    import numpy as np

    found = np.zeros(t.size, dtype=bool)
    for column in values.T:
        found |= _of_column(t, column, threshold)
    return found


def _of_column(t: Array, column: Array, threshold: float) -> NDArray[Any]:
    import numpy as np

    found = np.zeros(t.size, dtype=bool)
    for _ in range(_ROUNDS):
        kept = np.flatnonzero(np.isfinite(column) & ~found)
        if kept.size < 9:
            break
        off = _deviations(t[kept], column[kept])
        limit = np.maximum(threshold * _MAD * _local_median(off), _least(column[kept]))
        padded = np.pad(off, 2)
        largest = off >= np.max([padded[i : i + off.size] for i in range(5)], axis=0)
        new = kept[largest & (off > limit)]
        if not new.size:
            break
        found[new] = True
    return _short(found)


def _short(found: NDArray[Any]) -> NDArray[Any]:
    """Those of few in a row: more are fast motion, or a stretch that is not to be trusted."""
    import numpy as np

    edges = np.diff(np.r_[0, found.astype(int), 0])
    kept = found.copy()
    for start, end in zip(np.flatnonzero(edges > 0), np.flatnonzero(edges < 0), strict=True):
        if end - start > _IN_A_ROW:
            kept[start:end] = False
    return kept


def _local_median(off: Array) -> Array:
    """The median of the deviations around each, (n,), or of all where that is more.

    Noise grows with speed, where frames are blurred, and the motion dies away.
    """
    import numpy as np

    width = min(_AROUND, off.size)
    windows = np.lib.stride_tricks.sliding_window_view(off, width)
    local = np.median(windows, axis=1)
    before = (off.size - local.size) // 2
    padded = np.pad(local, (before, off.size - local.size - before), mode="edge")
    return np.maximum(padded, np.median(off))


def _least(column: Array) -> float:
    """What no outlier is below: a share of the motion, and some steps of the last digit.

    Where many samples repeat the one before, frames or a sensor hold their value, and each change
    is a step of its own.
    """
    import numpy as np

    steps = np.abs(np.diff(column))
    risen = steps[steps > 0]
    if not risen.size:
        return 0.0
    held = risen.size < _HELD * steps.size
    low, high = np.quantile(column, (0.01, 0.99))
    step = float(np.median(risen) if held else risen.min())
    return max(_STEPS * step, _SHARE * float(high - low))


def _deviations(t: Array, v: Array) -> Array:
    """How far each sample is from what its neighbours say, (n,); where they say nothing, 0.

    They say it three ways: the parabola through three before it, the one through three after, the
    cubic through two on each side. The median of the three is not moved by an outlier beside it.
    At an end, where a way is missing, there is no judgement.
    """
    import numpy as np

    ways = ((-3, -2, -1), (1, 2, 3), (-2, -1, 1, 2))
    made = np.array([_through(t, v, places) for places in ways])
    off: Array = np.abs(v - np.median(made, axis=0))
    return np.where(np.isfinite(off), off, 0.0)


def _through(t: Array, v: Array, places: tuple[int, ...]) -> Array:
    """The polynomial through neighbours at these places, at each sample, (n,) (Lagrange's form)."""
    import numpy as np

    first, last = -min(*places, 0), t.size - max(*places, 0)
    at = t[first:last]
    nodes = [t[first + place : last + place] for place in places]
    made = np.zeros(at.size)
    for i, node in enumerate(nodes):
        weight = np.ones(at.size)
        for j, other in enumerate(nodes):
            if i != j:
                weight = weight * (at - other) / (node - other)
        made += weight * v[first + places[i] : last + places[i]]
    whole = np.full(t.size, np.nan)
    whole[first:last] = made
    return whole
