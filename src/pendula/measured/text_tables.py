"""Tables in text files, of any usual dialect."""

from __future__ import annotations

import csv
import math
import re
from typing import TYPE_CHECKING

from pendula.measured.dialects import USUAL, Dialect, dialect_of
from pendula.measured.header_rows import header_of
from pendula.measured.tables import Table, table_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula._types import Array

_COMMENT = re.compile(r"\s*(?:#|%|//|!|')+\s?(.*)")
_LETTER = re.compile(r"[^\W\d_]")
_WORDS = re.compile(r"\s{2,}|\t+")
_WITH_UNITS = re.compile(r"[^()\[\]]+[(\[][^)\]]*[)\]]")
_LABELS = re.compile(r"[^\s(\[]+(?:\s*[(\[][^)\]]*[)\]])?")


def text_table(text: str, *, name: str = "") -> Table | None:
    """The table that a text holds; None: it holds no rows of numbers.

    Args:
        text: of the file, decoded.
        name: of the table, where the file has several.
    """
    lines = text.splitlines()
    bare = [_without_comment(line) for line in lines]
    plain = [line for line, (_, comment) in zip(lines, bare, strict=True) if line and not comment]
    dialect = dialect_of([line for line in plain if line.strip()])
    if dialect is None:
        return None
    rows = [
        [] if comment else dialect.row(line) for line, (_, comment) in zip(lines, bare, strict=True)
    ]
    start, end = _block(rows)
    if start == end:
        return None
    numbers, places = _numbers(rows[start:end], start)
    width = numbers.shape[1]
    header = header_of(_rows_before(bare[:start], dialect, width), width)
    told = str(dialect)
    return table_of(
        name,
        header.labels,
        list(numbers.T),
        groups=header.groups,
        units=header.units,
        lines=places,
        notes=[] if dialect == USUAL else [f"{told[0].upper()}{told[1:]}."],
    )


def _without_comment(line: str) -> tuple[str, bool]:
    """A line without the sign of a comment in front, and whether it had one."""
    found = _COMMENT.fullmatch(line)
    return (found[1], True) if found else (line, False)


def _block(rows: Sequence[list[float] | None]) -> tuple[int, int]:
    """Where the longest run of rows of numbers begins and ends; empty rows do not end one."""
    best, start, last, count = (0, 0, 0), 0, 0, 0
    for i, row in enumerate([*rows, None]):
        if row is None:
            best = max(best, (count, start, last))
            count = 0
        elif not all(map(math.isnan, row)):
            start = i if count == 0 else start
            count, last = count + 1, i + 1
    return best[1], best[2]


def _numbers(rows: Sequence[list[float] | None], start: int) -> tuple[Array, Array]:
    """The numbers (n, width), NaN where there are none, and the line of each row, from 1."""
    import numpy as np

    there = [(i, row) for i, row in enumerate(rows, start=start + 1) if row]
    width = max(len(row) for _, row in there)
    if any(len(row) < width for _, row in there):
        there = [(i, row + [math.nan] * (width - len(row))) for i, row in there]
    values = np.array([row for _, row in there], dtype=np.float64)
    values[np.isinf(values)] = np.nan
    kept = np.isfinite(values).any(axis=1)
    return values[kept], np.array([i for i, _ in there], dtype=np.float64)[kept]


def _rows_before(
    lines: Sequence[tuple[str, bool]], dialect: Dialect, width: int
) -> list[list[str]]:
    """The cells of the lines above the numbers; of several comments only the last is one."""
    rows: list[list[str]] = []
    for line, comment in reversed(lines):
        if not _LETTER.search(line) or line.startswith("multi:"):
            continue
        cells = _header_cells(line, dialect, width)
        if comment and len(cells) < width:
            if rows:
                break
            continue
        rows.insert(0, cells)
    return rows


def _header_cells(line: str, dialect: Dialect, width: int) -> list[str]:
    """The cells of a header, which may be separated in another way than the numbers are."""
    if dialect.separator != " ":
        cells = next(csv.reader([line], delimiter=dialect.separator, skipinitialspace=True), [])
        if len(cells) >= width or len(cells) > 1:
            return [cell.strip() for cell in cells]
    ways = (
        *(next(csv.reader([line], delimiter=each), []) for each in ";\t,|"),
        _WORDS.split(line.strip()),
        _WITH_UNITS.findall(line),
        _LABELS.findall(line),
        line.split(),
    )
    for cells in sorted(ways, key=lambda each: len(each) != width):
        if len(cells) in (width, width + 1):
            return [cell.strip().strip('"') for cell in cells]
    return [line.strip()]
