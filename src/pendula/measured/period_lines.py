"""The two laws that a table of periods follows, as weighted straight lines."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from pendula.measured.period_corrections import CORRECTIONS, amplitude_excess

if TYPE_CHECKING:
    from collections.abc import Callable, Collection

    from pendula._types import Array

_PASSES = 20  # the weights hold the line's slope; they settle in a few


class Table(NamedTuple):
    """Measured periods with what else is known.

    Attributes:
        period: (n,) [s].
        known: of the apparatus and the swings by name; see `Correction`.
        timing: standard deviations of the periods, (n,) [s], or all 1.
        length_error: of each length [m].
        amplitude_error: of each amplitude [rad].
    """

    period: Array
    known: dict[str, Any]
    timing: Array
    length_error: float
    amplitude_error: float


class Line(NamedTuple):
    """A law fitted to a table.

    Attributes:
        values: of its parameters, (k,).
        covariance: by the errors of the table, (k, k).
        measured: periods, (n,) [s].
        fitted: periods, (n,) [s].
        errors: with which the fitted periods are compared: timing, length, amplitude, (n,) [s].
        freedom: rows less parameters.
    """

    values: Array
    covariance: Array
    measured: Array
    fitted: Array
    errors: Array
    freedom: int


def by_length(table: Table, corrections: Collection[str]) -> Line:
    """T² = F (4π²/g) (L + δ), F of the corrections: g, and δ where "offset" is one of them."""
    import numpy as np

    length, factor = table.known["length"], _factor(table, corrections)
    offset = "offset" in corrections
    # scaled by the mean length, so that both columns are of one size
    scale = float(length.mean())
    columns = np.stack([length / scale, np.ones_like(length)][: 1 + offset], axis=-1)

    def variance(line: Array, fitted: Array) -> Array:
        timing = 2.0 * np.sqrt(np.maximum(fitted, 0.0) / factor) * table.timing
        by_ruler = line[0] / scale * table.length_error
        by_protractor = fitted * _swing_error(table, corrections)
        return np.asarray(timing**2 + by_ruler**2 + by_protractor**2)

    line, covariance, fitted, spread = _weighted(columns, table.period**2 / factor, variance)
    slope, constant = line[0] / scale, line[1] if offset else 0.0
    values = np.array([4.0 * math.pi**2 / slope, constant / slope])
    jacobian = np.array(
        [[-values[0] / line[0], 0.0], [-values[1] / line[0], 1.0 / slope]][: 1 + offset]
    )[:, : 1 + offset]
    periods = np.sqrt(np.maximum(fitted, 0.0) * factor)
    errors = np.sqrt(spread) * factor / (2.0 * periods)
    freedom = len(length) - 1 - offset
    return Line(
        values[: 1 + offset],
        jacobian @ covariance @ jacobian.T,
        table.period,
        periods,
        errors,
        freedom,
    )


def by_amplitude(table: Table, corrections: Collection[str]) -> Line:
    """T = √F T0 (1 + 16 a (2 K(k)/π − 1)): T0 and a, 1/16 for a pendulum; T0 alone without.

    2 K/π − 1 = θ0²/16 + …: a is the slope of T/T0 against θ0² of small swings, and 1/16 for every
    amplitude where the law holds.
    """
    import numpy as np

    law = "amplitude" in corrections
    root = np.sqrt(_factor(table, set(corrections) - {"amplitude"}))
    columns = np.ones((len(table.period), 1))
    if law:
        columns = np.column_stack([columns, 16.0 * amplitude_excess(table.known["amplitude"])])

    def variance(line: Array, _: Array) -> Array:
        by_protractor = np.zeros_like(table.period)
        if law and table.amplitude_error:
            by_protractor = line[1] * 16.0 * _excess_error(table)
        return (table.timing / root) ** 2 + by_protractor**2

    line, covariance, fitted, spread = _weighted(columns, table.period / root, variance)
    jacobian = np.eye(len(line))
    values = line.copy()
    if law:
        values[1] = line[1] / line[0]
        jacobian[1] = [-values[1] / line[0], 1.0 / line[0]]
    return Line(
        values,
        jacobian @ covariance @ jacobian.T,
        table.period,
        fitted * root,
        np.sqrt(spread) * root,
        len(table.period) - len(line),
    )


def _factor(table: Table, corrections: Collection[str]) -> Array:
    """The product of the corrections' factors of T², (n,)."""
    import numpy as np

    known = {**table.known, "period": table.period}
    factors = [CORRECTIONS[name].factor(known) for name in corrections if name != "offset"]
    product: Array = np.ones_like(table.period)
    for factor in factors:
        product = product * factor
    return product


def _swing_error(table: Table, corrections: Collection[str]) -> Array | float:
    """The relative error of T² by that of the amplitudes."""
    if "amplitude" not in corrections or not table.amplitude_error:
        return 0.0
    excess = amplitude_excess(table.known["amplitude"])
    found: Array = 2.0 * _excess_error(table) / (1.0 + excess)
    return found


def _excess_error(table: Table) -> Array:
    """The error of T/T0 − 1 by that of the amplitudes, (n,): half of what ± one of them makes."""
    import numpy as np

    amplitude, error = np.asarray(table.known["amplitude"]), table.amplitude_error
    above = amplitude_excess(np.minimum(amplitude + error, math.pi * (1 - 1e-9)))
    return (above - amplitude_excess(np.abs(amplitude - error))) / 2.0


def _weighted(
    columns: Array, measured: Array, variance: Callable[[Array, Array], Array]
) -> tuple[Array, Array, Array, Array]:
    """Least squares with weights that the line itself decides (Orear, Am. J. Phys. 50 (1982) 912).

    Args:
        columns: (n, k).
        measured: (n,).
        variance: of the measured, (n,), from the parameters and the fitted, so that a row that is
            too small by chance gets no larger weight.

    Returns:
        The parameters, their covariance, the fitted and the variance.
    """
    import numpy as np

    line = _least_squares(columns, measured)
    for _ in range(_PASSES):
        spread = variance(line, columns @ line)
        weights: Array = np.asarray(1.0 / np.sqrt(spread))
        before = line
        line = _least_squares(columns * weights[:, None], measured * weights)
        if np.allclose(line, before, rtol=1e-14, atol=0.0):
            break
    inverse = np.linalg.pinv(columns * weights[:, None])
    covariance: Array = np.asarray(inverse @ inverse.T)
    return line, covariance, np.asarray(columns @ line), spread


def _least_squares(columns: Array, measured: Array) -> Array:
    import numpy as np

    found: Array = np.asarray(np.linalg.lstsq(columns, measured, rcond=None)[0], dtype=np.float64)
    return found
