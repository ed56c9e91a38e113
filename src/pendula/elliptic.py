"""Elliptic integrals and Jacobi elliptic functions of real arguments.

k is always the modulus, k ≥ 0; the parameter m = k² never appears. Instead of k every function
takes, by name, the complementary modulus kc = √(1 − k²), 0 ≤ kc ≤ 1, which keeps the digits near
k = 1. Arguments broadcast against each other; NaN gives NaN. The error bounds are in
docs/en/exact.md.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

from pendula import _engine
from pendula._checks import whole_number
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
        phi: amplitude, any real number [rad]; for k > 1 within [-π/2, π/2], with k |sin phi| ≤ 1.
        k: modulus, k ≥ 0.
        kc: complementary modulus, instead of k.

    Returns:
        A float or an array of the broadcast shape; infinite for k = 1 from phi = π/2 on.

    Raises:
        ValueError: for a negative modulus, kc outside [0, 1], neither or both of them, or an
            amplitude where the integral is not real.
    """
    import numpy as np

    result = _over(_engine.elliptic_F, modulus := _modulus(k, kc, math.inf), phi)
    angles, moduli = np.broadcast_arrays(np.asarray(phi, dtype=np.float64), modulus.values)
    complex_ones = np.isnan(result) & ~np.isnan(angles) & ~np.isnan(moduli)
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
    name, given, most = ("k", k, largest) if kc is None else ("kc", kc, 1.0)
    modulus = _Modulus(name, np.asarray(given, dtype=np.float64))
    outside = (modulus.values < 0.0) | (modulus.values > most) | np.isinf(modulus.values)
    if outside.any():
        value = float(modulus.values.flat[int(outside.argmax())])
        rule = f"lie within [0, {most:g}]" if most < math.inf else "be finite and not negative"
        raise ArgumentError(name, f"must {rule}, got {{value}} (modulus, not m = k²)", value=value)
    return modulus


def _jacobi(u: ArrayLike, k: ArrayLike | None, kc: ArrayLike | None) -> Any:
    import numpy as np

    modulus = _modulus(k, kc, math.inf)
    result = _over(_engine.jacobi, modulus, u)
    arguments, moduli = np.broadcast_arrays(np.asarray(u, dtype=np.float64), modulus.values)
    lost = np.isnan(result[0]) & ~np.isnan(arguments) & ~np.isnan(moduli)
    if lost.any():
        raise ArgumentError(
            "u",
            "must be at most 2^200 half periods in size; got {value}",
            value=float(arguments.flat[int(lost.argmax())]),
        )
    return result


def _over(function: Callable[..., Any], modulus: _Modulus, *arguments: ArrayLike) -> Any:
    """Broadcast, call the core on flat arrays, and shape the result; floats for scalars."""
    import numpy as np

    given = [np.asarray(each, dtype=np.float64) for each in arguments]
    *given, moduli = np.broadcast_arrays(*given, modulus.values)
    flat = (np.ascontiguousarray(each).ravel() for each in (*given, moduli))
    result = function(*flat, modulus.name == "kc")

    def shaped(values: Array) -> Any:
        return values.reshape(moduli.shape) if moduli.ndim else float(values[0])

    return tuple(map(shaped, result)) if isinstance(result, tuple) else shaped(result)
