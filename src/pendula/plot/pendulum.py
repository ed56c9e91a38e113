"""Figures of the simple pendulum that need no method: models, periods, portrait, cost of K."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import cycle
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._angles import warn_of_degrees
from pendula._checks import finite_number
from pendula._messages import ArgumentError
from pendula.plot.given import axis, curve, curves, items
from pendula.plot.labels import Labels, labels
from pendula.plot.style import (
    BACKED,
    FAINT,
    INK,
    degree_ticks,
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
    from pendula.systems import SimplePendulum


# Shades for curves that are no run: what a series of more and more terms, or periods, gives.
_SHADES = ("#a9a5d1", "#8f86c4", "#7461b3", "#54278f", "#2d0a57")
_SEPARATRIX = "#b07a00"


@styled
def linear_error(
    amplitudes: ArrayLike,
    errors: Mapping[int, ArrayLike],
    limits: Mapping[int, Mapping[float, float]],
    *,
    language: str = "en",
) -> Figure:
    """The linear model's error against amplitude, both logarithmic.

    Args:
        amplitudes: θ0 [rad], shape (n,), rising.
        errors: by number of periods T0, as a part of θ0, shape (n,).
        limits: by number of periods T0 and error, the amplitude [rad] that gives it: to be marked.
        language: "en" or "es".
    """
    words = labels(language)
    given, amplitudes = amplitudes, axis("amplitudes", amplitudes, "rad")
    warn_of_degrees("amplitudes", given, amplitudes, deeper=1)
    errors, limits = curves("errors", errors, "", amplitudes), _limits(limits, errors)
    figure, axes = panels(1, 1, 3.1, words)
    ax = axes[0, 0]
    for (count, error), colour in zip(errors.items(), cycle(_SHADES[:0:-1])):
        name = words.curve["period_1"] if count == 1 else words.curve["periods"].format(n=count)
        ax.plot(np.degrees(amplitudes), error, color=colour, linewidth=1.6, label=name)
        for value, limit in limits[count].items():
            ax.plot(np.degrees(limit), value, "o", color=colour, markersize=4)
            ax.annotate(
                words.plain(float(np.degrees(limit))) + "°",
                (np.degrees(limit), value),
                xytext=(5, -5),
                textcoords="offset points",
                va="top",
                color=colour,
                bbox=BACKED,
            )
    logarithmic(ax, "x", "y")
    _degrees_on_log(ax, np.degrees(amplitudes), words)
    ax.set_ylim(top=4)
    ax.set_xlabel(words.axis["amplitude"])
    ax.set_ylabel(words.axis["linear_error"])
    legend_above(figure, ax)
    return figure


@styled
def periods(
    amplitudes: ArrayLike,
    exact: ArrayLike,
    series: Mapping[int, ArrayLike],
    *,
    language: str = "en",
) -> Figure:
    """The period, in units of the small-angle one, against amplitude.

    Args:
        amplitudes: θ0 [rad], shape (n,), rising.
        exact: T/T0, shape (n,).
        series: T/T0 by number of terms, shape (n,).
        language: "en" or "es".
    """
    words = labels(language)
    given, amplitudes = amplitudes, axis("amplitudes", amplitudes, "rad")
    warn_of_degrees("amplitudes", given, amplitudes, deeper=1)
    exact = curve("exact", exact, "", amplitudes)
    series = curves("series", series, "", amplitudes)
    figure, axes = panels(1, 1, 3.3, words)
    ax = axes[0, 0]
    degrees = np.degrees(amplitudes)
    ax.plot(degrees, exact, **line("exact"))
    _at_end(ax, degrees[-1], float(exact[-1]), words.name("exact"), INK)
    for (terms, ratio), colour in zip(series.items(), cycle(_SHADES), strict=False):
        ax.plot(degrees, ratio, color=colour, linewidth=1.3)
        word = "series_1" if terms == 1 else "series"
        _at_end(ax, degrees[-1], float(ratio[-1]), words.curve[word].format(n=terms), colour)
    ax.set_xlim(0, degrees[-1])
    degree_ticks(ax, "x", 0, float(degrees[-1]))
    ax.set_xlabel(words.axis["amplitude"])
    ax.set_ylabel(words.axis["period"])
    return figure


@styled
def phase_portrait(system: SimplePendulum, releases: ArrayLike, *, language: str = "en") -> Figure:
    """The phase portrait [°, rad/s] of a simple pendulum with its separatrix.

    The orbits are the lines of equal energy, ω² = 2 ωn² (cos θ − cos θ0) (the paper's equation 14).

    Args:
        system: the pendulum.
        releases: amplitudes [rad] whose orbits are drawn in ink, the linear model's beside them.
        language: "en" or "es".
    """
    words = labels(language)
    amplitudes = axis("releases", releases, "rad")
    warn_of_degrees("releases", releases, amplitudes, deeper=1)
    if getattr(system, "name", "") != "simple":
        raise ArgumentError("system", "must be a SimplePendulum, got {value}", value=system)
    figure, axes = panels(1, 1, 3.4, words)
    ax = axes[0, 0]
    rate, theta = system.natural_frequency, np.linspace(-1.5 * np.pi, 1.5 * np.pi, 361)
    top = max(3.0, 1.1 * float(max(abs(amplitudes)))) * rate
    omega = np.linspace(-top, top, 241)
    level = (omega[:, None] / rate) ** 2 / 2 + 1 - np.cos(theta)
    others = sorted((*(1 - np.cos(np.radians((45, 90, 120)))), 2.6, 3.6))
    ax.contour(np.degrees(theta), omega, level, others, colors=FAINT, linewidths=0.9)
    for side in (1, -1):
        border = side * 2 * rate * np.cos(theta / 2)
        name = words.curve["separatrix"] if side > 0 else None
        ax.plot(np.degrees(theta), border, color=_SEPARATRIX, linewidth=1.5, label=name)
    for i, amplitude in enumerate(amplitudes.tolist()):
        _release(ax, rate, amplitude, words if i == 0 else None)
    legend_above(figure, ax)
    ax.set_xlim(-270, 270)
    ax.set_ylim(-top, top)
    degree_ticks(ax, "x", -270, 270)
    ax.set_xlabel(words.axis["angle"])
    ax.set_ylabel(words.axis["rate"])
    return figure


@styled
def elliptic_cost(
    kc: ArrayLike, terms: ArrayLike, iterations: ArrayLike, *, language: str = "en"
) -> Figure:
    """What K costs as k → 1: terms of the series, iterations of the AGM.

    Args:
        kc: complementary modulus, shape (n,), falling.
        terms: of the series, shape (n,); inf where too many.
        iterations: of the arithmetic-geometric mean, shape (n,).
        language: "en" or "es".
    """
    words = labels(language)
    kc = axis("kc", kc)
    terms, iterations = curve("terms", terms, "", kc), curve("iterations", iterations, "", kc)
    if not ((kc >= 0) & (kc <= 1)).all():
        raise ArgumentError("kc", "must lie within [0, 1], got {value}", value=kc)
    figure, axes = panels(1, 1, 2.9, words)
    ax = axes[0, 0]
    distance = kc**2 / (1 + np.sqrt((1 - kc) * (1 + kc)))  # 1 − k without the cancellation
    known = np.isfinite(terms)
    ax.plot(distance[known], terms[known], color=_SHADES[3], linewidth=1.6)
    ax.plot(distance, iterations, color=INK, linewidth=1.6, drawstyle="steps-mid")
    logarithmic(ax, "x", "y")
    ax.invert_xaxis()
    middle = np.count_nonzero(known) // 2
    _note(ax, distance[middle], terms[middle], words.curve["terms"], _SHADES[3])
    _note(ax, distance[middle], float(iterations[middle]), words.curve["iterations"], INK)
    ax.set_ylim(bottom=1)
    ax.set_xlabel(words.axis["distance"])
    ax.set_ylabel(words.axis["count"])
    return figure


def _limits(given: Any, errors: Mapping[int, Array]) -> dict[int, dict[float, float]]:
    """Amplitudes [rad] by number of periods and error."""
    limits = {
        count: {
            finite_number(f"limits[{count!r}]", value): finite_number(
                f"limits[{count!r}][{value!r}]", limit, "rad"
            )
            for value, limit in items(f"limits[{count!r}]", each)
        }
        for count, each in items("limits", given)
    }
    if not limits.keys() >= errors.keys():
        rule = "must have the keys of errors: {choices}; got {text}"
        shown = ", ".join(map(repr, limits)) or "none"
        raise ArgumentError("limits", rule, choices=tuple(errors), text=shown)
    return limits


def _release(ax: Axes, rate: float, amplitude: float, words: Labels | None) -> None:
    """The orbit of a release from rest and the linear model's ellipse, named if there are words."""
    turn = np.linspace(0, 2 * np.pi, 181)
    x, y = np.degrees(amplitude) * np.cos(turn), rate * amplitude * np.sin(turn)
    name = words.curve["linear_orbit"] if words else None
    ax.plot(x, y, **line("linear") | {"linewidth": 1.2}, label=name)
    swing = amplitude * np.cos(turn / 2)
    height = rate * np.sqrt(np.maximum(2 * (np.cos(swing) - np.cos(amplitude)), 0))
    for side in (1, -1):
        name = words.name("exact") if words and side > 0 else None
        ax.plot(np.degrees(swing), side * height, **line("exact"), label=name)


def _degrees_on_log(ax: Axes, degrees: Array, words: Labels) -> None:
    ticks = (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 45, 90, 180)
    shown = [d for d in ticks if degrees[0] <= d <= degrees[-1]]
    ax.set_xlim(degrees[0], degrees[-1])
    ax.set_xticks(shown, [words.local(f"{d:g}") for d in shown])


def _at_end(ax: Axes, x: float, y: float, text: str, colour: str) -> None:
    ax.annotate(
        text,
        (x, y),
        xytext=(4, 0),
        textcoords="offset points",
        va="center",
        color=colour,
        annotation_clip=False,
    )


def _note(ax: Axes, x: float, y: float, text: str, colour: str) -> None:
    ax.annotate(text, (x, y), xytext=(-6, 6), textcoords="offset points", ha="right", color=colour)
