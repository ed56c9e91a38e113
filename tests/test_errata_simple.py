"""Errata of the simple pendulum, (4) to (15): the printed form is wrong, the correct one right.

Each test derives the truth anew, and names both forms as the page prints them, so that a page
which swapped or changed them fails too.
"""

from collections.abc import Sequence
from typing import Any

import sympy as sp

from pendula.study.errata import errata

ROWS = {row.id: row for row in errata()}
t, x, theta_0, w_n = sp.symbols("t x theta_0 w_n", positive=True)


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


def test_eq_04() -> None:
    m, g, length = sp.symbols("m g L", positive=True)
    theta = sp.Function("theta")(t)
    bob = length * sp.Matrix([sp.sin(theta), -sp.cos(theta)])
    truth = m * g * (bob[1] - bob[1].subs(theta, 0))
    printed, correct = m * g * (1 - sp.cos(theta)), m * g * length * (1 - sp.cos(theta))
    show_by_algebra(
        "eq-04",
        {
            "u = mg(1 − cos θ)": [(printed - truth).subs(theta, x)],
            "u = mgL(1 − cos θ)": [(correct - truth).subs(theta, x)],
        },
    )
    # Only the correct one leads on to (5): dE/dt = 0 gives θ̈ = −(g/L) sin θ.
    kinetic = m * bob.diff(t).dot(bob.diff(t)) / 2
    acceleration = sp.solve(sp.simplify((kinetic + correct).diff(t)), theta.diff(t, 2))[0]
    assert sp.simplify(acceleration + g / length * sp.sin(theta)) == 0


def test_eq_09() -> None:
    c1, c2 = sp.symbols("C1 C2", positive=True)
    cos, sin = sp.cos(w_n * t), sp.sin(w_n * t)
    velocity = (c1 * cos + c2 * sin).diff(t)
    show_by_algebra(
        "eq-09",
        {
            # Here ω is what (9) itself defines, the angular velocity.
            "ω = −C₁ω sin ωₙt + C₂ω cos ωₙt": [velocity - velocity * (-c1 * sin + c2 * cos)],
            "ω = −C₁ωₙ sin ωₙt + C₂ωₙ cos ωₙt": [velocity - w_n * (-c1 * sin + c2 * cos)],
        },
    )


def test_eq_15_before() -> None:
    right_side = 1 - 2 * sp.sin(x / 2) ** 2
    show_by_algebra(
        "eq-15-before",
        {
            "½ cos 2θ = 1 − 2 sin²(θ/2)": [sp.cos(2 * x) / 2 - right_side],
            "cos θ = 1 − 2 sin²(θ/2)": [(sp.cos(x) - right_side).rewrite(sp.exp)],
        },
    )


def test_eq_14() -> None:
    theta = sp.Function("theta")(t)
    first_integral = theta.diff(t) ** 2 - 2 * w_n**2 * sp.cos(theta)  # (13)
    motion = {theta.diff(t, 2): -(w_n**2) * sp.sin(theta)}
    assert sp.simplify(first_integral.diff(t).subs(motion)) == 0  # so λ is a constant
    start = first_integral.subs(theta.diff(t), 0).subs(theta, theta_0)
    show_by_algebra(
        "eq-14",
        {
            "−2ωₙ² cos θ = λ": [-2 * w_n**2 * sp.cos(x) - start],
            "−2ωₙ² cos θ₀ = λ": [-2 * w_n**2 * sp.cos(theta_0) - start],
        },
    )
