"""Tables in HTML, as which objects show themselves in a notebook."""

from __future__ import annotations

from html import escape
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

_LEFT = ' style="text-align: left"'


def html_table(title: str, rows: Iterable[tuple[str, ...]]) -> str:
    """A table with a title; the first cell of each row is its name. All text is escaped."""
    lines = [
        "<tr>"
        + f"<th{_LEFT}>{escape(name)}</th>"
        + "".join(f"<td{_LEFT}>{escape(cell)}</td>" for cell in cells)
        + "</tr>"
        for name, *cells in rows
    ]
    caption = f"<caption{_LEFT}><strong>{escape(title)}</strong></caption>"
    return "\n".join([f"<table>{caption}<tbody>", *lines, "</tbody></table>"])
