"""Elliptic integrals and Jacobi elliptic functions of real arguments.

k is always the modulus, 0 ≤ k ≤ 1; the parameter m = k² never appears. Instead of k every function
takes, by name, the complementary modulus kc = √(1 − k²), which keeps the digits near k = 1.
Arguments broadcast against each other; NaN gives NaN.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from pendula import _engine
from pendula._checks import whole_number

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

__all__ = ["E", "F", "JacobiValues", "K", "K_series", "am", "sncndn"]


class JacobiValues(NamedTuple):
    """The three Jacobi elliptic functions."""

    sn: Any
    cn: Any
    dn: Any


def K(k: ArrayLike | None = None, *, kc: ArrayLike | None = None) -> Any:
    """Complete elliptic integral of the first kind, by the arithmetic-geometric mean (DLMF 19.8.5).

    Args:
        k: modulus, any shape.
        kc: complementary modulus, instead of k.

    Returns:
        A float or an array of the argument's shape; infinite for k = 1.

    Raises:
        ValueError: for a modulus outside [0, 1], or for neither or both of k and kc.
    """
    return _over(_engine.elliptic_K, k, kc)


def E(k: ArrayLike | None = None, *, kc: ArrayLike | None = None) -> Any:
    """Complete elliptic integral of the second kind, E = 2 R_G(0, kc², 1) (DLMF 19.25.1, by Boost).

    Arguments, returned shape and errors as for `K`; 1 for k = 1.
    """
    return _over(_engine.elliptic_E, k, kc)


def F(phi: ArrayLike, k: ArrayLike | None = None, *, kc: ArrayLike | None = None) -> Any:
    """Incomplete elliptic integral of the first kind, by Carlson's R_F (DLMF 19.25.5, Boost).

    Args:
        phi: amplitude, any real number [rad].
        k: modulus.
        kc: complementary modulus, instead of k.

    Returns:
        A float or an array of the broadcast shape.

    Raises:
        ValueError: as for `K`.
    """
    return _over(_engine.elliptic_F, k, kc, phi)


def am(u: ArrayLike, k: ArrayLike | None = None, *, kc: ArrayLike | None = None) -> Any:
    """Jacobi's amplitude, the inverse of F, not wrapped (DLMF 22.16.1, 22.20(ii)) [rad].

    Arguments, returned shape and errors as for `F`.
    """
    return _over(_engine.jacobi, k, kc, u)[0]


def sncndn(
    u: ArrayLike, k: ArrayLike | None = None, *, kc: ArrayLike | None = None
) -> JacobiValues:
    """The Jacobi elliptic functions sn, cn and dn (DLMF 22.20(ii)).

    Arguments, shape of each value and errors as for `F`.
    """
    return JacobiValues(*_over(_engine.jacobi, k, kc, u)[1:])


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
    return _over(lambda modulus, _: _engine.elliptic_K_series(modulus, count), k, kc)


def _over(
    function: Callable[..., Any], k: ArrayLike | None, kc: ArrayLike | None, *arguments: ArrayLike
) -> Any:
    """Broadcast, call the core on flat arrays, and shape the result; floats for scalars."""
    import numpy as np

    given = [np.asarray(each, dtype=np.float64) for each in arguments]
    *given, modulus, complement = np.broadcast_arrays(*given, *_moduli(k, kc))
    result = function(
        *(np.ascontiguousarray(each).ravel() for each in (*given, modulus, complement))
    )

    def shaped(values: Array) -> Any:
        return values.reshape(modulus.shape) if modulus.ndim else float(values[0])

    return tuple(map(shaped, result)) if isinstance(result, tuple) else shaped(result)


def _moduli(k: ArrayLike | None, kc: ArrayLike | None) -> tuple[Array, Array]:
    """Both moduli from the one given; √((1 − k)(1 + k)) loses nothing where 1 − k cancels."""
    import numpy as np

    if (k is None) == (kc is None):
        raise ValueError("give the modulus k or the complementary modulus kc=, one of the two")
    name, given = ("k", k) if kc is None else ("kc", kc)
    modulus = np.asarray(given, dtype=np.float64)
    outside = (modulus < 0.0) | (modulus > 1.0)
    if outside.any():
        value = float(modulus[outside].ravel()[0]) if modulus.ndim else float(modulus)
        raise ValueError(f"{name} must lie within [0, 1], got {value!r} (modulus, not m = k²)")
    other = np.sqrt((1.0 - modulus) * (1.0 + modulus))
    return (modulus, other) if kc is None else (other, modulus)
