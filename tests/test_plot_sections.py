"""Pictures of sections: points, labels and the colours of indicators."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from drawn import texts
from pendula import DoublePendulum, DrivenPendulum, plot
from pendula.chaos import chaotic_share, section

RODS = DoublePendulum.rods(gravity=9.81)
WILD, CALM = (2.0, 2.5, 0.0, 0.0), (0.4, -0.3, 0.2, 0.1)
SCALED = DrivenPendulum.scaled(2.0, 1.0, 2.0 / 3.0)
OTHER: Any = 3
EN = "rods: m₁ = m₂ = 1 kg; l₁ = l₂ = 1 m; g = 9.81 m/s²"
ES = "varillas: m₁ = m₂ = 1 kg; l₁ = l₂ = 1 m; g = 9,81 m/s²"


def test_a_section_shows_its_points_in_the_colours_of_an_indicator() -> None:
    found = section(RODS, energy=10.0, starts=6, crossings=20)
    black = found.plot(language="es")
    points = black.axes[0].collections[0].get_offsets()
    wanted = found.points.reshape(-1, 2) * (180.0 / np.pi, 1.0)
    np.testing.assert_allclose(points, wanted)
    assert black.axes[0].get_xlabel() == "ángulo θ₂ [°]"
    assert black.axes[0].get_ylabel() == "momento p₂ [J s]"
    assert f"{ES}; E = 10 J" in texts(black)
    values = np.array([2.0, 100.0, 3.0, 50.0, 2.0, 10.0])
    figure = plot.section(found, values)
    drawn: Any = figure.axes[0].collections[0]
    assert drawn.norm.vmin == 2.0
    assert drawn.norm.vmax == 100.0
    assert list(np.unique(drawn.get_array())) == sorted(set(values))
    first = drawn.get_array()[0]
    assert first == 100.0  # chaotic motions lie below
    assert figure.axes[1].get_ylabel() == "mean MEGNO ⟨Y⟩"


@pytest.mark.parametrize(
    ("indicator", "label", "chaotic_below"),
    [
        ("megno", "mean MEGNO ⟨Y⟩", np.argmax),
        ("lyapunov", "Lyapunov exponent λ [1/s]", np.argmax),
        ("sali", "SALI", np.argmin),
    ],
)
def test_a_section_in_the_colours_of_its_own_indicator(
    indicator: str, label: str, chaotic_below: Any
) -> None:
    found = section(RODS, energy=12.0, starts=6, crossings=4, indicator=indicator, t_max=60.0)
    figure = found.plot()
    drawn: Any = figure.axes[0].collections[0]
    assert figure.axes[1].get_ylabel() == label
    assert f"{EN}; E = 12 J; t = 60 s" in texts(figure)
    values = found.values
    assert values is not None
    wildest, least = int(chaotic_below(values)), int(chaotic_below(-values))
    np.testing.assert_allclose(drawn.get_offsets()[0, 1], found.points[wildest, 0, 1])
    inks = drawn.to_rgba(np.clip(values, *drawn.get_clim()))[:, :3].sum(axis=1)
    assert inks[wildest] > inks[least]  # chaos is light, whatever the indicator


def test_a_strobed_section_has_angle_and_rate() -> None:
    figure = section(SCALED, (0.1, 0.0), crossings=30).plot()
    assert figure.axes[0].get_ylabel() == "angular velocity ω"
    assert len(figure.axes[0].collections[0].get_offsets()) == 30


def test_a_share_is_drawn_with_its_error_and_what_is_open() -> None:
    found = chaotic_share(RODS, [12.0, 8.0], n=20, t_max=50.0)
    figure = plot.chaotic_share(found, language="es")
    above, below = figure.axes
    (line,) = (each for each in above.get_lines() if each.get_marker() == "o")
    assert np.asarray(line.get_xdata()).tolist() == [8.0, 12.0]
    assert np.asarray(line.get_ydata()).tolist() == found.share.values[::-1].tolist()
    assert (above.get_ylabel(), below.get_xlabel()) == ("parte caótica", "energía [J]")
    assert f"{ES}; t = 50 s" in texts(figure)
    assert "indeciso" in texts(figure)
    with pytest.raises(ValueError, match=r"dataset must be what pendula\.chaos\.chaotic_share"):
        plot.chaotic_share(OTHER)
