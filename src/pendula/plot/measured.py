"""Figures of a recording beside its fit: residuals, damping, phase portrait, period, methods."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from pendula.measured.whole_swings import periods_at, rates
from pendula.plot.labels import Labels, labels
from pendula.plot.style import (
    degree_ticks,
    for_logarithm,
    legend_above,
    line,
    logarithmic,
    panels,
    styled,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from pendula._types import Array
    from pendula.measured.fitted import FittedRecording
    from pendula.measured.whole_swings import Seen, Swings

_DATA: dict[str, Any] = {"color": "#7d8894", "marker": ".", "markersize": 2.6, "linestyle": "none"}
_SWING = _DATA | {"color": "#0072b2", "markersize": 5}
_BAND = "#e3e6ea"
_FORMULA = "#b07a00"
_MOST_POINTS = 4000  # samples drawn: more make no other picture, and files of megabytes
_LAGS = 400  # of the autocorrelation
_PERIODS_SHOWN = 6  # of it
_LOOKS: dict[str, dict[str, Any]] = {
    "model": line("exact"),
    "undamped": {"color": "#63309b", "linestyle": (0, (4, 1.2)), "linewidth": 1.3},
    "damped-linear": line("linear"),
}


class Compared(Protocol):
    """An experiment beside formulas and methods; see `pendula.study.measured.comparison`."""

    @property
    def t(self) -> Array:
        """Times, (n,) [s]."""

    @property
    def measured(self) -> Array:
        """Angles [rad] or rates [rad/s], (n,) or (n, 2)."""

    @property
    def is_angle(self) -> bool:
        """Which of both."""

    @property
    def runs(self) -> Iterable[str]:
        """Names of the solutions."""

    def values(self, name: str) -> Array:
        """One solution, shaped alike."""

    def difference(self, name: str) -> Array:
        """How far it is from the experiment, shaped alike."""


@styled
def measured_fit(recording: FittedRecording, *, language: str = "en") -> Figure:
    """What was measured with the fitted model over it, and the residuals below.

    Args:
        recording: of one pendulum or of a double one, whose angles get a panel each.
        language: "en" or "es".
    """
    words, m = labels(language), recording.fitted.shape[1]
    figure, axes = panels(2 * m, 1, 1.0 + 1.9 * m, words, sharex=True)
    kind, unit, factor = _shown(recording)
    for i in range(m):
        top, below = axes[2 * i, 0], axes[2 * i + 1, 0]
        t, measured = _thinned(recording.t, factor * recording.measured[:, i])
        top.plot(t, measured, label=words.name("measured"), **_DATA)
        fitted = factor * recording.fitted[:, i]
        top.plot(recording.t, fitted, label=words.name("model"), **line("exact") | {"linewidth": 1})
        top.set_ylabel(words.axis[f"angle_{i + 1}" if m > 1 else f"measured_{kind}"])
        below.plot(*_thinned(recording.t, factor * recording.residuals[:, i]), **_DATA)
        below.axhline(0.0, color=line("exact")["color"], linewidth=0.8)
        below.set_ylabel(words.axis["residual"].format(unit=unit))
    axes[-1, 0].set_xlabel(words.axis["time"])
    axes[-1, 0].set_xlim(recording.t[0], recording.t[-1])
    legend_above(figure, axes[0, 0])
    return figure


@styled
def residual_autocorrelation(recording: FittedRecording, *, language: str = "en") -> Figure:
    """How alike residuals are that lie a time apart; independent ones would be within the band.

    Args:
        recording: evenly sampled, or nearly so: neighbours count as one usual step apart.
        language: "en" or "es".
    """
    words = labels(language)
    figure, axes = panels(1, 1, 2.3, words)
    ax, step = axes[0, 0], float(np.median(np.diff(recording.t)))
    for residuals in recording.residuals.T:
        found = autocorrelation(residuals, _lags(recording, step))
        ax.plot(step * np.arange(len(found)), found, color="#0072b2", linewidth=1.2)
    bound = 2.0 / np.sqrt(len(recording.t))
    ax.axhspan(-bound, bound, color=_BAND, label=words.curve["independent"])
    ax.set_xlim(0.0, step * (len(found) - 1))
    ax.set_xlabel(words.axis["lag"])
    ax.set_ylabel(words.axis["autocorrelation"])
    legend_above(figure, ax)
    return figure


@styled
def damping(measured: Swings, model: Swings, *, language: str = "en") -> Figure:
    """Amplitude of each swing against time on a logarithmic axis: straight for viscous friction.

    Args:
        measured: swings of the recording.
        model: those of the fitted model.
        language: "en" or "es".
    """
    words = labels(language)
    figure, axes = panels(1, 1, 2.7, words)
    ax = axes[0, 0]
    ax.plot(measured.t, np.degrees(measured.amplitude), label=words.name("measured"), **_SWING)
    ax.plot(model.t, np.degrees(model.amplitude), label=words.name("model"), **line("exact"))
    _degrees_on_log(ax, np.degrees(measured.amplitude), words)
    ax.set_xlabel(words.axis["time"])
    ax.set_ylabel(words.axis["swing_amplitude"])
    legend_above(figure, ax)
    return figure


@styled
def measured_portrait(recorded: Seen, *, language: str = "en") -> Figure:
    """Angle and rate of the samples, and the fitted model's way through them.

    Args:
        recorded: of one pendulum.
        language: "en" or "es".
    """
    words = labels(language)
    figure, axes = panels(1, 1, 3.4, words)
    ax = axes[0, 0]
    theta, omega = _thinned(*rates(recorded))
    ax.plot(np.degrees(theta), omega, label=words.name("measured"), **_DATA)
    orbit = np.degrees(recorded.model.theta)
    look = line("exact") | {"linewidth": 0.6}
    ax.plot(orbit, recorded.model.omega, label=words.name("model"), **look)
    degree_ticks(ax, "x", float(orbit.min()), float(orbit.max()))
    ax.set_xlabel(words.axis["angle"])
    ax.set_ylabel(words.axis["rate"])
    legend_above(figure, ax)
    return figure


@styled
def period_of_amplitude(measured: Swings, omega0_squared: float, *, language: str = "en") -> Figure:
    """Period of each swing against its amplitude, beside 4 K(k)/ω0 of the fit.

    Args:
        measured: swings of the recording.
        omega0_squared: of the fit [1/s²].
        language: "en" or "es".
    """
    words = labels(language)
    figure, axes = panels(1, 1, 2.9, words)
    ax = axes[0, 0]
    ax.plot(np.degrees(measured.amplitude), measured.period, label=words.name("measured"), **_SWING)
    amplitudes = np.linspace(0.0, 1.05 * float(measured.amplitude.max()), 200)
    exact = periods_at(omega0_squared, amplitudes)
    ax.plot(np.degrees(amplitudes), exact, color=_FORMULA, label=words.curve["by_formula"])
    ax.axhline(exact[0], label=words.curve["small_swings"], **line("linear"))
    ax.set_xlim(0.0, np.degrees(amplitudes[-1]))
    degree_ticks(ax, "x", 0.0, float(np.degrees(amplitudes[-1])))
    ax.set_xlabel(words.axis["swing_amplitude"])
    ax.set_ylabel(words.axis["swing_period"])
    legend_above(figure, ax)
    return figure


@styled
def measured_methods(compared: Compared, *, language: str = "en") -> Figure:
    """Experiment, formulas and methods over one another, and below how far each is from it.

    Args:
        compared: the experiment with its solutions.
        language: "en" or "es".
    """
    words = labels(language)
    measured = np.degrees(_columns(compared.measured))
    m = measured.shape[1]
    figure, axes = panels(m + 1, 1, 2.6 + 2.0 * m, words, sharex=True)
    kind, unit = ("angle", "°") if compared.is_angle else ("rate", "°/s")
    for i, ax in enumerate(axes[:m, 0]):
        ax.plot(*_thinned(compared.t, measured[:, i]), label=words.name("measured"), **_DATA)
        for name in compared.runs:
            values = np.degrees(_columns(compared.values(name))[:, i])
            ax.plot(compared.t, values, label=words.name(name), **_LOOKS.get(name, line(name)))
        reach = 1.15 * float(np.nanmax(np.abs(measured[:, i])))
        ax.set_ylim(-reach, reach)
        ax.set_ylabel(words.axis[f"angle_{i + 1}" if m > 1 else f"measured_{kind}"])
    below = axes[m, 0]
    for name in compared.runs:
        largest = _columns(compared.difference(name)).max(axis=1)
        look = _LOOKS.get(name, line(name)) | {"linewidth": 1.0}
        below.plot(compared.t, for_logarithm(np.degrees(largest)), **look)
    logarithmic(below, "y")
    below.set_xlim(compared.t[0], compared.t[-1])
    below.set_ylabel(words.axis["experiment_difference"].format(unit=unit))
    below.set_xlabel(words.axis["time"])
    legend_above(figure, axes[0, 0], columns=4)
    return figure


@styled
def measured_models(
    names: Sequence[str],
    residuals: Sequence[float],
    preferred: int,
    unit: str,
    *,
    language: str = "en",
) -> Figure:
    """Residuals that each model leaves, the best at the top of a logarithmic axis.

    Args:
        names: of the models, in the language.
        residuals: root of the mean square of each [unit].
        preferred: place of the model that is.
        unit: of the residuals.
        language: "en" or "es".
    """
    words = labels(language)
    figure, axes = panels(1, 1, 0.8 + 0.22 * len(names), words)
    ax, order = axes[0, 0], np.argsort(residuals)
    for place, i in enumerate(order):
        look = _SWING if i == preferred else _DATA | {"markersize": 5}
        ax.plot(residuals[i], place, **look | {"marker": "o"})
    ax.set_yticks(range(len(names)), [names[i] for i in order])
    ax.invert_yaxis()
    logarithmic(ax, "x")
    ax.set_xlabel(words.axis["residual_rms"].format(unit=unit))
    return figure


def autocorrelation(residuals: Array, lags: int) -> Array:
    """Of residuals, from the lag 0 on, (lags,); missing ones are left out."""
    centred = residuals - np.nanmean(residuals)
    square = np.nanmean(centred**2)
    found: Array = np.array(
        [np.nanmean(centred[lag:] * centred[: len(centred) - lag]) / square for lag in range(lags)]
    )
    return found


def _lags(recording: FittedRecording, step: float) -> int:
    """How many lags are drawn: some periods, and no more than half the record."""
    system = recording.system
    shown = _PERIODS_SHOWN * 2.0 * np.pi / system.slowest_frequency / step if system else _LAGS
    return int(max(2, min(shown, len(recording.t) // 2)))


def _shown(recording: FittedRecording) -> tuple[str, str, float]:
    """What was measured, the unit in which it is shown, and what multiplies it."""
    quantity = recording.measurement.quantity
    if quantity == "acceleration":
        return quantity, "m/s²", 1.0
    return ("rate", "°/s", 180.0 / np.pi) if quantity == "rate" else ("angle", "°", 180.0 / np.pi)


def _columns(values: Array) -> Array:
    """Of one angle (n, 1), of two (n, 2)."""
    return values.reshape(len(values), -1)


def _thinned(t: Array, values: Array) -> tuple[Array, Array]:
    """Every k-th sample, where there are too many to draw."""
    every = -(-len(t) // _MOST_POINTS)
    return t[::every], values[::every]


def _degrees_on_log(ax: Axes, degrees: Array, words: Labels) -> None:
    from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

    ax.set_yscale("log")
    low, high = float(degrees.min()), float(degrees.max())
    ax.set_ylim(low / 1.2, high * 1.2)
    ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0), numticks=20))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.yaxis.set_major_formatter(FuncFormatter(lambda y, _: words.local(f"{y:g}")))
