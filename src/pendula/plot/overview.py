"""One run at a glance."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from pendula._engine import method_named
from pendula._late_methods import method_of
from pendula._messages import ArgumentError
from pendula.plot.animation.motions import finer
from pendula.plot.labels import Labels, labels
from pendula.plot.style import (
    INK,
    degree_ticks,
    for_logarithm,
    localise,
    logarithmic,
    panels,
    styled,
)
from pendula.run.trajectory import Trajectory

if TYPE_CHECKING:
    from collections.abc import Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_SECOND = "#0072b2"
_SMOOTH = 2000  # points that make a line of that length smooth


@method_of(Trajectory)
def plot(run: Trajectory, *, ax: Any = None, language: str = "en") -> Any:
    """Angles, phase portrait or path, and energy error in one figure (extra: report).

    `ax` and `language` are as for `pendula.plot.trajectory`.
    """
    return trajectory(run, ax=ax, language=language)


@overload
def trajectory(trajectory: Trajectory, *, ax: None = None, language: str = "en") -> Figure: ...


@overload
def trajectory(
    trajectory: Trajectory, *, ax: Axes | Sequence[Axes], language: str = "en"
) -> Any: ...


@styled
def trajectory(trajectory: Trajectory, *, ax: Any = None, language: str = "en") -> Any:
    """One run at a glance: angles, phase portrait or path of the tip, energy error.

    Args:
        trajectory: what `solve` or `exact` returned, with states of shape (n, 2) or (n, 4).
        ax: axes to draw into: one, for the angles alone, or three, for the angles, the energy error
            and the portrait or path; None: a figure of its own.
        language: "en" or "es".

    Returns:
        A figure, which a notebook shows, for `.savefig(path)`; or the axes given.

    Raises:
        ValueError: for several trajectories at once, one without outputs, anything else, other
            axes, or an unknown language.
    """
    _check(trajectory)
    words = labels(language)
    if ax is not None:
        _into(_axes(ax), trajectory, words)
        return ax
    figure, axes = panels(2, 2, 4.4, words, gridspec_kw={"width_ratios": (1.4, 1)})
    grid = axes[0, 1].get_gridspec()
    for panel in axes[:, 1]:
        panel.remove()
    curve = _between_steps(trajectory)
    _angles(axes[0, 0], curve, words)
    _energy(axes[1, 0], trajectory, words)
    axes[0, 0].sharex(axes[1, 0])
    axes[0, 0].tick_params(labelbottom=False)
    plane = figure.add_subplot(grid[:, 1])
    localise(plane, words)
    _plane(plane, curve, words)
    return figure


def _axes(ax: Any) -> list[Axes]:
    """The axes that were given, one or three."""
    from matplotlib.axes import Axes

    given = list(np.ravel(np.asarray(ax, dtype=object)))
    if len(given) not in (1, 3) or not all(isinstance(each, Axes) for each in given):
        raise ArgumentError(
            "ax",
            "must be axes of matplotlib, one for the angles or three for angles, energy error and "
            "portrait or path, got {text}",
            text=f"{len(given)} of {type(given[0]).__name__}" if given else "none",
        )
    return given


def _into(axes: list[Axes], run: Trajectory, words: Labels) -> None:
    """Draw the angles, and where there is room the energy error and the portrait or path."""
    curve = _between_steps(run)
    drawn = ((_angles, curve), (_energy, run), (_plane, curve))
    for ax, (draw, each) in zip(axes, drawn, strict=False):
        localise(ax, words)
        draw(ax, each, words)
    if len(axes) == 1:
        axes[0].set_xlabel(words.axis["time"])


def _check(given: object) -> None:
    """Refuse what cannot be drawn as one run."""
    name = "trajectory"
    if not isinstance(given, Trajectory):
        rule, way_out = "must be what solve or exact returned, got {value}", ""
        if hasattr(given, "data_vars"):
            way_out = "draw maps with plot.flip_map or plot.divergence_map"
        raise ArgumentError(name, rule, way_out, value=given)
    if given.states.ndim != 2:
        rule, way_out = "must be one motion, got states of shape {value}", "draw them one by one"
        raise ArgumentError(name, rule, way_out, value=given.states.shape)
    if not given.t.size:
        rule = "has no outputs to draw: the run ended as {value} before the first of them"
        way_out = "ask for earlier times, or more steps"
        raise ArgumentError(name, rule, way_out, value=given.outcome)


def _between_steps(run: Trajectory) -> Trajectory:
    """The run with times between its outputs where those are the few steps of an adaptive method.

    Straight lines from one such step to the next would be seen.
    """
    asked = run.request
    few = isinstance(asked.t, float) and asked.digits is None and 1 < run.t.size < _SMOOTH
    if not few or not method_named(run.method).adaptive:
        return run
    times = finer(run.t, math.ceil(_SMOOTH / run.t.size))
    return replace(run, t=times, states=run.at(times))


def _angles(ax: Axes, run: Trajectory, words: Labels) -> None:
    theta = np.degrees(run.theta)
    if theta.ndim == 1:
        ax.plot(run.t, theta, color=INK, linewidth=1.2)
        ax.set_ylabel(words.axis["angle"])
    else:
        ax.plot(run.t, theta[:, 0], color=INK, linewidth=1.2, label="θ₁")
        ax.plot(run.t, theta[:, 1], color=_SECOND, linewidth=1.2, linestyle="--", label="θ₂")
        ax.legend(loc="best", ncols=2)
        ax.set_ylabel(words.axis["angle"])
    degree_ticks(ax, "y", float(np.nanmin(theta)), float(np.nanmax(theta)))


def _energy(ax: Axes, run: Trajectory, words: Labels) -> None:
    error = np.abs(run.energy_error)
    ax.plot(run.t, for_logarithm(error), color=INK, linewidth=1.0)
    if np.any(error > 0):
        logarithmic(ax, "y")
    ax.set_xlabel(words.axis["time"])
    ideal = run.system.can.conservative
    ax.set_ylabel(words.axis["energy_error" if ideal else "energy_defect"])


def _plane(ax: Axes, run: Trajectory, words: Labels) -> None:
    style: dict[str, Any] = {"color": INK, "linewidth": 0.9}
    if run.theta.ndim == 1:
        theta = np.degrees(run.theta)
        ax.plot(theta, run.omega, **style)
        ax.set_xlabel(words.axis["angle"])
        ax.set_ylabel(words.axis["rate"])
        degree_ticks(ax, "x", float(np.nanmin(theta)), float(np.nanmax(theta)), most=5)
        return
    tip = run.system.positions(run.states)[:, -1]
    ax.plot(tip[:, 0], tip[:, 1], **style)
    ax.plot(0, 0, "+", color="#4a525b", markersize=7)
    ax.set_aspect("equal")
    ax.set_xlabel(words.axis["x"])
    ax.set_ylabel(words.axis["y"])
