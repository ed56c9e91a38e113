"""Flip maps: our cells beside heyoka's event loop, threads beside one, a cluster beside threads."""

import math
import time
from typing import Any

import heyoka
import numpy as np

import pendula
from benchmarks.taylor_forms import BASE, FORMS
from pendula.events import flip

SYSTEM = pendula.DoublePendulum.rods(gravity=9.81)
T_MAX, TOLERANCE = 100.0 / math.sqrt(9.81), 1e-8
TURN = (-math.pi, math.pi)
SIDE, SAMPLE = 200, 1000  # cells along an angle; of those, how many heyoka runs
CLUSTER_SIDE = 1024
FORM = "θ, p, all sines"  # heyoka's fastest, see the Taylor table


def starts() -> Any:
    """Cells (n, 4) of the map in which a flip is not forbidden."""
    centres = (np.arange(SIDE) + 0.5) * (2.0 * math.pi / SIDE) - math.pi
    first, second = (each.ravel() for each in np.meshgrid(centres, centres, indexing="ij"))
    allowed = 3.0 * np.cos(first) + np.cos(second) <= 2.0
    still = np.zeros(np.count_nonzero(allowed))
    return np.stack([first[allowed], second[allowed], still, still], axis=1)


def ours(states: Any, threads: int) -> tuple[float, float, Any]:
    """CPU and wall time [s] of the map's cells, and how long each took to flip."""
    flips = [flip(1, terminal=True), flip(2, terminal=True)]
    cpu, wall = time.process_time(), time.perf_counter()
    done = pendula.ensemble(
        SYSTEM, states, [T_MAX], tolerance=TOLERANCE, events=flips, threads=threads
    )
    spent = time.process_time() - cpu, time.perf_counter() - wall
    return *spent, done.reached


def by_heyoka(states: Any) -> tuple[float, Any]:
    """CPU time [s] of heyoka's loop over cells with terminal events, and the flip times."""
    form = FORMS[FORM]
    first, second = heyoka.make_vars(*BASE)[:2]
    events = [heyoka.t_event(angle**2 - math.pi**2) for angle in (first, second)]
    start = form.start(states[:1, :2].T)[:, 0]
    engine = heyoka.taylor_adaptive(form.equations(), start, tol=TOLERANCE, t_events=events)
    given = form.start(states[:, :2].T)
    times = np.empty(len(states))
    begin = time.process_time()
    for i in range(len(states)):
        engine.reset_cooldowns()
        engine.time = 0.0
        engine.state[:] = given[:, i]
        engine.propagate_until(T_MAX)
        times[i] = engine.time
    return time.process_time() - begin, times


def by_cluster(threads: int) -> tuple[float, float]:
    """Wall times [s] of a map by as many threads, and by as many workers of a local cluster."""
    import distributed

    client_of: Any = distributed.Client  # untyped
    cluster_of: Any = distributed.LocalCluster
    cells = (TURN, TURN, (CLUSTER_SIDE, CLUSTER_SIDE), T_MAX)
    with (
        cluster_of(
            n_workers=threads, threads_per_worker=1, processes=True, dashboard_address=None
        ) as cluster,
        client_of(cluster) as client,
    ):
        pendula.flip_map(SYSTEM, TURN, TURN, (64, 64), 1.0, client=client)  # imports there
        least = [math.inf, math.inf]
        for _ in range(3):
            for i, where in enumerate(({"threads": threads}, {"client": client})):
                begin = time.perf_counter()
                pendula.flip_map(SYSTEM, *cells, tolerance=TOLERANCE, resolve=False, **where)
                least[i] = min(least[i], time.perf_counter() - begin)
    return least[0], least[1]


def report() -> None:
    """Print the figures and the ratios that are asked for."""
    states = starts()
    sample = np.random.default_rng(1).permutation(len(states))[:SAMPLE]
    runs = [(ours(states, 1), ours(states, 2), by_heyoka(states[sample])) for _ in range(3)]
    one = min(run[0][0] for run in runs)
    walls = [min(run[i][1] for run in runs) for i in (0, 1)]
    theirs = min(run[2][0] for run in runs)
    early = runs[0][0][2][sample] < 5.0  # before chaos parts the two
    assert np.allclose(runs[0][0][2][sample][early], runs[0][2][1][early], rtol=1e-4)
    rate, other = len(states) / one, SAMPLE / theirs
    print(f"Flip map, two uniform rods, t ≤ {T_MAX:.1f} s, tolerance {TOLERANCE:g}, no resolve\n")
    print(f"{'':44}{'trajectories a CPU-second':>28}")
    print(f"{'pendula, one thread':44}{rate:28.0f}   (asked: ≥ 60000)")
    print(f"{'heyoka ' + FORM + ', event loop':44}{other:28.0f}")
    print(f"\npendula ÷ heyoka's event loop:    {rate / other:6.1f}   (asked: ≥ 10)")
    print(f"two threads ÷ one:                {walls[0] / walls[1]:6.2f}   (asked: ≥ 1.9)")
    local, cluster = by_cluster(2)
    print(f"two workers of a cluster ÷ local: {cluster / local:6.3f}   (asked: ≤ 1.1)")


if __name__ == "__main__":
    report()
