"""How a table of numbers is written as text: what separates its cells, and its decimal mark."""

from __future__ import annotations

import csv
import math
import re
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

_MISSING = {
    "",
    "nan",
    "na",
    "n/a",
    "null",
    "none",
    "-",
    "--",
    "---",
    "#n/a",
    "inf",
    "-inf",
    "*",
    "?",
}
_LINES_TRIED = 300
_POINT = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?")
_COMMA = re.compile(r"[-+]?(?:\d+(?:,\d+)?|,\d+)(?:[eEdD][-+]?\d+)?")
_CLOCK = re.compile(r"(?:(\d+):)?(\d{1,2}):(\d{1,2}(?:[.,]\d+)?)")
_NAMES = {",": "commas", ";": "semicolons", "\t": "tabs", " ": "blanks", "|": "bars"}
_CANDIDATES = tuple((each, mark) for each in ";\t,| " for mark in ".,")


@dataclass(frozen=True)
class Dialect:
    """How cells are separated and numbers written.

    Attributes:
        separator: of cells; a blank stands for any number of blanks and tabs.
        mark: the decimal one.
        quoted: whether cells stand in quotes.
    """

    separator: str
    mark: str
    quoted: bool = field(default=False, compare=False)

    def __str__(self) -> str:
        """In words, for notes."""
        mark = "decimal commas" if self.mark == "," else "decimal points"
        return f"{_NAMES[self.separator]} between cells and {mark}"

    def cells(self, line: str) -> list[str]:
        """The cells of a line."""
        if self.separator == " ":
            return line.replace('"', "").split()
        if self.quoted and '"' in line:
            return next(csv.reader([line], delimiter=self.separator, skipinitialspace=True), [])
        return line.split(self.separator)

    def number(self, cell: str) -> float | None:
        """A cell's number, NaN where there is none; None: it is something else."""
        text = cell.strip().replace("−", "-")
        if text[:1] == text[-1:] == '"':
            text = text[1:-1].strip()
        if text.lower() in _MISSING:
            return math.nan
        if (_COMMA if self.mark == "," else _POINT).fullmatch(text):
            return float(text.replace(",", ".").replace("d", "e").replace("D", "e"))
        clock = _CLOCK.fullmatch(text)
        if clock:
            hours, minutes, seconds = clock.groups()
            return 3600 * int(hours or 0) + 60 * int(minutes) + float(seconds.replace(",", "."))
        return None

    def row(self, line: str) -> list[float] | None:
        """The numbers of a line, NaN for what is none; None: it is no line of numbers.

        A line of numbers may hold a text, a remark or a name, but more numbers than texts. An
        empty line is a row without numbers.
        """
        cells = self.cells(line)
        if self.mark == ".":
            try:
                return list(map(float, cells))
            except ValueError:
                pass
        numbers = [self.number(cell) for cell in cells]
        texts = sum(each is None for each in numbers)
        found = sum(each is not None and math.isfinite(each) for each in numbers)
        if found <= texts and texts:
            return None
        return [math.nan if each is None else each for each in numbers]


USUAL = Dialect(",", ".")


def dialect_of(lines: Sequence[str]) -> Dialect | None:
    """The dialect in which most of the lines are rows of numbers; None: in none are any.

    Args:
        lines: of the file, without blank ones and comments.
    """
    last = lines[max(0, len(lines) - _LINES_TRIED) :]
    tried = last if len(lines) <= 2 * _LINES_TRIED else [*lines[_LINES_TRIED:][:100], *last]
    best, best_score = None, (0, 0, 0)
    for separator, mark in _CANDIDATES:
        for quoted in (False, True) if any('"' in line for line in tried) else (False,):
            dialect = Dialect(separator, mark, quoted)
            rows = [dialect.row(line) for line in tried]
            numbers = [row for row in rows if row and not all(map(math.isnan, row))]
            widths = Counter(map(len, numbers))
            if not widths:
                continue
            width, most = max(widths.items(), key=lambda item: (item[1], item[0]))
            whole = sum(
                all(dialect.number(cell) is not None for cell in dialect.cells(line))
                for line in tried
            )
            score = (whole + most, min(width, 2), mark == ".")
            if score > best_score:
                best, best_score = dialect, score
    return best
