"""Sheets of .xls, .xlsx and .ods files."""

from __future__ import annotations

import datetime
import math
from io import BytesIO
from typing import TYPE_CHECKING, Any

from pendula._checks import extra
from pendula.measured.dialects import Dialect
from pendula.measured.header_rows import header_of
from pendula.measured.tables import Table, table_of
from pendula.measured.text_tables import text_table

if TYPE_CHECKING:
    from collections.abc import Sequence

_TYPED = Dialect(";", ",")  # numbers that stand as text in a sheet, with a decimal comma


def sheet_tables(data: bytes) -> list[Table]:
    """The tables of the sheets that hold any numbers.

    Raises:
        ValueError: for a file that is damaged or locked by a password.
    """
    workbook = extra("python_calamine", "fit").CalamineWorkbook.from_filelike(BytesIO(data))
    found = (
        _table(name, workbook.get_sheet_by_name(name).to_python(skip_empty_area=False))
        for name in workbook.sheet_names
    )
    return [table for table in found if table is not None]


def _table(name: str, rows: Sequence[Sequence[Any]]) -> Table | None:
    """One sheet's table: the longest run of rows with numbers, and what stands above."""
    import numpy as np

    cells = [[_number(cell) for cell in row] for row in rows]
    start, end = _block([_is_row(row) for row in cells])
    if start == end:
        return _of_text(name, rows)
    width = max(len(row) for row in cells[start:end])
    values = np.array(
        [
            [math.nan if each is None else each for each in row] + [math.nan] * (width - len(row))
            for row in cells[start:end]
        ]
    )
    kept = np.isfinite(values).any(axis=1)
    above = [[str(cell).strip() for cell in row] for row in rows[:start]]
    header = header_of([row for row in above if any(row)], width)
    return table_of(
        name,
        header.labels,
        list(values[kept].T),
        groups=header.groups,
        units=header.units,
        lines=np.arange(start + 1.0, end + 1)[kept],
        what="row",
    )


def _of_text(name: str, rows: Sequence[Sequence[Any]]) -> Table | None:
    """The table of a sheet into whose first cells whole lines of a text table were put."""
    lines = [str(row[0]) if row else "" for row in rows]
    return text_table("\n".join(lines), name=name)


def _number(cell: Any) -> float | None:
    """A cell's number, NaN where it is empty; None: it is a text."""
    if isinstance(cell, bool):
        return None
    if isinstance(cell, int | float):
        return float(cell)
    if isinstance(cell, datetime.timedelta):
        return cell.total_seconds()
    if isinstance(cell, datetime.time):
        return cell.hour * 3600 + cell.minute * 60 + cell.second + cell.microsecond * 1e-6
    if isinstance(cell, datetime.datetime):
        return cell.timestamp()
    text = str(cell)
    point = Dialect(";", ".").number(text)
    return _TYPED.number(text) if point is None else point


def _is_row(row: Sequence[float | None]) -> bool:
    """Whether it holds more numbers than texts."""
    texts = sum(each is None for each in row)
    return sum(each is not None and math.isfinite(each) for each in row) > texts


def _block(are_rows: Sequence[bool]) -> tuple[int, int]:
    """Where the longest run of rows begins and ends."""
    best = (0, 0)
    start = None
    for i, is_row in enumerate([*are_rows, False]):
        if is_row and start is None:
            start = i
        elif not is_row and start is not None:
            best = max(best, (start, i), key=lambda each: each[1] - each[0])
            start = None
    return best
