"""Uncertainties of fitted values that can be believed although the residuals are correlated."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

from pendula._checks import extra
from pendula.measured.least_squares import triangle
from pendula.measured.noise import (
    Noise,
    Series,
    autocorrelation_time,
    blocks,
    filtered,
    grid_places,
    noise_of,
)

if TYPE_CHECKING:
    from pendula._types import Array
    from pendula.measured.problem import Problem

_PROBABILITY = 0.9545  # of two standard errors to either side
_FEWEST, _MOST = 8, 25  # blocks
_BLOCK = 5.0  # autocorrelation times that a block is long, at least
_CHANCE = 0.001  # that blocks scatter so much by chance: below it they are believed
_PART = 1e-5  # of the largest: what a flat direction consists of
_FLAT = 1e-7  # of the largest singular value: a direction that the data do not tell


@dataclass(frozen=True, eq=False)
class Errors:
    """Uncertainties of a fit.

    Attributes:
        covariance: the one to be believed, (k, k).
        standard: its standard errors, (k,); infinite: the data do not tell it by itself.
        plain: as if the residuals were independent, (k,).
        kinds: by name: of the noise's autocorrelation, and of blocks, (k,) each.
        noises: of each column of each recording.
        times: integrated autocorrelation times of their residuals, in samples.
        effective: independent samples that carry as much.
        correlation: of the parameters, as if they had no bounds, (k, k).
        beyond: how far beyond the bounds that are active the optimum would be without them, (k,).
        structured: residuals scatter over blocks more than noise does.
        flat: directions (k,) in which the data tell nothing, in units of what each parameter does.
    """

    covariance: Array
    standard: Array
    plain: Array
    kinds: dict[str, Array]
    noises: list[Noise]
    times: list[float]
    effective: float
    correlation: Array
    beyond: Array
    structured: bool
    flat: list[Array]

    def untold(self, names: tuple[str, ...]) -> list[tuple[str, ...]]:
        """Names of what the data hold only together, a group for each flat direction."""
        return [
            tuple(n for n, d in zip(names, each, strict=True) if abs(d) > _PART * abs(each).max())
            for each in self.flat
        ]


def errors_of(problem: Problem, x: Array) -> Errors:
    """The uncertainties at the optimum.

    The covariance is (JᵀJ)⁻¹ Jᵀ V J (JᵀJ)⁻¹ with the covariance V of the noise (White,
    Econometrica 48 (1980) 817), which is estimated with a first-order autocorrelation. Each
    standard error is widened by Student's factor for the freedom that its own estimate has
    (Satterthwaite, Biometrics Bull. 2 (1946) 110), so that two of them hold the true value with a
    probability of 95 %. Where residuals have more structure, as when the model is not the truth,
    their sums over blocks of the record scatter more than such noise explains; then the blocks'
    errors, which are the larger, are taken.
    """
    import numpy as np

    series = _series(problem, x)
    jacobian = problem.jacobian(x)  # with the gaps between windows, which have no noise
    size = np.linalg.norm(jacobian, axis=0)
    size[size == 0.0] = 1.0
    _, singular, directions = np.linalg.svd(triangle(jacobian / size))
    good = singular > _FLAT * singular[0]
    inverse = (directions[good].T / singular[good] ** 2) @ directions[good] / np.outer(size, size)
    noises = [noise_of(each) for each in series]
    middle = sum(filtered(s, *n.varied()) for s, n in zip(series, noises, strict=True))
    covariance = inverse @ middle @ inverse
    modelled = np.sqrt(np.maximum(np.diagonal(covariance), 1e-300))
    modelled = modelled * _student(series, noises, inverse, modelled)
    times = [autocorrelation_time(each.residuals) for each in series]
    scattered, trusted = _of_blocks(series, times, inverse)
    least = np.maximum(modelled, 1e-300)
    factor = np.where(scattered > trusted * modelled, scattered / least, 1.0)
    standard = modelled * factor
    covariance = correlation_of(covariance) * np.outer(standard, standard)
    rest = np.concatenate([each.residuals for each in series])
    variance = float(np.sum(rest**2)) / max(len(rest) - len(x), 1)
    flat = list(directions[~good])
    untold = np.any([abs(each) > _PART * abs(each).max() for each in flat], axis=0)
    return Errors(
        covariance,
        np.where(untold, np.inf, standard),
        np.where(untold, np.inf, np.sqrt(variance * np.maximum(np.diagonal(inverse), 0.0))),
        {"autocorrelation": modelled, "blocks": scattered},
        noises,
        times,
        float(sum(len(s.residuals) / tau for s, tau in zip(series, times, strict=True))),
        correlation_of(covariance),
        -inverse @ (jacobian.T @ problem.residuals(x)),
        bool((factor > 1.001).any()),
        flat,
    )


def correlation_of(covariance: Array) -> Array:
    """Correlations, (k, k)."""
    import numpy as np

    scale = np.sqrt(np.maximum(np.diagonal(covariance), 1e-300))
    return np.asarray(covariance / np.outer(scale, scale))


def _series(problem: Problem, x: Array) -> list[Series]:
    """Residuals and derivatives of each column of each recording."""
    residuals, jacobian = problem.residuals(x), problem.jacobian(x)
    found, begin = [], 0
    for recording in problem.recordings:
        places = grid_places(recording.t)
        for column in recording.there.T:
            end = begin + int(column.sum())
            found.append(Series(residuals[begin:end], jacobian[begin:end], places[column]))
            begin = end
    return found


def _student(series: list[Series], noises: list[Noise], inverse: Array, modelled: Array) -> Array:
    """Student's factors by which standard errors are widened, (k,)."""
    import numpy as np

    special = extra("scipy.special", "fit")
    uncertain = np.zeros(len(modelled))
    for each, noise in zip(series, noises, strict=True):
        low, high = (filtered(each, *noise.varied(side)) for side in (-0.5, 0.5))
        spread = (inverse @ (high - low) @ inverse).diagonal()
        # of the logarithm of the standard error, by the noise's autocorrelation and its variance
        uncertain += (0.5 * spread / np.maximum(modelled**2, 1e-300)) ** 2 + 0.5 / noise.freedom
    freedom = np.maximum(0.5 / np.maximum(uncertain, 1e-12), 2.0)
    return np.asarray(special.stdtrit(freedom, 0.5 + 0.5 * _PROBABILITY) / 2.0)


def _of_blocks(series: list[Series], times: list[float], inverse: Array) -> tuple[Array, float]:
    """Standard errors (k,) of sums over blocks, and how far chance takes them beyond others."""
    import numpy as np

    special = extra("scipy.special", "fit")
    total, count = np.zeros_like(inverse), 0
    for each, tau in zip(series, times, strict=True):
        own = int(np.clip(len(each.residuals) / (_BLOCK * tau), _FEWEST, _MOST))
        own = min(own, len(each.residuals))
        total += blocks(each, own)
        count += own - 1
    scattered = np.sqrt(np.maximum(np.diagonal(inverse @ total @ inverse), 0.0))
    return scattered, math.sqrt(float(special.chdtri(count, _CHANCE)) / count)
