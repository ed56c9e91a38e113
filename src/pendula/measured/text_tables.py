"""Tables in text files, of any usual dialect."""

from __future__ import annotations

import csv
import re
from typing import TYPE_CHECKING

from pendula.measured.dialects import Dialect, dialect_of
from pendula.measured.header_rows import Header, header_of
from pendula.measured.tables import Table, table_of

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula._types import Array

_COMMENT = re.compile(r"\s*(?:#|%|//|!|')+\s?(.*)")
_WORDS = re.compile(r"\s{2,}|\t+")
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
    start, end, width = _block(lines, dialect)
    if start == end:
        return None
    header = header_of(_rows_before(bare[:start], dialect, width), width)
    numbers, places = _numbers(lines[start:end], dialect, width)
    notes = [] if (dialect.separator, dialect.mark) == (",", ".") else [f"{dialect}."]
    return _table(
        name, header, numbers, places + start, [each[:1].upper() + each[1:] for each in notes]
    )


def _table(name: str, header: Header, numbers: Array, lines: Array, notes: list[str]) -> Table:
    return table_of(
        name,
        header.labels,
        list(numbers.T),
        groups=header.groups,
        units=header.units,
        lines=lines,
        notes=notes,
    )


def _without_comment(line: str) -> tuple[str, bool]:
    """A line without the sign of a comment in front, and whether it had one."""
    found = _COMMENT.fullmatch(line)
    return (found[1], True) if found else (line, False)


def _block(lines: Sequence[str], dialect: Dialect) -> tuple[int, int, int]:
    """Where the longest run of lines of numbers begins and ends, and how wide it is."""
    best, start, count, width, widest = (0, 0, 0), 0, 0, 0, 0
    last = 0
    for i, line in enumerate([*lines, "end"]):
        cells = dialect.is_row(line) if line else 0
        if cells:
            if not count:
                start, widest = i, 0
            count, last, widest = count + 1, i + 1, max(widest, cells)
        elif not _is_empty(line, dialect) and count:
            if count > width:
                best, width = (start, last, widest), count
            count = 0
    return best


def _is_empty(line: str, dialect: Dialect) -> bool:
    """Whether a line holds neither text nor number: an empty one, or empty cells only."""
    if not line.strip():
        return True
    cells = dialect.cells(line)
    return len(cells) > 1 and all(dialect.number(cell) is not None for cell in cells)


def _numbers(lines: Sequence[str], dialect: Dialect, width: int) -> tuple[Array, Array]:
    """The numbers (n, width), NaN where there are none, and which line each row is, from 1."""
    import numpy as np

    rows, places = [], []
    comma = dialect.mark == ","
    empty = [np.nan] * width
    for i, line in enumerate(lines, start=1):
        cells = dialect.cells(line)
        try:
            row = [float(cell.replace(",", ".") if comma else cell) for cell in cells]
        except ValueError:
            read = map(dialect.number, cells)
            row = [np.nan if each is None else each for each in read]
        if row:
            rows.append(row + empty[len(row) :])
            places.append(i)
    values = np.array(rows, dtype=np.float64)
    values[np.isinf(values)] = np.nan
    kept = np.isfinite(values).any(axis=1)
    return values[kept], np.array(places, dtype=np.float64)[kept]


def _rows_before(
    lines: Sequence[tuple[str, bool]], dialect: Dialect, width: int
) -> list[list[str]]:
    """The cells of the lines above the numbers; of several comments only the last is one."""
    rows: list[list[str]] = []
    for line, comment in reversed(lines):
        if not line.strip() or line.startswith("multi:"):
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
    for cells in (
        *(next(csv.reader([line], delimiter=each), []) for each in ";\t,|"),
        _WORDS.split(line.strip()),
        _LABELS.findall(line),
        line.split(),
    ):
        if len(cells) in (width, width + 1):
            return [cell.strip().strip('"') for cell in cells]
    return [line.strip()]
