"""Several runs of one system over one another: angles, differences, energy errors, paths."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import NDArray

from pendula._checks import number, one_of, positive_number
from pendula.plot.given import axis, curve, curves, items
from pendula.plot.labels import Labels, labels
from pendula.plot.style import (
    BACKED,
    MARKERS,
    degree_ticks,
    for_logarithm,
    legend_above,
    line,
    logarithmic,
    panels,
    styled,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from numpy.typing import ArrayLike

    from pendula._types import Array
    from pendula.run.trajectory import Trajectory


class Fit(Protocol):
    """A straight line through errors in logarithms: error [rad] = constant · step ** order."""

    @property
    def order(self) -> float:
        """Slope of the line; nan where there is none."""

    @property
    def constant(self) -> float:
        """Its error at a step of 1 s [rad]."""

    @property
    def used(self) -> NDArray[np.bool_]:
        """Which points it was drawn through."""


_UNITS = {"difference": "deg", "energy_error": ""}  # of what `series` draws
_ROOM = 0.6  # a run may leave the first one's range by this part of it before the panel cuts it off


@styled
def angles(
    cases: Sequence[Mapping[str, Trajectory]], titles: Sequence[str] = (), *, language: str = "en"
) -> Figure:
    """Angles [°] against time: one panel per case, for the double pendulum one per angle.

    Args:
        cases: for each panel the runs by name ("exact", "linear", "reference" or a method's),
            the one to compare with first.
        titles: a short heading for each panel.
        language: "en" or "es".
    """
    words = labels(language)
    if next(iter(cases[0].values())).theta.ndim == 2:
        figure, axes = panels(2, 1, 4.2, words, sharex=True)
        for i in range(2):
            _angle_panel(axes[i, 0], cases[0], words, i)
            axes[i, 0].set_ylabel(words.axis[f"angle_{i + 1}"])
        axes[1, 0].set_xlabel(words.axis["time"])
    else:
        figure, axes = panels(len(cases), 1, 0.6 + 1.75 * len(cases), words)
        for ax, case in zip(axes[:, 0], cases, strict=True):
            _angle_panel(ax, case, words)
            ax.set_ylabel(words.axis["angle"])
        axes[-1, 0].set_xlabel(words.axis["time"])
    _head(axes, titles)
    legend_above(figure, axes[0, 0])
    return figure


@styled
def series(
    cases: Sequence[tuple[ArrayLike, Mapping[str, ArrayLike]]],
    quantity: str,
    titles: Sequence[str] = (),
    *,
    language: str = "en",
) -> Figure:
    """Errors against time on logarithmic axes, one panel per case, side by side.

    Args:
        cases: for each panel times [s], shape (n,), and by the run's name its error, shape (n,).
        quantity: what the errors are, "difference" [°] or "energy_error".
        titles: a short heading for each panel.
        language: "en" or "es".
    """
    words = labels(language)
    one_of("quantity", quantity, _UNITS)
    figure, axes = panels(1, len(cases), 2.7, words)
    for ax, (times, runs) in zip(axes[0], cases, strict=True):
        t = axis("t", times, "s")
        for name, values in curves("cases", runs, _UNITS[quantity], t).items():
            ax.plot(t, for_logarithm(values), label=words.name(name), **line(name))
        logarithmic(ax, "y")
        ax.set_xlim(t[0], t[-1])
        ax.set_xlabel(words.axis["time"])
    axes[0, 0].set_ylabel(words.axis[quantity])
    _head(axes, titles)
    legend_above(figure, axes[0, 0])
    return figure


@styled
def parting(
    t: ArrayLike,
    differences: Mapping[str, ArrayLike],
    times: Mapping[str, float],
    tolerance: float,
    *,
    language: str = "en",
) -> Figure:
    """How runs part from a reference, on a logarithmic axis.

    The time after which the reference itself is not to be trusted is shaded.

    Args:
        t: times [s], shape (n,).
        differences: largest angle difference [°] by the run's name, shape (n,); "reference" is
            that between the reference and its own repetitions.
        times: when each passed the tolerance [s]; inf: never.
        tolerance: [°].
        language: "en" or "es".
    """
    words = labels(language)
    t = axis("t", t, "s")
    differences = curves("differences", differences, "deg", t)
    times = {key: number(f"times[{key!r}]", each, "s") for key, each in items("times", times)}
    tolerance = positive_number("tolerance", tolerance, "deg")
    figure, axes = panels(1, 1, 3.2, words)
    ax = axes[0, 0]
    for name, values in differences.items():
        label = words.curve["repeated"] if name == "reference" else words.name(name)
        ax.plot(t, for_logarithm(values), label=label, **line(name) | {"linewidth": 1.1})
    logarithmic(ax, "y")
    ax.set_xlim(t[0], t[-1])
    ax.axhline(tolerance, color="#6b737c", linewidth=0.8)
    for name, moment in times.items():
        if np.isfinite(moment):
            _moment(ax, name, moment, tolerance, words)
    horizon = times.get("reference", np.inf)
    if np.isfinite(horizon):
        ax.axvspan(horizon, t[-1], color="#eceef1", linewidth=0, zorder=0)
    ax.set_xlabel(words.axis["time"])
    ax.set_ylabel(words.axis["difference_reference"])
    legend_above(figure, ax)
    return figure


@styled
def tip_paths(runs: Mapping[str, Trajectory], *, language: str = "en") -> Figure:
    """The path of the lower end [m], one panel per run, each over the first one's path.

    Args:
        runs: runs of one double pendulum by name, the one to compare with first.
        language: "en" or "es".
    """
    words = labels(language)
    (first, reference), *others = runs.items()
    figure, axes = panels(1, len(others), 2.2, words, sharex=True, sharey=True)
    for ax, (name, run) in zip(axes[0], others, strict=True):
        for which, drawn in ((first, reference), (name, run)):
            tip = drawn.system.positions(drawn.states)[:, -1]
            style = line(which) | {"linewidth": 0.9}
            if which == first:
                style |= {"color": "#8c949d", "linewidth": 1.8}
            ax.plot(tip[:, 0], tip[:, 1], label=words.name(which), **style)
        ax.plot(0, 0, "+", color="#4a525b", markersize=6)
        ax.set_aspect("equal")
        ax.set_title(words.name(name), color=line(name)["color"])
        ax.set_xlabel(words.axis["x"])
    axes[0, 0].set_ylabel(words.axis["y"])
    return figure


@styled
def convergence(
    steps: ArrayLike,
    cases: Sequence[Mapping[str, tuple[ArrayLike, Fit]]],
    titles: Sequence[str] = (),
    *,
    language: str = "en",
) -> Figure:
    """Error against step, both logarithmic, one panel per system, with the lines fitted.

    Args:
        steps: [s], shape (n,).
        cases: for each panel, by method, the errors [rad], shape (n,), and the line through them,
            as `pendula.analysis.convergence_order` gives it.
        titles: a heading for each panel.
        language: "en" or "es".
    """
    words = labels(language)
    steps = axis("steps", steps, "s")
    figure, axes = panels(1, len(cases), 3.1, words, sharey=True)
    for ax, case, title in zip(axes[0], cases, titles, strict=True):
        for name, (error, fit) in case.items():
            errors = curve(f"cases[{name!r}]", error, "rad", steps)
            _error_line(ax, name, steps, errors, fit, words=words)
        logarithmic(ax, "x", "y")
        ax.set_title(title)
        ax.set_xlabel(words.axis["step"])
    axes[0, 0].set_ylabel(words.axis["error"])
    legend_above(figure, axes[0, 0])
    return figure


def _error_line(
    ax: Axes, name: str, steps: Array, error: Array, fit: Fit, *, words: Labels
) -> None:
    """Errors as markers, full where the line was drawn through them; the line and its slope."""
    look: dict[str, Any] = {"color": line(name)["color"], "markersize": 3.5, "linestyle": "none"}
    shape, degrees, used = MARKERS[name], for_logarithm(np.degrees(error)), fit.used
    ax.plot(steps[~used], degrees[~used], shape, markerfacecolor="white", **look)
    ax.plot(steps[used], degrees[used], shape, **look)
    if not np.isfinite(fit.order):
        ax.plot([], [], label=words.name(name), **line(name))
        return
    fitted = np.degrees(fit.constant * steps[used] ** fit.order)
    ax.plot(steps[used], fitted, label=words.name(name), **line(name))
    middle = int(np.argsort(steps[used])[np.count_nonzero(used) // 2])
    # Below the line and to its right: on the left the axis may be near.
    ax.annotate(
        words.local(f"{fit.order:.2f}"),
        (steps[used][middle], fitted[middle]),
        xytext=(5, -2),
        textcoords="offset points",
        ha="left",
        va="top",
        color=look["color"],
    )


def _angle_panel(ax: Axes, case: Mapping[str, Trajectory], words: Labels, i: int = 0) -> None:
    drawn = []
    for name, run in case.items():
        theta = np.degrees(run.theta if run.theta.ndim == 1 else run.theta[:, i])
        ax.plot(run.t, theta, label=words.name(name), **line(name))
        drawn.append(theta)
    low, high = _window(drawn)
    ax.set_ylim(low, high)
    ax.set_xlim(0.0, next(iter(case.values())).t[-1])
    degree_ticks(ax, "y", low, high)


def _window(drawn: Sequence[Array]) -> tuple[float, float]:
    """The range to show: all of the first run, and the others as far as they stay near it."""
    low, high = float(np.min(drawn[0])), float(np.max(drawn[0]))
    room = _ROOM * (high - low)
    below = min(float(np.nanmin(d)) for d in drawn)
    above = max(float(np.nanmax(d)) for d in drawn)
    low, high = max(below, low - room), min(above, high + room)
    margin = 0.06 * (high - low) or 1.0
    return low - margin, high + margin


def _moment(ax: Axes, name: str, moment: float, tolerance: float, words: Labels) -> None:
    style: dict[str, Any] = {"color": line(name)["color"]}
    ax.plot(moment, tolerance, "o", markersize=4.5, **style)
    early = moment < 0.12 * ax.get_xlim()[1]
    ax.annotate(
        words.plain(moment) + " s",
        (moment, tolerance),
        xytext=(5 if early else -5, 6),
        textcoords="offset points",
        ha="left" if early else "right",
        bbox=BACKED,
        **style,
    )


def _head(axes: Any, titles: Sequence[str]) -> None:
    for ax, title in zip(axes.flat, titles, strict=False):
        ax.set_title(title)
