"""A figure that notebooks show without pyplot, and that puts the cells of maps on whole pixels."""

from __future__ import annotations

import math
from contextlib import contextmanager
from io import BytesIO
from typing import TYPE_CHECKING, Any

from matplotlib.figure import Figure

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.axes import Axes

DOTS = 200  # an inch, of a picture of pixels, or more where a map has more cells
_MOST_SHOWN = 300  # dots an inch in a notebook, which keeps its pictures as text
_SCREEN = 100  # dots an inch of a screen, as matplotlib takes it


class ShownFigure(Figure):
    """What the functions of `pendula.plot` return.

    Attributes:
        cells: the axes of a map, and the cells along x and y; None: no map.
    """

    cells: tuple[Axes, tuple[int, int]] | None = None

    def savefig(self, fname: Any, *, transparent: bool | None = None, **options: Any) -> None:
        """Write the figure, at 200 dots an inch or more: a map gets whole pixels for each cell."""
        dots = options.pop("dpi", None)
        with self._on_whole_pixels(dots) as fitting:
            super().savefig(fname, transparent=transparent, dpi=fitting, **options)

    def _repr_png_(self) -> tuple[bytes, dict[str, int]]:
        """What a notebook shows, with its size on the page."""
        buffer, size = BytesIO(), self.get_size_inches() * _SCREEN
        with self._on_whole_pixels(None) as fitting:
            shown = fitting if fitting <= _MOST_SHOWN else DOTS
            super().savefig(buffer, format="png", dpi=shown)
        return buffer.getvalue(), {"width": round(size[0]), "height": round(size[1])}

    @contextmanager
    def _on_whole_pixels(self, dots: float | None) -> Iterator[float]:
        """The dots an inch, with the axes of a map moved by less than a pixel while it is drawn.

        Where none are asked for they are as many as give each cell a whole number of pixels along
        x, and along y where the cells are square or nearly so; at least one everywhere.
        """
        if self.cells is None or dots is not None:
            yield DOTS if dots is None else dots
            return
        ax, (columns, rows) = self.cells
        engine, aspect, before = self.get_layout_engine(), ax.get_aspect(), ax.get_position(True)
        self.draw_without_rendering()
        place, size = ax.get_position(), self.get_size_inches()
        width, height = place.width * size[0], place.height * size[1]  # inches
        least = max(DOTS, columns / width, rows / height)
        across = math.ceil(round(least * width / columns, 9)) * columns
        fitting = across / width
        up = _near(fitting * height, rows)
        whole = size * fitting
        left, low = round(place.x0 * whole[0]), round(place.y0 * whole[1])
        try:
            self.set_layout_engine("none")
            ax.set_aspect("auto")
            ax.set_position((left / whole[0], low / whole[1], across / whole[0], up / whole[1]))
            yield fitting
        finally:
            ax.set_position(before)
            ax.set_in_layout(True)  # which `set_position` ends
            ax.set_aspect(aspect)
            self.set_layout_engine(engine)


def _near(pixels: float, cells: int) -> int:
    """The multiple of the cells that is nearest, or whole pixels where none is within 2 %."""
    fitting = cells * round(pixels / cells)
    return fitting if abs(fitting - pixels) <= 0.02 * pixels else math.ceil(pixels)
