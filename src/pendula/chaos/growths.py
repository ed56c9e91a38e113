"""How the variations of motions grow, as exponents are worked out from, with standard errors."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from pendula.chaos.variations import Asked, first_variations
from pendula.chaos.verdict import falls_slowly, standard_error_of_mean

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from pendula._progress import Progress
    from pendula._types import Array
    from pendula.chaos.variations import VariedRuns


@dataclass(frozen=True)
class Plan:
    """How exponents are worked out.

    Attributes:
        count: of exponents.
        tangent: the first variation, or k of them; None: the usual ones.
        transient: time at the start that is left out [s].
        threads: of the runs.
    """

    count: int
    tangent: ArrayLike | None
    transient: float
    threads: object

    def outputs(self, t0: float, times: Array) -> Array:
        """Times (m,), and before them the end of the transient, where there is one [s]."""
        import numpy as np

        return np.concatenate([[t0 + self.transient], times]) if self.transient else times

    def growth(self, asked: Asked, progress: Progress) -> tuple[Array, Array, VariedRuns]:
        """Ln of the growths since the transient, (n, m, k), and each mean MEGNO, (n,)."""
        import numpy as np

        given = first_variations(asked.system, self.tangent, self.count, "tangent")
        if self.count == 1:
            runs = asked.runs(given, "megno", self.threads, progress)
            assert runs.integrals is not None
            mean = runs.integrals[:, -1, 1] / (asked.t[-1] - asked.t0)
        else:
            d = len(asked.system.components)
            whole = np.linalg.qr(np.concatenate([given, np.eye(d)]).T)[
                0
            ].T  # the first span the same
            runs = asked.runs(whole, "orthogonal", self.threads, progress)
            mean = np.full(len(asked.starts), np.nan)
        growth = runs.growth[..., : self.count]
        if self.transient:
            growth = growth[:, 1:] - growth[:, :1]
        return growth, mean, runs


def standard_errors(growth: Array, length: float) -> Array:
    """Standard errors of exponents [1/s].

    Args:
        growth: ln of the growths at even times, (n, m, k).
        length: up to the last of them [s].

    Returns:
        (n, k); NaN where the run is too short.
    """
    import numpy as np

    rates = _rates(growth, length)
    return np.array([[standard_error_of_mean(each) for each in row.T] for row in rates])


def errors_that_fall_slowly(growth: Array, length: float) -> Array:
    """Whether the error of each exponent falls more slowly than 1/√T by its run, (n, k)."""
    import numpy as np

    rates = _rates(growth, length)
    return np.array([[falls_slowly(each) for each in row.T] for row in rates])


def _rates(growth: Array, length: float) -> Array:
    """Mean rates of growth between even times, (n, m, k) [1/s]."""
    import numpy as np

    rates: Array = np.diff(growth, axis=1, prepend=0.0) / (length / growth.shape[1])
    return rates
