"""Chaotic, regular or undecided; and the error of a mean whose parts are correlated."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pendula._types import Array

VERDICTS = "chaotic", "regular", "undecided"
# Of the mean MEGNO, which tends to 2 on a torus and grows as λt/2 in chaos. Double rods with 4 to
# 20 J, 800 starts, after 400 s: regular ones up to 4.7; chaotic ones, told by their exponent over
# 8000 s, from 5.7 on, but for those that have kept to the edge of an island all the while. Of 150
# starts at 4, 15 and 20 J each none is told wrongly; of 150 at 10 J 4 of the 127 chaotic ones are
# still regular by any measure: they leave their island later.
REGULAR_BELOW, CHAOTIC_ABOVE = 2.5, 5.5
# Of the mean's error, which is the largest that these many blocks give: fewer are longer, and see
# slower parts of the motion, such as the edges of islands, to which it sticks. It is 0.9 to 1.2 of
# the spread of 60 starts at 12 to 60 J in runs of 2000 s, 0.6 to 1.2 in runs of 400 s; sixteen
# alone give 0.7 to 1.05 and 0.5 to 1.0.
LEAST_BLOCKS, MOST_BLOCKS = 8, 16
FEWEST_BLOCKS = 4


def verdict_of(mean_megno: Any) -> Any:
    """Each mean MEGNO's: "chaotic", "regular" or "undecided"."""
    import numpy as np

    value = np.asarray(mean_megno)
    found = np.where(value > CHAOTIC_ABOVE, "chaotic", "undecided")
    found = np.where(value < REGULAR_BELOW, "regular", found)
    return found if found.ndim else str(found)


def standard_error_of_mean(parts: Array) -> float:
    """Of the mean of a series (m,) of equal parts, from blocks of two correlation times at least.

    The largest of those that sixteen, eight and four blocks give; NaN where fewer than eight of two
    correlation times fit in.
    """
    count = parts.size
    most = min(MOST_BLOCKS, count // math.ceil(2.0 * _correlation_time(parts)))
    if most < LEAST_BLOCKS:
        return math.nan
    return max(_error_by_blocks(parts, each) for each in (most, LEAST_BLOCKS, FEWEST_BLOCKS))


def _error_by_blocks(parts: Array, blocks: int) -> float:
    """Of the mean, from the scatter of the means of so many blocks."""
    block = parts.size // blocks
    means = parts[: blocks * block].reshape(blocks, block).mean(axis=1)
    return float(means.std(ddof=1) / math.sqrt(blocks))


def _correlation_time(parts: Array) -> float:
    """Integrated autocorrelation time, in parts, by Sokal's window (1997, eq. 3.16)."""
    import numpy as np

    rest = parts - parts.mean()
    count = rest.size
    spectrum = np.abs(np.fft.rfft(rest, 2 * count)) ** 2
    correlation = np.fft.irfft(spectrum)[:count]
    if not correlation[0] > 0.0:
        return 0.5
    time = 0.5
    for lag in range(1, count):
        time += float(correlation[lag] / correlation[0])
        if lag >= 6.0 * time:
            break
    return max(time, 0.5)
