"""Motions and elliptic functions to any number of digits by mpmath, none of it from the core.

Landen's transformation over the arithmetic-geometric mean (DLMF 19.8, 22.20(ii)) with the
complementary modulus kc, never 1 − k². Doubles are taken as exact.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from mpmath import mp, mpf

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable


def settled(function: Callable[[], Iterable[Any]], dps: int, agreeing: int = 42) -> list[Any]:
    """Values that come out the same with twice the digits, or else with more and more of them."""
    while dps < 9000:
        with mp.workdps(dps):
            once = list(function())
        with mp.workdps(2 * dps):
            again = list(function())
        with mp.workdps(60):
            if all(map(lambda x, y: same(x, y, agreeing), once, again)):
                return again
        dps *= 2
    raise ArithmeticError("does not settle")


def same(x: Any, y: Any, digits: int) -> bool:
    """Whether two numbers agree; what is far below every double is zero."""
    tiny = mpf(10) ** -420
    if x == y or (abs(x) < tiny and abs(y) < tiny):
        return True
    return bool(abs(x - y) <= mpf(10) ** -digits * abs(y))


# ---- elliptic functions of the complementary modulus, 0 < kc <= 1 ----


class Means(NamedTuple):
    """The means from 1 and kc, and half their differences."""

    a: list[Any]
    b: list[Any]
    c: list[Any]


def means(kc: Any) -> Means:
    a, b, c = [mpf(1)], [mpf(kc)], [mpf(0)]
    while True:
        half = (a[-1] - b[-1]) / 2
        a, b, c = [*a, (a[-1] + b[-1]) / 2], [*b, mp.sqrt(a[-1] * b[-1])], [*c, half]
        if abs(half) < 64 * mp.eps * a[-1]:
            return Means(a, b, c)


def complete_K(kc: Any) -> Any:
    return mp.inf if kc == 0 else mp.pi / (2 * mp.agm(1, kc))


def complete_E(kc: Any) -> Any:
    if kc == 0:
        return mpf(1)
    a, _, c = means(kc)
    half_k2 = (1 - kc) * (1 + kc) / 2
    return (
        mp.pi
        / (2 * a[-1])
        * (1 - half_k2 - sum(2 ** (n - 1) * c[n] ** 2 for n in range(1, len(c))))
    )


def incomplete_F(phi: Any, kc: Any) -> Any:
    if phi == 0:
        return mpf(0)
    a, b, _ = means(kc)
    turns = mp.nint(phi / mp.pi)
    p = phi - turns * mp.pi
    for x, y in zip(a[:-1], b[:-1], strict=True):
        n = mp.nint(p / mp.pi)
        rest = p - n * mp.pi
        p += n * mp.pi + mp.atan2(y * mp.sin(rest), x * mp.cos(rest))
    return p / (mpf(2) ** (len(a) - 1) * a[-1]) + turns * mp.pi / a[-1]


def jacobi(u: Any, kc: Any) -> tuple[Any, Any, Any, Any]:
    """The functions am, which is not wrapped, sn, cn and dn."""
    a, b, c = means(kc)
    p = mpf(2) ** (len(a) - 1) * a[-1] * u
    for n in range(len(a) - 1, 0, -1):
        sine, cosine = mp.sin(p), mp.cos(p)
        p = (p + mp.atan2(c[n] * sine, mp.hypot(a[n] * cosine, b[n] * sine))) / 2
    sine, cosine = mp.sin(p), mp.cos(p)
    return p, sine, cosine, mp.hypot(cosine, kc * sine)


# ---- the same of a modulus given as k, also above 1, or as kc ----


def complement(k: Any = None, kc: Any = None) -> Any:
    return mpf(kc) if kc is not None else mp.sqrt((1 - mpf(k)) * (1 + mpf(k)))


def inverted(k: float) -> tuple[Any, Any]:
    """k above 1, and √(1 − 1/k²)."""
    return mpf(k), mp.sqrt((mpf(k) - 1) * (mpf(k) + 1)) / mpf(k)


def digits(k: float | None = None, kc: float | None = None) -> int:
    """To work with: a small complement costs twice its exponent."""
    with mp.workdps(60):
        small = mpf(1) if k is not None and k > 1 else complement(k, kc)
        return int(120 + 2.2 * (0 if small == 0 else max(0.0, -float(mp.log10(small)))))


def F_of(phi: Any, k: float | None = None, kc: float | None = None) -> Any:
    phi = mpf(phi)
    if k is not None and k > 1:
        stretch, q = inverted(k)
        sine = stretch * mp.sin(phi)
        return incomplete_F(mp.atan2(sine, mp.sqrt((1 - sine) * (1 + sine))), q) / stretch
    q = complement(k, kc)
    if q == 0:
        return mp.asinh(mp.tan(phi)) if abs(phi) < mp.pi / 2 else mp.sign(phi) * mp.inf
    return incomplete_F(phi, q)


def jacobi_of(u: Any, k: float | None = None, kc: float | None = None) -> tuple[Any, ...]:
    u = mpf(u)
    if k is not None and k > 1:  # DLMF 22.17.2-4; cn(u, k) = dn(ku, 1/k) > 0, so am = arcsin(sn)
        stretch, q = inverted(k)
        _, sine, dn, cn = jacobi(stretch * u, q)
        return mp.atan2(sine / stretch, cn), sine / stretch, cn, dn
    q = complement(k, kc)
    if q != 0:
        return jacobi(u, q)
    if abs(u) > 3000:  # sech is far below every double
        return mp.sign(u) * mp.pi / 2, mp.sign(u), mpf(0), mpf(0)
    return 2 * mp.atan(mp.tanh(u / 2)), mp.tanh(u), mp.sech(u), mp.sech(u)


# ---- pendulums ----


class Motion(NamedTuple):
    """A state, and what its errors are measured by."""

    theta: Any
    omega: Any
    omega_max: Any
    amplitude: Any


def simple(theta0: Any, omega0: Any, gravity: Any, length: Any, t: Any) -> Motion:
    """The simple pendulum, the time t after (theta0, omega0): DLMF 22.19(i)."""
    theta0, omega0, gravity, length, t = map(mpf, (theta0, omega0, gravity, length, t))
    wn = mp.sqrt(gravity / length)
    turns = 2 * mp.pi * mp.nint(theta0 / (2 * mp.pi))
    half, forwards = (theta0 - turns) / 2, mp.sign(omega0)
    a, b, c = mp.sin(half), omega0 / (2 * wn), mp.cos(half)
    if (
        theta0 == 0 and omega0 * omega0 * length == 4 * gravity
    ):  # exact: these are products of doubles
        angle = 4 * mp.atan(mp.tanh(forwards * wn * t / 2))
        return Motion(angle, 2 * forwards * wn * mp.sech(wn * t), 2 * wn, mp.pi)
    if a == 0 and b == 0:
        return Motion(turns, mpf(0), mpf(0), mpf(0))
    k, kc2 = mp.hypot(a, b), (c - b) * (c + b)
    if kc2 == 0:
        raise ArithmeticError("the separatrix")
    if kc2 > 0:
        kc = mp.sqrt(kc2)
        _, sn, cn, dn = jacobi(wn * t + incomplete_F(mp.atan2(a, b), kc), kc)
        angle = turns + 2 * mp.atan2(k * sn, dn)
        return Motion(angle, 2 * wn * k * cn, 2 * wn * k, 2 * mp.atan2(k, kc))
    q = mp.sqrt(-kc2) / k
    p, _, _, dn = jacobi(forwards * k * wn * t + incomplete_F(half, q), q)
    return Motion(turns + 2 * p, 2 * forwards * wn * k * dn, 2 * wn * k, mp.pi)


def period(theta0: Any, omega0: Any, gravity: Any, length: Any) -> Any:
    """Of a swing or of a turn."""
    wn = mp.sqrt(mpf(gravity) / mpf(length))
    c, b = mp.cos(mpf(theta0) / 2), mpf(omega0) / (2 * wn)
    k, kc2 = mp.hypot(mp.sin(mpf(theta0) / 2), b), (c - b) * (c + b)
    if kc2 >= 0:
        return 4 * complete_K(mp.sqrt(kc2)) / wn
    return 2 * complete_K(mp.sqrt(-kc2) / k) / (k * wn)


def linear(theta0: Any, omega0: Any, gravity: Any, length: Any, t: Any) -> Motion:
    """The linear pendulum."""
    theta0, omega0, t = map(mpf, (theta0, omega0, t))
    wn = mp.sqrt(mpf(gravity) / mpf(length))
    sine, cosine, largest = mp.sin(wn * t), mp.cos(wn * t), mp.hypot(theta0, omega0 / wn)
    angle, speed = theta0 * cosine + omega0 / wn * sine, omega0 * cosine - theta0 * wn * sine
    return Motion(angle, speed, wn * largest, largest)
