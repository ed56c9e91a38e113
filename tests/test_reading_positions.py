"""Positions of marked points: pivot, length and angles, units and which way y grows."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from scipy.optimize import least_squares

from pendula.measured.circle import circle_of
from recordings import LENGTH, OTHER_SWING, SWING, TIMES, X, Y, rows, text
from test_reading_text import measured

if TYPE_CHECKING:
    from pathlib import Path

T = TIMES
X2, Y2 = X + 0.4 * np.sin(OTHER_SWING), Y - 0.4 * np.cos(OTHER_SWING)


def test_angles_and_length_of_a_marker_in_metres(tmp_path: Path) -> None:
    content = text("t;x (cm);y (cm)", rows(T, 100 * X + 3, 100 * Y - 2, separator=";", mark=","))
    found = measured(tmp_path / "a.csv", content)
    assert (found.quantity, found.names, found.unit) == ("position", ("x", "y"), "m")
    np.testing.assert_allclose(found.values.T, [X + 0.03, Y - 0.02], rtol=0, atol=1e-7)
    angle = found.as_angle()
    assert (angle.quantity, angle.names, angle.unit) == ("angle", ("theta",), "rad")
    np.testing.assert_allclose(angle.values[:, 0], SWING, rtol=0, atol=1e-5)
    assert angle.geometry["length"] == pytest.approx(LENGTH, abs=1e-5)
    assert angle.geometry["pivot_x"] == pytest.approx(0.03, abs=1e-5)
    assert angle.geometry["circle_rms"] < 1e-7
    again = measured(tmp_path / "a.csv", content, as_angle=True)
    np.testing.assert_array_equal(again.values, angle.values)
    assert angle.as_angle() is angle


@pytest.mark.parametrize("down", [True, False])
def test_the_motion_shows_which_way_y_grows(down: bool, tmp_path: Path) -> None:
    up = 500 + 800 * (-Y if down else Y)
    found = measured(tmp_path / "a.csv", text("t,x (px),y (px)", rows(T, 900 + 800 * X, up)))
    assert (found.unit, found.reading["y_axis"]) == ("px", "down" if down else "up")
    angle = found.as_angle()
    np.testing.assert_allclose(angle.values[:, 0], SWING, rtol=0, atol=1e-6)
    assert angle.geometry["length_px"] == pytest.approx(800 * LENGTH, abs=1e-3)
    turned = measured(
        tmp_path / "a.csv",
        text("t,x (px),y (px)", rows(T, 900 + 800 * X, up)),
        y_axis="up" if down else "down",
    )
    np.testing.assert_array_equal(turned.values[:, 1], -found.values[:, 1])


def test_pixels_with_a_scale_are_metres(tmp_path: Path) -> None:
    content = text("frame,x,y", rows(np.arange(400.0), 900 + 800 * X, 500 - 800 * Y))
    found = measured(tmp_path / "a.csv", content, frame_rate=50, scale=1 / 800)
    assert found.unit == "m"
    np.testing.assert_allclose(found.t, T, rtol=0, atol=1e-12)
    assert found.as_angle().geometry["length"] == pytest.approx(LENGTH, abs=1e-6)


def test_positions_without_a_unit_are_asked_for(tmp_path: Path) -> None:
    content = text("t,x,y", rows(T, 1000 * X + 0.5, 1000 * Y))
    with pytest.raises(ValueError, match="^unit is not told: positions from -600 to 177.* unit=mm"):
        measured(tmp_path / "a.csv", content)
    whole = text("t,x,y", rows(T, np.round(1000 * X), np.round(1000 * Y)))
    assert measured(tmp_path / "b.csv", whole).unit == "px"


def test_two_bobs_in_any_order(tmp_path: Path) -> None:
    columns = rows(T, X2, Y2, X, Y)
    for header in ("t,x_m2,y_m2,x_m1,y_m1", "t,x (m),y (m),x (m),y (m)", "t,xA,yA,xB,yB"):
        found = measured(tmp_path / "a.csv", text(header, columns), unit="m")
        assert (found.names, found.bodies) == (("x1", "y1", "x2", "y2"), 2)
        angle = found.as_angle()
        np.testing.assert_allclose(angle.values.T, [SWING, OTHER_SWING], rtol=0, atol=1e-4)
        assert angle.geometry["l1"] == pytest.approx(LENGTH, abs=1e-5)
        assert angle.geometry["l2"] == pytest.approx(0.4, abs=1e-5)


def test_a_point_that_stands_still_is_the_pivot(tmp_path: Path) -> None:
    content = text("t,x0,y0,x1,y1", rows(T, 0 * T + 0.3, 0 * T + 0.1, X + 0.3, Y + 0.1))
    found = measured(tmp_path / "a.csv", content, unit="m")
    assert found.names == ("x", "y")
    assert found.geometry == {"pivot_x": 0.3, "pivot_y": 0.1}
    np.testing.assert_allclose(found.as_angle().values[:, 0], SWING, rtol=0, atol=1e-5)


def test_points_without_names_in_pixels_y_first(tmp_path: Path) -> None:
    """As the film of a double pendulum is stored: y before x, y down, the pivot first."""
    joint_x, joint_y = np.sin(OTHER_SWING), -np.cos(OTHER_SWING)
    pairs = [0 * T, 0 * T, joint_y, joint_x, joint_y + Y, joint_x + X]
    whole = [np.round(1000 - 400 * each if i % 2 == 0 else 700 + 400 * each) for i, each in
             enumerate(pairs)]  # fmt: skip
    content = text(rows(*whole, form="%.0f"))
    with pytest.raises(ValueError, match=r"has no column of times; .*frame_rate=30$"):
        measured(tmp_path / "a.csv", content)
    found = measured(tmp_path / "a.csv", content, frame_rate=50)
    assert (found.reading["x"], found.reading["y"]) == ((4, 6, 2), (3, 5, 1))
    assert found.reading["y_axis"] == "down"
    angle = found.as_angle().values
    np.testing.assert_allclose(angle.T, [OTHER_SWING, SWING], rtol=0, atol=0.01)


def test_points_that_are_too_many_are_asked_for(tmp_path: Path) -> None:
    content = text("t,xA,yA,xB,yB,xC,yC", rows(T, X, Y, X2, Y2, X + X2, Y + Y2))
    with pytest.raises(ValueError, match="^x could be of 3 points: 'xA' or 'xB' or 'xC'; name one"):
        measured(tmp_path / "a.csv", content, unit="m")
    found = measured(tmp_path / "a.csv", content, x=("xA", "xB"), y=("yA", "yB"), unit="m")
    np.testing.assert_allclose(found.values.T, [X, Y, X2, Y2], rtol=0, atol=1e-6)


def test_a_straight_line_has_no_pivot(tmp_path: Path) -> None:
    found = measured(tmp_path / "a.csv", text("t,x (m),y (m)", rows(T, X, 0.5 * X)))
    with pytest.raises(ValueError, match="^positions must lie on an arc"):
        found.as_angle()


@pytest.mark.parametrize("arc", [0.2, 1.0, 6.0])
def test_the_circle_is_that_of_least_squares(arc: float) -> None:
    random = np.random.default_rng(7)
    angle = np.linspace(-arc / 2, arc / 2, 300)
    x = 3.0 + 2.0 * np.sin(angle) + random.normal(0.0, 0.002, angle.size)
    y = 1.0 - 2.0 * np.cos(angle) + random.normal(0.0, 0.002, angle.size)
    x[7] = np.nan
    there = np.isfinite(x)

    def off(circle: tuple[float, float, float]) -> np.ndarray:
        return np.hypot(x[there] - circle[0], y[there] - circle[1]) - circle[2]

    truth = least_squares(off, (3.0, 1.0, 2.0), xtol=1e-15, ftol=1e-15, gtol=1e-15)
    found = circle_of(x, y)
    assert found is not None
    np.testing.assert_allclose((found.x, found.y, found.radius), truth.x, rtol=1e-6)
    assert found.rms == pytest.approx(np.sqrt(np.mean(truth.fun**2)), rel=1e-9)
    covariance = np.linalg.inv(truth.jac.T @ truth.jac) * (truth.fun @ truth.fun) / (298 - 2)
    assert found.radius_error == pytest.approx(np.sqrt(covariance[2, 2]), rel=1e-2)
