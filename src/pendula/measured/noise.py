"""The noise of a recording: how alike neighbouring residuals are, and what that does to errors."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pendula._checks import extra
from pendula.measured.least_squares import triangle

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from pendula._types import Array

_FLAT = 1e-10  # of the largest singular value: a direction that the data do not tell
_NOTHING = 1e-20  # a power of the autocorrelation that no sum of a record shows
_LARGEST = 5.3  # atanh of the autocorrelation that is looked for, 0.99995


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
        innovation: variance of what is independent.
        uncertainty: standard error of atanh ρ.
        freedom: how many residuals the variance comes of.
    """

    correlation: float
    innovation: float
    uncertainty: float
    freedom: int

    def varied(self, deviations: float = 0.0) -> tuple[float, float]:
        """ρ and the variance of e, with atanh ρ off by so many standard errors.

        The record tells the variance of what is independent well, and that of e not: where the
        noise wanders slowly, it depends on ρ.
        """
        rho = math.tanh(math.atanh(self.correlation) + deviations * self.uncertainty)
        return rho, self.innovation / (1.0 - rho * rho)


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
    optimize = extra("scipy.optimize", "fit")
    likelihood = _Likelihood.of(series)

    def lost(z: float) -> float:
        return likelihood.lost(math.tanh(z))[0]

    found = optimize.minimize_scalar(
        lost, bounds=(-1.5, _LARGEST), method="bounded", options={"xatol": 1e-5}
    )
    z, h = float(found.x), 0.02
    bend = (lost(z + h) - 2.0 * lost(z) + lost(z - h)) / h**2
    rho = math.tanh(z)
    left = likelihood.lost(rho)[1]
    least = 1.0 / math.sqrt(likelihood.n)
    return Noise(
        rho,
        left / likelihood.freedom,
        min(max(1.0 / math.sqrt(bend), least), 1.0) if bend > 0.0 else 1.0,
        likelihood.freedom,
    )


@dataclass(frozen=True, eq=False)
class _Likelihood:
    """Sums over all steps from one sample to the next, of which every ρ makes its likelihood.

    Attributes:
        n: samples.
        freedom: those less the parameters.
        first: products of the first sample's columns, (k + 1, k + 1): derivatives and residual.
        gaps: distinct distances of neighbours.
        counts: how often each occurs.
        sums: for each, products of later by later, later by earlier, earlier by earlier samples.
    """

    n: int
    freedom: int
    first: Array
    gaps: list[int]
    counts: list[int]
    sums: list[tuple[Array, ...]]

    @classmethod
    def of(cls, series: Series) -> _Likelihood:
        """The sums of a series."""
        import numpy as np

        told = np.abs(series.jacobian).max(axis=0) > 0.0
        jacobian = series.jacobian[:, told]
        basis = _basis(jacobian / np.linalg.norm(jacobian, axis=0))
        both = np.column_stack([basis, series.residuals])
        steps = np.diff(series.places)
        gaps, counts = np.unique(steps, return_counts=True)
        sums = []
        for gap in gaps:
            later, earlier = both[1:][steps == gap], both[:-1][steps == gap]
            pairs = ((later, later), (later, earlier), (earlier, earlier))
            sums.append(tuple(products(*pair) for pair in pairs))
        n = len(both)
        first = np.outer(both[0], both[0])
        return cls(n, n - basis.shape[1], first, gaps.tolist(), counts.tolist(), sums)

    def lost(self, rho: float) -> tuple[float, float]:
        """−log of the restricted likelihood, and the sum of squares of what is independent."""
        import numpy as np

        unlike = 1.0 - rho * rho
        gram = self.first * unlike
        lost = -math.log(unlike)
        for gap, count, (later, mixed, earlier) in zip(
            self.gaps, self.counts, self.sums, strict=True
        ):
            power = rho**gap
            share = (1.0 - power * power) / unlike
            gram = gram + (later - power * (mixed + mixed.T) + power * power * earlier) / share
            lost += count * math.log(share)
        k = len(gram) - 1
        inner = np.linalg.solve(gram[:k, :k], gram[:k, k])
        left = max(float(gram[k, k] - gram[:k, k] @ inner), 1e-300)
        lost += self.freedom * math.log(left) + float(np.linalg.slogdet(gram[:k, :k])[1])
        return 0.5 * lost, left


def products(one: Array, other: Array) -> Array:
    """oneᵀ other of tall matrices, whose bits do not depend on threads as BLAS shares work out."""
    import numpy as np

    return np.asarray(np.einsum("ni,nj->ij", one, other))


def _basis(jacobian: Array) -> Array:
    """Columns of length one at right angles that span the same space, (n, up to k)."""
    import numpy as np

    _, singular, directions = np.linalg.svd(triangle(jacobian))
    good = singular > _FLAT * singular[0]
    return np.asarray(jacobian @ (directions[good].T / singular[good]))


def filtered(series: Series, rho: float, variance: float) -> Array:
    """Jᵀ V J, (k, k), with the covariance V = variance ρ^|distance| of the noise."""
    import numpy as np

    spread = np.zeros((series.jacobian.shape[1], int(series.places[-1]) + 1))
    spread[:, series.places] = series.jacobian.T
    both = _decayed(spread, rho) + _decayed(spread[:, ::-1], rho)[:, ::-1] - spread
    return variance * products(series.jacobian, both[:, series.places].T)


def _decayed(rows: Array, rho: float) -> Array:
    """Σ ρ^l of each row's value l places before, by Σ ρ^l z^l = (1 + ρz)(1 + ρ²z²) …; (k, n)."""
    found, power, far = rows.copy(), rho, 1
    while far < rows.shape[1] and abs(power) > _NOTHING:
        found[:, far:] += power * found[:, :-far]
        power, far = power * power, 2 * far
    return found


def blocks(series: Series, count: int) -> Array:
    """Σ of (J_bᵀ r_b)(J_bᵀ r_b)ᵀ over so many blocks of neighbours, (k, k)."""
    import numpy as np

    each = series.jacobian * series.residuals[:, np.newaxis]
    edges = np.linspace(0, len(each), count + 1).astype(int)[:-1]
    sums = np.add.reduceat(each, edges, axis=0)
    return np.asarray(sums.T @ sums) * count / (count - 1.0)


def autocorrelation_time(residuals: Array) -> float:
    """1 + 2 Σ ρ_l up to the first that is not positive, in samples.

    Residuals of a pendulum swing with it. The sum over whole swings would cancel, and call them as
    good as independent.

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
    ended = shape <= 0.0
    last = int(ended.argmax()) if ended.any() else n
    return float(2.0 * shape[:last].sum() / shape[0] - 1.0)
