"""Closed forms beside SciPy's ellipj alone, for as many points with the same m, in one run."""

import time
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.special import ellipj, ellipkinc

import pendula
from pendula import _engine, elliptic

PENDULUM = pendula.SimplePendulum(length=9.80665)  # ωn = 1 rad/s: times are ellipj's arguments
POINTS, REPEATS, ASKED = 10**6, 7, 0.1
LATER = 12.3  # s, the one time of many states
LARGE_ENOUGH = 1e-9  # rad; ellipj's own errors are far below, for these m and times
Case = tuple[Callable[[], Any], Callable[[], Any]]  # ours, ellipj


def states_of(m: Any, phase: Any) -> Any:
    """States with the parameter m = k²: sin(θ/2) = k sin φ, ω/2ωn = k cos φ."""
    k = np.sqrt(m)
    return np.stack([2 * np.arcsin(k * np.sin(phase)), 2 * k * np.cos(phase)], axis=-1)


def angle_by_scipy(t: Any, m: Any, phase: Any) -> Any:
    """The angle a time t after the phase φ, by ellipj and ellipkinc."""
    sn, _, _, _ = ellipj(t + ellipkinc(phase, m), m)
    return 2 * np.arcsin(np.sqrt(m) * sn)


def one_trajectory(m: float, t: Any) -> Case:
    """Many times of one release from rest."""
    start = np.array([2 * np.arcsin(np.sqrt(m)), 0.0])
    wrong = pendula.exact(PENDULUM, start, t).theta - angle_by_scipy(t, m, np.pi / 2)
    assert np.abs(wrong).max() < LARGE_ENOUGH
    return lambda: pendula.exact(PENDULUM, start, t), lambda: ellipj(t, m)


def many_states(m: Any, phase: Any) -> Case:
    """Many states at one time."""
    starts = states_of(m, phase)
    starts[phase == np.pi / 2, 1] = 0.0
    wrong = pendula.exact(PENDULUM, starts, LATER).theta[:, 0] - angle_by_scipy(LATER, m, phase)
    assert np.abs(wrong).max() < LARGE_ENOUGH
    return lambda: pendula.exact(PENDULUM, starts, LATER), lambda: ellipj(LATER, m)


def functions(u: Any, m: Any) -> Case:
    """The elliptic functions by themselves."""
    k = np.sqrt(m)
    for ours, theirs in zip(elliptic.sncndn(u, k), ellipj(u, m)[:3], strict=True):
        assert np.abs(ours - theirs).max() < LARGE_ENOUGH
    return lambda: elliptic.sncndn(u, k), lambda: ellipj(u, m)


def cases(points: int) -> dict[str, Case]:
    """What is measured, after a look whether it is right."""
    random = np.random.default_rng(1)
    t = np.linspace(0.0, 100.0, points)
    m = random.uniform(0.25, 0.9, points)
    still, moving = np.full(points, np.pi / 2), random.uniform(-np.pi, np.pi, points)
    return {
        **{f"exact, one trajectory, m = {one}": one_trajectory(one, t) for one in (0.25, 0.5, 0.9)},
        "exact, many states at rest": many_states(m, still),
        "exact, many states moving": many_states(m, moving),
        "sncndn, one modulus, m = 0.5": functions(t, 0.5),
        "sncndn, many moduli": functions(t, m),
    }


def nanoseconds(run: Callable[[], Any], points: int) -> float:
    """Of one run, a point."""
    start = time.perf_counter()
    run()
    return (time.perf_counter() - start) / points * 1e9


def figures(points: int = POINTS, repeats: int = REPEATS) -> dict[str, tuple[float, float]]:
    """Nanoseconds a point of each case and of ellipj: the least of runs that take turns."""
    measured = cases(points)
    least = dict.fromkeys(measured, (np.inf, np.inf))
    for _ in range(repeats):
        for name, (ours, theirs) in measured.items():
            one, other = least[name]
            least[name] = (
                min(one, nanoseconds(ours, points)),
                min(other, nanoseconds(theirs, points)),
            )
    return least


def report(points: int = POINTS, repeats: int = REPEATS) -> None:
    """Print the table."""
    loops = _engine.machines()[-1]
    print(f"Closed forms, ns a point of {points}, one thread, by the loops {loops}")
    print("m from 0.25 to 0.9 where it is not named\n")
    print(f"{'':36}{'ns':>8}{'ellipj':>10}{'÷ ellipj':>11}")
    for name, (ours, theirs) in figures(points, repeats).items():
        asked = f"   (asked: ≤ {ASKED})" if name.startswith("exact") else ""
        print(f"{name:36}{ours:8.1f}{theirs:10.1f}{ours / theirs:11.3f}{asked}")


if __name__ == "__main__":
    report()
