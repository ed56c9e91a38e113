"""The stored indicators of chaos, and motions that their tests share."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from pendula import DoublePendulum
from stored import document

STORED = document("chaos.json")
CASES = STORED["indicators"]
each_case = pytest.mark.parametrize("case", CASES, ids=lambda case: case["name"])
RODS = DoublePendulum.rods(gravity=9.81)
WILD, CALM = (2.0, 2.5, 0.0, 0.0), (0.4, -0.3, 0.2, 0.1)


def double_of(given: dict[str, Any]) -> DoublePendulum:
    """The system of a stored case."""
    values = {key: given[key] for key in ("m1", "m2", "l1", "l2", "gravity")}
    made: DoublePendulum = getattr(DoublePendulum, given["form"])(**values)
    return made


def of(case: dict[str, Any], name: str, until: float = 10.0) -> tuple[list[float], np.ndarray]:
    """Times up to one, and the stored values there; NaN: not stored."""
    rows = [row for row in case["values"] if row["t"] <= until]
    values = [float("nan") if row[name] is None else float(row[name]) for row in rows]
    return [float(row["t"]) for row in rows], np.array(values)
