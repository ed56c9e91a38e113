"""The browser laboratory: links that are recipes, the server of its page, and its export."""

from __future__ import annotations

from pendula.lab.recipe import Recipe, read_link

__all__ = ["Recipe", "read_link"]
