"""Small oscillations of the double pendulum, and constants that have no digits."""

from __future__ import annotations

import math

import numpy as np
import pytest

from catalogue import SYSTEMS, label
from pendula import DoublePendulum, LinearPendulum, SimplePendulum

BODIES = DoublePendulum.bodies(1.2, 0.7, 0.9, 0.4, 0.3, 0.05, 0.02, 9.81, l2=0.8)


def test_normal_modes_of_equal_rods() -> None:
    """ω² l/g = 3 ∓ 6/√7."""
    modes = DoublePendulum.rods(gravity=9.81).normal_modes()
    for frequency, sign in zip(modes.frequencies, (-1, 1), strict=True):
        assert frequency**2 / 9.81 == pytest.approx(3 + sign * 6 / math.sqrt(7), rel=1e-14)


@pytest.mark.parametrize(
    "system", [*(each for each in SYSTEMS if each.name == "double"), BODIES], ids=label
)
def test_normal_modes_solve_the_eigenproblem(system: DoublePendulum) -> None:
    from scipy.linalg import eigh

    c = system.constants
    squares, _ = eigh(np.diag([c["D"], c["E"]]), [[c["A"], c["C"]], [c["C"], c["B"]]])
    modes = system.normal_modes()
    np.testing.assert_allclose(np.square(modes.frequencies), squares, rtol=1e-12)
    for frequency, shape in zip(modes.frequencies, modes.shapes, strict=True):
        assert math.hypot(*shape) == pytest.approx(1.0)
        # a small push along the shape is accelerated by −ω² times itself
        push = 1e-7 * np.array(shape)
        np.testing.assert_allclose(
            system.rhs([*push, 0, 0])[2:], -(frequency**2) * push, rtol=1e-6, atol=1e-17
        )


EXTREME = [
    DoublePendulum.rods(1e300, 1e-300, 1.0, 1.0),
    DoublePendulum.rods(1e150, 1e-150, 1.0, 1.0),
    DoublePendulum.rods(1e-150, 1e150, 1.0, 2.0),
    DoublePendulum.rods(1e150, 1e150, 1.0, 1e-150, 1e150),
    DoublePendulum.rods(1e-150, 1e-150, 1e-3, 1.0, 1e-150),
    DoublePendulum.rods(1e-300, 1e-300, 1.0, 1e150, 1.0),
    DoublePendulum.rods(1e-300, 1e-300, 1.0, 1e300, 1e300),
    DoublePendulum.rods(1e300, 1e-300, 1e-3, 1e150, 1.0),
    DoublePendulum.bobs(1e200, 1e100, 1e-100, 1e-50, 1e100),
    DoublePendulum.bobs(1e150, 1e-150, 1e-75, 1e75),
    DoublePendulum.bobs(1e-300, 1e-300, 1e150, 1.0, 1.0),
    DoublePendulum.bobs(3e100, 1e100, 1e3, 1.0, 1e-300),
    DoublePendulum.bodies(1e150, 1e150, 1.0, 0.5, 0.5, 1e149, 1e149),
    DoublePendulum.bodies(1e-100, 1e-200, 1.0, 0.5, 0.0, 1e-101, 1e-201, 1e50),
]


@pytest.mark.parametrize("system", EXTREME, ids=repr)
def test_normal_modes_do_not_leave_the_range_of_numbers(system: DoublePendulum) -> None:
    from mpmath import mp, mpf

    modes = system.normal_modes()
    with mp.workdps(1000):
        A, B, C, D, E = (mpf(system.constants[name]) for name in "ABCDE")
        root = mp.sqrt((A * E - B * D) ** 2 + 4 * C * C * D * E)
        squares = [(A * E + B * D + sign * root) / (2 * (A * B - C * C)) for sign in (-1, 1)]
        lines = (squares[0] * C, D - squares[0] * A), (E - squares[1] * B, squares[1] * C)
        for i, (x, y) in enumerate(lines):
            frequency, length = mp.sqrt(squares[i]), mp.hypot(x, y) * (mp.sign(x) or 1)
            assert abs(modes.frequencies[i] - frequency) <= 1e-15 * frequency
            truth = float(x / length), float(y / length)
            assert modes.shapes[i] == pytest.approx(truth, rel=1e-14, abs=1e-15)
            assert modes.shapes[i][0] >= 0.0


@pytest.mark.parametrize("part", [0.05, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-30, 1e-100])
def test_a_light_upper_bob_keeps_all_digits(part: float) -> None:
    """A B − C² is the difference of nearly equal numbers there: frequencies from the parameters."""
    from mpmath import mp, mpf

    with mp.workdps(300):
        for m2, l1, l2 in ((1.0, 1.7, 1.9), (0.3, 0.9, 1.1)):
            g, light, heavy = mpf(9.81), mpf(part), mpf(m2)
            bobs = light * mpf(l1) ** 2 * heavy * mpf(l2) ** 2
            A, B = (light + heavy) * mpf(l1) ** 2, heavy * mpf(l2) ** 2
            D, E = (light + heavy) * g * mpf(l1), heavy * g * mpf(l2)
            whole = A * E + B * D
            fast = (whole + mp.sqrt(whole**2 - 4 * bobs * D * E)) / 2
            truth = [float(mp.sqrt(D * E / fast)), float(mp.sqrt(fast / bobs))]
            found = DoublePendulum.bobs(part, m2, l1, l2, 9.81).normal_modes().frequencies
            assert found == pytest.approx(truth, rel=5e-15 if part > 0.01 else 1e-15)
            # the same as bodies without a moment of inertia of their own
            of_bodies = DoublePendulum.bodies(part, m2, l1, l1, l2, 0.0, 0.0, 9.81)
            assert of_bodies.normal_modes().frequencies == pytest.approx(truth, rel=5e-15)


@pytest.mark.parametrize(
    ("make", "values", "constant"),
    [
        ("rods", (1e-300, 1e-300, 1e-10, 1e150), "A"),  # 1e-320 has three digits
        ("rods", (1.0, 1e-300, 1.0, 1e-10), "B"),
        ("rods", (1e-100, 1e-100, 1.0, 1.0, 1e-220), "D"),
        ("rods", (1.0, 1e-300, 1e-300, 1.0), "A|C|determinant_floor"),
        ("bodies", (1.0, 1.0, 1.0, 0.5, 1e-300, 0.1, 0.1, 1e-100), "E"),  # 0, but c2 is not
    ],
)
def test_parameters_whose_constants_have_lost_their_digits_are_refused(
    make: str, values: tuple[float, ...], constant: str
) -> None:
    rule = f"^parameters cannot be computed with: their constant ({constant}) is "
    with pytest.raises(ValueError, match=rule):
        getattr(DoublePendulum, make)(*values)


@pytest.mark.parametrize("values", [(1e-160, 1.0, 1e-160), (1.0, 1e-320, 1.0)])
def test_a_bob_whose_constants_have_lost_their_digits_is_refused(values: tuple[float, ...]) -> None:
    for kind in (LinearPendulum, SimplePendulum):
        with pytest.raises(ValueError, match="^parameters cannot be computed with"):
            kind(*values)
