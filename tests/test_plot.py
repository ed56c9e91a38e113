"""The figures: what they show, in which words, and always the same."""

from __future__ import annotations

import re
import subprocess
import sys
from typing import TYPE_CHECKING, Any

import matplotlib
import numpy as np
import pytest
from matplotlib.colors import to_hex
from matplotlib.text import Text

from pendula import (
    DoublePendulum,
    LinearPendulum,
    SimplePendulum,
    Trajectory,
    exact,
    plot,
    solve,
)
from pendula._checks import how_to_install
from pendula.analysis import agm_iterations, convergence_order, series_terms, work_precision
from pendula.plot.labels import LANGUAGES, labels
from pendula.plot.style import line

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from pendula._types import MethodName
    from pendula.systems import System

T = np.linspace(0.0, 4.0, 201)
LINEAR, SIMPLE, RODS = LinearPendulum(0.5), SimplePendulum(0.5), DoublePendulum.rods()
LARGE, START = (2.6, 0.0), (2.0, -0.2, 0.0, 0.0)


def _runs(system: System, state: tuple[float, ...], first: str) -> dict[str, Trajectory]:
    reference = exact(system, state, T) if first == "exact" else None
    runs = {m: solve(system, state, T, m, step=0.02) for m in ("euler", "heun", "rk4")}
    return {first: reference or solve(system, state, T, "rk4", step=0.001), **runs}


WORK = [
    work_precision(each, start, 0.7, points=3) for each, start in ((SIMPLE, LARGE), (RODS, START))
]


def _figures(language: str) -> dict[str, Figure]:
    words: dict[str, Any] = {"language": language}
    simple, double = _runs(SIMPLE, LARGE, "exact"), _runs(RODS, START, "reference")
    errors = {m: np.abs(r.energy_error) for m, r in double.items()}
    steps = np.geomspace(0.1, 0.00625, 5)
    case = {"euler": (0.1 * steps, convergence_order(steps, 0.1 * steps))}
    amplitudes = np.linspace(0.1, 3, 20)
    kc = np.geomspace(0.9, 0.05, 8)
    return {
        "angles": plot.angles([simple], ["a"], **words),
        "double": plot.angles([double], **words),
        "series": plot.series([(T, errors)], "energy_error", **words),
        "parting": plot.parting(T, errors, {"euler": 1.25, "reference": 3.0}, 1e-3, **words),
        "paths": plot.tip_paths(double, **words),
        "convergence": plot.convergence(steps, [case], ["b"], **words),
        "linear_error": plot.linear_error(
            amplitudes, {10: amplitudes**2}, {10: {0.25: 0.5}}, **words
        ),
        "periods": plot.periods(
            amplitudes, amplitudes + 1, {1: amplitudes, 2: amplitudes}, **words
        ),
        "work": plot.work_precision(WORK, ["a", "b"], **words),
        "work2": plot.work_precision(WORK, against=["evaluations"], **words),
        "portrait": plot.phase_portrait(SIMPLE, (0.1, 2.6), **words),
        "cost": plot.elliptic_cost(kc, series_terms(kc, 1e-9), agm_iterations(kc, 1e-9), **words),
        "run": plot.trajectory(simple["exact"], **words),
        "run2": plot.trajectory(double["heun"], **words),
    }


@pytest.fixture(scope="module", params=LANGUAGES)
def figures(request: pytest.FixtureRequest) -> tuple[str, dict[str, Figure]]:
    return request.param, _figures(request.param)


def _texts(figure: Figure) -> list[str]:
    figure.draw_without_rendering()
    return [t.get_text() for t in figure.findobj(Text) if isinstance(t, Text) and t.get_text()]


def test_every_axis_is_labelled_in_the_language(figures: tuple[str, dict[str, Figure]]) -> None:
    language, drawn = figures
    known = set(labels(language).axis.values())
    for name, figure in drawn.items():
        for ax in figure.axes:
            if ax.get_visible() and not (ax.get_shared_y_axes().get_siblings(ax)[1:]):
                assert ax.get_ylabel() in known | {""}, name
        assert {ax.get_xlabel() for ax in figure.axes} & known, name
        assert {ax.get_ylabel() for ax in figure.axes} & known, name


def test_numbers_have_the_decimal_sign_of_the_language(
    figures: tuple[str, dict[str, Figure]],
) -> None:
    language, drawn = figures
    wrong = {"en": r"\d,\d", "es": r"\d\.\d"}[language]
    right = {"en": r"\d\.\d", "es": r"\d,\d"}[language]
    seen = [text for figure in drawn.values() for text in _texts(figure)]
    assert not [text for text in seen if re.search(wrong, text)]
    assert len([text for text in seen if re.search(right, text)]) > 10


def test_nothing_is_drawn_outside_the_figure(figures: tuple[str, dict[str, Figure]]) -> None:
    for name, figure in figures[1].items():
        figure.draw_without_rendering()
        whole = figure.bbox.padded(1)
        for text in figure.findobj(Text):
            if isinstance(text, Text) and text.get_text() and text.get_visible():
                box = text.get_window_extent()
                inside = whole.contains(box.x0, box.y0) and whole.contains(box.x1, box.y1)
                # Ticks beyond the ends of an axis exist, but are not drawn.
                assert inside or not re.search("[a-z]{2}", text.get_text()), (name, text)


def test_svg_is_the_same_each_time_and_has_no_date() -> None:
    one, two = (plot.svg(_figures("en")["portrait"]) for _ in range(2))
    assert one == two
    assert b"dc:date" not in one


def test_a_users_own_settings_do_not_matter() -> None:
    expected = plot.svg(plot.phase_portrait(SIMPLE, (0.1, 2.6)))
    with matplotlib.rc_context({"font.size": 20, "lines.linewidth": 5, "xtick.top": True}):
        assert plot.svg(plot.phase_portrait(SIMPLE, (0.1, 2.6))) == expected


def test_a_run_looks_the_same_in_every_figure(figures: tuple[str, dict[str, Figure]]) -> None:
    words = labels(figures[0])
    for name in ("angles", "series", "convergence"):
        for ax in figures[1][name].axes:
            for drawn in ax.get_lines():
                for run in ("exact", "euler", "heun", "rk4"):
                    if drawn.get_label() == words.name(run):
                        assert to_hex(drawn.get_color()) == line(run)["color"]
    looks = [line(run) for run in ("exact", "euler", "heun", "rk4", "linear")]
    assert len({look["color"] for look in looks}) == len({str(k["linestyle"]) for k in looks}) == 5


def test_trajectory_shows_the_run() -> None:
    run = exact(SIMPLE, LARGE, T)
    angle, energy, phase = plot.trajectory(run).axes
    np.testing.assert_array_equal(angle.get_lines()[0].get_ydata(), np.degrees(run.theta))
    np.testing.assert_array_equal(phase.get_lines()[0].get_ydata(), run.omega)
    assert energy.get_yscale() == "log"
    double = _runs(RODS, START, "reference")["heun"]
    tip = plot.trajectory(double).axes[2].get_lines()[0]
    np.testing.assert_array_equal(tip.get_ydata(), RODS.positions(double.states)[:, 1, 1])


def test_trajectory_plot_is_this_figure() -> None:
    run = exact(SIMPLE, LARGE, T)
    assert plot.svg(run.plot()) == plot.svg(plot.trajectory(run))


def test_trajectory_refuses_several_runs_and_other_languages() -> None:
    several = exact(SIMPLE, [LARGE, (0.1, 0.0)], T)
    with pytest.raises(ValueError, match="must be one motion, got states of shape"):
        plot.trajectory(several)
    with pytest.raises(ValueError, match="language must be one of en, es; got 'fr'"):
        plot.trajectory(exact(SIMPLE, LARGE, T), language="fr")


def test_a_run_at_rest_can_be_drawn() -> None:
    still = solve(SIMPLE, (0.0, 0.0), T, "euler", step=0.02)
    assert b"<svg" in plot.svg(plot.trajectory(still))


def test_a_run_that_blew_up_does_not_hide_the_others() -> None:
    runs = _runs(RODS, START, "reference")
    runs["euler"] = solve(RODS, START, T, "euler", step=0.5)
    shown = plot.angles([runs]).axes[0].get_ylim()
    theta = np.degrees(runs["reference"].theta[:, 0])
    assert shown[1] - shown[0] < 3 * (theta.max() - theta.min())


def test_errors_past_all_bounds_do_not_flatten_the_others() -> None:
    errors = {"euler": np.geomspace(1e-3, 1e300, len(T)), "rk4": np.full(len(T), 1e-6)}
    low, high = plot.series([(T, errors)], "difference").axes[0].get_ylim()
    assert 1e-8 < low < 1e-6
    assert 1e3 < high < 1e11


def test_slopes_stand_off_the_axis() -> None:
    steps = np.geomspace(0.01, 0.01 / 128, 8)
    case = {
        m: (e, convergence_order(steps, e))
        for m, e in {"euler": steps, "heun": steps**2, "rk4": 1e3 * steps**4}.items()
    }
    figure = plot.convergence(steps, [case] * 3, ["a", "b", "c"])
    figure.draw_without_rendering()
    for ax in figure.axes:
        assert len(ax.texts) == 3
        for text in ax.texts:
            assert ax.bbox.x0 + 4 < text.get_window_extent().x0
            assert text.get_window_extent().x1 < ax.bbox.x1 + 4


def test_catalogues_of_both_languages_have_the_same_words() -> None:
    english, spanish = (labels(language) for language in LANGUAGES)
    for part in ("run", "axis", "curve"):
        assert getattr(english, part).keys() == getattr(spanish, part).keys()


@pytest.mark.parametrize("module", ["pendula.plot", "pendula.study", "pendula.analysis"])
def test_import_does_not_bring_matplotlib(module: str) -> None:
    code = f"import sys, {module}; sys.exit('matplotlib' in sys.modules or 'typst' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_without_matplotlib_one_line_says_what_to_install(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    with pytest.raises(ImportError, match=re.escape(how_to_install("report"))):
        plot.phase_portrait(SIMPLE, (0.1,))


@pytest.mark.parametrize("amplitude", [0.6, 1.7, 4.5, 8, 27, 44, 80, 100, 179])
def test_a_phase_portrait_tells_its_scale(amplitude: float) -> None:
    """Three angles at least, and no more than there is room for."""
    run = solve(SIMPLE, (np.radians(amplitude), 0.0), 6.0)
    figure = plot.trajectory(run)
    (plane,) = (ax for ax in figure.axes if "rad/s" in ax.get_ylabel())
    low, high = plane.get_xlim()
    assert 3 <= sum(low <= each <= high for each in plane.get_xticks()) <= 5


@pytest.mark.parametrize("method", ["taylor", "dop853"])
def test_lines_follow_the_motion_between_the_steps(method: MethodName) -> None:
    """Where the outputs are the few steps of an adaptive method, straight lines would be seen."""
    run = solve(SIMPLE, (0.08, 0.0), -6.0, method)
    angle, energy, plane = plot.trajectory(run).axes
    (line_over_time,), (orbit,) = angle.get_lines(), plane.get_lines()
    times, shown = np.asarray(line_over_time.get_data())
    assert np.isin(run.t, times).all()
    truth = np.degrees(exact(SIMPLE, (0.08, 0.0), times).theta)
    assert abs(shown - truth).max() < 1e-9
    assert abs(np.diff(shown, 2)).max() < 0.01 * np.ptp(shown)
    assert abs(np.diff(np.asarray(orbit.get_xdata()), 2)).max() < 0.01 * np.ptp(shown)
    assert np.size(energy.get_lines()[0].get_xdata()) == run.t.size
    asked = solve(SIMPLE, (0.08, 0.0), T, method)
    assert np.size(plot.trajectory(asked).axes[0].get_lines()[0].get_xdata()) == T.size
