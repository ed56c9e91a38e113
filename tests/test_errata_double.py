"""Errata of the double pendulum, (29) to (50): the printed form is wrong, the correct one right.

The truth is the motion of two uniform rods, derived from the positions of their points by
integrals along the rods; (30) to (41) are not used. Each test names both forms as the page
prints them, so that a page which swapped or changed them fails too.
"""

from collections.abc import Sequence
from functools import cache
from typing import Any

import sympy as sp

from pendula.study.errata import errata

ROWS = {row.id: row for row in errata()}

m1, m2, l1, l2, g, s = sp.symbols("m1 m2 l1 l2 g s", positive=True)
# Angles, angular velocities and angular accelerations.
q1, q2, w1, w2, a1, a2 = sp.symbols("q1 q2 w1 w2 a1 a2", real=True)

cos12, sin12 = sp.cos(q1 - q2), sp.sin(q1 - q2)
HALF, THIRD = sp.Rational(1, 2), sp.Rational(1, 3)


def rate(quantity: Any) -> Any:
    """Return the time derivative of an expression or vector, by the chain rule."""
    return sum(
        (quantity.diff(of) * by for of, by in ((q1, w1), (q2, w2), (w1, a1), (w2, a2))),
        start=0 * quantity,
    )


# The point at distance s along each rod, from the pivot, y up; half-way it is (28).
along1, along2 = (sp.Matrix([sp.sin(angle), -sp.cos(angle)]) for angle in (q1, q2))
points = (s * along1, l1 * along1 + s * along2)
centres = (points[0].subs(s, l1 / 2), points[1].subs(s, l2 / 2))


@cache
def energies() -> tuple[sp.Expr, sp.Expr]:
    """Return kinetic and potential energy, both integrals over the points of the rods."""
    kinetic = potential = sp.Integer(0)
    for point, mass, length in zip(points, (m1, m2), (l1, l2), strict=True):
        speed_squared = sp.expand(rate(point).dot(rate(point)))
        kinetic += sp.integrate(mass / length * speed_squared / 2, (s, 0, length))
        potential += sp.integrate(mass / length * g * point[1], (s, 0, length))
    return kinetic, potential


def lagrangian() -> sp.Expr:
    kinetic, potential = energies()
    return kinetic - potential


def is_zero(expression: sp.Expr) -> bool:
    """Decide it exactly: with tan(q/2) for each angle it is a rational function."""
    tan1, tan2 = sp.symbols("tan1 tan2", real=True)
    rational = sp.expand_trig(expression)
    for angle, tan in ((q1, tan1), (q2, tan2)):
        sin, cos = 2 * tan / (1 + tan**2), (1 - tan**2) / (1 + tan**2)
        rational = rational.subs({sp.sin(angle): sin, sp.cos(angle): cos})
    return bool(sp.numer(sp.together(rational)).expand() == 0)


def is_plainly_not_zero(expression: sp.Expr) -> bool:
    """Evaluate it at one point without symmetry."""
    symbols = (m1, m2, l1, l2, g, q1, q2, w1, w2, a1, a2)
    point = {symbol: sp.Rational(3 + 2 * i, 7) for i, symbol in enumerate(symbols)}
    return bool(abs(expression.subs(point).evalf()) > 1e-3)


def show(row_id: str, differences: dict[str, Sequence[sp.Expr]]) -> None:
    """Each difference from the truth: some printed one is not zero, all correct ones are."""
    row = ROWS[row_id]
    assert any(is_plainly_not_zero(difference) for difference in differences[row.printed["en"]])
    assert all(is_zero(difference) for difference in differences[row.correct["en"]])


def test_eq_29() -> None:
    v1, v2 = map(rate, centres)

    def off(sign: int) -> list[sp.Expr]:
        return list(v2 - 2 * v1 - l2 / 2 * w2 * sp.Matrix([sp.cos(q2), sign * sp.sin(q2)]))

    show(
        "eq-29",
        {
            "v₂ = 2v₁ + (l₂/2) θ̇₂ (cos θ₂, −sin θ₂)": off(-1),
            "v₂ = 2v₁ + (l₂/2) θ̇₂ (cos θ₂, sin θ₂)": off(+1),
        },
    )


def test_eq_32() -> None:
    v2 = rate(centres[1])
    rest = l1**2 * w1**2 + l1 * w1 * l2 * w2 * cos12 - v2.dot(v2)
    show(
        "eq-32",
        {
            "v₂² = l₁²θ̇₁² + l₁θ̇₁l₂θ̇₂ cos(θ₁ − θ₂) + (l₂²/4) θ̇₂": [rest + l2**2 / 4 * w2],
            "v₂² = l₁²θ̇₁² + l₁θ̇₁l₂θ̇₂ cos(θ₁ − θ₂) + (l₂²/4) θ̇₂²": [rest + l2**2 / 4 * w2**2],
        },
    )


def test_eq_35() -> None:
    def off(share: sp.Rational) -> list[sp.Expr]:
        inside = l1**2 * w1**2 + share * l2**2 * w2**2 + l1 * l2 * w1 * w2 * cos12
        kinetic = m1 * l1**2 * w1**2 / 6 + m2 * inside / 2
        weight = (m1 / 2 + m2) * g * l1 * sp.cos(q1) + m2 / 2 * g * l2 * sp.cos(q2)
        return [kinetic - energies()[0], kinetic + weight - lagrangian()]  # (35), (37)

    show(
        "eq-35",
        {
            "T = ⅙ m₁l₁²θ̇₁² + ½ m₂ (l₁²θ̇₁² + ¼ l₂²θ̇₂² + l₁l₂θ̇₁θ̇₂ cos(θ₁ − θ₂))": off(HALF**2),
            "T = ⅙ m₁l₁²θ̇₁² + ½ m₂ (l₁²θ̇₁² + ⅓ l₂²θ̇₂² + l₁l₂θ̇₁θ̇₂ cos(θ₁ − θ₂))": off(THIRD),
        },
    )


def test_eq_36() -> None:
    y1, y2 = (centre[1] for centre in centres)
    truth = energies()[1]
    show(
        "eq-36",
        {
            "V = −m₁gy₁ − m₂gy₂": [-m1 * g * y1 - m2 * g * y2 - truth],
            "V = m₁gy₁ + m₂gy₂": [m1 * g * y1 + m2 * g * y2 - truth],
        },
    )


def test_eq_43() -> None:
    rest = HALF * m2 * l1 * l2 * w1 * cos12 - lagrangian().diff(w2)
    inertia = m2 * l2**2 * w2
    show(
        "eq-43",
        {
            "∂L/∂θ̇₂ = ½ m₂l₂²θ̇₂ + ½ m₂l₁l₂θ̇₁ cos(θ₁ − θ₂)": [HALF * inertia + rest],
            "∂L/∂θ̇₂ = ⅓ m₂l₂²θ̇₂ + ½ m₂l₁l₂θ̇₁ cos(θ₁ − θ₂)": [THIRD * inertia + rest],
        },
    )


def test_eq_44() -> None:
    coupling = a1 * cos12 - w1 * sin12 * (w1 - w2)
    right_side = m2 / 3 * a2 * l2**2 + HALF * m2 * l1 * l2 * coupling  # as printed
    show(
        "eq-44",
        {
            "d/dt ∂L/∂θ̇₁ = ⅓ m₂l₂²θ̈₂ + …": [rate(lagrangian().diff(w1)) - right_side],
            "d/dt ∂L/∂θ̇₂ = ⅓ m₂l₂²θ̈₂ + …": [rate(lagrangian().diff(w2)) - right_side],
        },
    )


def test_eq_45() -> None:
    rest = -HALF * m2 * g * l2 * sp.sin(q2) - lagrangian().diff(q2)
    sine = HALF * m2 * l1 * l2 * sin12
    show(
        "eq-45",
        {
            "∂L/∂θ₂ = ½ m₂l₁l₂θ̇₁θ̇₁ sin(θ₁ − θ₂) − ½ m₂gl₂ sin θ₂": [sine * w1 * w1 + rest],
            "∂L/∂θ₂ = ½ m₂l₁l₂θ̇₁θ̇₂ sin(θ₁ − θ₂) − ½ m₂gl₂ sin θ₂": [sine * w1 * w2 + rest],
        },
    )


def euler_lagrange() -> tuple[sp.Expr, sp.Expr]:
    """Return the left sides of (38), zero on every motion, for either rod."""
    along = ((q1, w1), (q2, w2))
    first, second = (rate(lagrangian().diff(w)) - lagrangian().diff(q) for q, w in along)
    return first, second


def equations_47() -> tuple[sp.Expr, sp.Expr]:
    """Return the left sides of (47), which are those of (42) and (46), as printed."""
    first = (
        (m1 / 3 + m2) * l1**2 * a1
        + HALF * m2 * l1 * l2 * (a2 * cos12 + w2**2 * sin12)
        + (m1 / 2 + m2) * g * l1 * sp.sin(q1)
    )
    second = (
        m2 / 3 * l2**2 * a2
        + HALF * m2 * l1 * l2 * (a1 * cos12 - w1**2 * sin12)
        + m2 / 2 * g * l2 * sp.sin(q2)
    )
    return first, second


def equations_48() -> tuple[sp.Expr, sp.Expr]:
    """Return the left sides of (48) as printed."""
    first = (
        2 * (m1 / (3 * m2) + 1) * l1 / l2 * a1
        + a2 * cos12
        + w2**2 * sin12
        + (m1 / m2 + 2) * g / l2 * sp.sin(q1)
    )
    second = 2 * THIRD * l2 / l1 * a2 + a1 * cos12 - w1**2 * sin12 + g / l1 * sp.sin(q2)
    return first, second


def accelerations(length_below: sp.Symbol) -> dict[sp.Symbol, sp.Expr]:
    """Return (49) as printed and (50) with the given length in the denominator."""
    below = 15 * m2 + 8 * m1 - 9 * m2 * sp.cos(2 * (q1 - q2))
    pull1 = m2 * l2 * w2**2 * sin12 + (m1 + 2 * m2) * g * sp.sin(q1)
    pull2 = g * sp.sin(q2) - l1 * w1**2 * sin12
    return {
        a1: (18 * m2 * cos12 * pull2 - 12 * pull1) / (l1 * below),
        a2: (18 * cos12 * pull1 - 12 * (m1 + 3 * m2) * pull2) / (length_below * below),
    }


def test_right_42() -> None:
    assert is_zero(equations_47()[0] - euler_lagrange()[0])


def test_right_46() -> None:
    assert is_zero(equations_47()[1] - euler_lagrange()[1])


def test_right_47() -> None:
    for printed, truth in zip(equations_47(), euler_lagrange(), strict=True):
        assert is_zero(printed - truth)


def test_eq_48_before() -> None:
    def off(divisor: sp.Expr) -> list[sp.Expr]:
        pairs = zip(equations_47(), equations_48(), strict=True)
        return [dividend / divisor - quotient for dividend, quotient in pairs]

    show(
        "eq-48-before",
        {
            "(48) = (47) / (m₂l₁l₂)": off(m2 * l1 * l2),
            "(48) = (47) / (½ m₂l₁l₂)": off(HALF * m2 * l1 * l2),
        },
    )


def test_right_48() -> None:
    for printed, truth in zip(equations_48(), euler_lagrange(), strict=True):
        assert is_zero(printed * HALF * m2 * l1 * l2 - truth)


def test_right_49() -> None:
    # Cramer's rule, so that (50) has no part in it.
    matrix, right_side = sp.linear_eq_to_matrix(euler_lagrange(), [a1, a2])
    first = sp.Matrix.hstack(right_side, matrix.col(1))
    assert is_zero(accelerations(l2)[a1] * matrix.det() - first.det())


def test_eq_50() -> None:
    def off(length_below: sp.Symbol) -> list[sp.Expr]:
        solved = accelerations(length_below)
        return [left_side.subs(solved) for left_side in euler_lagrange()]

    text = "ω̇₂ = … / ({}(15m₂ + 8m₁ − 9m₂ cos(2Δθ₁₂)))"
    show("eq-50", {text.format("l₁"): off(l1), text.format("l₂"): off(l2)})
    # With equal rods nobody would notice.
    assert all(is_zero(left_side.subs(l2, l1)) for left_side in off(l1))
