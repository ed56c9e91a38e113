"""Periodic orbits with their multipliers, and families of them over energy or a parameter."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._late_methods import method_of
from pendula._messages import ArgumentError
from pendula.chaos.families import Family
from pendula.chaos.orbit import PeriodicOrbit
from pendula.plot.case import case_of, start_of, symbol_of
from pendula.plot.labels import labels
from pendula.plot.style import FAINT, INK, degree_ticks, panels, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pendula._types import Array
    from pendula.plot.labels import Labels

_SECOND, _UNSTABLE = "#0072b2", "#d55e00"
_SHADE = "#e8f1f7"
_BORDERS = -2.0, 2.0  # of μ + 1/μ, between which an orbit is elliptic
_LARGEST = 30.0  # of μ + 1/μ: beyond, the axis is not linear
_AROUND = 1.25  # of the largest multiplier, or of the unit circle


@method_of(PeriodicOrbit)
@method_of(Family)
def plot(found: PeriodicOrbit | Family, *, language: str = "en") -> Any:
    """The orbit with its multipliers, or the family's periods and stability (extra: report)."""
    if isinstance(found, Family):
        return family(found, language=language)
    return periodic_orbit(found, language=language)


@styled
def periodic_orbit(
    orbit: PeriodicOrbit, *, title: str | None = None, language: str = "en"
) -> Figure:
    """The angles over one period, and the multipliers about the unit circle.

    Args:
        orbit: what `periodic_orbit`, `normal_mode` or `family` gave.
        title: above it; None: the case that is shown.
        language: "en" or "es".

    Raises:
        ValueError: for another result, or an unknown language.
    """
    words = labels(language)
    if not isinstance(orbit, PeriodicOrbit):
        rule = "must be a periodic orbit of pendula.chaos, got {value}"
        raise ArgumentError("orbit", rule, value=orbit)
    figure, axes = panels(1, 2, 3.1, words, gridspec_kw={"width_ratios": (1.9, 1)})
    _angles(axes[0, 0], orbit, words)
    _multipliers(axes[0, 1], orbit, words)
    axes[0, 0].set_title(_case(orbit, words) if title is None else title)
    axes[0, 1].set_title(words.case[orbit.kind])
    return figure


def _case(orbit: PeriodicOrbit, words: Labels) -> str:
    values = {"T": (orbit.period, "" if orbit.system.form == "scaled" else "s")}
    if orbit.conservative:
        values["E"] = orbit.energy, "J"
    shown = case_of(orbit.system, words, values)
    return f"{shown}\n{start_of(orbit.system, orbit.state, words)}"


def _angles(ax: Axes, orbit: PeriodicOrbit, words: Labels) -> None:
    run = orbit.trajectory()
    theta = np.degrees(run.theta).reshape(run.t.size, -1)
    lines = ("-", INK), ("--", _SECOND)
    for i, (style, colour) in enumerate(lines[: theta.shape[1]]):
        label = f"θ{'₁₂'[i]}" if theta.shape[1] > 1 else None
        ax.plot(run.t, theta[:, i], style, color=colour, linewidth=1.3, label=label)
    if theta.shape[1] > 1:
        ax.legend(loc="best")
    ax.set_xlabel(words.axis["time"])
    ax.set_ylabel(words.axis["angle"])
    degree_ticks(ax, "y", float(theta.min()), float(theta.max()))


def _multipliers(ax: Axes, orbit: PeriodicOrbit, words: Labels) -> None:
    circle = np.exp(1j * np.linspace(0.0, math.tau, 181))
    ax.plot(circle.real, circle.imag, color=FAINT, linewidth=1.0, zorder=1)
    colour = _SECOND if orbit.stable else _UNSTABLE
    found = orbit.multipliers[-2:] if orbit.system.can.degrees_of_freedom > 1 else orbit.multipliers
    ax.plot(found.real, found.imag, "o", color=colour, markersize=5, zorder=3)
    wide = _AROUND * max(1.0, float(abs(found).max()))
    ax.set_xlim(-wide, wide)
    ax.set_ylim(-wide, wide)
    ax.set_aspect("equal")
    ax.set_xlabel(words.axis["real"])
    ax.set_ylabel(words.axis["imaginary"])


@styled
def family(found: Family, *, title: str | None = None, language: str = "en") -> Figure:
    """Period and stability of a family of periodic orbits against energy or the parameter.

    Below, μ + 1/μ: between −2 and 2, where it is shaded, orbits are stable; unstable ones are
    dashed in both panels. The dots are the changes of stability.

    Args:
        found: what `pendula.chaos.family` returned.
        title: above it; None: the case that is shown.
        language: "en" or "es".

    Raises:
        ValueError: for another result, one without orbits, or an unknown language.
    """
    words = labels(language)
    if not isinstance(found, Family) or not found.orbits:
        rule = "must be what pendula.chaos.family returned, with orbits, got {value}"
        raise ArgumentError("found", rule, value=found)
    figure, axes = panels(2, 1, 4.6, words, sharex=True)
    above, below = axes[:, 0]
    values, orbits, changes = _with_changes(found)
    periods = np.array([each.period for each in orbits])
    sums = np.array([each.multiplier_sum for each in orbits])
    stable = np.array([each.stable for each in orbits])
    for ax, curve in ((above, periods), (below, sums)):
        _by_stability(ax, values, curve, stable, changes, words)
        places = [np.interp(each.value, values, curve) for each in found.changes]
        marked = [each.value for each in found.changes]
        label = words.curve["stability_change"]
        ax.plot(marked, places, "o", color=INK, markersize=4.5, zorder=4, label=label)
    below.axhspan(*_BORDERS, color=_SHADE, linewidth=0, zorder=0)
    if abs(sums).max() > _LARGEST:
        below.set_yscale("symlog", linthresh=4.0)
    _named(above, below, found, words)
    handles, names = above.get_legend_handles_labels()
    unique = dict(zip(names, handles, strict=True))
    figure.legend(unique.values(), unique.keys(), loc="outside upper left", ncols=3)
    above.set_title(_case_of_family(found, words) if title is None else title)
    return figure


def _with_changes(found: Family) -> tuple[Array, list[PeriodicOrbit], Array]:
    """Values and orbits, those at the changes among them; the values of the changes."""
    every = [*zip(found.values.tolist(), found.orbits, strict=True)]
    every += [(each.value, each.orbit) for each in found.changes]
    every.sort(key=lambda each: each[0])
    values = np.array([value for value, _ in every])
    return values, [orbit for _, orbit in every], np.array([each.value for each in found.changes])


def _by_stability(
    ax: Axes, values: Array, curve: Array, stable: Any, changes: Array, words: Labels
) -> None:
    """Pieces between changes of stability: whole lines where stable, dashed where not."""
    ends = [values[0], *changes, values[-1]]
    for low, high in pairwise(ends):
        inside = (values >= low) & (values <= high)
        middle = (values > low) & (values < high)
        calm = bool(np.median(stable[middle if middle.any() else inside]) > 0.5)
        ax.plot(
            values[inside],
            curve[inside],
            color=_SECOND if calm else _UNSTABLE,
            linestyle="-" if calm else (0, (4, 1.5)),
            linewidth=1.5,
            label=words.curve["stable" if calm else "unstable"],
        )


def _named(above: Axes, below: Axes, found: Family, words: Labels) -> None:
    scaled = found.orbits[0].system.form == "scaled"
    above.set_ylabel(words.axis["period_scaled" if scaled else "period_seconds"])
    driven = not found.orbits[0].conservative
    below.set_ylabel(words.axis["multiplier_total" if driven else "multiplier_sum"])
    energy = found.along == "energy"
    below.set_xlabel(words.axis["energy"] if energy else symbol_of(found.along))


def _case_of_family(found: Family, words: Labels) -> str:
    shown = () if found.along == "energy" else (found.along,)
    return case_of(found.orbits[0].system, words, without=shown)
