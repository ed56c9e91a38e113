"""Arguments of a run, checked: states, output times, steps and tolerances."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pendula import _engine
from pendula._checks import (
    LARGEST_COUNT,
    finite_array,
    finite_number,
    one_of,
    positive_number,
    states_array,
)

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from pendula.systems import System

    Array = NDArray[np.float64]

MOST_OWN_STEPS = 10**7  # of an adaptive method as outputs, if no limit is named: 400 MB
LARGEST_TOLERANCE, BEST_TOLERANCE = 1e-3, 2.0**-52
LARGEST_PHASE = 1e-3  # that a small swing may turn between two neighbouring times [rad]


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


def checked_tolerance(tolerance: float | None) -> float:
    """The tolerance of an adaptive method, or the best one."""
    if tolerance is None:
        return BEST_TOLERANCE
    value = finite_number("tolerance", tolerance)
    if not BEST_TOLERANCE <= value <= LARGEST_TOLERANCE:
        raise ValueError(
            f"tolerance must lie between 2^-52 = {BEST_TOLERANCE:.3g} and {LARGEST_TOLERANCE:g}, "
            f"got {value!r}; for more digits than a double has, take digits=12, say"
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


def check_rounding_of_times(system: System, t0: float, end: float) -> None:
    """Refuse times so large that the motion moves between one double and the next.

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
            f"t0 and t must be small enough to tell times apart: near {max(abs(t0), abs(end)):g} s "
            f"doubles are {apart:g} s apart; let t0 be 0"
        )
