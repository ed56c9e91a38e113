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
# Of the mean's error: it is made from the means of 2, 4, … 2^5 blocks, and there is none where the
# run is too short for eight blocks of two correlation times.
LEAST_BLOCKS, HALVINGS = 8, 5
# The error falls as T^(H−1), with H from 1/2, where blocks forget each other, to 1, where a run
# remembers its start. Before a run is seen H − 1/2 is taken to be exponentially distributed, with
# about the mean of the largest chaotic seas of two rods at 6, 8, 10, 12, 15, 20, 30, 40, 60 and
# 100 J: their spreads over 25 to 155 runs fall from 400 to 10 000 s as by H − 1/2 = 0.34, 0.20,
# 0.22, 0, 0.07, 0.01, 0.01, 0, 0.07 and 0.35. The errors then are 1.0 to 1.5 of the spread at 12 to
# 40 J, 0.9 to 1.3 at 60 J, 0.6 to 1.0 at 8 and 10 J and 0.5 to 0.6 at 100 J, runs of 400 to
# 10 000 s, root mean squares; the largest of those by 16, 8 and 4 blocks 0.9 to 1.3, 0.7 to 1.0,
# 0.5 to 0.7 and 0.3 to 0.4.
EXPECTED_MEMORY = 0.1
# H from which an error is told to fall slowly, as T^-0.35 or less: what 1 to 9 of 100 runs tell at
# 12 to 40 J, 9 to 33 at 60 J, 6 to 31 at 10 J and 26 to 43 at 100 J.
SLOW = 0.65


def verdict_of(mean_megno: Any) -> Any:
    """Each mean MEGNO's: "chaotic", "regular" or "undecided"."""
    import numpy as np

    value = np.asarray(mean_megno)
    found = np.where(value > CHAOTIC_ABOVE, "chaotic", "undecided")
    found = np.where(value < REGULAR_BELOW, "regular", found)
    return found if found.ndim else str(found)


def standard_error_of_mean(parts: Array) -> float:
    """Of the mean of a series (m,) of equal parts, m at least 32, whose memory may be long.

    The geometric mean of the errors that each H gives, by the probability that the blocks leave to
    it: 1.2 times too large where no memory is. NaN where fewer than eight blocks of two
    correlation times fit in.
    """
    import numpy as np

    if parts.size // math.ceil(2.0 * _correlation_time(parts)) < LEAST_BLOCKS:
        return math.nan
    _, errors, weights = _errors_by_memory(parts)
    return float(np.exp(weights @ np.log(errors))) if errors.all() else 0.0


def falls_slowly(parts: Array) -> bool:
    """Whether the mean's error more probably than not falls more slowly than T^-0.35."""
    exponents, errors, weights = _errors_by_memory(parts)
    return bool(errors.all() and weights[exponents > SLOW].sum() > 0.5)


def _errors_by_memory(parts: Array) -> tuple[Array, Array, Array]:
    """Exponents H, the error of the mean that each gives, and the probability of each, (50,).

    Means over T/n of fractional noise have the variance s² n^(2−2H), s² that over T (Mandelbrot &
    Van Ness 1968, SIAM Rev. 10, 422), hence differences of neighbouring ones (4 − 4^H) s² n^(2−2H).
    These are taken as independent and normal (Wornell & Oppenheim 1992, IEEE Trans. Signal Process.
    40, 611): the likelihood of H is that with the best s², which is the error squared.
    """
    import numpy as np

    halvings = np.arange(1, HALVINGS + 1)
    squares = np.array([_mean_square_difference(parts, 2**i) for i in range(1, HALVINGS + 1)])
    exponents = 0.5 + 0.49 * np.arange(50) / 50
    shapes = (4.0 - 4.0**exponents) * 4.0 ** np.outer(halvings, 1.0 - exponents)  # by s²
    pairs = 2.0 ** (halvings - 1)
    variances = pairs @ (squares[:, np.newaxis] / shapes) / pairs.sum()
    if not variances.all():
        return exponents, np.sqrt(variances), np.full(50, 1.0 / 50)
    log = -0.5 * (pairs @ np.log(shapes) + pairs.sum() * np.log(variances))
    log -= (exponents - 0.5) / EXPECTED_MEMORY
    weights = np.exp(log - log.max())
    return exponents, np.sqrt(variances), weights / weights.sum()


def _mean_square_difference(parts: Array, blocks: int) -> float:
    """Of the means of neighbouring blocks, two and two."""
    length = parts.size // blocks
    means = parts[: blocks * length].reshape(blocks // 2, 2, length).mean(axis=2)
    return float(((means[:, 1] - means[:, 0]) ** 2).mean())


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
