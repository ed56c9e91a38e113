"""What series tell: the 0–1 test at each of its frequencies, and the lines of a spectrum."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pendula._late_methods import method_of
from pendula._messages import ArgumentError
from pendula.chaos.frequencies import Frequencies
from pendula.chaos.zero_one import ZeroOne
from pendula.plot.labels import labels
from pendula.plot.running import VERDICTS
from pendula.plot.style import FAINT, INK, given_or_new, logarithmic, styled

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes

    from pendula.plot.labels import Labels


@method_of(ZeroOne)
@method_of(Frequencies)
def plot(result: ZeroOne | Frequencies, *, ax: Any = None, language: str = "en") -> Any:
    """What the series tells (extra: report); see `pendula.plot.spectrum`."""
    return spectrum(result, ax=ax, language=language)


@styled
def spectrum(
    result: ZeroOne | Frequencies,
    *,
    ax: Axes | None = None,
    title: str | None = None,
    language: str = "en",
) -> Any:
    """K_c of the 0–1 test with its median K, or the lines of a spectrum with what they leave.

    Of several series, one beside another: K in the colour of its verdict, or the frequencies.

    Args:
        result: of `zero_one` or `frequencies`.
        ax: axes to draw into; None: a figure of its own.
        title: above it; None: K and the verdict, or how many lines were fitted, or series taken.
        language: "en" or "es".

    Returns:
        A figure, which a notebook shows, for `.savefig(path)`; or the axes given.

    Raises:
        ValueError: for another result, or an unknown language.
    """
    words = labels(language)
    if not isinstance(result, ZeroOne | Frequencies):
        rule = "must be what zero_one or frequencies returned, got {value}"
        raise ArgumentError("result", rule, value=result)
    figure, place = given_or_new(ax, 3.4, words)
    told = _draw_of(result)(place, result, words)
    place.set_title(told if title is None else title)
    return figure if ax is None else ax


def _draw_of(result: ZeroOne | Frequencies) -> Callable[..., str]:
    """What draws such a result, and returns its title."""
    if isinstance(result, ZeroOne):
        return _correlations if result.values.ndim == 1 else _medians
    return _lines if result.frequencies.ndim == 1 else _lines_of_each


def _correlations(ax: Axes, found: ZeroOne, words: Labels) -> str:
    ax.plot(found.c, found.values, ".", color=INK, markersize=4)
    ax.axhline(found.value, color=VERDICTS[found.verdict], linewidth=1.2)
    _limits(ax, float(found.values.min()))
    ax.set_xlabel(words.axis["test_frequency"])
    ax.set_ylabel(words.axis["correlation"])
    return f"K = {words.local(f'{found.value:.3f}')}, {words.curve[found.verdict]}"


def _medians(ax: Axes, found: ZeroOne, words: Labels) -> str:
    for verdict, colour in VERDICTS.items():
        (chosen,) = np.nonzero(found.verdict == verdict)
        if chosen.size:
            label = f"{words.curve[verdict]} ({chosen.size})"
            ax.plot(chosen, found.value[chosen], "o", color=colour, markersize=3.5, label=label)
    _limits(ax, float(found.value.min()))
    _series_below(ax, words)
    ax.set_ylabel(words.axis["median_correlation"])
    ax.legend(loc="best")
    return words.curve["series_tested"].format(n=len(found.value))


def _limits(ax: Axes, lowest: float) -> None:
    """Lines at 0 and 1, between which K lies but for what is lower."""
    for limit in (0.0, 1.0):
        ax.axhline(limit, color=FAINT, linewidth=0.8, zorder=0)
    ax.set_ylim(min(-0.1, lowest - 0.05), 1.1)


def _series_below(ax: Axes, words: Labels) -> None:
    """Whole numbers of series along the axis, from 0 as they are indexed."""
    from matplotlib.ticker import MaxNLocator

    ax.set_xlabel(words.axis["series"])
    ax.xaxis.set_major_locator(MaxNLocator(integer=True))


def _lines(ax: Axes, found: Frequencies, words: Labels) -> str:
    sizes = np.abs(found.amplitudes)
    left = found.residual * np.sqrt((sizes**2).sum())
    low = 0.3 * min(float(sizes.min()), max(float(left), 1e-16 * float(sizes.max())))
    ax.vlines(found.frequencies, low, sizes, color=INK, linewidth=1.4)
    ax.plot(found.frequencies, sizes, "o", color=INK, markersize=3.5)
    if left > low:
        ax.axhline(left, color=FAINT, linewidth=0.9, linestyle="--", label=words.curve["left"])
        ax.legend(loc="best")
    ax.set_xlabel(words.axis["frequency"])
    ax.set_ylabel(words.axis["amplitude_of_lines"])
    logarithmic(ax, "y")
    ax.set_ylim(bottom=low)
    return words.curve["lines"].format(shown=found.frequencies.size, fitted=found.fitted)


def _lines_of_each(ax: Axes, found: Frequencies, words: Labels) -> str:
    count, shown = found.frequencies.shape
    places = np.arange(count)
    dots: dict[str, Any] = {"marker": "o", "linestyle": "none"}
    strongest = words.curve["strongest_line"]
    ax.plot(places, found.frequencies[:, 0], **dots, color=INK, markersize=3.5, label=strongest)
    if shown > 1:
        others = found.frequencies[:, 1:].ravel()
        label = words.curve["other_lines"]
        dots |= {"color": FAINT, "markersize": 2.5, "zorder": 1, "label": label}
        ax.plot(np.repeat(places, shown - 1), others, **dots)
        ax.legend(loc="best")
    _series_below(ax, words)
    ax.set_ylabel(words.axis["frequency"])
    return words.curve["lines_of_each"].format(n=count, shown=shown)
