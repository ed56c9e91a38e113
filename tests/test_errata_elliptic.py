"""Errata of the elliptic solution, (18) to (27): the printed form is wrong, the correct one right.

Each test derives the truth anew, and names both forms as the page prints them, so that a page
which swapped or changed them fails too.
"""

import math
from collections.abc import Callable, Sequence
from fractions import Fraction
from typing import Any

import mpmath as mp
import sympy as sp

from pendula.study.errata import errata

ROWS = {row.id: row for row in errata()}
TAU = 2 * math.pi
W_N, THETA_0 = 1.3, 2.2  # a release from rest at 126°, far from small angles
K = math.sin(THETA_0 / 2)

k, x, phi = sp.symbols("k x phi", positive=True)


def forms(row_id: str, meaning: dict[str, Any]) -> tuple[Any, Any]:
    """Return what the printed and the correct text of a row mean."""
    return meaning[ROWS[row_id].printed["en"]], meaning[ROWS[row_id].correct["en"]]


def show_by_algebra(row_id: str, differences: dict[str, Sequence[sp.Expr]]) -> None:
    """Each difference from the truth: none of the printed ones is zero, all correct ones are."""
    printed, correct = forms(row_id, differences)
    for difference in printed:
        symbols = sorted(difference.free_symbols, key=str)
        point = {symbol: sp.Rational(3 + 2 * i, 11) for i, symbol in enumerate(symbols)}
        assert abs(difference.subs(point).evalf()) > 1e-6
    for difference in correct:
        assert sp.simplify(difference) == 0


def show_by_numbers(row_id: str, errors: dict[str, Sequence[Any]]) -> None:
    """Errors against the truth: the largest printed one is plain, the correct ones are nil."""
    printed, correct = forms(row_id, errors)
    assert max(abs(error) for error in printed) > 1e-2
    assert max(abs(error) for error in correct) < 1e-10


def test_eq_18_after() -> None:
    angle = sp.asin(x)  # x stands for the paper's t = sin θ
    show_by_algebra(
        "eq-18-after",
        {
            "dθ = (1 − sin² θ)^(1/2) dt": [angle.diff(x) - sp.sqrt(1 - sp.sin(angle) ** 2)],
            "dθ = (1 − t²)^(−1/2) dt": [angle.diff(x) - 1 / sp.sqrt(1 - x**2)],
        },
    )


def substitution() -> tuple[sp.Expr, sp.Expr]:
    """Return dθ/dφ of sin(θ/2) = k sin φ, and (dφ/dz)² from (19) with z = ωₙt."""
    theta = 2 * sp.asin(k * sp.sin(phi))
    slope = theta.diff(phi)
    return slope, 4 * (k**2 - sp.sin(theta / 2) ** 2) / slope**2


def test_eq_20() -> None:
    slope, rate_squared = substitution()
    root, cos = sp.sqrt(1 - k**2 * sp.sin(phi) ** 2), sp.cos(phi)
    left = cos**2 / root**2 * rate_squared
    sin_half = k * sp.sin(phi)
    show_by_algebra(
        "eq-20",
        {
            "dθ = 2k cos φ (1 − k² sin² φ)^(1/2) dφ; "
            "cos² φ (1 − k² sin² φ)^(−1) (∂zφ)² = 1 − sin²(θ/2)": [
                slope - 2 * k * cos * root,
                left - (1 - sin_half**2),
            ],
            "dθ = 2k cos φ (1 − k² sin² φ)^(−1/2) dφ; "
            "cos² φ (1 − k² sin² φ)^(−1) (∂zφ)² = cos² φ": [
                slope - 2 * k * cos / root,
                left - cos**2,
            ],
        },
    )


def test_eq_20_line_5() -> None:
    _, rate_squared = substitution()
    inside = 1 - k**2 * sp.sin(phi) ** 2
    show_by_algebra(
        "eq-20-line-5",
        {
            "(∂zφ)² = (1 − k² sin² φ)^(1/2)": [rate_squared - sp.sqrt(inside)],
            "(∂zφ)² = 1 − k² sin² φ": [rate_squared - inside],
        },
    )


def elliptic_integral(angle: Any, modulus: Any) -> Any:
    """Return F(φ, k) by quadrature of its definition; (18) is the case φ = τ/4."""
    return mp.quad(lambda a: 1 / mp.sqrt(1 - (modulus * mp.sin(a)) ** 2), [0, angle])


def time_of_fall(angle: float) -> Any:
    """Return ωₙt from rest at θ0 down to an angle, by quadrature of dt = dθ/θ̇, (16)."""

    def slowness(a: Any) -> Any:
        # k² − sin²(θ/2) as a product, which loses no digits near θ0.
        return 1 / (2 * mp.sqrt(mp.sin((THETA_0 - a) / 2) * mp.sin((THETA_0 + a) / 2)))

    with mp.workdps(30):  # the end point is singular
        return mp.quad(slowness, [angle, THETA_0])


def test_eq_20_after() -> None:
    whole = elliptic_integral(TAU / 4, K)
    printed, correct = [], []
    for angle in (0.2, 1.1, 1.9):
        y, truth = mp.sin(angle / 2) / K, time_of_fall(angle)
        printed.append(whole - elliptic_integral(y, K) - truth)
        correct.append(whole - elliptic_integral(mp.asin(y), K) - truth)
    show_by_numbers(
        "eq-20-after",
        {"ωₙt = K(k) − F(y, k)": printed, "ωₙt = K(k) − F(arcsin y, k)": correct},
    )


def released(modulus: float) -> Callable[[Any], Any]:
    """Return θ(t) of (21), K and sn taking the given modulus."""
    quarter = elliptic_integral(TAU / 4, modulus)

    def angle(time: Any) -> Any:
        return 2 * mp.asin(K * mp.ellipfun("sn", quarter - W_N * time, k=modulus))

    return angle


def residuals(angle: Callable[[Any], Any]) -> list[Any]:
    """Return θ̈ + ωₙ² sin θ, (12), at some times, and how far the start is off θ0."""
    times = (0.3, 1.0, 2.5)
    motion = [mp.diff(angle, time, 2) + W_N**2 * mp.sin(angle(time)) for time in times]
    return [*motion, angle(0) - THETA_0]


def test_eq_21() -> None:
    # The same letters as in (18), where K(k) takes the modulus.
    show_by_numbers(
        "eq-21",
        {
            "θ = 2 arcsin(sin(θ₀/2) sn[K(sin²(θ₀/2)) − ωₙt, sin²(θ₀/2)])": residuals(
                released(K**2)
            ),
            "θ = 2 arcsin(k sn[K(k) − ωₙt, k]), k = sin(θ₀/2)": residuals(released(K)),
        },
    )

    # The trap: a library that takes the parameter m = k² makes the print right.
    def by_parameter(time: Any) -> Any:
        return 2 * mp.asin(K * mp.ellipfun("sn", mp.ellipk(K**2) - W_N * time, m=K**2))

    assert max(map(abs, residuals(by_parameter))) < 1e-10


def test_eq_21_velocity() -> None:
    angle, quarter = released(K), elliptic_integral(TAU / 4, K)
    printed, correct = [], []
    for time in (0.3, 1.0, 2.5):
        truth = mp.diff(angle, time)
        cn, dn = (mp.ellipfun(name, quarter - W_N * time, k=K) for name in ("cn", "dn"))
        long_form = -2 * W_N * mp.sec(angle(time) / 2) * cn * dn
        printed.append(long_form - truth)
        correct += [K * long_form - truth, -2 * W_N * K * cn - truth]
    show_by_numbers(
        "eq-21-velocity",
        {
            "θ̇ = −2ωₙ sec(θ/2) cn[K(k) − ωₙt, k] dn[K(k) − ωₙt, k]": printed,
            "θ̇ = −2ωₙk sec(θ/2) cn[K(k) − ωₙt, k] dn[K(k) − ωₙt, k]"
            " = −2ωₙk cn[K(k) − ωₙt, k]": correct,
        },
    )


def odd_product(n: int) -> int:
    """Return (2n − 1)!! = 1·3·5…(2n − 1) by its definition."""
    return math.prod(range(1, 2 * n, 2))


def test_eq_22() -> None:
    printed, correct = [], []
    for n in range(6):
        derivative = ((1 - x) ** sp.Rational(-1, 2)).diff(x, n)
        factor = sp.Rational(odd_product(n), 2**n)
        printed.append(derivative - factor * (1 - x) ** sp.Rational(-(2 * n - 1), 2))
        correct.append(derivative - factor * (1 - x) ** sp.Rational(-(2 * n + 1), 2))
    show_by_algebra(
        "eq-22",
        {
            "fⁿ(x) = (2n − 1)!!/2ⁿ · (1 − x)^(−(2n − 1)/2)": printed,
            "f⁽ⁿ⁾(x) = (2n − 1)!!/2ⁿ · (1 − x)^(−(2n + 1)/2)": correct,
        },
    )
    # The series needs x = 0 only, where the misprint does no harm: so (23) is right.
    assert [difference.subs(x, 0) for difference in printed] == [0] * 6


def test_eq_24() -> None:
    half, printed, correct = sp.Rational(1, 2), [], []
    for n in range(5):
        factor = sp.Rational(odd_product(n), 2**n * math.factorial(n)) * k ** (2 * n)
        truth = factor * sp.integrate(sp.sin(phi) ** (2 * n), (phi, 0, sp.pi / 2))  # (23)
        beta = sp.gamma(n + half) * sp.gamma(half) / sp.gamma(n + 1)
        printed.append(factor * beta - truth)
        correct.append(factor * beta / 2 - truth)
    show_by_algebra(
        "eq-24",
        {
            "K(k) = Σ (2n − 1)!!/(2ⁿ n!) · k²ⁿ · Γ(n + ½) Γ(½)/Γ(n + 1)": printed,
            "K(k) = Σ (2n − 1)!!/(2ⁿ n!) · k²ⁿ · ½ Γ(n + ½) Γ(½)/Γ(n + 1)": correct,
        },
    )


def test_eq_25_after() -> None:
    printed, correct = [], []
    for n in range(9):
        below = 2**n * math.factorial(n)
        even_product = math.prod(range(2, 2 * n + 1, 2))  # (2n)!!
        printed.append(Fraction(even_product, below) - odd_product(n))
        correct.append(Fraction(math.factorial(2 * n), below) - odd_product(n))
    show_by_numbers(
        "eq-25-after",
        {"(2n − 1)!! = (2n)!!/(2ⁿ n!)": printed, "(2n − 1)!! = (2n)!/(2ⁿ n!)": correct},
    )


def test_eq_27() -> None:
    period = 4 * time_of_fall(0) / W_N
    coefficients = (math.comb(2 * n, n) / 4**n for n in range(300))
    series = TAU * sum((a * K**n) ** 2 for n, a in enumerate(coefficients))
    w_0 = 0  # the release from rest of (14); the form is multiplied up, so 0 does not divide
    show_by_numbers(
        "eq-27",
        {
            "T = (τ/ω₀) Σ [(2n)!/(2²ⁿ (n!)²)]² k²ⁿ": [period * w_0 - series],
            "T = (τ/ωₙ) Σ [(2n)!/(2²ⁿ (n!)²)]² k²ⁿ": [period * W_N - series],
        },
    )
