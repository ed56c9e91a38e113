"""Pictures of what series tell: the 0–1 test, and the lines of a spectrum."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from pendula import plot
from pendula.chaos import frequencies, zero_one

OTHER: Any = 3


def test_the_test_of_a_series_shows_each_frequency_and_the_verdict() -> None:
    series = [0.3]
    while len(series) < 2000:
        series.append(4.0 * series[-1] * (1.0 - series[-1]))
    found = zero_one(series)
    (ax,) = found.plot(language="es").axes
    assert np.array_equal(ax.get_lines()[0].get_ydata(), found.values)
    assert ax.get_title(loc="left") == f"K = {found.value:.3f}".replace(".", ",") + ", caótico"
    assert ax.get_xlabel() == "frecuencia de la prueba c [rad por muestra]"
    made = found.to_xarray()
    assert made.attrs["verdict"] == "chaotic"
    assert np.array_equal(made["K_c"].values, found.values)


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
