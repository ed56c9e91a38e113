"""Attributes of files and datasets; in what `KEY` holds, so is called the version that made it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection

KEY = "pendula"  # what they were made from, as JSON
UNFINISHED = "unfinished"  # of a store whose chunks are not all there
_KINDS = {  # of files, by keys of their description
    "recording or fit": {"measured"},
    "sweep": {"sweep"},
    "chaos": {"chaos"},
    "map": {"map"},
    "ensemble": {"ensemble"},
    "comparison": {"reference", "outputs"},
    "trajectory": {"method", "state", "t"},
    "events": {"method", "state", "reached"},
}


def kind_of(known: Collection[str]) -> str | None:
    """What a file with such a description holds; None: nothing that pendula writes."""
    return next((kind for kind, names in _KINDS.items() if names <= set(known)), None)
