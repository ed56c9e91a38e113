"""The same work by pendula.solve, numba, numpy and SciPy; all reach the same state."""

import importlib.util
from typing import Any

import numba
import numpy as np
from scipy.integrate import solve_ivp

import pendula
from benchmarks.lanes import AT_ONE, START, STEP, TRAJECTORIES, best, on_machine
from pendula._engine import machines

A, B, C, D, E = 4.0 / 3.0, 1.0 / 3.0, 0.5, 1.5 * 9.81, 0.5 * 9.81


@numba.njit(fastmath=True)
def numba_rk4(y: Any, h: float, steps: int) -> Any:
    """Its best form: constants and state in local variables, no arrays in the loop."""
    a, b, c, d, e = 4.0 / 3.0, 1.0 / 3.0, 0.5, 1.5 * 9.81, 0.5 * 9.81
    y1, y2, v1, v2 = y[0], y[1], y[2], y[3]
    for _ in range(steps):
        s1 = s2 = s3 = s4 = 0.0
        p1, p2, p3, p4 = y1, y2, v1, v2
        for stage in range(4):
            delta = p1 - p2
            sine, coupling = np.sin(delta), c * np.cos(delta)
            r1 = -c * sine * p4 * p4 - d * np.sin(p1)
            r2 = c * sine * p3 * p3 - e * np.sin(p2)
            inverse = 1.0 / (a * b - coupling * coupling)
            k1, k2 = p3, p4
            k3, k4 = (b * r1 - coupling * r2) * inverse, (a * r2 - coupling * r1) * inverse
            weight = h / 3.0 if stage in (1, 2) else h / 6.0
            s1, s2, s3, s4 = s1 + weight * k1, s2 + weight * k2, s3 + weight * k3, s4 + weight * k4
            ahead = h if stage == 2 else 0.5 * h
            p1, p2, p3, p4 = y1 + ahead * k1, y2 + ahead * k2, v1 + ahead * k3, v2 + ahead * k4
        y1, y2, v1, v2 = y1 + s1, y2 + s2, v1 + s3, v2 + s4
    return np.array([y1, y2, v1, v2])


def rhs(y: Any) -> Any:
    """Slopes of states (4, …), by numpy."""
    delta = y[0] - y[1]
    sine, coupling = np.sin(delta), C * np.cos(delta)
    r1 = -C * sine * y[3] ** 2 - D * np.sin(y[0])
    r2 = C * sine * y[2] ** 2 - E * np.sin(y[1])
    inverse = 1.0 / (A * B - coupling**2)
    return np.stack(
        [y[2], y[3], (B * r1 - coupling * r2) * inverse, (A * r2 - coupling * r1) * inverse]
    )


def numpy_rk4(y: Any, h: float, steps: int) -> Any:
    """RK4 of states (4, n) at once."""
    for _ in range(steps):
        k1 = rhs(y)
        k2 = rhs(y + 0.5 * h * k1)
        k3 = rhs(y + 0.5 * h * k2)
        k4 = rhs(y + h * k3)
        y = y + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)
    return y


def all_figures() -> dict[str, float]:
    """Nanoseconds a step and trajectory of each peer, and of pendula.solve."""
    system, steps = pendula.DoublePendulum.rods(gravity=9.81), 100_000

    def solved(count: int) -> Any:
        return pendula.solve(system, START, [count * STEP], "rk4", step=STEP).states[-1]

    for state in (solved(10_000), numba_rk4(np.array(START), STEP, 10_000)):
        assert np.abs(state - AT_ONE).max() < 1e-9  # the same work, done right
    many = np.repeat(np.array(START)[:, np.newaxis], TRAJECTORIES, axis=1)
    assert np.abs(numpy_rk4(many[:, :1], STEP, 10_000)[:, 0] - AT_ONE).max() < 1e-9
    figures = {
        "pendula.solve": best(lambda: solved(steps), 9) / steps * 1e9,
        **{f"pendula.ensemble, {name}": on_machine(name) * 1e9 for name in machines()[1:]},
        "numba, fastmath, locals": best(lambda: numba_rk4(np.array(START), STEP, steps), 9)
        / steps
        * 1e9,
        f"numpy, {TRAJECTORIES} trajectories at once": best(lambda: numpy_rk4(many, STEP, 20), 5)
        / (20 * TRAJECTORIES)
        * 1e9,
        "SciPy RK45, step 1 ms (one trajectory)": by_scipy() * 1e9,
    }
    if importlib.util.find_spec("jax"):
        figures[f"JAX, vmap of {TRAJECTORIES}"] = by_jax(many) * 1e9
    return figures


def by_scipy() -> float:
    """Seconds a step of one trajectory by SciPy, with a step that no error shortens."""
    tight: dict[str, Any] = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-12}
    done = solve_ivp(lambda _, y: rhs(y), (0.0, 1.0), START, **tight)
    assert np.abs(done.y[:, -1] - AT_ONE).max() < 1e-9
    fixed: dict[str, Any] = {"method": "RK45", "rtol": 1e3, "atol": 1e3, "max_step": 1e-3}
    return best(lambda: solve_ivp(lambda _, y: rhs(y), (0.0, 1.0), START, **fixed), 3) / 1000


def by_jax(states: Any) -> float:
    """RK4 of states (4, n) by JAX, compiled, with doubles: seconds a step and trajectory."""
    import jax

    jax.config.update("jax_enable_x64", True)
    jnp, steps = jax.numpy, 200

    def slopes(y: Any) -> Any:
        delta = y[0] - y[1]
        sine, coupling = jnp.sin(delta), C * jnp.cos(delta)
        r1 = -C * sine * y[3] ** 2 - D * jnp.sin(y[0])
        r2 = C * sine * y[2] ** 2 - E * jnp.sin(y[1])
        turned = [B * r1 - coupling * r2, A * r2 - coupling * r1]
        return jnp.stack([y[2], y[3], *turned]) / jnp.array([1.0, 1.0, *[A * B - coupling**2] * 2])

    def step(_: int, y: Any) -> Any:
        k1 = slopes(y)
        k2 = slopes(y + 0.5 * STEP * k1)
        k3 = slopes(y + 0.5 * STEP * k2)
        k4 = slopes(y + STEP * k3)
        return y + STEP / 6.0 * (k1 + 2.0 * (k2 + k3) + k4)

    run = jax.jit(jax.vmap(lambda y: jax.lax.fori_loop(0, steps, step, y)))
    given = jnp.asarray(states.T)
    ended = np.asarray(run(given))  # compiles
    assert np.abs(ended[0] - numpy_rk4(states[:, :1], STEP, steps)[:, 0]).max() < 1e-9
    return float(best(lambda: run(given).block_until_ready(), 5) / (steps * states.shape[1]))
