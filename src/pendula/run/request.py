"""What was asked for: enough to run it, and to run it again."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, cast

from pendula import _engine
from pendula._checks import any_as_large, finite_array, finite_number, states_array
from pendula._messages import ArgumentError, meant
from pendula._rules import broken, refuse
from pendula.run.options import BEST_TOLERANCE, Options, checked_types

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from pendula._types import Array, MethodName
    from pendula.systems import System


@dataclass(frozen=True, kw_only=True)
class Request(Options):
    """What was asked for, with the options of the run.

    Attributes:
        state: at time t0, (d,), or (..., d) for several exact solutions.
        t: the one end time, where the output is the method's own steps, or output times, (n,) [s].
        t0: time of the state [s].
    """

    state: Array
    t: float | Array
    t0: float = 0.0

    @property
    def end(self) -> float:
        """The time up to which the run was to be made [s]."""
        return self.t if isinstance(self.t, float) else float(self.t[-1])

    def for_core(self, system: System, method: str) -> _engine.Request:
        """The request as the core takes it."""
        import numpy as np

        return core_request(
            system._description(),
            method,
            self.state,
            self.t0,
            np.array([self.t]) if isinstance(self.t, float) else self.t,
            self,
            own_steps=isinstance(self.t, float),
        )


def core_request(
    description: _engine.Description,
    method: str,
    state: Array,
    t0: float,
    times: Array,
    options: Options,
    *,
    own_steps: bool = False,
) -> _engine.Request:
    """A request of the core."""
    return _engine.Request(
        description,
        method,
        state,
        t0,
        times,
        own_steps,
        [each.for_core() for each in options.events],
        **options.numbers(),
    )


def request_of(
    system: System, state: ArrayLike, t: ArrayLike, method: MethodName, t0: float, **given: Any
) -> tuple[Request, _engine.Request]:
    """The checked request that the arguments of `solve` make, and the same for the core.

    The method's name is one of the catalogue: `checked_name`.

    Raises:
        TypeError: for an option that there is none of.
        ValueError: for an argument out of range, or two that exclude one another.
    """
    start = checked_state(state, system, "for many use <call=ensemble>(system, states, t, …)")
    origin = finite_number("t0", t0, "s")
    times = times_array(t)
    wanted = float(times) if times.ndim == 0 else times
    options = checked_types(given, "solve")
    if "digits" not in options:  # which have a range of their own
        check_angles(system, start)
        if _engine.method_named(method).adaptive:
            options.setdefault("tolerance", BEST_TOLERANCE)
    asked = Request(state=start, t=wanted, t0=origin, **options)
    for_core = asked.for_core(system, method)
    refuse(_engine.check(for_core))
    return asked, for_core


def checked_name(method: object, argument: str = "method") -> MethodName:
    """The name of a method as the catalogue writes it; upper and lower case are the same."""
    names = list(_engine.methods_by_name())
    name = method.lower() if isinstance(method, str) else ""
    if name not in names:
        raise broken(
            argument, "unknown_name", way_out=meant(name, names), choices=names, value=method
        )
    return cast("MethodName", str(name))


def check_angles(system: System, start: Array) -> None:
    """Refuse a start whose angles the sine does not take, before a run that could not begin.

    Raises:
        ValueError: naming the angle.
    """
    angles = start[: system.can.degrees_of_freedom]
    if system.can.periodic and any_as_large(angles, _engine.LARGEST_ANGLE):
        raise ArgumentError(
            "state",
            "must have angles below 2^26 rad = {most} rad, got {value}",
            "take whole turns off: the motion is the same",
            most=round(_engine.LARGEST_ANGLE),
            value=float(angles[abs(angles).argmax()]),
        )


def checked_state(state: ArrayLike, system: System, many: str = "") -> Array:
    """One state of the system, (d,); `many` says what there is for several."""
    start = states_array(state, system.component_units)
    if start.ndim != 1:
        raise ArgumentError(
            "state",
            "must be one state of shape {wanted}, got shape {value}",
            many,
            wanted=(start.shape[-1],),
            value=start.shape,
        )
    return start


def times_array(t: ArrayLike) -> Array:
    """An end time, (), or output times, (n,), finite."""
    times = finite_array("t", t, "s")
    if times.ndim > 1 or times.size == 0:
        raise ArgumentError(
            "t",
            "must be one end time or output times of shape (n,), got shape {value}",
            value=times.shape,
        )
    return times
