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

largest_angle: float = 67108864.0

class Description:
    """A system's name, the index of its form, and that form's parameters."""

    def __init__(self, system: str, form: int, parameters: Sequence[float]) -> None: ...

def rhs(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """Time derivative of each state, (n, d)."""

def energies(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)]) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
    """Kinetic and potential energy of each state [J]."""

def positions(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """Bob, or end of each rod, (n, d/2, 2) [m]."""

def constants(description: Description) -> dict[str, float]:
    """The constants that the equations of motion are written in."""

def solve_fixed(description: Description, method: str, state: Sequence[float], t0: float, step: float, step_limit: int, times: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], own_steps: bool, progress: object | None) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], int, str, int]:
    """
    Times, states, how many of both were reached, how the run ended, and steps taken. `step` is negative for a run backward; with own_steps the one time is the end.
    """

def exact_linear(length: float, gravity: float, theta0: float, omega0: float, t: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """States (n, 2) of the linear pendulum at times t after the start."""

def exact_simple(length: float, gravity: float, theta0: float, t: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """
    States (n, 2) of the simple pendulum at times t after its release from rest.
    """

def elliptic_K(k: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], kc: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """K by the arithmetic-geometric mean."""

def elliptic_K_series(k: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], terms: int) -> NDArray[numpy.float64]:
    """The first terms of the power series of K."""

def elliptic_E(k: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], kc: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """The complete integral of the second kind."""

def elliptic_F(phi: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], k: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], kc: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """The incomplete integral of the first kind."""

def jacobi(u: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], k: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], kc: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64], NDArray[numpy.float64]]:
    """am, sn, cn and dn."""

def modulus_of_amplitude(amplitude: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
    """k = |sin(amplitude/2)| and kc = |cos(amplitude/2)|."""
