"""Uncertainties on request: by blocks of residuals drawn again, and by profiles of the sum."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

from pendula.measured.errors import correlation_of
from pendula.measured.least_squares import Search, least_squares
from pendula.measured.problem import Optimum, Problem, Sampled, minimise

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np

    from pendula._types import Array
    from pendula.measured.errors import Errors

_DRAWS = 100
_BLOCK = 5.0  # autocorrelation times that a block is long
_PRECISE = Search(1e-5)
_FAR = 2.0  # standard errors at which a profile is taken
_TRIES = 3


def with_other_errors(
    problem: Problem, best: Optimum, errors: Errors, kind: str, seed: int
) -> Errors:
    """The errors with those of another kind as the ones to be believed.

    Args:
        problem: that was solved.
        best: its optimum.
        errors: by the noise's autocorrelation.
        kind: "profile", "bootstrap", or "corrected": the errors as they are.
        seed: of the bootstrap.
    """
    import numpy as np

    if kind == "corrected":
        return errors
    if kind == "bootstrap":
        covariance = np.atleast_2d(np.cov(_drawn(problem, best, errors, seed).T))
    else:
        widths = _profiles(problem, best, errors)
        ratio = widths / np.maximum(errors.standard, 1e-300)
        covariance = errors.covariance * np.outer(ratio, ratio)
    standard = np.sqrt(np.maximum(np.diagonal(covariance), 0.0))
    kinds = {**errors.kinds, kind: standard}
    correlation = correlation_of(covariance)
    return replace(
        errors, covariance=covariance, standard=standard, kinds=kinds, correlation=correlation
    )


def _drawn(problem: Problem, best: Optimum, errors: Errors, seed: int) -> Array:
    """Optima of recordings made of the fit and blocks of residuals (Künsch 1989), (draws, k)."""
    import numpy as np

    random = np.random.default_rng(seed)
    fitted = problem.predicted(best.x)
    lengths = iter([max(round(_BLOCK * tau), 1) for tau in errors.times])
    blocks = [[next(lengths) for _ in each.values.T] for each in problem.recordings]
    found = []
    for _ in range(_DRAWS):
        parts = zip(problem.recordings, fitted, blocks, strict=True)
        again = problem.of([_again(each, made, long, random) for each, made, long in parts])
        found.append(minimise(again, best.x).x)
    return np.array(found)


def _again(
    recording: Sampled, fitted: Array, lengths: list[int], random: np.random.Generator
) -> Sampled:
    """A recording of the fitted motion with residuals in blocks of these lengths, drawn again."""
    import numpy as np

    values = recording.values.copy()
    for j, (there, length) in enumerate(zip(recording.there.T, lengths, strict=True)):
        residuals = (recording.values - fitted)[there, j]
        n, long = len(residuals), min(length, len(residuals))
        begins = random.integers(0, n - long + 1, -(-n // long))
        order = (begins[:, np.newaxis] + np.arange(long)).ravel()[:n]
        values[there, j] = fitted[there, j] + (residuals - residuals.mean())[order]
    return replace(recording, values=values)


def _profiles(problem: Problem, best: Optimum, errors: Errors) -> Array:
    """Standard errors from how the sum of squares grows when each parameter is held, (k,).

    The sum is compared with what it is at the optimum, by the ratio of the believed to the plain
    variance: so correlated residuals count as what they are worth.
    """
    import numpy as np

    samples = sum(int(each.there.sum()) for each in problem.recordings)
    lower, _ = problem.bounds()
    widths = []
    for j in range(len(best.x)):
        worth = (errors.standard[j] / max(errors.plain[j], 1e-300)) ** 2
        unit = best.rms**2 * samples / max(samples - len(best.x), 1) * worth
        sides = []
        for sign in (-1.0, 1.0):
            step = _FAR * errors.standard[j]
            for _ in range(_TRIES):
                value = best.x[j] + sign * step
                if value <= lower[j]:
                    break
                held = _Held(problem, j, value).least(np.delete(best.x, j))
                growth = (held**2 - best.rms**2) * samples / unit
                step *= _FAR / math.sqrt(max(growth, 0.1))
            else:
                sides.append(step / _FAR)
        widths.append(float(np.mean(sides)) if sides else float(errors.standard[j]))
    return np.array(widths)


class _Held:
    """A problem with one of its parameters held."""

    def __init__(self, problem: Problem, j: int, value: float) -> None:
        self.problem, self.j, self.value = problem, j, value

    def whole(self, x: Array) -> Array:
        """All parameters."""
        import numpy as np

        return np.insert(x, self.j, self.value)

    def residuals(self, x: Array) -> Array:
        """Of the problem."""
        return self.problem.residuals(self.whole(x))

    def jacobian(self, x: Array) -> Array:
        """By the others."""
        import numpy as np

        return np.delete(self.problem.jacobian(self.whole(x)), self.j, axis=1)

    def blocks(self) -> Sequence[tuple[slice, Sequence[int]]]:
        """All of them as one."""
        return [(slice(None), range(len(self.problem.names) - 1))]

    def least(self, x: Array) -> float:
        """Root mean square of the residuals at the optimum."""
        import numpy as np

        lower, upper = (np.delete(each, self.j) for each in self.problem.bounds())
        _, cost = least_squares(self, x, lower, upper, _PRECISE)
        return math.sqrt(cost / len(self.residuals(x)))
