"""Periodic orbits with their multipliers, and families of them over energy or a parameter."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._late_methods import method_of
from pendula._messages import ArgumentError
from pendula.chaos.families import Family
from pendula.chaos.orbit import PeriodicOrbit
from pendula.plot.case import axis_of, case_of, start_of
from pendula.plot.labels import labels
from pendula.plot.style import FAINT, INK, degree_ticks, panels, styled

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

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
    dashed in both panels. The dots are the changes of stability, folds among them.

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
    pieces = _pieces(found)
    label = words.curve["stability_change"]
    for ax, of in ((above, "period"), (below, "multiplier_sum")):
        for calm, piece in pieces:
            _drawn_piece(ax, calm, piece, of, words)
        marked = [(each.value, getattr(each.orbit, of)) for each in found.changes]
        ax.plot(
            *np.reshape(marked, (-1, 2)).T, "o", color=INK, markersize=4.5, zorder=4, label=label
        )
    sums = np.array([each.multiplier_sum for each in found.orbits])
    below.axhspan(*_BORDERS, color=_SHADE, linewidth=0, zorder=0)
    if abs(sums).max() > _LARGEST:
        below.set_yscale("symlog", linthresh=4.0)
    _named(above, below, found, words)
    handles, names = above.get_legend_handles_labels()
    unique = dict(zip(names, handles, strict=True))
    figure.legend(unique.values(), unique.keys(), loc="outside upper left", ncols=3)
    above.set_title(_case_of_family(found, words) if title is None else title)
    return figure


def _pieces(found: Family) -> list[tuple[bool, list[tuple[float, PeriodicOrbit]]]]:
    """Values and orbits from change to change, ends included, and whether they are stable."""
    every = [*zip(found.values.tolist(), found.orbits, strict=True)]
    pieces: list[tuple[bool, list[tuple[float, PeriodicOrbit]]]] = []
    before: list[tuple[float, PeriodicOrbit]] = []
    first = 0
    for change in (*found.changes, None):
        last = len(every) if change is None else change.place
        inside = every[first:last]
        after = [] if change is None else [(change.value, change.orbit)]
        if inside:
            calm = np.median([each.stable for _, each in inside]) > 0.5
        else:
            calm = bool(pieces) and not pieces[-1][0]
        pieces.append((bool(calm), [*before, *inside, *after]))
        first, before = last, after
    return pieces


def _drawn_piece(
    ax: Axes, calm: bool, piece: list[tuple[float, PeriodicOrbit]], of: str, words: Labels
) -> None:
    """A whole line where stable, dashed where not."""
    ax.plot(
        [value for value, _ in piece],
        [getattr(orbit, of) for _, orbit in piece],
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
    below.set_xlabel(
        words.axis["energy"] if energy else axis_of(found.orbits[0].system, found.along)
    )


def _case_of_family(found: Family, words: Labels) -> str:
    shown = () if found.along == "energy" else (found.along,)
    return case_of(found.orbits[0].system, words, without=shown)
