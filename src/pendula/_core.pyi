"""
The compiled core of pendula. Use the package; this module has no checks.
"""

from collections.abc import Sequence
from typing import Annotated, Any

import numpy
from numpy.typing import NDArray


def systems() -> list[dict[str, Any]]:
    """The catalogue's systems with their parameters and capabilities."""

def methods() -> list[dict[str, Any]]:
    """The catalogue's methods."""

def machines() -> list[str]:
    """What this processor is of the machines that loops are built for."""

largest_angle: float = 67108864.0

on_grid: float = 1e-09

most_outputs: int = 100000000

def series_order(tolerance: float) -> int:
    """The order of the series that the Taylor method takes."""

def rhs(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], t: float) -> NDArray[numpy.float64]:
    """Time derivative of each state, (n, d)."""

def energies(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)]) -> tuple[NDArray[numpy.float64], NDArray[numpy.float64]]:
    """Kinetic and potential energy of each state [J]."""

def positions(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """Bob, or end of each rod, (n, d/2, 2) [m]."""

def within_range_of_sine(angles: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """
    The same directions, without whole turns where the angle is too large for the sine [rad].
    """

def constants(description: Description) -> dict[str, float]:
    """The constants that the equations of motion are written in."""

def scales(description: Description) -> tuple[float, float]:
    """
    Energy scale [J], and the largest frequency of small oscillations [rad/s].
    """

class Description:
    """A system's name, the index of its form, and that form's parameters."""

    def __init__(self, system: str, form: int, parameters: Sequence[float]) -> None: ...

class Event:
    """What to look for inside the steps of a run."""

    def __init__(self, kind: int, index: int, value: float, value_tail: float, every_turn: bool, direction: int, terminal: int) -> None: ...

def event_kinds() -> list[str]:
    """The kinds of events, by number."""

class Request:
    """What to run."""

    def __init__(self, system: Description, method: str, state: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], t0: float, times: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], own_steps: bool = False, events: Sequence[Event] = [], step: float | None = None, tolerance: float | None = None, certify: float | None = None, max_steps: int | None = None, digits: int | None = None) -> None: ...

class Fault:
    """What is wrong with a request: argument, rule, value and details."""

    @property
    def argument(self) -> str:
        """Name of the argument."""

    @property
    def rule(self) -> str:
        """Key of the rule, of `rule_rows`."""

    @property
    def value(self) -> None | float | int | str | list[str]:
        """What was given."""

    @property
    def details(self) -> dict[str, Any]:
        """What else the sentences name."""

def rule_rows() -> list[tuple[str, str, str, str, str]]:
    """
    Key, sentence and way out in English, sentence and way out in Spanish of each rule.
    """

def option_rows() -> list[dict[str, Any]]:
    """The options of a run."""

def check(request: Request) -> Fault | None:
    """The first fault of a request."""

def check_method(request: Request) -> Fault | None:
    """The first fault of a request's method and system."""

def check_options(request: Request) -> Fault | None:
    """
    The first fault of a request whose system, method, state and times are sound.
    """

def check_system(description: Description) -> Fault | None:
    """The first fault of a description."""

class Pieces:
    """When friction in a joint changed."""

    @property
    def times(self) -> NDArray[numpy.float64]:
        """(k,) [s]."""

    def senses(self, joints: int) -> NDArray[numpy.float64]:
        """
        Which way each joint slips from then on, 1 or -1, or 0: it sticks, (k, joints).
        """

class Crossings:
    """Times and states at which an event took place."""

    @property
    def trajectories(self) -> NDArray[numpy.int64]:
        """(k,), of an ensemble."""

    @property
    def times(self) -> NDArray[numpy.float64]:
        """(k,) [s]."""

    def states(self, dimension: int) -> NDArray[numpy.float64]:
        """(k, d) [rad, rad/s]."""

class DenseOutput:
    """The motion inside the steps of a run that was made."""

    @property
    def reached(self) -> float:
        """The time up to which the run was made [s]."""

    def at(self, times: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], dimension: int) -> NDArray[numpy.float64]:
        """States (n, d) at times (n,) in the direction of the run."""

class RunResult:
    """What came of one run."""

    @property
    def refused(self) -> Fault | None:
        """The fault for which nothing was run; None: it was."""

    @property
    def outcome(self) -> str:
        """How it ended."""

    @property
    def n_steps(self) -> int: ...

    @property
    def n_evaluations(self) -> int: ...

    @property
    def reached(self) -> float:
        """The time up to which the run was made [s]."""

    @property
    def t(self) -> NDArray[numpy.float64]:
        """(n,) [s]."""

    def states(self, dimension: int) -> NDArray[numpy.float64]:
        """(n, d) [rad, rad/s]."""

    def tails(self, dimension: int) -> NDArray[numpy.float64]:
        """What the states go on with, of a run with many digits, (n, d)."""

    @property
    def events(self) -> list[Crossings]: ...

    @property
    def pieces(self) -> Pieces: ...

    @property
    def trust_horizon(self) -> float | None:
        """[s]; None: not asked."""

    @property
    def dense(self) -> DenseOutput:
        """None: the method has none."""

class EnergyBalance:
    """Work done on a system and heat that it gave off since t0 [J]."""

    def parts(self, powers: int) -> NDArray[numpy.float64]:
        """Of each power, (n, powers)."""

    @property
    def net(self) -> NDArray[numpy.float64]:
        """Works less heats, (n,)."""

    @property
    def net_tails(self) -> NDArray[numpy.float64]:
        """What they go on with, (n,)."""

def balance(request: Request, progress: object | None) -> EnergyBalance:
    """Of the run, at the request's times."""

def powers(system: str) -> tuple[list[str], list[str]]:
    """
    Names of what does work on a system, and of what turns its energy into heat.
    """

class CrossingDerivatives:
    """How times and states of an event change."""

    def times(self, columns: int) -> NDArray[numpy.float64]:
        """(k, columns)."""

    def states(self, dimension: int, columns: int) -> NDArray[numpy.float64]:
        """At the event, whose time changes too, (k, d, columns)."""

class RunDerivatives:
    """How a run changes with its start and with the parameters."""

    @property
    def run(self) -> RunResult:
        """The run itself, but for its pieces and its dense output."""

    def states(self, dimension: int, columns: int) -> NDArray[numpy.float64]:
        """At the outputs, (n, d, columns)."""

    @property
    def events(self) -> list[CrossingDerivatives]: ...

def derivatives(request: Request, outputs: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], columns: Sequence[int], progress: object | None) -> RunDerivatives:
    """
    Of the run, at output times of its own, by components of the start and, from their count on, parameters.
    """

class EnsembleResult:
    """What came of many runs."""

    @property
    def refused(self) -> Fault | None:
        """The fault for which nothing was run; None: they were."""

    @property
    def outcomes(self) -> list[str]:
        """(n,): how each ended."""

    @property
    def n_steps(self) -> NDArray[numpy.int64]:
        """(n,)."""

    @property
    def n_evaluations(self) -> NDArray[numpy.int64]:
        """(n,)."""

    @property
    def reached(self) -> NDArray[numpy.float64]:
        """The time up to which each was made, (n,) [s]."""

    def states(self, times: int, dimension: int) -> NDArray[numpy.float64]:
        """(n, m, d) [rad, rad/s]; NaN where a run did not come so far."""

    def derivatives(self, times: int, dimension: int, columns: int) -> NDArray[numpy.float64]:
        """Of the states, (n, m, d, columns)."""

    @property
    def events(self) -> list[Crossings]: ...

    @property
    def trust_horizon(self) -> NDArray[numpy.float64]:
        """(n,) [s]; empty: not asked."""

def solve(request: Request, progress: object | None) -> RunResult:
    """The run that is asked for, checked."""

def ensemble(request: Request, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], parameters: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], columns: Sequence[int], threads: int, progress: object | None) -> EnsembleResult:
    """
    The runs from states (n, d) with parameters (n, p), or (1, p) for all, in place of the request's own, and their derivatives by components of the start and, from their count on, parameters.
    """

def varied(request: Request, use: str, variations: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], parameters: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], threads: int, progress: object | None) -> EnsembleResult:
    """
    The runs from states (n, d) with variations (k, d), free, for the MEGNO of the one, or made orthogonal; `states` tells of them, too.
    """

def trust_horizon(request: Request, progress: object | None) -> float:
    """
    The trust horizon of a run that reached its end; infinite: not within the run.
    """

def outcomes() -> list[str]:
    """How runs end, by number."""

largest_long_angle: float = 1125899906842624.0

def long_run_digits() -> list[int]:
    """Decimal digits of the levels of `long_run`."""

def long_run(request: Request, level: int, progress: object | None) -> RunResult:
    """
    The run with the digits of a level: states and their tails at the request's times.
    """

largest_start_angle: float = 1125899906842624.0

largest_start_speed: float = 8.452712498170644e+270

counted_half_periods: float = 1125899906842624.0

most_half_periods: float = 1.6069380442589903e+60

def exact(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], t: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], t0: float, out: Annotated[NDArray[numpy.float64], dict(shape=(None, None, None), order='C', device='cpu')]) -> bool:
    """
    States (m, n, 2) at times t (n,) from states (m, 2) at t0, into `out`; false where one is too large.
    """

def exact_derivatives(description: Description, state: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], t: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)], t0: float, columns: Sequence[int]) -> NDArray[numpy.float64]:
    """
    Derivatives (n, 2, columns) at times t (n,) of the motion from a state (2,) at t0.
    """

def periods(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """Periods of states (m, 2) [s]."""

def actions(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """Actions of states (m, 2) [J s]."""

def times_at(description: Description, states: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], theta: Annotated[NDArray[numpy.float64], dict(shape=(None,), order='C', device='cpu', writable=False)]) -> NDArray[numpy.float64]:
    """When each state (m, 2) first has its angle (m,) [s]."""

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

second_run_tolerance: float = 0.001

flip_agreement: float = 0.0001

class Flips:
    """First flips of a double pendulum's rods."""

    @property
    def refused(self) -> Fault | None:
        """The fault for which nothing was run; None: it was."""

    @property
    def time(self) -> NDArray[numpy.float64]:
        """(n,) [s]; NaN: none."""

    @property
    def rod(self) -> NDArray[numpy.uint8]:
        """(n,); 0: none."""

    @property
    def forbidden(self) -> NDArray[numpy.uint8]:
        """(n,): 1 where the energy is too small for a flip."""

    @property
    def resolved(self) -> NDArray[numpy.uint8]:
        """(n,): 1 where the second run agrees; empty: not asked."""

def flips(description: Description, t_max: float, tolerance: float, which: int, resolve: bool, starts: Annotated[NDArray[numpy.float64], dict(shape=(None, None), order='C', device='cpu', writable=False)], threads: int, progress: object | None) -> Flips:
    """First flips from states (n, 4) at rest."""
