"""What cannot be read gets one line: what is wrong, and what to name."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from pendula.measured import read
from recordings import DEGREES, OTHER_SWING, SWING, TIMES, X, rows, text

if TYPE_CHECKING:
    from pathlib import Path

T = TIMES
FALLING = np.where(np.arange(T.size) == 100, T[98], T)
USUAL = text("t,theta", rows(T, SWING))
ASKED: list[tuple[str, dict[str, Any], str]] = [
    (
        text("theta", rows(SWING)),
        {},
        r"has no column of times; name one with time=1, or give the fr",
    ),
    (text("frame,theta", rows(T * 50, SWING)), {}, r"has no times, but counts frames in 'frame'; "),
    (
        text("t (s),time (s),a (°)", rows(T, 2 * T**1.1, SWING)),
        {},
        r"^time could be either of two columns or more: 't \(s\)' or 'time \(s\)'; name one",
    ),
    (
        text("time,angle", rows(1000 * T, SWING)),
        {},
        r"^time_unit of the times in 'time' is not told, and they go in steps of 20; say it",
    ),
    (
        text("t,theta", rows(FALLING, SWING)),
        {},
        r"^time falls from 1.98 to 1.96 s at line 102 of the file, in 't'; correct that line, n",
    ),
    (
        text("t,angle left (°),angle right (°)", rows(T, DEGREES, DEGREES + 1)),
        {},
        r"^angle could be one of 2 columns: 'angle left \(°\)' or 'angle right \(°\)'; name",
    ),
    (
        text(rows(T, SWING, OTHER_SWING)),
        {},
        r"has no column that is known as an angle, a rate, .*: 2, 3; name it with angle=2, rate",
    ),
    (text("t (s),Potential (V)", rows(T, SWING)), {}, r"has no column that is known .*'Potential"),
    (text("t (s),Position (m)", rows(T, X)), {}, r"has no column that is known .*'Position \(m\)'"),
    (text("t,ax,ay,az", rows(T, X, X - np.mean(X), 0 * X)), {}, r"^radial is not told: no axis"),
    (USUAL, {"angle": "thta"}, r"^angle must be one of the columns t, theta, got 'thta'; did you "),
    (
        text("t,a,a", rows(T, SWING, SWING)),
        {"angle": "a"},
        r"^angle names several columns with 'a', those of numbers 2, 3; name one by its number",
    ),
    (
        USUAL,
        {"unit": "m"},
        r"^unit must be a unit of the same kind as rad, got 'm'; write unit=deg",
    ),
    (USUAL, {"time_unit": "m"}, r"^time_unit must be a unit of time, got 'm'; write time_unit=ms$"),
    (USUAL, {"run": 2}, r"^run must be one of 1, got '2'$"),
    (USUAL, {"sheet": "A"}, r"^sheet cannot be 'A': the file has one table only; leave it out$"),
    (USUAL, {"t": (3, 2)}, r"^t must start before it ends, got \(3.0, 2.0\)$"),
    (USUAL, {"t": 3}, r"^t must be a start and an end \[s\], got 3$"),
    (USUAL, {"t": (90, 99)}, r"^t must hold two samples of 0 … 7.98 s, got \(90.0"),
    (
        USUAL,
        {"angle": 2, "rate": 2},
        r"^angle cannot be named together with rate; a measurement ho",
    ),
    (USUAL, {"x": (1, 2), "y": 1}, r"^x must name as many columns as y, got 2$"),
    (USUAL, {"angle": (1, 2, 1)}, r"^angle must name at most 2 columns, got 3$"),
    (USUAL, {"angle": 1.5}, r"^angle must be a column's label, or its number from 1, got 1.5$"),
    (USUAL, {"frame_rate": 0}, r"^frame_rate must be .*positive.*got 0"),
    (USUAL, {"zero": "left"}, r"^zero .*down.*up"),
    (USUAL, {"linear": 1}, r"^linear must be True or False, got 1$"),
    (USUAL, {"period": 2, "length": 1}, r"^unit of the lengths is not told, and they go"),
]


@pytest.mark.parametrize(("content", "given", "said"), ASKED)
def test_one_line_says_what_to_name(
    content: str, given: dict[str, Any], said: str, tmp_path: Path
) -> None:
    path = tmp_path / "a.csv"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(ValueError, match=said) as error:
        read(path, **given)
    assert "\n" not in str(error.value)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        read(tmp_path / "none.csv")
