"""Bifurcation pictures: where motions go in the end, with the exponent below."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._late_methods import method_of
from pendula._messages import ArgumentError
from pendula.chaos.bifurcation import Bifurcation
from pendula.plot.case import axis_of, case_of
from pendula.plot.labels import labels
from pendula.plot.running import VERDICTS
from pendula.plot.style import FAINT, INK, degree_ticks, legend_above, panels, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pendula.plot.labels import Labels

_MARK = "#009e73"
_MANY = 40_000  # points: beyond, they get smaller, down to a pixel
_SURE = 3.0  # standard errors above 0: the colour of chaos
_SIZES = 0.2, 1.6  # points² of a mark


@method_of(Bifurcation)
def plot(found: Bifurcation, *, language: str = "en") -> Any:
    """Points and exponents over the parameter (extra: report); see `pendula.plot.bifurcation`."""
    return bifurcation(found, language=language)


@styled
def bifurcation(
    found: Bifurcation, *, quantity: str = "auto", title: str | None = None, language: str = "en"
) -> Figure:
    """Where motions go in the end over a parameter, and below the largest exponent with its error.

    Dotted lines are the changes of stability that were located by multipliers; the exponent's
    colour says where it is above 0 by three standard errors.

    Args:
        found: what `pendula.chaos.bifurcation` returned.
        quantity: "angle": θ or θ2; "rate": ω, or the momentum p2 of a double pendulum; "auto": ω,
            which is bounded where θ turns, or θ2.
        title: above it; None: the case that is shown.
        language: "en" or "es".

    Raises:
        ValueError: for another result, or an unknown quantity or language.
    """
    words = labels(language)
    if not isinstance(found, Bifurcation):
        rule = "must be what pendula.chaos.bifurcation returned, got {value}"
        raise ArgumentError("found", rule, value=found)
    figure, axes = panels(2, 1, 5.2, words, sharex=True, gridspec_kw={"height_ratios": (2.2, 1)})
    above, below = axes[:, 0]
    _points(above, found, _angles(found, quantity), words)
    _exponents(below, found, words)
    for i, change in enumerate(found.changes):
        label = "" if i else words.curve["stability_change"]
        for ax in (above, below):
            how: dict[str, Any] = {"color": _MARK, "linewidth": 0.8, "linestyle": ":", "zorder": 0}
            ax.axvline(change.value, label=label, **how)
    legend_above(figure, below, columns=3)
    energy = found.parameter == "energy"
    below.set_xlabel(words.axis["energy"] if energy else axis_of(found.system, found.parameter))
    above.set_title(_case(found, words) if title is None else title)
    return figure


def _angles(found: Bifurcation, quantity: str) -> bool:
    """Whether the angle is drawn."""
    double = found.exponents.shape[1] == 4
    choices = {"angle": True, "rate": False, "auto": bool(double)}
    if quantity not in choices:
        rule = "must be one of {choices}, got {value}"
        raise ArgumentError("quantity", rule, choices=tuple(choices), value=quantity)
    return choices[quantity]


def _points(ax: Axes, found: Bifurcation, angles: bool, words: Labels) -> None:
    double = found.exponents.shape[1] == 4
    shown = found.points[..., 0 if angles else 1]
    values = np.degrees(shown) if angles else shown
    x = np.repeat(found.values, shown.shape[1])
    low, high = _SIZES
    size = max(low, high * min(1.0, _MANY / max(1, x.size)))
    ax.scatter(x, values.ravel(), s=size, color=INK, linewidths=0, rasterized=True)
    if angles:
        ax.set_ylabel(words.axis["angle_2" if double else "angle"])
        degree_ticks(ax, "y", float(np.nanmin(values)), float(np.nanmax(values)))
        return
    scaled = found.system.form == "scaled"
    ax.set_ylabel(words.axis["momentum_2" if double else "rate_scaled" if scaled else "rate"])


def _exponents(ax: Axes, found: Bifurcation, words: Labels) -> None:
    order = np.argsort(found.values, kind="stable")
    x, y = found.values[order], found.exponents[order, 0]
    error = found.standard_errors[order]
    ax.axhline(0.0, color=FAINT, linewidth=0.8, zorder=0)
    ax.fill_between(x, y - error, y + error, color=FAINT, alpha=0.6, linewidth=0, zorder=1)
    chaotic = y > _SURE * np.nan_to_num(error)
    for name, verdict, chosen in (
        ("exponent_above", "chaotic", chaotic),
        ("exponent_not_above", "regular", ~chaotic),
    ):
        label = words.curve[name] if chosen.any() else ""
        ax.plot(x[chosen], y[chosen], ".", color=VERDICTS[verdict], markersize=2.6, label=label)
    scaled = found.system.form == "scaled"
    ax.set_ylabel(words.axis["exponent_scaled" if scaled else "exponent"])


def _case(found: Bifurcation, words: Labels) -> str:
    energy = found.recipe.get("energy")
    values = {} if energy is None else {"E": (float(energy), "J")}
    return case_of(found.system, words, values, without=(found.parameter,))
