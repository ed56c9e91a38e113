"""Pictures of what series tell: the 0–1 test, and the lines of a spectrum."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from pendula import plot
from pendula.chaos import frequencies, zero_one

OTHER: Any = 3


def logistic(rate: float) -> list[float]:
    series = [0.3]
    while len(series) < 2000:
        series.append(rate * series[-1] * (1.0 - series[-1]))
    return series


def test_the_test_of_a_series_shows_each_frequency_and_the_verdict() -> None:
    found = zero_one(logistic(4.0))
    (ax,) = found.plot(language="es").axes
    assert np.array_equal(ax.get_lines()[0].get_ydata(), found.values)
    assert ax.get_title(loc="left") == f"K = {found.value:.3f}".replace(".", ",") + ", caótico"
    assert ax.get_xlabel() == "frecuencia de la prueba c [rad por muestra]"
    made = found.to_xarray()
    assert made.attrs["verdict"] == "chaotic"
    assert np.array_equal(made["K_c"].values, found.values)


def test_tests_of_several_series_stand_side_by_side_in_the_colours_of_their_verdicts() -> None:
    found = zero_one([logistic(4.0), logistic(3.5), logistic(3.7)])
    figure = found.plot(language="es")
    (ax,) = figure.axes
    dots = [line for line in ax.get_lines() if line.get_marker() == "o"]
    drawn = {(x, y) for line in dots for x, y in zip(*line.get_data(), strict=True)}
    assert drawn == set(enumerate(found.value))
    assert len({line.get_color() for line in dots}) == 2
    legend = ax.get_legend()
    assert legend is not None
    assert [each.get_text() for each in legend.get_texts()] == ["caótico (2)", "regular (1)"]
    assert ax.get_title(loc="left") == "series: 3"
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("serie", "K, mediana de K_c")


def test_lines_of_several_series_stand_over_one_another() -> None:
    t = np.arange(4000) * 0.05
    second = 0.01 * np.cos(2.7 * t + 0.4)
    found = frequencies(t, [np.cos(w * t) + second for w in (1.3, 1.4, 1.5)], 2)
    (ax,) = found.plot().axes
    strongest, others = (line for line in ax.get_lines() if line.get_marker() == "o")
    assert strongest.get_xdata().tolist() == [0, 1, 2]
    assert strongest.get_ydata() == pytest.approx([1.3, 1.4, 1.5])
    assert others.get_ydata() == pytest.approx([2.7] * 3)
    assert ax.get_title(loc="left") == "series: 3; lines of each: 2"
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("series", "frequency ω [rad/s]")
    (spanish,) = found.plot(language="es").axes
    assert spanish.get_title(loc="left") == "series: 3; líneas de cada una: 2"
    alone = frequencies(t, [second], 1).plot().axes[0]
    assert len([line for line in alone.get_lines() if line.get_marker() == "o"]) == 1


def test_lines_of_a_spectrum_stand_at_their_frequencies() -> None:
    t = np.arange(4000) * 0.05
    found = frequencies(t, np.cos(1.3 * t) + 0.01 * np.cos(2.7 * t + 0.4), 2)
    (ax,) = found.plot().axes
    (dots,) = [line for line in ax.get_lines() if line.get_marker() == "o"]
    assert dots.get_xdata() == pytest.approx([1.3, 2.7])
    assert dots.get_ydata() == pytest.approx([1.0, 0.01])
    assert ax.get_yscale() == "log"
    with pytest.raises(ValueError, match="result must be what zero_one or frequencies returned"):
        plot.spectrum(OTHER)
