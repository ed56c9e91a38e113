"""Pictures of chaos: what they show of the numbers, in both languages, with the case on them."""

from __future__ import annotations

import io
from typing import Any

import numpy as np
import pytest
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure

from drawn import texts
from pendula import DampedDoublePendulum, DoublePendulum, DrivenPendulum, SimplePendulum, plot
from pendula.chaos import (
    bifurcation,
    family,
    indicator_map,
    lyapunov,
    megno,
    normal_mode,
    sali,
    section,
    section_map,
)
from pendula.plot.case import case_of
from pendula.plot.labels import labels
from refusals import told

RODS = DoublePendulum.rods(gravity=9.81)
WILD, CALM = (2.0, 2.5, 0.0, 0.0), (0.4, -0.3, 0.2, 0.1)
SCALED = DrivenPendulum.scaled(2.0, 1.0, 2.0 / 3.0)
OTHER: Any = 3
EN = "rods: m₁ = m₂ = 1 kg; l₁ = l₂ = 1 m; g = 9.81 m/s²"
ES = "varillas: m₁ = m₂ = 1 kg; l₁ = l₂ = 1 m; g = 9,81 m/s²"


def lines(ax: Any) -> list[Any]:
    return [line for line in ax.get_lines() if len(line.get_xdata()) > 2]


# ---- the case ----


@pytest.mark.parametrize(
    ("system", "case"),
    [
        (RODS, EN),
        (DoublePendulum.bobs(2.0, 1.0, gravity=9.81), "bobs: m₁ = 2 kg; m₂ = 1 kg; l₁ = l₂ = 1 m"),
        (SCALED, "without units: q = 2; a = 1; Ω = 0.666667"),
        (SimplePendulum(0.5), "bob: l = 0.5 m; g = 9.80665 m/s²; m = 1 kg"),
        (DampedDoublePendulum.rods(viscous=(0.1, 0.0)), "rods with friction: m₁ = m₂ = 1 kg"),
    ],
)
def test_the_case_names_what_is_not_zero(system: Any, case: str) -> None:
    shown = case_of(system, labels("en"))
    assert shown.startswith(case)
    assert " = 0" not in shown.replace("= 0.", "")
    assert not shown.endswith("b₂ = 0 N m s")


def test_the_case_has_energy_and_spanish_numbers() -> None:
    assert case_of(RODS, labels("es"), {"E": (7.5, "J")}) == f"{ES}; E = 7,5 J"


# ---- running estimates ----


def test_an_exponent_runs_in_the_band_of_its_error() -> None:
    found = lyapunov(RODS, WILD, 100.0)
    figure = found.plot()
    ax = figure.axes[0]
    drawn = lines(ax)[0]
    assert np.array_equal(drawn.get_ydata(), found.running[:, 0])
    band = ax.collections[0].get_paths()[0].vertices
    last = band[np.isclose(band[:, 0], 100.0)]
    value, error = found.exponents[0], found.standard_error[0]
    assert last[:, 1].min() == pytest.approx(value - error)
    assert last[:, 1].max() == pytest.approx(value + error)
    early = band[np.isclose(band[:, 0], 1.0)]
    assert np.ptp(early[:, 1]) == pytest.approx(20.0 * error)  # √(100/1) times as wide
    said = texts(figure)
    assert EN in said
    assert "θ₁ = 114.592°" in said
    assert f"λ₁ = {value:.4g} ± {error:.2g}, chaotic" in said


def test_a_regular_exponent_falls_on_logarithmic_axes_without_a_band() -> None:
    figure = lyapunov(RODS, CALM, 100.0).plot(language="es")
    assert figure.axes[0].get_yscale() == "log"
    assert not figure.axes[0].collections
    assert "regular" in texts(figure)
    assert "exponente de Lyapunov λ [1/s]" in texts(figure)


def test_several_exponents_and_several_motions() -> None:
    assert len(lines(lyapunov(RODS, WILD, 50.0, exponents=4).plot().axes[0])) == 4
    many = lyapunov(RODS, [WILD, CALM, (0.3, 0.1, 0.0, 0.0)], 200.0)
    figure = many.plot()
    colours = [line.get_color() for line in lines(figure.axes[0])]
    assert len(set(colours)) == 2
    assert "chaotic (1)" in texts(figure)
    assert "regular (2)" in texts(figure)


def test_names_of_all_exponents_fit_into_the_figure() -> None:
    figure = lyapunov(RODS, WILD, 100.0, exponents=4).plot(language="es")
    figure.draw_without_rendering()
    (legend,) = figure.legends
    assert len(legend.get_texts()) == 4
    for text in legend.get_texts():
        assert text.get_window_extent().x1 < figure.bbox.x1
    assert len(figure.axes[0].collections) == 2  # bands of those that differ from 0


def test_megno_and_sali() -> None:
    t = np.linspace(1.0, 60.0, 60)
    calm = megno(RODS, CALM, t).plot()
    drawn = lines(calm.axes[0])
    assert np.array_equal(drawn[1].get_ydata(), megno(RODS, CALM, t).mean)
    assert calm.axes[0].get_yscale() == "linear"
    assert megno(RODS, WILD, t).plot().axes[0].get_yscale() == "log"
    found = sali(RODS, WILD, t)
    ax = found.plot().axes[0]
    assert np.array_equal(lines(ax)[0].get_ydata(), found.value)
    assert ax.get_ylabel() == "SALI"


# ---- sections ----


# ---- orbits, families, bifurcations ----


def test_an_orbit_and_its_multipliers() -> None:
    orbit = normal_mode(RODS, 1, amplitude=1.0)
    figure = orbit.plot()
    angles, plane = figure.axes
    theta1, theta2 = (line.get_ydata() for line in lines(angles))
    assert theta1[0] == pytest.approx(np.degrees(1.0))
    assert theta1[-1] == pytest.approx(theta1[0])
    assert theta2.max() == pytest.approx(np.degrees(orbit.state[1]), abs=15.0)
    marks = next(line for line in plane.get_lines() if line.get_marker() == "o")
    found = marks.get_xdata() + 1j * marks.get_ydata()
    np.testing.assert_allclose(np.abs(found), 1.0, atol=1e-9)
    assert "elliptic" in texts(figure)
    assert "elíptica" in texts(orbit.plot(language="es"))


def test_a_family_is_dashed_where_it_is_unstable() -> None:
    found = family(normal_mode(RODS, 2, energy=6.0), 12, energy=(5.0, 11.0))
    (change,) = found.changes
    figure = found.plot()
    above, below = figure.axes
    for ax in (above, below):
        calm, wild = lines(ax)
        assert calm.get_linestyle() == "-"
        assert wild.get_linestyle() == "--"
        assert calm.get_xdata()[-1] == wild.get_xdata()[0] == change.value
    sums = np.concatenate([lines(below)[0].get_ydata(), lines(below)[1].get_ydata()])
    assert sums.min() == pytest.approx(found.orbits[0].multiplier_sum)
    assert below.get_xlabel() == "energy [J]"
    assert "stability changes" in texts(figure)
    assert "período T [s]" in texts(found.plot(language="es"))


def test_a_family_is_drawn_round_its_fold() -> None:
    rods = DoublePendulum.rods(1.17, 1.92, 0.55, 1.91, gravity=9.81)
    found = family(normal_mode(rods, 1, energy=9.0), 6, energy=(8.0, 10.0))
    (fold,) = found.changes
    calm, wild = lines(found.plot().axes[0])
    assert (calm.get_linestyle(), wild.get_linestyle()) == ("-", "--")
    assert calm.get_xdata()[-1] == wild.get_xdata()[0] == fold.value
    assert [*calm.get_xdata()[:-1], *wild.get_xdata()[1:]] == found.values.tolist()


def test_a_bifurcation_has_the_exponent_below_and_marks_doublings() -> None:
    values = np.linspace(1.06, 1.075, 6)
    found = bifurcation(SCALED, "a", values, points=32, transient=100)
    assert found.doublings
    above, below = found.plot().axes
    assert len(above.collections[0].get_offsets()) == 6 * 32
    marks = {line.get_xdata()[0] for line in above.get_lines()}
    assert {each.value for each in found.changes} <= marks
    drawn = np.sort(
        np.concatenate([line.get_xdata() for line in below.get_lines() if line.get_marker() == "."])
    )
    np.testing.assert_allclose(drawn, values)
    assert "q = 2" in texts(found.plot())
    assert "a = 1" not in texts(found.plot())  # it is the axis
    degrees = plot.bifurcation(found, quantity="angle", language="es")
    assert degrees.axes[0].get_ylabel() == "ángulo θ [°]"
    (legend,) = degrees.legends
    said = [each.get_text() for each in legend.get_texts()]
    assert said == ["λ < 3 errores estándar", "cambia la estabilidad"]


# ---- maps ----


def test_an_indicator_map_is_light_where_it_is_chaotic() -> None:
    data = indicator_map(RODS, (-3.0, 3.0), (-3.0, 3.0), (12, 10), 15.0)
    figure = plot.stored_map(data, language="es")
    ax = figure.axes[0]
    shown = np.asarray(ax.get_images()[0].get_array()).transpose(1, 0, 2)
    brightness = shown.sum(axis=-1).ravel()[np.argsort(data.megno.values.ravel())]
    assert brightness[-20:].min() > brightness[:20].max()
    assert f"{ES}; t = 15 s" in texts(figure)
    assert ax.child_axes[0].get_ylabel() == "MEGNO medio ⟨Y⟩"
    small = indicator_map(RODS, (-3.0, 3.0), (-3.0, 3.0), (12, 10), 15.0, "sali")
    image = plot.indicator_map(small).axes[0].get_images()[0].get_array()
    light = np.asarray(image).transpose(1, 0, 2).sum(axis=-1).ravel()
    order = np.argsort(small.sali.values.ravel())
    assert light[order[:20]].min() > light[order[-20:]].max()


def test_a_section_map_has_its_own_axes_and_is_hatched_beyond_the_energy() -> None:
    data = section_map(RODS, 6.0, (14, 11), 10.0)
    figure = plot.stored_map(data)
    ax = figure.axes[0]
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("angle θ₂ [°]", "momentum p₂ [J s]")
    shown = np.asarray(ax.get_images()[0].get_array()).transpose(1, 0, 2) / 255
    beyond = data.forbidden.values
    assert beyond.any()
    np.testing.assert_allclose(
        shown[beyond], np.broadcast_to(to_rgb("#f7f8f9"), (beyond.sum(), 3)), atol=3e-3
    )
    assert "beyond the energy" in texts(figure)
    assert f"{EN}; E = 6 J; t = 10 s" in texts(figure)
    _, _, low, high = ax.get_images()[0].get_extent()
    half = np.sqrt(2.0 * RODS.constants["B"] * 6.0)
    assert (low, high) == pytest.approx((-half, half))


def test_pictures_go_into_axes_that_are_given() -> None:
    figure = Figure(figsize=(9, 6), layout="constrained")
    grid = figure.subplots(2, 2).ravel()
    found = lyapunov(RODS, WILD, 20.0)
    assert found.plot(ax=grid[0]) is grid[0]
    points = section(RODS, energy=5.0, starts=3, crossings=10)
    assert plot.section(points, [2.0, 3.0, 4.0], ax=grid[1], title="here") is grid[1]
    assert grid[1].get_title(loc="left") or grid[1].get_title()
    data = section_map(RODS, 5.0, (6, 5), 5.0)
    assert plot.indicator_map(data, ax=grid[2]) is grid[2]
    assert plot.running(megno(RODS, CALM, [1.0, 2.0, 3.0]), ax=grid[3]) is grid[3]
    figure.savefig(io.BytesIO(), format="png")


@pytest.mark.parametrize("kind", ["png", "svg", "pdf"])
def test_the_same_picture_has_the_same_bytes(kind: str) -> None:
    found = section(RODS, energy=5.0, starts=3, crossings=10)
    one, other = (plot.picture(found.plot(), kind) for _ in range(2))
    assert one == other


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: plot.running(OTHER), "result must be what lyapunov, megno, sali or gali returned"),
        (lambda: plot.section(OTHER), "found must be what pendula.chaos.section returned"),
        (lambda: plot.family(OTHER), "found must be what pendula.chaos.family returned"),
        (lambda: plot.periodic_orbit(OTHER), "orbit must be a periodic orbit of pendula.chaos"),
        (lambda: plot.bifurcation(OTHER), "found must be what pendula.chaos.bifurcation returned"),
        (
            lambda: plot.indicator_map(OTHER),
            "dataset must be a dataset of pendula.chaos.indicator_map",
        ),
        (
            lambda: plot.section(section(RODS, WILD, crossings=3), [1.0, 2.0]),
            "indicator must have shape (1,), got shape (2,)",
        ),
        (
            lambda: plot.section(section(RODS, WILD, crossings=3), [1.0], limits=(3.0, 2.0)),
            "limits must be two values, 0 < low < high",
        ),
        (
            lambda: plot.indicator_map(
                indicator_map(RODS, (0.0, 1.0), (0.0, 1.0), (2, 2), 1.0), limits=(0.0, 1.0)
            ),
            "limits must be two values, low < high, above 0 for logarithmic colours",
        ),
        (lambda: lyapunov(RODS, WILD, 9.0).plot(language="fr"), "language must be one of en, es"),
    ],
)
def test_a_picture_of_something_else_is_refused(call: Any, message: str) -> None:
    assert message in told(call)
