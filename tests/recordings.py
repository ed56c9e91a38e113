"""Recordings that tests read: real ones from beside the project, and swings written as files."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula._types import Array
    from pendula.measured import Measurement, PeriodTable

TIMES = np.arange(0.0, 8.0, 0.02)
SWING = 0.3 * np.exp(-0.05 * TIMES) * np.cos(4.4 * TIMES)  # rad
RATE = -0.3 * np.exp(-0.05 * TIMES) * (0.05 * np.cos(4.4 * TIMES) + 4.4 * np.sin(4.4 * TIMES))
OTHER_SWING = 0.4 * np.cos(4.4 * TIMES + 1.0)
DEGREES = np.degrees(SWING)
LENGTH = 0.6
X, Y = LENGTH * np.sin(SWING), -LENGTH * np.cos(SWING)


def recording(name: str) -> Path:
    """A real recording; the test is skipped where it is not there."""
    here = Path(__file__).resolve().parents[1]
    named = os.environ.get("PENDULA_RECORDINGS")
    folders = [Path(named)] if named else [up / "shared" / "data" for up in here.parents[:2]]
    for folder in folders:
        if (folder / name).is_file():
            return folder / name
    pytest.skip(f"no recording {name}: name its folder with PENDULA_RECORDINGS")


def rows(*columns: Array, separator: str = ",", mark: str = ".", form: str = "%.6f") -> list[str]:
    """Lines of numbers; an empty cell is a NaN."""
    return [
        separator.join("" if np.isnan(each) else (form % each).replace(".", mark) for each in row)
        for row in zip(*columns, strict=True)
    ]


def text(*lines: str | Sequence[str]) -> str:
    """A file of lines, or lists of lines."""
    flat = [each for line in lines for each in ([line] if isinstance(line, str) else line)]
    return "\n".join(flat) + "\n"


def same(one: Measurement | PeriodTable, other: Measurement | PeriodTable) -> None:
    """Compare two recordings bit for bit."""
    for name in ("t", "values", "period", "length", "amplitude", "repeats"):
        ours, theirs = getattr(one, name, None), getattr(other, name, None)
        assert (ours is None) == (theirs is None)
        if ours is not None and theirs is not None:
            np.testing.assert_array_equal(ours, theirs)
    assert one.reading == other.reading
