"""An ensemble while it runs, and how it refuses a wrong call."""

from __future__ import annotations

import math
import signal
import threading
import time
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from pendula import DoublePendulum, LinearPendulum, SimplePendulum, ensemble
from pendula.events import flip

if TYPE_CHECKING:
    from pendula._types import MethodName

RODS, BOBS = DoublePendulum.rods(), DoublePendulum.bobs()
LINEAR, SIMPLE = LinearPendulum(), SimplePendulum()


def starts(count: int) -> np.ndarray:
    return np.random.default_rng(1).uniform(-3.0, 3.0, (count, 4))


@pytest.mark.parametrize("options", [{}, {"certify": 1e-6}])
def test_progress_rises_to_the_end(options: dict[str, Any]) -> None:
    told: list[float] = []
    count = 40 if options else 3000
    ensemble(RODS, starts(count), [60.0], progress=told.append, **options)
    assert len(told) > 2
    assert all(0.0 <= a <= b for a, b in pairwise(told))
    assert told[-1] == 1.0


@pytest.mark.parametrize("threads", [1, 3])
@pytest.mark.parametrize(
    ("count", "t", "method", "options"),
    [
        (40, 1e6, "taylor", {}),
        (40, 1e6, "dop853", {}),
        (40, 1e6, "dop853", {"events": flip(1)}),
        (40, 1e6, "gauss8", {"step": 1e-3}),
        (10**6, 100.0, "taylor", {}),
        (40, 200.0, "taylor", {"certify": 1.0}),
    ],
)
def test_an_interrupt_ends_it(
    count: int, t: float, method: MethodName, options: dict[str, Any], threads: int
) -> None:
    states = starts(count)
    timer = threading.Timer(0.4, signal.raise_signal, [signal.SIGINT])
    started = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        ensemble(RODS, states, [t], method, threads=threads, **options)
    assert time.monotonic() - started < 10.0  # 0.1 s after the signal; a machine may be busy


def test_an_error_of_the_progress_ends_it() -> None:
    def fail(share: float) -> None:
        raise RuntimeError(share)

    with pytest.raises(RuntimeError):
        ensemble(RODS, starts(40), [1e6], progress=fail)


# ---- wrong calls ----


@pytest.mark.parametrize(
    ("system", "states", "t", "options", "told"),
    [
        (RODS, np.zeros(4), 1.0, {"threads": 0}, r"threads must be a whole number from 1 to 1024"),
        (RODS, np.zeros(4), 1.0, {"threads": 1.5}, r"threads must be a whole number"),
        (RODS, np.zeros(4), 1.0, {"threads": 2000}, r"from 1 to 1024, got 2000"),
        ([RODS, LINEAR], np.zeros(4), 1.0, {}, r"got double rods, linear; make an ensemble"),
        ([RODS, BOBS], np.zeros(4), 1.0, {}, r"got double bobs, double rods; make"),
        ([], np.zeros(4), 1.0, {}, r"system must be one pendulum, or n of .* got none"),
        ("double", np.zeros(4), 1.0, {}, r"system must be a pendulum .* got 'double'"),
        ([RODS, 5], np.zeros(4), 1.0, {}, r"system must be a pendulum .* got 5"),
        ([RODS, RODS], np.zeros((3, 4)), 1.0, {}, r"shape \(n, 4\), for 2 systems, got \(3, 4\)"),
        (RODS, np.zeros((2, 2, 4)), 1.0, {}, r"states must be one for each .* got \(2, 2, 4\)"),
        (RODS, np.zeros(3), 1.0, {}, r"states must be \(theta1, .* got shape \(3,\)"),
        (RODS, [[0, 0, 0, math.nan]], 1.0, {}, r"states must hold finite .* at states\[0, 3\]"),
        (RODS, np.zeros(4), 0.0, {}, r"t must differ from t0"),
        (RODS, np.zeros(4), [1.0, 0.5], {}, r"t must rise"),
        (RODS, np.zeros(4), 1.0, {"method": "magic"}, r"method must be one of euler, "),
        (RODS, np.zeros(4), 1.0, {"method": "verlet"}, r"method 'verlet' needs a system"),
        (RODS, np.zeros(4), 1.0, {"method": "rk4"}, r"step is needed"),
        (RODS, np.zeros(4), 1.0, {"step": 0.1}, r"step is not taken by the adaptive"),
        (RODS, np.zeros(4), 1.0, {"tolerance": 1.0}, r"tolerance must lie between"),
        (RODS, np.zeros(4), 1.0, {"max_steps": 0}, r"max_steps must be a whole number"),
        (RODS, np.zeros(4), 1.0, {"certify": 2.0}, r"certify must be an angle of at most 1 rad"),
        (SIMPLE, np.zeros(2), 1.0, {"events": flip(2)}, r"i must be 1 for the simple"),
        (
            RODS,
            np.zeros(4),
            1.0,
            {"events": flip(1), "method": "rk4", "step": 0.1},
            r"events are not taken by the fixed-step method 'rk4'",
        ),
        (RODS, np.zeros(4), 1e300, {}, r"^t must be small enough to tell times apart"),
    ],
)
def test_wrong_calls_are_told(
    system: Any, states: Any, t: Any, options: dict[str, Any], told: str
) -> None:
    with pytest.raises(ValueError, match=told):
        ensemble(system, states, t, **options)


def test_a_motion_and_its_mirror_image_flip_at_the_same_times() -> None:
    released = np.zeros((6000, 4))
    released[:, :2] = np.random.default_rng(3).uniform(-3.1, 3.1, (6000, 2))
    flips = [flip(1, terminal=True), flip(2, terminal=True)]
    runs = [
        ensemble(RODS, states, [20.0], tolerance=1e-8, events=flips)
        for states in (released, -released)
    ]
    np.testing.assert_array_equal(runs[0].reached, runs[1].reached)  # 0.9 % once differed by an ulp
    np.testing.assert_array_equal(runs[0].events[1].states, -runs[1].events[1].states)


def test_energies_are_known_where_the_motion_is() -> None:
    states = [[1.0, 2.0, 0.0, 0.0], [2.0**27, 0.0, 0.0, 0.0]]
    many = ensemble(RODS, states, [1.0, 2.0])
    assert list(many.outcomes) == ["reached_end", "not_finite"]
    np.testing.assert_array_equal(many.energy[0], RODS.energy(many.states[0]))
    assert np.isnan(many.energy[1]).all()
