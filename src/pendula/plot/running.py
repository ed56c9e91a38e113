"""Running estimates: exponents with the band of their error, MEGNO, SALI and GALI against time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, overload

import numpy as np

from pendula._late_methods import method_of
from pendula._messages import ArgumentError
from pendula.chaos.alignment import ALIGNED, Alignment
from pendula.chaos.lyapunov import Lyapunov
from pendula.chaos.megno import Megno
from pendula.plot.case import case_of, start_of
from pendula.plot.labels import labels
from pendula.plot.style import (
    FAINT,
    INK,
    for_logarithm,
    given_or_new,
    legend_above,
    logarithmic,
    styled,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pendula._types import Array
    from pendula.plot.labels import Labels

    Running = Lyapunov | Megno | Alignment

_COLOURS = INK, "#0072b2", "#d55e00", "#009e73"
VERDICTS = {"chaotic": "#c2185b", "regular": "#0072b2", "undecided": "#8a9199"}
_BAND = 0.16  # opacity
_SETTLED = 0.05  # of the run, before which an estimate may leave the frame
_SURE = 3.0  # standard errors that an exponent differs from 0
_TWO = 2.0  # the mean MEGNO of a torus
_FEW = 3  # names that have room inside the axes
_STEEP = 20.0  # a MEGNO beyond is drawn on a logarithmic axis


@method_of(Lyapunov)
@method_of(Megno)
@method_of(Alignment)
def plot(result: Running, *, ax: Any = None, language: str = "en") -> Any:
    """The estimate against time (extra: report); see `pendula.plot.running`."""
    return running(result, ax=ax, language=language)


@overload
def running(
    result: Running, *, ax: None = None, title: str | None = None, language: str = "en"
) -> Figure: ...


@overload
def running(
    result: Running, *, ax: Axes, title: str | None = None, language: str = "en"
) -> Axes: ...


@styled
def running(
    result: Running, *, ax: Axes | None = None, title: str | None = None, language: str = "en"
) -> Figure | Axes:
    """How an exponent, MEGNO, SALI or GALI settles with time.

    The band about the last value of an exponent is its standard error, at a time t of the run's T
    √(T/t) times as wide: where the estimate should have run; those that come to 0 have none.
    Several motions are lines in the colours of their verdicts.

    Args:
        result: of `lyapunov`, `megno`, `sali` or `gali`.
        ax: axes to draw into; None: a figure of its own.
        title: above it; None: the case that is shown.
        language: "en" or "es".

    Returns:
        A figure, which a notebook shows, for `.savefig(path)`; or the axes given.

    Raises:
        ValueError: for another result, or an unknown language.
    """
    words = labels(language)
    if not isinstance(result, Lyapunov | Megno | Alignment):
        rule = "must be what lyapunov, megno, sali or gali returned, got {value}"
        raise ArgumentError("result", rule, value=result)
    figure, place = given_or_new(ax, 3.4, words)
    draw: Any = {Lyapunov: _exponents, Megno: _megno, Alignment: _alignment}[type(result)]
    draw(place, result, words)
    names = place.get_legend_handles_labels()[1]
    if ax is None and len(names) > _FEW:
        legend_above(figure, place, columns=2)
    elif names:
        place.legend(loc="best")
    place.set_title(_case(result, words) if title is None else title)
    return figure if ax is None else ax


def _case(result: Running, words: Labels) -> str:
    shown = case_of(result.system, words)
    if result.start.ndim == 1:
        shown += "\n" + start_of(result.system, result.start, words)
    return shown


def _unitless(result: Running) -> str:
    """What the label of a rate ends with where the system has no units."""
    return "_scaled" if result.system.form == "scaled" else ""


def _exponents(ax: Axes, found: Lyapunov, words: Labels) -> None:
    elapsed = found.t - found.t[0] + (found.t[1] - found.t[0])
    ax.set_xlabel(words.axis["elapsed"])
    ax.set_ylabel(words.axis[f"lyapunov{_unitless(found)}"])
    if found.exponents.ndim > 1:
        values = [for_logarithm(each) for each in found.running[..., 0]]
        _by_verdict(ax, elapsed, values, found.verdict, words)
        logarithmic(ax, "x", "y")
        return
    calm = found.exponents.size == 1 and found.verdict == "regular"
    for i, (value, error) in enumerate(zip(found.exponents, found.standard_error, strict=True)):
        colour = _COLOURS[i % len(_COLOURS)]
        label = _told(found, i, words)
        ax.plot(elapsed, found.running[:, i], color=colour, linewidth=1.2, label=label)
        if not calm and abs(value) > _SURE * error:  # else it falls as ln t/t, outside of any band
            wide = error * np.sqrt(elapsed[-1] / elapsed)
            ends = value - wide, value + wide
            ax.fill_between(elapsed, *ends, color=colour, alpha=_BAND, linewidth=0)
    logarithmic(ax, "x")
    if calm:
        logarithmic(ax, "y")
        return
    late = found.running[elapsed >= _SETTLED * elapsed[-1]]
    low, high = min(0.0, float(late.min())), max(0.0, float(late.max()))
    room = 0.15 * (high - low)
    ax.axhline(0.0, color=FAINT, linewidth=0.8, zorder=0)
    ax.set_ylim(low - room, high + room)


def _told(found: Lyapunov, i: int, words: Labels) -> str:
    """An exponent with its error; a single one with the verdict."""
    value, error = found.exponents[i], found.standard_error[i]
    name = words.curve["exponent"].format(i="₁₂₃₄"[i])
    text = f"{name} = {words.local(f'{value:.4g}')}"
    if not np.isnan(error):
        text += f" ± {words.local(f'{error:.2g}')}"
    return f"{text}, {words.curve[found.verdict]}" if found.exponents.size == 1 else text


def _megno(ax: Axes, found: Megno, words: Labels) -> None:
    elapsed = np.abs(found.t - found.t0)
    ax.set_xlabel(words.axis["elapsed"])
    if found.mean.ndim > 1:
        ax.set_ylabel(words.axis["megno"])
        _by_verdict(ax, elapsed, list(found.mean), found.verdict, words)
    else:
        ax.set_ylabel(words.axis["megno_and_mean"])
        ax.plot(elapsed, found.megno, color=FAINT, linewidth=0.9, label=words.curve["megno_itself"])
        ax.plot(elapsed, found.mean, color=INK, linewidth=1.4, label=words.curve["megno_mean"])
    colour = _COLOURS[1]
    ax.axhline(_TWO, color=colour, linewidth=0.9, linestyle="--", label=words.curve["torus"])
    if np.nanmax(found.mean) > _STEEP:
        logarithmic(ax, "y")


def _alignment(ax: Axes, found: Alignment, words: Labels) -> None:
    sali = found.count == 2
    ax.set_xlabel(words.axis["time"])
    ax.set_ylabel(words.axis["sali" if sali else "gali"].format(k=found.count))
    for each in np.atleast_2d(found.value):
        ax.plot(found.t, for_logarithm(each), color=INK, linewidth=1.1)
    label = words.curve["aligned"]
    ax.axhline(ALIGNED, color=_COLOURS[1], linewidth=0.9, linestyle="--", label=label)
    logarithmic(ax, "y")


def _by_verdict(ax: Axes, t: Array, values: list[Array], verdicts: Any, words: Labels) -> None:
    """A thin line for each motion; the legend counts them."""
    for verdict, colour in VERDICTS.items():
        chosen = [each for each, told in zip(values, verdicts, strict=True) if told == verdict]
        for i, each in enumerate(chosen):
            label = f"{words.curve[verdict]} ({len(chosen)})" if i == 0 else None
            ax.plot(t, each, color=colour, linewidth=0.8, alpha=0.8, label=label)
