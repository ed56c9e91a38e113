"""One look for all figures.

A run has the same colour and line everywhere, and numbers have the language's decimal sign.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager, nullcontext
from functools import wraps
from io import BytesIO
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

import numpy as np

from pendula._checks import extra
from pendula.plot.labels import Labels

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pendula._types import Array

P = ParamSpec("P")
Drawn = TypeVar("Drawn")

INK = "#1b1f24"
FAINT = "#b9bec5"
_MOST = 1e9  # an error beyond this is no error any more, and would flatten all the others
WIDTH = 6.4  # inches; the width of the report's column

# Okabe & Ito's palette ("Color Universal Design", 2008); line styles distinguish runs, too.
_LINES: dict[str, dict[str, Any]] = {
    "exact": {"color": INK, "linestyle": "-", "linewidth": 1.5},
    "reference": {"color": INK, "linestyle": "-", "linewidth": 1.5},
    "linear": {"color": "#cc79a7", "linestyle": (0, (6, 2)), "linewidth": 1.6},
    "euler": {"color": "#d55e00", "linestyle": (0, (5, 1.5)), "linewidth": 1.3},
    "heun": {"color": "#0072b2", "linestyle": (0, (6, 1.5, 1, 1.5)), "linewidth": 1.3},
    "rk4": {"color": "#009e73", "linestyle": (0, (1.2, 1.2)), "linewidth": 1.8},
    "dop853": {"color": "#3fa9e0", "linestyle": "-", "linewidth": 1.3},
    "taylor": {"color": "#c2185b", "linestyle": "-", "linewidth": 1.7},
}
# Families of methods: one line style each, and the darker, the higher the order.
_FAMILIES: tuple[tuple[Any, dict[str, str]], ...] = (
    (
        (0, (4, 1.2)),
        {
            "symplectic-euler": "#c3a5e3",
            "verlet": "#a578d3",
            "yoshida4": "#8650be",
            "yoshida6": "#63309b",
            "yoshida8": "#3f1270",
        },
    ),
    (
        (0, (4, 1.2, 1, 1.2)),
        {"midpoint": "#dcbf85", "gauss4": "#c19337", "gauss6": "#946a12", "gauss8": "#5c4004"},
    ),
)
for _style, _shades in _FAMILIES:
    _LINES |= {
        name: {"color": shade, "linestyle": _style, "linewidth": 1.2}
        for name, shade in _shades.items()
    }
_OTHER: dict[str, Any] = {"color": "#e69f00", "linestyle": "-", "linewidth": 1.3}
# One for each order, so that methods of the same order look alike.
MARKERS = {
    **dict.fromkeys(("euler", "symplectic-euler"), "o"),
    **dict.fromkeys(("heun", "verlet", "midpoint"), "s"),
    **dict.fromkeys(("rk4", "yoshida4", "gauss4"), "^"),
    **dict.fromkeys(("yoshida6", "gauss6"), "D"),
    **dict.fromkeys(("yoshida8", "gauss8", "dop853"), "p"),
    "taylor": "*",
}
_FONT = b"'DejaVu Sans'"
_FONTS = _FONT + b", Verdana, sans-serif"  # Verdana's letters are as wide
BACKED = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.6}
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")

_RC: dict[str, Any] = {
    "font.family": "DejaVu Sans",
    "font.size": 8.5,
    "axes.labelsize": 8.5,
    "axes.edgecolor": "#6b737c",
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 8.5,
    "axes.titlelocation": "left",
    "axes.grid": True,
    "grid.color": "#e3e6ea",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "legend.handlelength": 2.6,
    "lines.dash_capstyle": "butt",
    "text.color": INK,
    "xtick.color": "#4a525b",
    "ytick.color": "#4a525b",
    "xtick.labelsize": 8,
    "ytick.labelsize": 8,
    # The same figure must give the same bytes: no random identifiers.
    "svg.hashsalt": "pendula",
    # Letters stay text, which can be searched, read aloud and edited.
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
}


def styled(draw: Callable[P, Drawn]) -> Callable[P, Drawn]:
    """Let a function draw in this look; matplotlib is only imported when it is called.

    What it draws into axes that it is given has the look of these.
    """

    @wraps(draw)
    def drawn(*args: P.args, **kwargs: P.kwargs) -> Drawn:
        with look() if kwargs.get("ax") is None else nullcontext():
            return draw(*args, **kwargs)

    return drawn


@contextmanager
def look() -> Iterator[None]:
    """A context in which matplotlib draws in this look."""
    matplotlib = extra("matplotlib", "report")
    with matplotlib.rc_context():
        # From the defaults on, whatever a user's own settings are: figures are the same everywhere.
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(_RC)
        yield


def panels(
    rows: int, columns: int, height: float, words: Labels, **options: Any
) -> tuple[Figure, Any]:
    """A figure of rows × columns panels, `height` inches high, numbers in the language's way."""
    from pendula.plot.shown import ShownFigure

    figure = ShownFigure(figsize=(WIDTH, height), layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False, **options)
    for ax in axes.flat:
        localise(ax, words)
    return figure, axes


def given_or_new(ax: Axes | None, height: float, words: Labels) -> tuple[Any, Axes]:
    """Axes and the figure they are in: those given, or new ones alone, `height` inches high."""
    if ax is None:
        figure, axes = panels(1, 1, height, words)
        return figure, axes[0, 0]
    localise(ax, words)
    return ax.get_figure(root=True), ax


def localise(ax: Axes, words: Labels) -> None:
    """Write the numbers on the axes of one panel in the language's way."""
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_major_formatter(_number_formatter(words))


def _number_formatter(words: Labels) -> Any:
    from matplotlib.ticker import ScalarFormatter

    class Formatter(ScalarFormatter):
        def __call__(self, x: float, pos: int | None = None) -> str:
            return words.local(str(super().__call__(x, pos)))

    formatter = Formatter(useOffset=False)
    formatter.set_scientific(False)
    return formatter


def line(run: str) -> dict[str, Any]:
    """Colour, line style and width of a run, for `Axes.plot`."""
    return dict(_LINES.get(run, _OTHER))


def logarithmic(ax: Axes, *axes: str) -> None:
    """Give an axis ("x", "y" or both) a logarithmic scale, with powers of ten at the ticks.

    Call it when all lines are drawn: it widens a range of less than two powers of ten.
    """
    from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

    for name in axes:
        getattr(ax, f"set_{name}scale")("log", nonpositive="mask")
        axis = getattr(ax, f"{name}axis")
        low, high = getattr(ax, f"get_{name}lim")()
        if name == "y" and low > 0 and high / low < 100:
            ax.set_ylim(low / 10, high * 10)
        axis.set_major_locator(LogLocator(numticks=8))
        axis.set_major_formatter(FuncFormatter(power_of_ten))
        axis.set_minor_locator(NullLocator())


def for_logarithm(values: Array) -> Array:
    """Errors with those left out that a logarithmic axis cannot show, or only them.

    Those are zero, and the errors of runs that blew up.
    """
    return np.where((values > 0) & (values < _MOST), values, np.nan)


def power_of_ten(x: float, _: int) -> str:
    """A tick of a logarithmic axis."""
    return "10" + str(round(np.log10(x))).translate(_SUPERSCRIPTS) if x > 0 else ""


def degree_ticks(ax: Axes, axis: str, low: float, high: float, most: int = 7) -> None:
    """Put at most so many ticks of an angle axis [°] on parts of a turn, if the range allows."""
    from matplotlib.ticker import MultipleLocator

    span = high - low
    steps = (0.2, 0.5, 1, 2, 5, 10, 15, 30, 45, 90, 180, 360)
    fitting = [s for s in steps if span / s <= most]
    if fitting and np.isfinite(span) and span > 0:
        getattr(ax, f"{axis}axis").set_major_locator(MultipleLocator(fitting[0]))


def legend_above(figure: Figure, ax: Axes, columns: int = 5) -> None:
    """Put one legend over all panels, made from the labelled lines of one of them."""
    handles, names = ax.get_legend_handles_labels()
    figure.legend(handles, names, loc="outside upper left", ncols=columns)


def svg(figure: Figure) -> bytes:
    """A figure as SVG: the same figure gives the same bytes, no date within."""
    return picture(figure, "svg")


def picture(figure: Figure, kind: str, dots: float | None = None) -> bytes:
    """A figure as "svg", "pdf" or "png", the same bytes each time.

    Letters are text in SVG and PDF, in DejaVu Sans or, where a reader of SVG has it not, in the
    like.

    Args:
        figure: what a function of `pendula.plot` returned.
        kind: "svg", "pdf" or "png".
        dots: an inch, of "png"; None: 200, or as many as give each cell of a map whole pixels.
    """
    undated: dict[str, Any] = {
        "svg": {"Date": None, "Creator": None},
        "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
        "png": {"Software": None},
    }
    buffer = BytesIO()
    with look():
        figure.savefig(buffer, format=kind, metadata=undated[kind], dpi=dots)
    drawn = buffer.getvalue()
    return drawn.replace(_FONT, _FONTS) if kind == "svg" else drawn
