"""The noise of a recording: how alike neighbouring residuals are, and what that does to errors."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pendula._checks import extra

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pendula._types import Array

_LARGEST = 5.3  # atanh of the autocorrelation that is looked for, 0.99995
_WHITE = 1e-9  # a share of the largest diagonal element below which a column tells nothing


@dataclass(frozen=True, eq=False)
class Series:
    """Residuals of one column of one recording, in order of time.

    Attributes:
        residuals: (n,).
        jacobian: their derivatives by the parameters, (n, k).
        places: of the samples on an even grid of times, rising, (n,): a gap is as wide as it is.
    """

    residuals: Array
    jacobian: Array
    places: NDArray[np.int64]


@dataclass(frozen=True)
class Noise:
    """Noise e of which e_i − ρ e_{i−1} is independent, one sample after the other.

    Attributes:
        correlation: ρ, of neighbouring samples.
        variance: of e.
        uncertainty: standard error of atanh ρ.
        freedom: how many residuals the variance comes of.
    """

    correlation: float
    variance: float
    uncertainty: float
    freedom: int


def grid_places(t: Array) -> NDArray[np.int64]:
    """Places of times on an even grid: one further for a usual step, more over a gap.

    Args:
        t: rising, as uneven as they are, (n,) [s].
    """
    import numpy as np

    steps = np.diff(t)
    usual = np.median(steps) if len(steps) else 1.0
    places = np.zeros(len(t), np.int64)
    np.cumsum(np.maximum(np.rint(steps / usual), 1.0).astype(np.int64), out=places[1:])
    return places


def noise_of(series: Series) -> Noise:
    """The noise, by restricted maximum likelihood (Patterson & Thompson, Biometrika 58 (1971) 545).

    Residuals of a fit are less alike than the noise was, as the parameters take up some of it, and
    the more so the fewer there are; the restricted likelihood is that of what they leave.
    """
    import numpy as np

    optimize = extra("scipy.optimize", "fit")
    used = _told(series.jacobian)
    short = Series(series.residuals, series.jacobian[:, used], series.places)

    def lost(z: float) -> float:
        return _likelihood(short, math.tanh(z))[0]

    found = optimize.minimize_scalar(
        lost, bounds=(-1.5, _LARGEST), method="bounded", options={"xatol": 1e-4}
    )
    z = float(found.x)
    h = 0.02
    bend = (lost(z + h) - 2.0 * lost(z) + lost(z - h)) / h**2
    n = len(series.residuals)
    freedom = n - int(used.sum())
    rho = math.tanh(z)
    left = _likelihood(short, rho)[1]
    least = 1.0 / math.sqrt(n)
    return Noise(
        rho,
        left / freedom / (1.0 - rho * rho),
        max(1.0 / math.sqrt(bend), least) if bend > 0.0 else 1.0,
        freedom,
    )


def _told(jacobian: Array) -> NDArray[np.bool_]:
    """Columns that this series says anything about, (k,)."""
    import numpy as np

    return np.asarray(np.abs(jacobian).max(axis=0) > 0.0)


def _likelihood(series: Series, rho: float) -> tuple[float, float]:
    """−2 log of the restricted likelihood / 2, and the sum of squares of the innovations."""
    import numpy as np

    both = np.column_stack([series.jacobian, series.residuals])
    gaps = np.diff(series.places)
    powers = np.sign(rho) ** gaps * np.abs(rho) ** gaps if rho else np.zeros(len(gaps))
    shares = (1.0 - powers**2) / (1.0 - rho**2)  # variances of the innovations
    white = np.empty_like(both)
    white[0] = both[0] * math.sqrt(1.0 - rho**2)
    white[1:] = (both[1:] - powers[:, np.newaxis] * both[:-1]) / np.sqrt(shares)[:, np.newaxis]
    size = np.linalg.norm(white[:, :-1], axis=0)
    triangle: Array = np.linalg.qr(np.asarray(white / np.append(size, 1.0)), mode="r")
    n, k = series.jacobian.shape
    left = float(triangle[k, k] ** 2)
    diagonal = np.abs(np.diagonal(triangle)[:k]) * size
    lost = (n - k) * math.log(max(left, 1e-300))
    lost += float(np.log(shares).sum()) - math.log(1.0 - rho**2)
    lost += 2.0 * float(np.log(np.maximum(diagonal, 1e-300)).sum())
    return 0.5 * lost, left


def filtered(series: Series, rho: float) -> Array:
    """Jᵀ V J, (k, k), of the autocorrelation V = ρ^|distance| of the noise."""
    import numpy as np

    n = int(series.places[-1]) + 1
    padded = 1 << (2 * n - 1).bit_length()
    spread = np.zeros((n, series.jacobian.shape[1]))
    spread[series.places] = series.jacobian
    lags = np.minimum(np.arange(padded), padded - np.arange(padded))
    kernel = np.fft.rfft(float(rho) ** lags if rho else (lags == 0) * 1.0)
    smooth = np.fft.irfft(
        np.fft.rfft(spread, padded, axis=0) * kernel[:, np.newaxis], padded, axis=0
    )
    return np.asarray(series.jacobian.T @ smooth[series.places])


def blocks(series: Series, count: int) -> Array:
    """Σ of (J_bᵀ r_b)(J_bᵀ r_b)ᵀ over so many blocks of neighbours, (k, k)."""
    import numpy as np

    each = series.jacobian * series.residuals[:, np.newaxis]
    edges = np.linspace(0, len(each), count + 1).astype(int)[:-1]
    sums = np.add.reduceat(each, edges, axis=0)
    return np.asarray(sums.T @ sums) * count / (count - 1.0)


def autocorrelation_time(residuals: Array) -> float:
    """1 + 2 Σ ρ_l, in samples, the sum up to five times itself (Sokal 1997).

    Args:
        residuals: evenly sampled, or nearly, (n,).
    """
    import numpy as np

    n = len(residuals)
    centred = residuals - residuals.mean()
    padded = 1 << (2 * n - 1).bit_length()
    power = np.abs(np.fft.rfft(centred, padded)) ** 2
    shape = np.fft.irfft(power, padded)[:n]
    if shape[0] <= 0.0:
        return 1.0
    sums = 2.0 * np.cumsum(shape / shape[0]) - 1.0
    enough = np.arange(n) >= 5.0 * sums
    return float(max(sums[int(enough.argmax()) if enough.any() else n - 1], 1.0))
