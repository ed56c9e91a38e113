"""A driven pendulum with friction, and derivatives of the double pendulum, beside heyoka's."""

import math
import time
from collections.abc import Callable, Mapping
from typing import Any

import heyoka
import numpy as np

import pendula
from benchmarks.taylor_forms import FORMS
from benchmarks.taylor_peers import RELEASED, measured

Q, DRIVE, FREQUENCY = 2.0, 1.5, 2.0 / 3.0  # θ̈ + θ̇/q + sin θ = a cos Ωt, chaotic
START, END = (0.2, 0.0), 1000.0
SHORT = 20.0  # until when two runs of it agree
REPEATS = 7
LANES_END = 10.0
NAMES = ("theta1", "theta2", "omega1", "omega2")
STARTS = np.zeros((256, 4))  # released from rest at any angles
STARTS[:, :2] = np.random.default_rng(14).uniform(-np.pi, np.pi, (256, 2))
Run = Callable[[float], tuple[int, Any]]  # steps, and the state at the end


def equations(*, drive_as_states: bool, sines_as_states: bool) -> tuple[list[tuple[Any, Any]], Any]:
    """The driven pendulum as heyoka is told of it, and its start."""
    theta, omega, sine, cosine, swing, other = heyoka.make_vars("x", "v", "s", "c", "d", "e")
    drive = swing if drive_as_states else DRIVE * heyoka.cos(FREQUENCY * heyoka.time)
    pull = sine if sines_as_states else heyoka.sin(theta)
    all_of_them = [(theta, omega), (omega, drive - pull - omega / Q)]
    start = list(START)
    if sines_as_states:
        all_of_them += [(sine, cosine * omega), (cosine, -(sine * omega))]
        start += [math.sin(START[0]), math.cos(START[0])]
    if drive_as_states:
        all_of_them += [(swing, -FREQUENCY * other), (other, FREQUENCY * swing)]
        start += [DRIVE, 0.0]
    return all_of_them, np.array(start)


def by_heyoka(**form: bool) -> Run:
    """One trajectory of the driven pendulum by heyoka."""
    told, start = equations(**form)
    engine = heyoka.taylor_adaptive(told, start.copy())

    def run(end: float) -> tuple[int, Any]:
        engine.time = 0.0
        engine.state[:] = start
        return engine.propagate_until(end)[3], engine.state[:2].copy()

    return run


def by_pendula() -> Run:
    """The same by `pendula.solve`; the system is made before, as heyoka's engine is."""
    system = pendula.DrivenPendulum.scaled(Q, DRIVE, FREQUENCY)

    def run(end: float) -> tuple[int, Any]:
        found = pendula.solve(system, START, [end])
        return found.n_steps, found.states[-1]

    return run


def variational(form: str) -> Run:
    """The double pendulum with four tangents by heyoka."""
    told = FORMS[form]
    system = heyoka.var_ode_sys(told.equations(), heyoka.var_args.vars, 1)
    start = told.start(np.array(RELEASED))
    engine = heyoka.taylor_adaptive(system, start.copy(), compact_mode=True)
    first = engine.state.copy()

    def run(end: float) -> tuple[int, Any]:
        engine.time = 0.0
        engine.state[:] = first
        return engine.propagate_until(end)[3], engine.state[: len(start)].copy()

    return run


def derived(end: float) -> tuple[int, Any]:
    """The same derivatives by `pendula.solve`, whose plain run comes with them."""
    system = pendula.DoublePendulum.rods(gravity=9.81)
    run = pendula.solve(system, (*RELEASED, 0.0, 0.0), [end], derivatives="state")
    return run.n_steps, run.states[-1]


def heyoka_in_lanes(tangents: int) -> Callable[[], int]:
    """Double rods with tangents by heyoka's batch of eight, the same starts; it gives the steps."""
    told = FORMS["θ, p"]
    equations = told.equations()
    variables = [each[0] for each in equations]
    system = heyoka.var_ode_sys(equations, variables[:tangents], 1)
    first = told.start(STARTS[:, :2].T.copy())
    changes = np.zeros((4 * tangents, STARTS.shape[0]))
    changes[:: tangents + 1][:tangents] = 1.0
    starts = np.concatenate([first, changes])
    engine = heyoka.taylor_adaptive_batch(system, np.ascontiguousarray(starts[:, :8]))

    def run() -> int:
        steps = 0
        for begin in range(0, starts.shape[1], 8):
            engine.set_time(0.0)
            engine.state[:] = starts[:, begin : begin + 8]
            engine.propagate_until(LANES_END)
            steps += sum(each[3] for each in engine.propagate_res)
        return steps

    return run


def pendula_in_lanes(names: tuple[str, ...]) -> Callable[[], int]:
    """The same by `pendula.ensemble`."""
    system = pendula.DoublePendulum.rods(gravity=9.81)

    def run() -> int:
        many = pendula.ensemble(system, STARTS, [LANES_END], threads=1, derivatives=names)
        return int(many.n_steps.sum())

    return run


def in_lanes(tangents: int) -> float:
    """Print the times of a second of motion; heyoka's over pendula's."""
    jobs = {"pendula": pendula_in_lanes(NAMES[:tangents]), "heyoka": heyoka_in_lanes(tangents)}
    least = dict.fromkeys(jobs, math.inf)
    steps = dict.fromkeys(jobs, 0)
    for _ in range(3):
        for name, run in jobs.items():
            begin = time.process_time()
            steps[name] = run()
            least[name] = min(least[name], time.process_time() - begin)
    seconds = len(STARTS) * LANES_END
    print(f"Double rods in lanes, {tangents} tangents: a second of motion [µs], a step [ns]")
    for name, total in least.items():
        print(f"{name:12}{total / seconds * 1e6:10.2f}{total / steps[name] * 1e9:10.0f}")
    print()
    return least["heyoka"] / least["pendula"]


def figures(title: str, jobs: Mapping[str, Run], end: float) -> dict[str, float]:
    """Print and return the least CPU time of each [s]; they take turns."""
    steps = {name: run(end)[0] for name, run in jobs.items()}
    least = dict.fromkeys(jobs, math.inf)
    for _ in range(REPEATS):
        for name, run in jobs.items():
            least[name] = min(least[name], measured(run, end))  # type: ignore[arg-type]
    print(f"{title}\n\n{'':44}{'CPU [ms]':>10}{'steps':>10}{'ns a step':>11}")
    for name, seconds in least.items():
        each = seconds / steps[name] * 1e9
        print(f"{name:44}{seconds * 1e3:10.3f}{steps[name]:10}{each:11.0f}")
    print()
    return least


def report() -> None:
    """Print the tables and the ratios that are asked for."""
    driven: dict[str, Run] = {"pendula taylor": by_pendula()}
    for drive in (False, True):
        for sines in (False, True):
            names = "drive a state" if drive else "cos Ωt", "all sines" if sines else "sin θ"
            driven[f"heyoka; {', '.join(names)}"] = by_heyoka(
                drive_as_states=drive, sines_as_states=sines
            )
    states = np.array([run(SHORT)[1] for run in driven.values()])
    assert np.ptp(states, axis=0).max() < 1e-10, states
    one = figures(f"Driven pendulum, q = {Q}, a = {DRIVE}, to {END:.0f}", driven, END)
    tangents: dict[str, Run] = {"pendula, four tangents": derived}
    begin = time.process_time()
    tangents |= {f"heyoka, four tangents, {form}": variational(form) for form in list(FORMS)[:2]}
    print(f"heyoka compiled its variational equations in {time.process_time() - begin:.1f} s")
    four = figures(
        "Two uniform rods with their derivatives by the start, to 100 s", tangents, 100.0
    )
    theirs = min(seconds for name, seconds in one.items() if name.startswith("heyoka"))
    batch = min(seconds for name, seconds in four.items() if name.startswith("heyoka"))
    each = four["pendula, four tangents"] / derived(100.0)[0] * 1e9
    lanes = [in_lanes(tangents) for tangents in (1, 4)]
    for what, ratio, asked in (
        ("heyoka's best ÷ driven taylor", theirs / one["pendula taylor"], "≥ 3"),
        ("four tangents [ns a step]", each, "≤ 2500"),
        ("heyoka's ÷ four tangents", batch / four["pendula, four tangents"], "one trajectory"),
        ("heyoka's ÷ one tangent in lanes", lanes[0], "≥ 4"),
        ("heyoka's ÷ four tangents in lanes", lanes[1], "≥ 5"),
    ):
        print(f"{what + ':':36}{ratio:7.2f}   (asked: {asked})")


if __name__ == "__main__":
    report()
