"""A table as a file holds it: columns of numbers, with what their header says."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from pendula.measured.headings import Heading, heading_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from pendula._types import Array


@dataclass(frozen=True, eq=False)
class Column:
    """One column of a table.

    Attributes:
        number: its place in the file's table, from 1.
        label: what its header says, without what stands around it; empty: it has no header.
        values: its numbers, NaN where a cell is empty or no number, (n,).
        heading: what the label means.
        group: what stands above the label: a track, or a run; empty: nothing.
    """

    number: int
    label: str
    values: Array
    heading: Heading
    group: str = ""

    def __str__(self) -> str:
        """How messages call it: by its label, or its number."""
        return repr(self.label) if self.label else f"column {self.number}"


@dataclass(frozen=True, eq=False)
class Table:
    """The columns of one table.

    Attributes:
        name: of the sheet, or the file in an archive; empty: the file has one table only.
        columns: those that hold any number.
        lines: number of each row in its file, from 1, (n,).
        notes: what was understood or changed on the way, a sentence each.
        what: how messages call a row of the file: "line", "row", "frame" or "sample".
    """

    name: str
    columns: tuple[Column, ...]
    lines: Array
    notes: tuple[str, ...] = ()
    what: str = "line"

    def of(self, columns: Iterable[Column]) -> Table:
        """The same table with these of its columns only."""
        return replace(self, columns=tuple(columns))

    def rows(self, which: Array | slice) -> Table:
        """The same table with these of its rows only, without columns that are empty there."""
        import numpy as np

        columns = (replace(each, values=each.values[which]) for each in self.columns)
        kept = tuple(each for each in columns if np.isfinite(each.values).any())
        return replace(self, columns=kept, lines=self.lines[which])

    def noted(self, *notes: str) -> Table:
        """The same table with further notes."""
        return replace(self, notes=(*self.notes, *notes))


def table_of(
    name: str,
    labels: Sequence[str],
    values: Sequence[Array],
    *,
    groups: Sequence[str] = (),
    units: Sequence[str] = (),
    lines: Array | None = None,
    notes: Iterable[str] = (),
    what: str = "line",
) -> Table:
    """A table of what a file holds, without columns that are empty.

    Args:
        name: of the table.
        labels: of the columns, as the file writes them; none at all: it has no header.
        values: of the columns.
        groups: what stands above the labels.
        units: what stands below the labels.
        lines: of the rows in the file; None: they are counted from 1.
        notes: what was understood so far.
        what: a row of the file is called.
    """
    import numpy as np

    columns = []
    for i, column in enumerate(values):
        if not np.isfinite(column).any():
            continue
        label = labels[i].strip() if i < len(labels) else ""
        group = groups[i].strip() if i < len(groups) else ""
        unit = units[i].strip() if i < len(units) else ""
        heading = heading_of(label, unit=unit, group=group)
        columns.append(Column(i + 1, label, column, heading, group))
    count = len(values[0]) if values else 0
    rows = np.arange(1.0, count + 1) if lines is None else lines
    return Table(name, tuple(columns), rows, tuple(notes), what)
