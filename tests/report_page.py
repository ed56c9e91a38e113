"""A page of the report, as the tests read it."""

from __future__ import annotations

import html.parser
import unicodedata
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

# What a formula shows otherwise than plain text: its own sum and product, no sign of an exponent,
# a bar for a slash, and parentheses only where they are needed.
_SHOWN = str.maketrans({"Σ": "∑", "·": "⋅"} | dict.fromkeys("()/^\u2044"))


class Page(html.parser.HTMLParser):
    """What a page refers to, its text without scripts and styles, and the cells of its tables."""

    def __init__(self, source: str) -> None:
        super().__init__()
        self.references: list[str] = []
        self.text: list[str] = []
        self.classes: list[str] = []
        self.tags: list[str] = []
        self.cells: list[dict[str, str]] = []
        """Of each cell the `words`, the `formulas`, and `all` as it is read."""
        self._inside: list[str] = []
        self.feed(source)

    @property
    def words(self) -> str:
        """The text on one line."""
        return " ".join(" ".join(self.text).split())

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        given = dict(attrs)
        self.classes += (given.get("class") or "").split()
        self.references += [given[key] or "" for key in ("src", "href", "data") if key in given]
        if tag in ("script", "style", "td", "math"):
            self._inside.append(tag)
        if tag == "td":
            self.cells.append({"words": "", "formulas": "", "all": ""})

    def handle_endtag(self, tag: str) -> None:
        if tag in ("script", "style", "td", "math"):
            self._inside.pop()

    def handle_data(self, data: str) -> None:
        if {"script", "style"} & set(self._inside):
            return
        self.text.append(data)
        if "td" in self._inside:
            self.cells[-1]["formulas" if "math" in self._inside else "words"] += data
            self.cells[-1]["all"] += data


def page(folder: Path) -> Page:
    """The page in the folder of a study."""
    return Page((folder / "report.html").read_text(encoding="utf-8"))


def signs(text: str) -> str:
    """The signs of a text in their order, whether it is plain or set as mathematics."""
    return "".join(unicodedata.normalize("NFKC", text).translate(_SHOWN).split())
