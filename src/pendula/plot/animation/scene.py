"""Draws the frames: pendulums over one another, paths behind their bobs, energies as bars."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula.plot.style import FAINT, INK, localise

if TYPE_CHECKING:
    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from numpy.typing import NDArray

    from pendula._types import Array
    from pendula.plot.animation.motions import Motion
    from pendula.plot.labels import Labels

    Picture = NDArray[np.uint8]

# Okabe & Ito's palette, ink first; more motions than that take a scale of colours.
_COLOURS = (INK, "#d55e00", "#0072b2", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
_MOST_BARS = 8
_NARROWEST = 320  # pixels that have room for bars
_DOTS = 100  # an inch
_PIVOT = "#4a525b"
_PALE = 0.45  # opacity of potential energy
_ROOM = 0.09  # around all that is reached, as a part of it
_HEAD, _FOOT = 44, 58  # pixels for the clock and the names, and for what the bars mean


@dataclass(frozen=True, eq=False)
class Film:
    """What is shown.

    Attributes:
        motions: each at the fine times.
        names: of the motions; empty: none is shown.
        times: of the frames, (n,) [s].
        parts: fine times from one frame to the next.
        trail: fine times whose path is behind a bob.
        speed: seconds of the motion in one that is watched.
        energy: whether bars show the energies.
        size: width and height, even [pixels].
    """

    motions: list[Motion]
    names: tuple[str, ...]
    times: Array
    parts: int
    trail: int
    speed: float
    energy: bool
    size: tuple[int, int]


class Scene:
    """Draws frame after frame on what stays the same."""

    def __init__(self, film: Film, words: Labels) -> None:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        self._film, self._words = film, words
        width, height = film.size
        figure = Figure(figsize=(width / _DOTS, height / _DOTS), dpi=_DOTS)
        self._canvas: Any = FigureCanvasAgg(figure)
        head = _HEAD / height
        bars = film.energy and len(film.motions) <= _MOST_BARS and width >= _NARROWEST
        room = min(0.5, (120 + 24 * len(film.motions)) / width) if bars else 0.0
        self._colours = _colours(len(film.motions))
        self._moving: list[tuple[Any, Artist]] = []
        plane = figure.add_axes((0.0, 0.0, 1.0 - room, 1.0 - head))
        self._pendulums = [
            _Pendulum(plane, each, colour, order)
            for order, (each, colour) in enumerate(zip(film.motions, self._colours, strict=True))
        ]
        _frame(plane, film.motions, (1.0 - room) * width / (height - _HEAD))
        self._bars = None
        if bars:
            edge = 70 / width
            foot = _FOOT / height
            up = 1.0 - 1.6 * head - foot  # a title is above
            axes = figure.add_axes((1.0 - room + edge, foot, room - edge - 0.02, up))
            self._bars = _Bars(axes, film.motions, self._colours, words)
        self._clock = figure.text(0.02, 1.0 - 0.5 * head, "", size=13, va="center", animated=True)
        self._name(figure)
        self._still = self._drawn_still(figure)
        self._figure = figure

    def _drawn_still(self, figure: Any) -> Any:
        """What does not move."""
        self._canvas.draw()
        return self._canvas.copy_from_bbox(figure.bbox)

    def _name(self, figure: Any) -> None:
        """Names in their colours, from the right."""
        from matplotlib.lines import Line2D

        names, colours = self._film.names, self._colours
        if names:
            lines = [Line2D([], [], color=colour, linewidth=3) for colour in colours]
            figure.legend(
                lines[: len(names)],
                names,
                loc="upper right",
                ncols=min(4, len(names)),
                handlelength=1.2,
                fontsize=10 if len(names) <= 4 else 8,
            )

    def __len__(self) -> int:
        return len(self._film.times)

    def draw(self, frame: int) -> Picture:
        """A frame, (height, width, 3)."""
        film, place = self._film, frame * self._film.parts
        self._canvas.restore_region(self._still)
        renderer = self._canvas.get_renderer()
        for each in self._pendulums:
            each.draw(renderer, place, max(0, place - film.trail))
        if self._bars is not None:
            self._bars.draw(renderer, place)
        time = self._words.local(f"{film.times[frame]:.2f}")
        pace = "" if film.speed == 1.0 else f"   {self._words.local(f'{film.speed:g}')}×"
        self._clock.set_text(f"t = {time} s{pace}")
        self._clock.draw(renderer)
        return np.asarray(self._canvas.buffer_rgba())[..., :3].copy()


class _Pendulum:
    """Rods, bobs and the path behind the last one."""

    def __init__(self, ax: Axes, motion: Motion, colour: str, order: int) -> None:
        from matplotlib.collections import LineCollection
        from matplotlib.colors import to_rgb

        self._points, self._colour = motion.points, to_rgb(colour)
        # The first motion, which the others are compared with, is drawn broader, beneath them.
        broad = order == 0
        rods = motion.system.form == "rods"
        self._path = LineCollection([], linewidths=1.8, animated=True, capstyle="butt")
        ax.add_collection(self._path, autolim=False)
        (self._rods,) = ax.plot(
            [],
            [],
            color=colour,
            linewidth=(5.0 if broad else 2.4) if rods else (2.6 if broad else 1.5),
            marker="o",
            markersize=(6.0 if broad else 4.0) if rods else (14.0 if broad else 9.0),
            markevery=slice(1, None),
            solid_capstyle="round",
            animated=True,
        )
        (self._pivot,) = ax.plot([0.0], [0.0], "o", color=_PIVOT, markersize=5, animated=True)

    def draw(self, renderer: Any, place: int, start: int) -> None:
        """Draw the pendulum at a place, and its path from another on."""
        joints = self._points[place]
        if np.isfinite(joints).all():
            path = self._points[start : place + 1, -1]
            segments = np.stack([path[:-1], path[1:]], axis=1)
            there = np.isfinite(segments).all(axis=(1, 2))
            opacity = np.linspace(0.0, 0.75, len(segments) + 1)[1:]
            self._path.set_segments(list(segments[there]))
            self._path.set_colors([(*self._colour, each) for each in opacity[there]])
            self._path.draw(renderer)
            self._rods.set_data([0.0, *joints[:, 0]], [0.0, *joints[:, 1]])
            self._rods.draw(renderer)
        self._pivot.draw(renderer)


class _Bars:
    """Kinetic energy, and potential energy on top of it, a bar for each motion."""

    def __init__(self, ax: Axes, motions: list[Motion], colours: list[str], words: Labels) -> None:
        from matplotlib.patches import Patch

        self._motions = motions
        highest = max(float(np.nanmax(each.kinetic + each.potential)) for each in motions)
        ax.set_xlim(-0.6, len(motions) - 0.4)
        ax.set_ylim(0.0, 1.04 * highest if highest > 0 else 1.0)
        ax.set_xticks([])
        ax.grid(visible=False, axis="x")
        localise(ax, words)
        ax.set_title(words.axis["energy"], fontsize=9)
        places, none = range(len(motions)), [0.0] * len(motions)
        self._kinetic = ax.bar(places, none, 0.7, color=colours, animated=True)
        self._potential = ax.bar(places, none, 0.7, color=colours, alpha=_PALE, animated=True)
        key = colours[0] if len(motions) == 1 else _PIVOT
        ax.legend(
            [Patch(color=key, alpha=_PALE), Patch(color=key)],
            [words.curve["potential"], words.curve["kinetic"]],
            loc="upper center",
            bbox_to_anchor=(0.4, -0.03),
            handlelength=0.9,
            fontsize=8,
        )

    def draw(self, renderer: Any, place: int) -> None:
        """Draw the energies at a place."""
        for i, each in enumerate(self._motions):
            kinetic, potential = each.kinetic[place], each.potential[place]
            if np.isfinite(kinetic):
                self._kinetic[i].set_height(kinetic)
                self._potential[i].set_y(kinetic)
                self._potential[i].set_height(potential)
                self._kinetic[i].draw(renderer)
                self._potential[i].draw(renderer)


def _frame(ax: Axes, motions: list[Motion], shape: float) -> None:
    """Show the pivot and all that is ever reached, to scale, in a field of this width/height."""
    low, high = np.zeros(2), np.zeros(2)
    for each in motions:
        points = each.points.reshape(-1, 2)
        low = np.minimum(low, np.nanmin(points, axis=0))
        high = np.maximum(high, np.nanmax(points, axis=0))
    across, up = (high - low).tolist()
    half = (0.5 + _ROOM) * max(up, across / shape)
    x, y = (low + high) / 2
    ax.set_xlim(x - half * shape, x + half * shape)
    ax.set_ylim(y - half, y + half)
    ax.axhline(0.0, color=FAINT, linewidth=0.8, zorder=0)
    ax.set_axis_off()


def _colours(count: int) -> list[str]:
    """A colour for each motion."""
    if count <= len(_COLOURS):
        return list(_COLOURS[:count])
    from matplotlib import colormaps
    from matplotlib.colors import to_hex

    return [to_hex(colour) for colour in colormaps["turbo"](np.linspace(0.03, 0.97, count))]
