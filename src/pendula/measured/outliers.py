"""Samples that do not fit between their neighbours."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pendula._types import Array

_ROUNDS = 20
_MAD = 1.4826  # of a normal distribution: its standard deviation over its median deviation
_STEPS = 3.0  # usual steps from sample to sample, below which none is an outlier


def outliers_of(t: Array, values: Array, threshold: float) -> Array:
    """Which samples deviate robustly from the cubic through two neighbours on each side, (n,).

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


def _of_column(t: Array, column: Array, threshold: float) -> Array:
    import numpy as np

    found = np.zeros(t.size, dtype=bool)
    for _ in range(_ROUNDS):
        kept = np.flatnonzero(np.isfinite(column) & ~found)
        if kept.size < 9:
            break
        off = _deviations(t[kept], column[kept])
        limit = threshold * _MAD * float(np.median(off))
        steps = np.abs(np.diff(column[kept]))
        limit = max(limit, _STEPS * float(np.median(steps[steps > 0])) if steps.any() else 0.0)
        padded = np.pad(off, 2)
        largest = off >= np.max([padded[i : i + off.size] for i in range(5)], axis=0)
        new = kept[largest & (off > limit)]
        if not new.size:
            break
        found[new] = True
    return found


def _deviations(t: Array, v: Array) -> Array:
    """|v - cubic through two neighbours on each side|, (n,); of the ends 0 (Lagrange's form)."""
    import numpy as np

    off = np.zeros(t.size)
    at = t[2:-2]
    nodes = [t[:-4], t[1:-3], t[3:-1], t[4:]]
    around = [v[:-4], v[1:-3], v[3:-1], v[4:]]
    made = np.zeros(at.size)
    for i, node in enumerate(nodes):
        weight = np.ones(at.size)
        for j, other in enumerate(nodes):
            if i != j:
                weight = weight * (at - other) / (node - other)
        made += weight * around[i]
    off[2:-2] = np.abs(v[2:-2] - made)
    return off
