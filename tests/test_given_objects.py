"""Numbers of other kinds that carry units, and those too long to be shown."""

from __future__ import annotations

from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pandas as pd
import pint
import pytest

from pendula import SimplePendulum, degrees, elliptic, ensemble, solve

REGISTRY: Any = pint.UnitRegistry()
Q: Any = REGISTRY.Quantity
SIMPLE, START = SimplePendulum(), (1.0, 0.0)


def objects(values: Any) -> Any:
    made = np.empty(np.shape(np.array(values, dtype=object)), dtype=object)
    for place in np.ndindex(made.shape):
        made[place] = np.array(values, dtype=object)[place]
    return made


@pytest.mark.parametrize(
    ("made", "want"),
    [
        (lambda: SimplePendulum(Q(Fraction(1, 3), "cm")).length, 1 / 300),
        (lambda: SimplePendulum(Q(Decimal("0.1"), "mm")).length, 1e-4),
        (lambda: SimplePendulum(length=Q(10, "inch")).length, 0.254),
        (lambda: list(solve(SIMPLE, START, [Q(Fraction(1, 3), "min"), Q(1, "min")]).t), [20, 60]),
        (
            lambda: list(solve(SIMPLE, objects([Q(30, "deg"), Q(1, "rad/s")]), 0.1).states[0]),
            [degrees(30), 1.0],
        ),
        (
            lambda: list(solve(SIMPLE, START, objects([Q(1, "s"), Q(-1, "min")][:1])).t),
            [1.0],
        ),
        (
            lambda: list(solve(SIMPLE, START, pd.Series([Q(1, "s"), Q(1, "min")])).t),
            [1.0, 60.0],
        ),
        (
            lambda: ensemble(SIMPLE, objects([[Q(30, "deg"), 0.0]] * 2), [0.0, 1.0]).states[
                1, 0, 0
            ],
            degrees(30),
        ),
        (
            lambda: list(SIMPLE.period(objects([Q(30, "deg"), Q(1, "rad")]))),
            list(SIMPLE.period([degrees(30), 1.0])),
        ),
        (lambda: solve(SIMPLE, START, 9.0, max_steps=Q(3, "")).request.max_steps, 3),
    ],
)
def test_numbers_of_other_kinds_are_taken(made: Callable[[], Any], want: Any) -> None:
    assert made() == want


@pytest.mark.parametrize(
    ("made", "told"),
    [
        (lambda: SimplePendulum(objects([Q(1, "m")])), "length must be a number [m]"),
        (lambda: solve(SIMPLE, START, objects([Q(1, "m")])), "t must be in s or a unit of"),
        (lambda: solve(SIMPLE, START, 1, max_steps=Q(3, "m")), "max_steps must be a number wi"),
        (lambda: solve(SIMPLE, START, 1, max_steps=Q(3.5, "")), "max_steps must be a whole number"),
        (lambda: elliptic.K(10**400), "k must hold numbers, got 100000… (401 digits)"),
        (lambda: elliptic.K([10**5000]), "k must hold numbers, got a number of thousands of"),
        (lambda: SimplePendulum(Q(10**400, "m")), "length must be a finite number [m], got inf"),
        (lambda: solve(SIMPLE, (Q(10**400, "deg"), 0), 1), "state must hold numbers, got (<Quant"),
        (lambda: solve(SIMPLE, START, 1, max_steps=10**400), "got 100000… (401 digits)"),
        (lambda: solve(SIMPLE, START, 1, max_steps=-(10**5000)), "got a number of thousands of"),
    ],
)
def test_what_cannot_be_taken_is_told_in_a_short_line(made: Callable[[], Any], told: str) -> None:
    with pytest.raises(ValueError, match="must") as error:
        made()
    assert told in str(error.value)
    assert len(str(error.value)) < 160
