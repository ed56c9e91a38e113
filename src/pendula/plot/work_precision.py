"""Work against precision: what the error of each method costs."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._messages import ArgumentError
from pendula.plot.labels import Labels, labels
from pendula.plot.style import MARKERS, line, logarithmic, panels, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pendula.analysis import WorkPrecision

_FAMILIES: tuple[tuple[str, ...], ...] = (
    ("euler", "heun", "rk4", "dop853"),
    ("symplectic-euler", "verlet", "yoshida4", "yoshida6", "yoshida8"),
    ("midpoint", "gauss4", "gauss6", "gauss8"),
)
_LARGEST = 100.0  # an error beyond this [rad] is drawn at the upper edge, as a run that broke down
_ROOM = 3.0  # above the largest error and below the smallest
_SHADE = "#e8ebef"
_RESOLUTION: dict[str, Any] = {"color": "#6b737c", "linewidth": 1.0, "linestyle": ":"}


@styled
def work_precision(
    cases: Sequence[WorkPrecision],
    titles: Sequence[str] = (),
    *,
    against: Sequence[str] = ("evaluations", "seconds"),
    language: str = "en",
) -> Figure:
    """Error against evaluations and against time, one curve per method, all logarithmic.

    Runs that broke down are hollow marks at the upper edge. What the reference cannot resolve is
    shaded; the dotted line is the last bit of a double.

    Args:
        cases: as `pendula.analysis.work_precision` gives them; a row of panels each, or side by
            side if there is only one thing to draw against.
        titles: a heading for each case.
        against: "evaluations", "seconds" or both.
        language: "en" or "es".
    """
    if not isinstance(cases, Sequence) or not all(hasattr(each, "methods") for each in cases):
        rule = "must be a list of what pendula.analysis.work_precision returned, got {value}"
        raise ArgumentError("cases", rule, value=cases)
    words = labels(language)
    side_by_side = len(against) == 1
    rows, columns = (1, len(cases)) if side_by_side else (len(cases), len(against))
    figure, axes = panels(rows, columns, 0.9 + 3.1 * rows, words, sharey="row")
    grid = axes.T if side_by_side else axes
    for row, case in zip(grid, cases, strict=True):
        for ax, quantity in zip(row, against, strict=True):
            _panel(ax, case, quantity, words, _range(cases if side_by_side else [case]))
    for ax in axes[:, 0]:
        ax.set_ylabel(words.axis["error_rad"])
    for row, title in zip(grid, titles, strict=False):
        row[0].set_title(title)
    _legend(figure, cases, words)
    return figure


def _panel(
    ax: Axes, case: WorkPrecision, quantity: str, words: Labels, shown: tuple[float, float]
) -> None:
    low, high = shown
    for work in case.methods:
        cost = getattr(work, quantity)
        style = _style(work.method)
        within = (work.errors > 0) & (work.errors <= high)
        ax.plot(cost, np.where(within, work.errors, np.nan), **style)
        beyond = cost[~(work.errors <= high)]
        hollow = style | {"linestyle": "none", "markerfacecolor": "white", "markeredgewidth": 1.0}
        marks = ax.plot(beyond, np.full(len(beyond), high), **hollow, clip_on=False, zorder=4)
        marks[0].set_in_layout(False)
    logarithmic(ax, "x", "y")
    ax.set_ylim(low, high)
    ax.axhspan(low, case.reference_error, color=_SHADE, linewidth=0, zorder=0)
    ax.axhline(case.resolution, **_RESOLUTION, zorder=1)
    ax.set_xlabel(words.axis[quantity])


def _range(cases: Sequence[WorkPrecision]) -> tuple[float, float]:
    """The range of errors to show in panels side by side."""
    errors = np.concatenate([work.errors for case in cases for work in case.methods])
    shown = errors[(errors > 0) & (errors <= _LARGEST)]
    low = min(*(case.resolution for case in cases), float(shown.min(initial=np.inf)))
    high = max(*(case.reference_error for case in cases), float(shown.max(initial=0.0)))
    return low / _ROOM, high * _ROOM


def _legend(figure: Figure, cases: Sequence[WorkPrecision], words: Labels) -> None:
    """One legend over all panels: a column for each family of methods, the last with the rest."""
    from matplotlib.lines import Line2D
    from matplotlib.patches import Patch

    drawn = dict.fromkeys(work.method for case in cases for work in case.methods)
    columns: list[list[Any]] = []
    for family in (*_FAMILIES, [name for name in drawn if name not in sum(_FAMILIES, ())]):
        named = [(words.name(name), _style(name)) for name in family if name in drawn]
        columns.append([Line2D([], [], label=label, **style) for label, style in named])
    hollow: dict[str, Any] = {
        "color": "#6b737c",
        "marker": "o",
        "markerfacecolor": "white",
        "markersize": 4,
    }
    highest = _range(cases)[1]
    if any((~(work.errors <= highest)).any() for case in cases for work in case.methods):
        marks = Line2D([], [], label=words.curve["beyond"], linestyle="none", **hollow)
        columns[-1].append(marks)
    columns[-1] += [
        Patch(facecolor=_SHADE, label=words.curve["reference_error"]),
        Line2D([], [], label=words.curve["resolution"], **_RESOLUTION),
    ]
    columns = [each for each in columns if each]
    height = max(map(len, columns))
    empty = Line2D([], [], linestyle="none", label="")
    handles = [h for each in columns for h in (*each, *[empty] * (height - len(each)))]
    figure.legend(handles=handles, loc="outside upper left", ncols=len(columns))


def _style(method: str) -> dict[str, Any]:
    size = 5.5 if method == "taylor" else 3.8  # a star has little surface
    mark = {"marker": MARKERS.get(method, "v"), "markersize": size, "markeredgewidth": 0.5}
    return line(method) | mark
