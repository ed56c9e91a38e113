"""Arguments of a run, checked: states, output times, steps and tolerances."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from pendula import _engine
from pendula._checks import (
    LARGEST_COUNT,
    finite_array,
    finite_number,
    one_of,
    positive_number,
    states_array,
    whole_number,
)
from pendula.run.events import checked_events

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import ArrayLike

    from pendula._types import Array
    from pendula.run.events import Event
    from pendula.systems import System


MOST_OWN_STEPS = 10**7  # of an adaptive method as outputs, if no limit is named: 400 MB
LARGEST_TOLERANCE, BEST_TOLERANCE = 1e-3, 2.0**-52
MOST_DIGITS = 15  # that a double holds
LARGEST_PHASE = 1e-3  # that a small swing may turn between two neighbouring times [rad]
_MORE_DIGITS = "for more digits than a double has, take digits=12, say"


def checked_state(state: ArrayLike, system: System) -> Array:
    """One state of the system, (d,)."""
    start = states_array(state, system.components)
    if start.ndim != 1:
        raise ValueError(
            f"state must be one state of shape ({start.shape[-1]},), got {start.shape}"
        )
    return start


def checked_method(name: object, system: System) -> _engine.Method:
    """The method of that name, which takes the system."""
    known = {each.name: each for each in _engine.methods()}
    method = known[one_of("method", name, known)]
    if system.name not in method.systems:
        others = [each.name for each in known.values() if each.symplectic]
        takers = [other for other in others if system.name in known[other].systems]
        raise ValueError(
            f"method {method.name!r} needs a system whose energy separates into one part of the "
            f"momenta and one of the angles, which that of the {system.name} pendulum does not; "
            f"symplectic methods for it are {', '.join(takers)}"
        )
    return method


def checked_tolerance(tolerance: float | None, way_out: str = "") -> float:
    """The tolerance of an adaptive method, or the best one; `way_out`: of one too small."""
    if tolerance is None:
        return BEST_TOLERANCE
    value = finite_number("tolerance", tolerance)
    if not BEST_TOLERANCE <= value <= LARGEST_TOLERANCE:
        raise ValueError(
            f"tolerance must lie between 2^-52 = {BEST_TOLERANCE:.3g} and {LARGEST_TOLERANCE:g}, "
            f"got {value!r}" + ((way_out and value < BEST_TOLERANCE and f"; {way_out}") or "")
        )
    return value


def log2_of(tolerance: float) -> float:
    """To so few digits that every C library gives the same."""
    return round(math.log2(tolerance) * 1024.0) / 1024.0


def output_times(t: ArrayLike, t0: float) -> tuple[Array, bool]:
    """The times (n,), and whether the one of them is the end of a run's own steps."""
    import numpy as np

    times = finite_array("t", t, "s")
    if times.ndim == 0:
        if float(times) == t0:
            raise ValueError(f"t must differ from t0 = {t0!r} s, got {float(times)!r}")
        return times.reshape(1), True
    if times.ndim != 1 or times.size == 0:
        raise ValueError(
            f"t must be one end time or output times of shape (n,), got shape {times.shape}"
        )
    direction = np.sign(float(times[-1]) - t0)
    gaps = np.diff(times)
    if (gaps * direction <= 0).any() or (float(times[0]) - t0) * direction < 0:
        raise ValueError(
            f"t must rise (or fall) strictly from t0 = {t0!r} s or later, got {_shortened(times)}"
        )
    return times, False


def _shortened(times: Array) -> str:
    shown = ", ".join(f"{value:g}" for value in times[:4])
    return f"[{shown}{', …' if times.size > 4 else ''}]"


def step_size(method: str, step: float | None, t0: float, end: float) -> float:
    """The step of a fixed-step method, within the span and above the rounding of the times."""
    span = end - t0
    if step is None:
        raise ValueError(
            f"step is needed by the fixed-step method {method!r}; give step=0.001 [s], say"
        )
    size = positive_number("step", step, "s")
    if span != 0.0 and size > abs(span):
        raise ValueError(
            f"step must not exceed the span of {abs(span)!r} s from t0 to the end, got {size!r} s"
        )
    if abs(span) / size > LARGEST_COUNT:
        raise ValueError(
            f"step = {size!r} s is too small for a span of {abs(span)!r} s: over 2^53 steps"
        )
    if t0 + size == t0 or end - math.copysign(size, span) == end:
        raise ValueError(
            f"step = {size!r} s is below the rounding of times near {max(abs(t0), abs(end))!r} s; "
            "let t0 be 0, or take a larger step"
        )
    return size


def check_rounding_of_times(system: System, t0: float, end: float, name: str = "t0 and t") -> None:
    """Refuse times so large that the motion moves between one double and the next.

    Args:
        system: the pendulum.
        t0: the start [s].
        end: of the run [s].
        name: of the argument, or arguments, that they come from.

    Raises:
        ValueError: saying how far apart times are.
    """
    apart = math.ulp(max(abs(t0), abs(end)))
    known = system.constants
    if "A" in known:
        of_both = (known["A"] * known["E"] + known["B"] * known["D"]) / known["determinant_floor"]
    else:
        of_both = known["natural_frequency_squared"]
    if apart * math.sqrt(of_both) > LARGEST_PHASE:
        raise ValueError(
            f"{name} must be small enough to tell times apart: near {max(abs(t0), abs(end)):g} s "
            f"doubles are {apart:g} s apart; " + ("let t0 be 0" if t0 else "end the run before")
        )


def checked_options(
    systems: Sequence[System],
    method: _engine.Method,
    t0: float,
    times: Array,
    digits: int | None,
    events: Event | Iterable[Event],
    **given: Any,
) -> dict[str, Any]:
    """What a run is asked for besides its start and its times.

    Args:
        systems: of one kind.
        method: that takes them.
        t0: the start [s].
        times: of the outputs, (n,) [s].
        digits: as for `solve`, like the rest.
        events: one, or several.
        **given: step, tolerance, max_steps and certify.

    Returns:
        Fields of a `Request` and of a `Task`, by name.

    Raises:
        ValueError: for one out of range, or two that exclude one another.
    """
    check_together(method, digits, **given, events=events or None)
    step, limit, certify = given["step"], given["max_steps"], given["certify"]
    end, adaptive = float(times[-1]), method.adaptive
    for each in systems if adaptive else ():
        check_rounding_of_times(each, t0, end)
    chooses = adaptive and digits is None
    return {
        "step": None if adaptive else step_size(method.name, step, t0, end),
        "max_steps": None if limit is None else whole_number("max_steps", limit, LARGEST_COUNT),
        "tolerance": checked_tolerance(given["tolerance"], _MORE_DIGITS) if chooses else None,
        "events": checked_events(events, systems[0]),
        "certify": None if certify is None else checked_certify(certify),
    }


def checked_certify(certify: float) -> float:
    """The largest angle that a certified run may be off by."""
    allowed = positive_number("certify", certify, "rad")
    if allowed > 1.0:
        raise ValueError(
            f"certify must be an angle of at most 1 rad, got {allowed!r}: beyond it two motions "
            "have nothing to do with one another"
        )
    return allowed


def check_together(method: _engine.Method, digits: int | None, **given: object) -> None:
    """Refuse arguments that do not go with the method, or with digits."""
    if digits is not None:
        whole_number("digits", digits, MOST_DIGITS)
        other = f"the method {method.name!r}" if method.name != "taylor" else None
        for name in (other, *(name for name, value in given.items() if value is not None)):
            if name:
                raise ValueError(
                    f"digits is not taken together with {name}: it chooses method and precision "
                    "by itself; leave one of the two out"
                )
    if method.adaptive and given["step"] is not None:
        raise ValueError(
            f"step is not taken by the adaptive method {method.name!r}, got {given['step']!r}; "
            "leave it out, or name a tolerance"
        )
    if not method.adaptive and given["tolerance"] is not None:
        raise ValueError(
            f"tolerance is not taken by the fixed-step method {method.name!r}, "
            f"got {given['tolerance']!r}; choose the step, or an adaptive method such as 'taylor'"
        )
    if not method.adaptive and given["events"] is not None:
        raise ValueError(
            f"events are not taken by the fixed-step method {method.name!r}, which does not know "
            "the motion inside its steps; "
            f"take {' or '.join(each.name for each in _engine.methods() if each.adaptive)}"
        )
