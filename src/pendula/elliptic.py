"""Elliptic integrals and Jacobi elliptic functions of real arguments.

k is always the modulus, k ≥ 0; the parameter m = k² never appears. Instead of k every function
takes, by name, the complementary modulus kc = √(1 − k²), 0 ≤ kc ≤ 1, which keeps the digits near
k = 1. Arguments broadcast against each other; NaN gives NaN. The error bounds are in
docs/en/exact.md.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from pendula import _engine
from pendula._checks import broadcast_shape, numbers_array, whole_number
from pendula._messages import ArgumentError

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import ArrayLike

    from pendula._types import Array


__all__ = ["E", "F", "JacobiValues", "K", "K_series", "am", "sncndn"]


class JacobiValues(NamedTuple):
    """The three Jacobi elliptic functions."""

    sn: Any
    cn: Any
    dn: Any


def K(k: ArrayLike | None = None, *, kc: ArrayLike | None = None) -> Any:
    """Complete elliptic integral of the first kind, by the arithmetic-geometric mean (DLMF 19.8.5).

    Args:
        k: modulus, 0 ≤ k ≤ 1, any shape.
        kc: complementary modulus, instead of k.

    Returns:
        A float or an array of the argument's shape; infinite for k = 1.

    Raises:
        ValueError: for a modulus outside [0, 1], or for neither or both of k and kc.
    """
    return _over(_engine.elliptic_K, _modulus(k, kc, 1.0))


def E(k: ArrayLike | None = None, *, kc: ArrayLike | None = None) -> Any:
    """Complete elliptic integral of the second kind, by the means' differences (DLMF 19.8.6).

    Arguments, returned shape and errors as for `K`; 1 for k = 1.
    """
    return _over(_engine.elliptic_E, _modulus(k, kc, 1.0))


def F(phi: ArrayLike, k: ArrayLike | None = None, *, kc: ArrayLike | None = None) -> Any:
    """Incomplete elliptic integral of the first kind, by Carlson's R_F (DLMF 19.25.5).

    Args:
        phi: amplitude, any real number [rad]; for k > 1 within ±arcsin(1/k), or beyond by no more
            than an arcsine of doubles may be, which gives F there.
        k: modulus, k ≥ 0.
        kc: complementary modulus, instead of k.

    Returns:
        A float or an array of the broadcast shape; infinite for k = 1 from phi = π/2 on.

    Raises:
        ValueError: for a negative modulus, kc outside [0, 1], neither or both of them, or an
            amplitude where the integral is not real.
    """
    import numpy as np

    modulus, amplitude = _modulus(k, kc, math.inf), numbers_array("phi", phi, "rad")
    result = _over(_engine.elliptic_F, modulus, phi=amplitude)
    angles, moduli = np.broadcast_arrays(amplitude, modulus.values)
    lost = np.isnan(result) & ~np.isnan(angles) & ~np.isnan(moduli)
    if lost.any():
        result = np.where(lost, _at_limit(angles, moduli), result)
        result = result if result.ndim else float(result)
    complex_ones = np.isnan(result) & lost
    if complex_ones.any():
        where = int(complex_ones.argmax())
        raise ArgumentError(
            "phi",
            "must, for k > 1, lie within [-pi/2, pi/2] and k |sin phi| not above 1, where F is "
            "real; got {value} for {text}",
            value=float(angles.flat[where]),
            text=f"{modulus.name} = {float(moduli.flat[where])!r}",
        )
    return result


def am(u: ArrayLike, k: ArrayLike | None = None, *, kc: ArrayLike | None = None) -> Any:
    """Jacobi's amplitude, the inverse of F, not wrapped (DLMF 22.16.1) [rad].

    For k > 1 it swings between ± arcsin(1/k). Arguments and errors as for `sncndn`.
    """
    return _jacobi(u, k, kc)[0]


def sncndn(
    u: ArrayLike, k: ArrayLike | None = None, *, kc: ArrayLike | None = None
) -> JacobiValues:
    """The Jacobi elliptic functions sn, cn and dn, by theta functions (DLMF 22.2, 22.17).

    Args:
        u: argument, up to 2^200 half periods 2 K in size, each of its digits taken as given.
        k: modulus, k ≥ 0.
        kc: complementary modulus, instead of k.

    Returns:
        Three floats, or arrays of the broadcast shape.

    Raises:
        ValueError: for a negative modulus, kc outside [0, 1], neither or both of them, or an
            argument too large for its phase to be known.
    """
    return JacobiValues(*_jacobi(u, k, kc)[1:])


def K_series(k: ArrayLike | None = None, terms: int = 0, *, kc: ArrayLike | None = None) -> Any:
    """The first `terms` terms of the power series of K, each from the one before (DLMF 19.5.1).

    Herrera et al. (2024), eq. 26. Slow as k → 1: use `K` to compute.

    Args:
        k: modulus, any shape.
        terms: how many, from 1 to 10^9; the sum ends before where a term no longer changes it.
        kc: complementary modulus, instead of k.

    Raises:
        ValueError: as for `K`, or for another number of terms.
    """
    count = whole_number("terms", terms, 10**9)

    def series(moduli: Array, complement: bool) -> Array:
        return _engine.elliptic_K_series(moduli, complement, terms=count)

    return _over(series, _modulus(k, kc, 1.0))


def _at_limit(phi: Array, k: Array) -> Array:
    """F where a modulus k > 1 has its largest amplitude, K(1/k)/k (DLMF 19.7.3); NaN beyond.

    An amplitude is taken for the limit, arcsin(1/k), up to where the arcsine of doubles may lie:
    half an ulp of 1/k, which the slope tan(limit) of the arcsine multiplies, and an ulp of its
    own; both twice.
    """
    import numpy as np

    known = np.where(k > 1.0, k, np.nan)
    beyond = np.sqrt(known - 1.0) * np.sqrt(known + 1.0)
    limit = np.arctan2(1.0, beyond)
    rounding = 2.0 * (2.0**-53 / beyond + np.spacing(limit))
    within = np.abs(phi) <= limit + rounding
    moduli = np.where(within, beyond / known, 1.0)
    complete = _engine.elliptic_K(np.ascontiguousarray(moduli).ravel(), True).reshape(k.shape)
    return np.where(within, np.copysign(complete / known, phi), np.nan)


class _Modulus(NamedTuple):
    name: str
    values: Array


def _modulus(k: ArrayLike | None, kc: ArrayLike | None, largest: float) -> _Modulus:
    """The modulus that is given, checked."""
    import numpy as np

    if (k is None) == (kc is None):
        raise ArgumentError(
            "", "give the modulus <k> or the complementary modulus kc=, one of the two"
        )
    if k is not None:
        modulus, most = _Modulus("k", numbers_array("k", k)), largest
    else:
        modulus, most = _Modulus("kc", numbers_array("kc", cast("ArrayLike", kc))), 1.0
    outside = (modulus.values < 0.0) | (modulus.values > most) | np.isinf(modulus.values)
    if outside.any():
        value = float(modulus.values.flat[int(outside.argmax())])
        rule = f"lie within [0, {most:g}]" if most < math.inf else "be finite and not negative"
        raise ArgumentError(
            modulus.name, f"must {rule}, got {{value}} (modulus, not m = k²)", value=value
        )
    return modulus


def _jacobi(u: ArrayLike, k: ArrayLike | None, kc: ArrayLike | None) -> Any:
    import numpy as np

    modulus = _modulus(k, kc, math.inf)
    argument = numbers_array("u", u)
    result = _over(_engine.jacobi, modulus, u=argument)
    arguments, moduli = np.broadcast_arrays(argument, modulus.values)
    lost = np.isnan(result[0]) & ~np.isnan(arguments) & ~np.isnan(moduli)
    if lost.any():
        raise ArgumentError(
            "u",
            "must be at most 2^200 half periods in size; got {value}",
            value=float(arguments.flat[int(lost.argmax())]),
        )
    return result


def _over(function: Callable[..., Any], modulus: _Modulus, **arguments: Array) -> Any:
    """Broadcast, call the core on flat arrays, and shape the result; floats for scalars."""
    import numpy as np

    given = {**arguments, modulus.name: modulus.values}
    shape = broadcast_shape(**{name: each.shape for name, each in given.items()})
    flat = (np.ascontiguousarray(np.broadcast_to(each, shape)).ravel() for each in given.values())
    result = function(*flat, modulus.name == "kc")

    def shaped(values: Array) -> Any:
        return values.reshape(shape) if shape else float(values[0])

    return tuple(map(shaped, result)) if isinstance(result, tuple) else shaped(result)
