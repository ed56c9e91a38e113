"""
The compiled core of pendula. Use the package; this module has no checks.
"""

from collections.abc import Sequence
from typing import Annotated, Any

import numpy
from numpy.typing import NDArray


def systems() -> list[dict[str, Any]]:
    """The catalogue's systems with the rows of their parameters."""

def methods() -> list[dict[str, Any]]:
    """The catalogue's methods."""

def machines() -> list[str]:
    """What this processor is of the machines that loops are built for."""

largest_angle: float = 67108864.0

class Description:
    """A system's name, the index of its form, and that form's parameters."""

    def __init__(self, system: str, form: int, parameters: Sequence[float]) -> None: ...

def rhs(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """Time derivative of each state, (n, d)."""

def energies(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)]) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
    """Kinetic and potential energy of each state [J]."""

def within_range_of_sine(angles: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """
    The same directions, without whole turns where the angle is too large for the sine [rad].
    """

def positions(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """Bob, or end of each rod, (n, d/2, 2) [m]."""

def constants(description: Description) -> dict[str, float]:
    """The constants that the equations of motion are written in."""

def solve_fixed(description: Description, method: str, state: Sequence[float], t0: float, step: float, step_limit: int, times: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], own_steps: bool, progress: object | None) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], int, str, int, int]:
    """
    Times, states, how many of both were reached, how the run ended, steps taken and evaluations. `step` is negative for a run backward; with own_steps the one time is the end.
    """

class DenseOutput:
    """The motion inside the steps of a run that was made."""

    @property
    def reached(self) -> float:
        """The time up to which the run was made [s]."""

    def at(self, times: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
        """States (n, d) at times (n,) in the direction of the run."""

def solve_adaptive(description: Description, method: str, state: Sequence[float], t0: float, end: float, log2_of_tolerance: float, step_limit: int, times: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)] | None, events: Sequence[tuple[Any, ...]], progress: object | None) -> tuple[Any, ...]:
    """
    Times, states, how the run ended, steps, evaluations, (times, states) of each event, and the dense output. Without times the outputs are the steps'.
    """

def ensemble(system: str, form: int, parameters: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], method: str, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], t0: float, times: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], step: float, log2_of_tolerance: float, step_limit: int, events: Sequence[tuple[Any, ...]], threads: int, progress: object | None) -> tuple[Any, ...]:
    """
    States (n, times, d), how each run ended, its steps, the time it reached, and (trajectories, times, states) of each event, from states (n, d) and parameters (n, p), or (1, p) for all.
    """

def trust_horizons(system: str, form: int, parameters: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], method: str, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], t0: float, reached: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], step: float, log2_of_tolerance: float, certify: float, threads: int, progress: object | None) -> NDArray[numpy.float64]:
    """
    The trust horizon (n,) of each run of an ensemble, which came to the time `reached` (n,).
    """

def outcomes() -> list[str]:
    """How runs end, by number."""

def trust_horizon(description: Description, method: str, state: Sequence[float], t0: float, end: float, step: float, log2_of_tolerance: float, certify: float, progress: object | None) -> float:
    """
    First time at which an angle of the run is off by more than `certify`, or infinity. `step` is negative for a run backward, and 0 for an adaptive method.
    """

def long_run_digits() -> list[int]:
    """Decimal digits of the levels of `long_run`."""

def long_run(description: Description, level: int, state: Sequence[float], t0: float, times: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], progress: object | None) -> tuple[NDArray[numpy.float64], str]:
    """
    States (n, d, 2) at times (n,), which follow one another from t0 on, as heads and tails, and how it ended.
    """

largest_start_angle: float = 1125899906842624.0

largest_start_speed: float = 8.452712498170644e+270

counted_half_periods: float = 1125899906842624.0

most_half_periods: float = 1.6069380442589903e+60

def exact_linear(length: float, gravity: float, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], t: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], t0: float, out: Annotated[NDArray[numpy.float64], dict(shape=(None, None, None), order='C', device='cpu')]) -> bool:
    """
    States (m, n, 2) of the linear pendulum at times t from states (m, 2) at t0; false where t is too large.
    """

def exact_simple(length: float, gravity: float, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], t: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], t0: float, out: Annotated[NDArray[numpy.float64], dict(shape=(None, None, None), order='C', device='cpu')]) -> bool:
    """
    States (m, n, 2) of the simple pendulum at times t from states (m, 2) at t0; false where one is too large.
    """

def simple_period(length: float, gravity: float, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """Periods of states (m, 2)."""

def simple_action(length: float, gravity: float, mass: float, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """Actions of states (m, 2)."""

def simple_time_at(length: float, gravity: float, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], theta: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """When each state (m, 2) first has its angle (m,)."""

def linear_time_at(length: float, gravity: float, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], theta: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """The same of the linear pendulum."""

def elliptic_K(moduli: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], complement: bool) -> NDArray[numpy.float64]:
    """The complete integral of the first kind."""

def elliptic_E(moduli: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], complement: bool) -> NDArray[numpy.float64]:
    """The complete integral of the second kind."""

def elliptic_F(phi: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], moduli: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], complement: bool) -> NDArray[numpy.float64]:
    """The incomplete integral of the first kind."""

def elliptic_K_series(moduli: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], complement: bool, terms: int) -> NDArray[numpy.float64]:
    """The first terms of the power series of K."""

def jacobi(u: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], moduli: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], complement: bool) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64]]:
    """am, sn, cn and dn."""
