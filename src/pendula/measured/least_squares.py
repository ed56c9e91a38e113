"""Nonlinear least squares within bounds that a solution may lie on exactly."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

from pendula._checks import extra

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula._types import Array

# Damping of the first step: from afar it shortens the step; near the optimum it must not hold back
# the one direction in which two frictions are nearly collinear.
_FROM_AFAR, _NEAR = 1e-4, 1e-8
_LEAST_DAMPING = 1e-12
_LARGEST_DAMPING = 1e12
_ROWS = 256  # of a part of a tall matrix


class Search(NamedTuple):
    """How an optimum is looked for.

    Attributes:
        precision: relative change of the sum of squares at which it ends.
        most: steps at most.
        damping: of the first step.
    """

    precision: float
    most: int = 60
    damping: float = _NEAR


FINE = Search(1e-10)
CLOSE = Search(1e-3, 10)
# a start for another, from afar: of a model that is not the truth little is gained by more
ROUGH = Search(3e-2, 5, _FROM_AFAR)


class Residuals(Protocol):
    """What is to be made small."""

    def residuals(self, x: Array) -> Array:
        """(N,)."""

    def jacobian(self, x: Array) -> Array:
        """(N, k)."""

    def blocks(self) -> Sequence[tuple[slice, Sequence[int]]]:
        """Rows of the derivatives, and the columns in which they are not zero."""


def least_squares(
    of: Residuals,
    start: Array,
    lower: Array,
    upper: Array,
    search: Search,
    scale: float = 0.0,
) -> tuple[Array, float]:
    """Levenberg-Marquardt (Moré 1978), each step a bounded linear problem.

    Friction often ends at zero. Methods that keep inside the bounds only creep there, and those
    that hold a variable at its bound can stall when others are nearly collinear; here each step is
    the exact solution of the linear problem with its bounds (Stark & Parker, Comput. Stat. 10
    (1995) 129), by scipy.

    Args:
        of: residuals and their derivatives.
        start: within the bounds, (k,).
        lower: bounds, (k,).
        upper: likewise.
        search: how it is looked for.
        scale: residuals much beyond it count by their size, not its square (soft_l1); 0: none do.

    Returns:
        The solution (k,), and the sum that was made small.
    """
    import numpy as np

    precision, most, damping = search
    x = start
    rest = of.residuals(x)
    cost = _cost(rest, scale)
    size = np.zeros(len(x))
    for _ in range(most):
        weights = _weights(rest, scale)
        weighted = of.jacobian(x) * weights[:, np.newaxis]
        reduced, target = _reduced(weighted, rest * weights, of.blocks())
        size = np.maximum(size, np.linalg.norm(reduced, axis=0))
        size[size == 0.0] = 1.0
        before = cost
        while damping < _LARGEST_DAMPING:
            step = _step(reduced / size, target, damping, (lower - x) * size, (upper - x) * size)
            trial = np.clip(x + step / size, lower, upper)
            tried = of.residuals(trial)
            expected = np.sum(target**2) - np.sum((target + reduced @ (trial - x)) ** 2)
            new_cost = _cost(tried, scale)
            if new_cost < cost:
                gain = (cost - new_cost) / max(expected, 1e-300)
                damping = max(damping / (10.0 if gain > 0.5 else 1.0), _LEAST_DAMPING)
                x, rest, cost = trial, tried, new_cost
                break
            if expected <= precision * cost:
                return x, cost
            damping = max(10.0 * damping, _FROM_AFAR)
        if before - cost <= precision * cost:
            break
    return x, cost


def _cost(residuals: Array, scale: float) -> float:
    """The sum of squares, or of soft_l1's 2 s² (√(1 + r²/s²) − 1)."""
    import numpy as np

    if not scale:
        return float(np.sum(residuals**2))
    return float(2.0 * scale**2 * np.sum(np.sqrt(1.0 + (residuals / scale) ** 2) - 1.0))


def _weights(residuals: Array, scale: float) -> Array:
    """Square roots of the weights with which a sum of squares has the same gradient."""
    import numpy as np

    if not scale:
        return np.ones(len(residuals))
    return np.asarray((1.0 + (residuals / scale) ** 2) ** -0.25)


def _reduced(
    jacobian: Array, residuals: Array, blocks: Sequence[tuple[slice, Sequence[int]]]
) -> tuple[Array, Array]:
    """The same linear problem in k rows."""
    import numpy as np

    k = jacobian.shape[1]
    found = []
    for rows, columns in blocks:
        both = np.column_stack([jacobian[rows][:, columns], residuals[rows]])
        small = triangle(both)
        spread = np.zeros((len(small), k + 1))
        spread[:, [*columns, k]] = small
        found.append(spread)
    reduced = found[0] if len(found) == 1 else triangle(np.concatenate(found))
    return reduced[:, :k], reduced[:, k]


def triangle(matrix: Array) -> Array:
    """R of the QR decomposition of a tall matrix, by way of those of its parts.

    Each part is too small for LAPACK to share out, so the bits do not depend on threads, and
    nothing waits for them.
    """
    import numpy as np

    n, k = matrix.shape
    rows = max(_ROWS, 4 * k)
    parts = -(-n // rows)
    padded = np.zeros((parts * rows, k))
    padded[:n] = matrix
    stacked = np.array(np.linalg.qr(padded.reshape(parts, rows, k), mode="r"))
    if parts == 1:
        return np.asarray(stacked[0])
    return triangle(stacked.reshape(-1, k))


def _step(matrix: Array, target: Array, damping: float, lower: Array, upper: Array) -> Array:
    """δ within bounds that makes |matrix δ + target|² + damping |δ|² least."""
    import numpy as np

    k = matrix.shape[1]
    rows = np.concatenate([matrix, np.sqrt(damping) * np.eye(k)])
    wanted = np.concatenate([-target, np.zeros(k)])
    step = np.linalg.lstsq(rows, wanted, rcond=None)[0]
    if ((step >= lower) & (step <= upper)).all():
        return np.asarray(step)
    optimize = extra("scipy.optimize", "fit")
    return np.asarray(optimize.lsq_linear(rows, wanted, (lower, upper), "bvls").x)
