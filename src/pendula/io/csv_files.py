"""CSV: the recipe in the first line, then a table; as pendula wrote it or a spreadsheet saved it.

A spreadsheet may add a byte order mark, quotes, empty cells and lines, and cut the first line into
cells; where the comma is the decimal mark it separates by semicolons. All that is taken back. What
it does to the numbers is not: they have to fit their checksums.
"""

from __future__ import annotations

import codecs
import csv
import re
from contextlib import contextmanager
from functools import cache, partial
from typing import TYPE_CHECKING

from pendula._attributes import KEY
from pendula._messages import one_line
from pendula.io.attributes import NotATrajectoryError, attributes
from pendula.io.columns import TIME, labelled
from pendula.io.tables import one_motion
from pendula.io.whole import Stored

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from pendula._types import Array
    from pendula.run.trajectory import Trajectory

MARK = f"# {KEY}: "  # before the attributes, in the first line
_SEPARATORS = ",;\t"
_DECIMAL_COMMA = re.compile(r"\s*[+-]?\d*,\d+(?:[eE][+-]?\d+)?\s*")
_ROUNDED = 15  # digits that spreadsheets keep of a number
_HINT = (
    "; its numbers have at most 15 digits, as spreadsheets round them: take the file as it was "
    "before, or give the spreadsheet a copy"
)


def write_csv(trajectory: Trajectory, path: Path) -> None:
    """Write the recipe and the table."""
    one_motion(trajectory, "a .csv file")
    table = labelled(trajectory)
    with path.open("w", encoding="utf-8", newline="") as file:
        file.write(f"{MARK}{attributes(trajectory)}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(table)
        # float's own shortest decimal form: it gives the same bits back
        writer.writerows(zip(*(values.tolist() for values in table.values()), strict=True))


@contextmanager
def read_csv(path: Path) -> Iterator[Stored]:
    """What a file holds."""
    import numpy as np

    text = _text(path)
    first, _, rest = text.partition("\n")
    separator = _separator(rest)
    recipe = _recipe(first.rstrip("\r"), separator)
    if recipe is None:
        raise NotATrajectoryError(
            f"{path} was not written by pendula: its first line lacks {MARK!r}"
        )
    header, rows = _table(rest, separator, path)

    @cache
    def table() -> dict[str, Array]:
        try:
            cells = [[_number(cell, separator) for cell in row] for row in rows]
        except ValueError as error:
            raise NotATrajectoryError(
                f"{path} holds something else than numbers: {one_line(error)}"
            ) from None
        values = np.array(cells, dtype=np.float64).reshape(len(rows), len(header))
        return dict(zip(header, values.T, strict=True))

    shapes = dict.fromkeys(header, (len(rows),))
    size = path.stat().st_size
    yield Stored(recipe, shapes, lambda label: table()[label], size, partial(_hint, rows))


def _text(path: Path) -> str:
    """The text, without a byte order mark; spreadsheets' "Unicode" is UTF-16."""
    data = path.read_bytes()
    wide = data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    return data.decode("utf-16" if wide else "utf-8-sig")


def _separator(rest: str) -> str:
    """What stands behind the name of the first column."""
    behind = rest.lstrip('"').removeprefix(TIME).lstrip('"')[:1]
    return behind if behind and behind in _SEPARATORS else ","


def _recipe(line: str, separator: str) -> str | None:
    """The recipe in the first line, which may be quoted and cut into cells; None: it is none."""
    if line.startswith(MARK):
        whole = line[len(MARK) :].rstrip(_SEPARATORS)
        if whole.endswith("}"):
            return whole
    cells = next(csv.reader([line], delimiter=separator), [])
    if separator != ",":
        cells = [
            each.replace(",", ".") if _DECIMAL_COMMA.fullmatch(each) else each for each in cells
        ]
    joined = ",".join(cells).rstrip(",")
    return joined[len(MARK) :] if joined.startswith(MARK) else None


def _table(rest: str, separator: str, path: Path) -> tuple[list[str], list[list[str]]]:
    """The names and the rows, without what is empty at the right and below."""
    lines = list(csv.reader(rest.splitlines(), delimiter=separator))
    if lines and len(lines[0]) == 1 and separator in lines[0][0]:  # each line is one cell
        lines = [next(csv.reader(line or [""], delimiter=separator), []) for line in lines]
    while lines and not any(lines[-1]):
        lines.pop()
    if not lines:
        raise NotATrajectoryError(f"{path} is not whole: it has no header")
    header, *rows = lines
    while not header[-1]:
        header.pop()
    width = len(header)
    rows = [row if any(row[width:]) else row[:width] for row in rows]
    for number, row in enumerate(rows, start=1):
        if len(row) != width:
            what = f"row {number} has {len(row)} cells of {width}"
            raise NotATrajectoryError(f"{path} is not whole: {what}")
    return header, rows


def _number(cell: str, separator: str) -> float:
    if separator != "," and _DECIMAL_COMMA.fullmatch(cell):
        cell = cell.replace(",", ".")
    return float(cell)


def _hint(rows: list[list[str]]) -> str:
    """What is added to a number that does not fit: whether all look as if they were rounded."""
    longest = max((_digits(cell) for row in rows for cell in row), default=_ROUNDED + 1)
    return _HINT if longest <= _ROUNDED else ""


def _digits(cell: str) -> int:
    """Significant digits of a number's text."""
    found = re.match(r"\s*[+-]?([\d.,]*)", cell)
    return len(re.sub(r"[.,]", "", found[1]).lstrip("0")) if found else 0
