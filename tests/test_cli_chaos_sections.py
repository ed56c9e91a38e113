"""`pendula chaos section`: the same as in Python, in files and told."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from commands import floats, table_of, unfolded
from pendula import DoublePendulum, DrivenPendulum
from pendula.chaos import (
    section,
)

if TYPE_CHECKING:
    from commands import Call

RODS = DoublePendulum.rods()
WILD = (2.0, 2.5, 0.0, 0.0)
START = "--theta1 2rad --theta2 2.5rad"
SCALED = "driven --scaled --q 2 --a 1.07 --drive-frequency 0.6666666666666666"


def test_a_section_of_an_energy_and_of_a_start(call: Call) -> None:
    line = "chaos section double --energy 6J --starts 3 --crossings 4 -o s.csv"
    code, printed, _ = call(line)
    assert code == 0
    found = section(RODS, energy=6.0, starts=3, crossings=4)
    _, columns = table_of("s.csv")
    assert floats(columns["p2 [J s]"]) == found.points[..., 1].ravel().tolist()
    assert floats(columns["theta1 [rad]"]) == found.states[..., 0].ravel().tolist()
    assert columns["start"] == [str(i) for i in (1, 2, 3) for _ in range(4)]
    assert "3 motions, 4 crossings each" in printed
    code, printed, _ = call(f"chaos section {SCALED} --theta 0.2rad --crossings 5 -o d.csv")
    assert code == 0
    system = DrivenPendulum.scaled(2.0, 1.07, 0.6666666666666666)
    strobed = section(system, (0.2, 0.0), crossings=5)
    _, columns = table_of("d.csv")
    assert floats(columns["t [s]"]) == strobed.times.ravel().tolist()


@pytest.mark.parametrize(
    ("indicator", "told"),
    [
        ("megno", "by mean MEGNO at 50 s"),
        ("lyapunov", "Lyapunov exponents at 50 s from"),
        ("sali", "of SALI below 1e-08 at 50 s"),
    ],
)
def test_a_section_by_any_indicator(call: Call, indicator: str, told: str) -> None:
    line = f"chaos section double --energy 6J --starts 3 --crossings 2 --indicator {indicator}"
    code, printed, _ = call(f"{line} --t-max 50s -o i.csv")
    assert code == 0
    found = section(RODS, energy=6.0, starts=3, crossings=2, indicator=indicator, t_max=50.0)
    _, columns = table_of("i.csv")
    unit = " [1/s]" if indicator == "lyapunov" else ""
    assert found.values is not None
    assert floats(columns[indicator + unit]) == np.repeat(found.values, 2).tolist()
    assert told in unfolded(printed)
