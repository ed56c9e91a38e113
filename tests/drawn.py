"""What stands in a figure."""

from __future__ import annotations

from typing import Any

from matplotlib.text import Text


def texts(figure: Any) -> str:
    """All of its texts, a line each."""
    figure.draw_without_rendering()
    found = [each.get_text() for each in figure.findobj(Text) if isinstance(each, Text)]
    return "\n".join(found)
