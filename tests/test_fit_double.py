"""Fits of double pendulums, over windows."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest
from scipy.io import loadmat

import pendula
from pendula.measured import Measurement, fit, read
from pendula.measured.asked import sampled
from pendula.measured.double_model import SHAPE, STATE, DoubleModel, shape_of
from pendula.measured.problem import Problem
from pendula.measured.system_model import SystemModel
from pendula.measured.windows import cut
from pendula.study.measured.facts import value_rows
from pendula.study.report import catalogue
from recordings import recording
from simulated import correlated

# the machined pendulum's parameters, fitted by its owners
PUBLISHED = pendula.DampedDoublePendulum.bodies(
    0.0938440,
    0.1375960,
    0.1727192,
    0.1085652,
    0.1167790,
    4.3753e-4,
    1.26883e-3,
    9.80858,
    viscous=(2.3714e-4, 1.0e-5),
)


def window(i: int, step: int = 1, seconds: float = 10.0) -> Measurement:
    """A window of the machined double pendulum; its angles are from the upright."""
    kept = loadmat(recording("double_encoder_1kHz_windows.mat"))
    t, angles = kept[f"t_{i}"][0][::step], kept[f"y_{i}"][:2].T[::step] - np.pi
    inside = t <= t[0] + seconds
    return of_angles(t[inside], angles[inside])


def of_angles(t: np.ndarray, angles: np.ndarray) -> Measurement:
    names = ("theta1", "theta2")
    made = np.ascontiguousarray(t), np.ascontiguousarray(angles)
    return Measurement(*made, "angle", names, "rad", bodies=2)


@pytest.mark.parametrize(("i", "rms"), [(1, (4.4, 10.1)), (2, (3.0, 4.8)), (3, (1.7, 2.9))])
def test_windows_with_published_parameters_have_their_reference_residuals(
    i: int, rms: tuple[float, float]
) -> None:
    found = fit(window(i), PUBLISHED, free=())
    assert found.names == ("theta1", "theta2", "omega1", "omega2")
    reached = 1e3 * np.sqrt(np.mean(found.residuals**2, axis=0))
    np.testing.assert_allclose(reached, rms, atol=0.06)
    assert found.horizon is not None
    assert not found.horizon.left
    assert found.horizon.followed == pytest.approx(2.666, abs=1e-3)


def test_the_shape_is_found_without_knowing_anything() -> None:
    published = shape_of(PUBLISHED)
    for i in (1, 2, 3):
        found = fit(window(i), "viscous")
        for name in SHAPE:
            assert found[name].value == pytest.approx(published[name], rel=0.01), name
        ratio = found.derived["gravity_over_length1"]
        assert ratio.value == pytest.approx(9.80858 / 0.1727192, rel=0.01)
        assert found.rms < 7e-3
    wrong = fit(replace(window(1), geometry={"l1": 0.1}), "viscous")
    assert "gravity_unlikely" in wrong.flags
    right = fit(replace(window(1), geometry={"l1": 0.1727192}), "viscous")
    assert right["gravity"].value == pytest.approx(9.81, rel=0.01)
    assert "gravity_unlikely" not in right.flags


def test_the_model_leaves_where_it_is_wrong() -> None:
    heavier = pendula.DampedDoublePendulum.bodies(
        0.0938440, 0.1375960, 0.1727192, 0.1085652, 0.1367790, 4.3753e-4, 1.26883e-3, 9.80858
    )
    found = fit(window(1), heavier, free=(), tolerance=0.01, windows=0.5)
    assert found.horizon is not None
    assert found.horizon.left
    assert found.horizon.followed < 1.0 < found.horizon.trust
    assert len(found.recordings) == 6
    assert "left" in found.flags
    assert "leaves the measurement by 0.01 rad after" in found.notes[-1].sentence()


def test_true_values_of_a_chaotic_motion_lie_within_their_errors() -> None:
    system = pendula.DampedDoublePendulum.bobs(1.0, 0.5, 0.3, 0.25, 9.81, viscous=(2e-3, 1e-3))
    random = np.random.default_rng(4)
    true = shape_of(system)
    inside = []
    for start in ((2.0, 1.0, 0.0, 0.0), (1.0, 2.5, 0.0, 0.0), (1.5, -1.0, 1.0, 0.0)):
        t = np.arange(600) / 200.0
        angles = pendula.solve(system, start, t).states[:, :2]
        noise = np.stack([correlated(random, len(t), 0.9) for _ in range(2)], axis=1)
        found = fit(of_angles(t, angles + 2e-3 * noise), "viscous")
        for name in (*SHAPE, "viscous1", "viscous2"):
            inside.append(abs(found[name].value - true[name]) <= 2.5 * found[name].standard_error)
    assert np.mean(inside) > 0.85


def test_windows_have_starts_of_their_own_and_share_the_pendulum() -> None:
    found = fit(window(1), "viscous", windows=0.7)
    assert len(found.recordings) == 4
    assert found.names[:4] == SHAPE
    assert {"theta1[4]", "omega2[4]"} <= set(found.names)
    assert found.rms < fit(window(1), "viscous").rms
    note = next(note for note in found.notes if note.key == "windows")
    assert note.details["count"] == "4"
    assert "in 4 windows of" in note.sentence()
    told = [row[0] for row in value_rows(found, "en", catalogue("en"))]
    assert "angle 1 at the start[1]" in told
    assert "angle 1 at the start[2]" not in told
    begins = [each.t[0] for each in found.recordings]
    np.testing.assert_allclose(np.diff(begins), 2.666 / 4, atol=2e-3)


@pytest.mark.parametrize("start", [(3.0, 0.5, 0.0, 0.0), (2.0, -2.9, 6.0, 0.0)])
def test_a_long_chaotic_motion_that_turns_over_is_fitted_without_windows_being_named(
    start: tuple[float, ...],
) -> None:
    system = pendula.DampedDoublePendulum.bobs(1.0, 0.5, 0.3, 0.25, 9.81, viscous=(2e-3, 1e-3))
    t = np.arange(1000) / 100.0
    angles = pendula.solve(system, start, t).states[:, :2]
    assert np.ptp(angles) > 2.0 * np.pi
    noise = 1e-3 * np.random.default_rng(0).normal(size=angles.shape)
    found = fit(of_angles(t, angles + noise), "viscous")
    assert found.rms < 1.1e-3
    assert 2 <= len(found.recordings) <= 8
    for name, value in shape_of(system).items():
        if name in found.names:
            assert found[name].value == pytest.approx(value, rel=0.01), name


def test_a_filmed_double_pendulum_is_followed_in_windows_of_half_a_second_or_more() -> None:
    path = recording("double_pixels_no_header_no_time.csv")
    filmed = read(path, frame_rate=501, as_angle=True, t=(0.4, 3.4))
    assert isinstance(filmed, Measurement)
    found = fit(filmed, "viscous")
    assert found["B_over_A"].value == pytest.approx(0.075, abs=2e-3)
    assert found["C_over_A"].value == pytest.approx(0.102, abs=2e-3)
    assert found.rms < 0.013
    assert len(found.recordings) <= 6


def test_windows_join_and_so_tell_more() -> None:
    system = pendula.DampedDoublePendulum.bobs(1.0, 0.5, 0.3, 0.25, 9.81, viscous=(2e-3, 1e-3))
    t = np.arange(600) / 100.0
    angles = pendula.solve(system, (2.5, 2.5, 0.0, 0.0), t).states[:, :2]
    made = of_angles(t, angles + 2e-3 * np.random.default_rng(1).normal(size=angles.shape))
    tied, loose = (fit(made, "viscous", windows=1.5, continuity=each) for each in (1.0, 0.0))
    (near,), (far,) = (
        [note.details["gap"] for note in found.notes if note.key == "windows"]
        for found in (tied, loose)
    )
    assert isinstance(near, float)
    assert isinstance(far, float)
    assert near < 0.2 * far
    assert tied.rms < 1.05 * loose.rms
    true = shape_of(system)
    for name in SHAPE:
        i = tied.names.index(name)
        assert tied.standard_errors[i] < loose.standard_errors[i]
        assert abs(tied[name].value - true[name]) < 3.0 * tied[name].standard_error
    assert tied.recipe["continuity"] == 1.0


def test_derivatives_of_gaps_between_windows_are_those_of_differences() -> None:
    made = window(1, 10)
    for model, free in ((DoubleModel(), SHAPE), (SystemModel(PUBLISHED, "angle"), ("gravity",))):
        parts = cut(sampled(made, None), 0.9)
        names = (*STATE, *free)
        problem = Problem(model, tuple(parts), names, free, {}, joints=(2.0, 3.0, 0.5, 0.4))
        known = {**shape_of(PUBLISHED), "gravity": 9.8}
        starts = {f"{n}[{i}]": 0.3 * i for n in STATE for i in range(1, len(parts) + 1)}
        x = np.array([{**known, **starts}[name] for name in problem.names])
        slopes = problem.jacobian(x)
        for j, step in enumerate(1e-6 * np.eye(len(x))):
            difference = (problem.residuals(x + step) - problem.residuals(x - step)) / 2e-6
            np.testing.assert_allclose(slopes[:, j], difference, atol=2e-5 * abs(slopes).max())
        rows = np.zeros_like(slopes, dtype=bool)
        for part, columns in problem.blocks():
            rows[part, columns] = True
        assert not slopes[~rows].any()


def test_a_pendulum_with_the_fitted_values_moves_so() -> None:
    found = fit(window(3), "viscous")
    run = found.trajectory
    np.testing.assert_allclose(run.states[:, :2], found.fitted, atol=1e-7)


def test_a_window_of_a_second_is_fitted_in_time() -> None:
    made = window(1, 2, 1.0)
    assert len(made.t) in (500, 501)

    def seconds() -> float:
        begin = time.process_time()
        fit(made, "viscous")
        return time.process_time() - begin

    assert min(seconds() for _ in range(3)) < 0.6  # 0.18 s on an idle machine


def test_bad_arguments_of_double_pendulums_are_named() -> None:
    made = of_angles(np.arange(50) / 50.0, np.zeros((50, 2)))
    with pytest.raises(ValueError, match="must be one recording of a double pendulum, got 2"):
        fit([made, made])
    with pytest.raises(ValueError, match='"undamped", "viscous" or "viscous \\+ coulomb"'):
        fit(made, "quadratic")
    with pytest.raises(ValueError, match="system must be a double pendulum as the recording is"):
        fit(made, pendula.SimplePendulum())
    with pytest.raises(ValueError, match="windows must be positive"):
        fit(made, windows=-1.0)
    moving = of_angles(np.arange(50) / 50.0, 0.1 * np.sin(np.arange(100.0)).reshape(50, 2))
    line = "windows must hold 20 samples or more each; of 0.2 s one holds 10; take 0.42 s or longer"
    with pytest.raises(ValueError, match=line):
        fit(moving, windows=0.2)
