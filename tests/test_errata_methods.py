"""Erratum of the numerical methods, (54), and the forms right as printed: (53), (55), (56).

A method is right if its error against a known solution falls with its order as the step is
halved. Both problems are non-linear and depend on time, so that no wrong stage can hide.
"""

import math
from collections.abc import Callable

from pendula.study.errata import errata

ROWS = {row.id: row for row in errata()}

Vector = tuple[float, ...]
Step = Callable[[float, Vector, float], Vector]


def slope(x: float, y: float) -> float:
    """Return f of y′ = −y² cos x, whose solution from y(0) = 1 is 1/(1 + sin x)."""
    return -(y**2) * math.cos(x)


def slopes(t: float, u: Vector) -> Vector:
    """Return F of a pendulum (θ, ω) so driven that θ = sin t is its motion."""
    theta, omega = u
    return omega, -math.sin(theta) + math.sin(math.sin(t)) - math.sin(t)


def plus(u: Vector, *changes: tuple[float, Vector]) -> Vector:
    """Return u and some multiples of other vectors, added up."""
    return tuple(a + sum(by * v[i] for by, v in changes) for i, a in enumerate(u))


def heun_53(x: float, y: Vector, h: float) -> Vector:
    """Step as (53), which is for one equation."""
    (y_n,) = y
    predicted = y_n + h * slope(x, y_n)
    return (y_n + h * ((slope(x, y_n) + slope(x + h, predicted)) / 2),)


def heun_54(factor: Callable[[float], float]) -> Step:
    """Return the step of (54); what stands before its bracket is a function of h."""

    def step(t: float, u: Vector, h: float) -> Vector:
        w = plus(u, (h, slopes(t, u)))
        half = factor(h) / 2
        return plus(u, (half, slopes(t, u)), (half, slopes(t + h, w)))

    return step


def runge_kutta_55(x: float, y: Vector, h: float) -> Vector:
    """Step as (55), which is for one equation."""
    (y_n,) = y
    k1 = h * slope(x, y_n)
    k2 = h * slope(x + h / 2, y_n + k1 / 2)
    k3 = h * slope(x + h / 2, y_n + k2 / 2)
    k4 = h * slope(x + h, y_n + k3)
    return (y_n + (k1 + 2 * k2 + 2 * k3 + k4) / 6,)


def runge_kutta_56(t: float, u: Vector, h: float) -> Vector:
    """Step as (56); the k are without the factor h, which plus() puts in."""
    k1 = slopes(t, u)
    k2 = slopes(t + h / 2, plus(u, (h / 2, k1)))
    k3 = slopes(t + h / 2, plus(u, (h / 2, k2)))
    k4 = slopes(t + h, plus(u, (h, k3)))
    return plus(u, (h / 6, k1), (h / 3, k2), (h / 3, k3), (h / 6, k4))


def error(step: Step, steps: int, start: Vector, end: Vector) -> float:
    """Return the largest error at time 1 of a run from time 0."""
    h, state = 1 / steps, start
    for i in range(steps):
        state = step(i * h, state, h)
    return max(abs(a - b) for a, b in zip(state, end, strict=True))


def scalar_error(step: Step, steps: int) -> float:
    return error(step, steps, (1.0,), (1 / (1 + math.sin(1)),))


def system_error(step: Step, steps: int) -> float:
    return error(step, steps, (0.0, 1.0), (math.sin(1), math.cos(1)))


def order(errors: Callable[[Step, int], float], step: Step) -> float:
    """Return the order measured between 100 and 200 steps."""
    return math.log2(errors(step, 100) / errors(step, 200))


def test_right_53() -> None:
    assert abs(order(scalar_error, heun_53) - 2) < 0.1


def test_eq_54() -> None:
    row = ROWS["eq-54"]
    meaning = {
        "u = u₀ + [F(t₀, u₀) + F(t₀ + h, w)]/2": heun_54(lambda h: 1.0),
        "u = u₀ + h [F(t₀, u₀) + F(t₀ + h, w)]/2": heun_54(lambda h: h),
    }
    printed, correct = meaning[row.printed["en"]], meaning[row.correct["en"]]
    assert abs(order(system_error, correct) - 2) < 0.1
    # The print moves far even in a step of no length, so smaller steps make the error larger.
    assert abs(printed(0.0, (0.0, 1.0), 1e-9)[0] - 0.0) > 0.9
    assert system_error(printed, 200) > system_error(printed, 100) > 1


def test_right_55() -> None:
    assert abs(order(scalar_error, runge_kutta_55) - 4) < 0.1


def test_right_56() -> None:
    assert abs(order(system_error, runge_kutta_56) - 4) < 0.1
