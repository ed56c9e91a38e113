"""The lines above a table: names of the columns, their units, and what stands above them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from pendula.measured.header_units import header_unit

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True)
class Header:
    """What stands above the columns.

    Attributes:
        labels: of the columns; none: there is no header.
        units: below the labels; none: they have no line of their own.
        groups: above the labels, tracks or runs; none: there is no such line.
    """

    labels: tuple[str, ...] = ()
    units: tuple[str, ...] = ()
    groups: tuple[str, ...] = ()


def header_of(rows: Sequence[Sequence[str]], width: int) -> Header:
    """The header in the rows above a table.

    Args:
        rows: cells of each row, from the top; titles and settings may stand among them.
        width: how many columns the table has.
    """
    kept = [list(row) for row in rows]
    if not kept:
        return Header()
    units: list[str] = []
    if len(kept) > 1 and _are_units(kept[-1]) and _names(kept[-2], width):
        units = kept.pop()
    labels = kept.pop()
    if not _names(labels, width):
        return Header()
    groups = kept[-1] if kept and _is_group_row(kept[-1], width) else []
    return Header(tuple(labels), tuple(units), tuple(_filled(groups, width)))


def _names(row: Sequence[str], width: int) -> bool:
    """Whether a row can name the columns: it has a cell for each, or a table has one column."""
    filled = sum(bool(cell) for cell in row)
    return filled > 0 and len(row) >= min(width, 2) and (filled > 1 or width <= 2)


def _are_units(row: Sequence[str]) -> bool:
    """Whether each cell that is not empty is a unit: "(m)", "[°]", "s"."""
    cells = [cell for cell in row if cell]
    bare = [cell.strip("()[]{} ") for cell in cells]
    bracketed = [cell[:1] + cell[-1:] in ("()", "[]", "{}") for cell in cells]
    known = [bool(each) and header_unit(each) is not None for each in bare]
    return bool(cells) and (all(known) or all(bracketed)) and any(known)


def _is_group_row(row: Sequence[str], width: int) -> bool:
    """Whether a row names tracks or runs, each above several columns."""
    filled = [i for i, cell in enumerate(row) if cell]
    if not filled or len(row) < min(width, 2):
        return False
    return len(filled) > 1 or filled[0] > 0


def _filled(row: Sequence[str], width: int) -> list[str]:
    """The cells, each standing for the empty ones behind it too."""
    filled: list[str] = []
    for i in range(width if row else 0):
        cell = row[i] if i < len(row) else ""
        filled.append(cell or (filled[-1] if filled else ""))
    return filled
