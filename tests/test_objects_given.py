"""Numbers that are objects: fractions, decimals, columns of a table."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from pendula import (
    DoublePendulum,
    SimplePendulum,
    degrees,
    ensemble,
    exact,
    solve,
    time_at,
)
from pendula.events import angle
from refusals import told

if TYPE_CHECKING:
    pass

SIMPLE, RODS = SimplePendulum(), DoublePendulum.rods()
START = (2.0, 2.5, 0.0, 0.0)
RECIPE: dict[str, Any] = {"system": {"kind": "simple"}, "run": {"t_max": "1 s"}}


@pytest.mark.parametrize(
    "third",
    [
        Fraction(1, 3),
        Decimal(1) / 3,
        np.array(Fraction(1, 3)),
        np.array([Fraction(1, 3)], dtype=object)[0],
        pd.Series([Fraction(1, 3), 0], dtype=object)[0],
    ],
)
def test_a_fraction_is_a_number(third: Any) -> None:
    assert SimplePendulum(third).length == 1 / 3
    assert DoublePendulum.rods(third).values[0] == 1 / 3
    assert solve(SIMPLE, (third, 0), third).request.state[0] == 1 / 3
    assert solve(SIMPLE, (1, 0), [third, 1]).t[0] == 1 / 3
    assert exact(SIMPLE, (1, 0), third).t[0] == 1 / 3
    assert solve(SIMPLE, (1, 0), 1.0, "rk4", step=third).request.step == 1 / 3
    assert degrees(third) == degrees(1 / 3)
    assert time_at(SIMPLE, (1, 0), third) == time_at(SIMPLE, (1, 0), 1 / 3)
    assert angle(1, third).value == 1 / 3


def test_object_columns_are_numbers() -> None:
    table = pd.DataFrame(
        {"theta": [1, Fraction(1, 2)], "omega": [0.5, Decimal("0.25")]}, dtype=object
    )
    plain = [(1.0, 0.5), (0.5, 0.25)]
    for given in (table, table.to_numpy(), table.to_numpy().tolist()):
        np.testing.assert_array_equal(
            exact(SIMPLE, given, 1.0).states, exact(SIMPLE, plain, 1.0).states
        )
        many = ensemble(SIMPLE, given, 1.0)
        np.testing.assert_array_equal(many.states, ensemble(SIMPLE, plain, 1.0).states)
        np.testing.assert_array_equal(SIMPLE.energy(given), SIMPLE.energy(plain))
    times = pd.Series([Fraction(1, 2), 1], dtype=object)
    assert solve(SIMPLE, (1, 0), times).t.tolist() == [0.5, 1.0]


def test_object_columns_keep_their_units() -> None:
    import pint

    unit: Any = pint.UnitRegistry()
    given = np.array([unit.Quantity(30.0, "deg"), unit.Quantity(0.0, "deg/s")], dtype=object)
    assert solve(SIMPLE, given, 1.0).request.state[0] == degrees(30)
    column = xr.DataArray(np.array([Fraction(1, 2)], dtype=object), attrs={"units": "ms"})
    assert solve(SIMPLE, (1, 0), column).t.tolist() == [0.0005]


@pytest.mark.parametrize(
    "entry", [None, "1", True, 1j, pd.NA, pd.Timestamp(0), np.timedelta64(1, "s"), [1], b"1"]
)
def test_objects_that_are_no_numbers(entry: Any) -> None:
    given = np.empty(2, dtype=object)
    given[:] = [Fraction(1, 2), entry]
    assert told(lambda: solve(SIMPLE, given, 1.0)).startswith("state must hold numbers, got")
