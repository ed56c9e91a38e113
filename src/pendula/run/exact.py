"""Solutions in closed form: the motion, when it passes an angle, and its action."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pendula import _engine
from pendula._angles import warn_of_degrees
from pendula._checks import broadcast_shape, finite_array, finite_number, states_array
from pendula.run.closed_form import exact_states
from pendula.run.derivatives import checked_derivatives, exact_derivatives
from pendula.run.request import Request
from pendula.run.trajectory import Trajectory
from pendula.systems import System, with_closed_form

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import ArrayLike


def exact(
    system: System,
    state: ArrayLike,
    t: ArrayLike,
    *,
    t0: float = 0.0,
    derivatives: str | Iterable[str] | None = None,
) -> Trajectory:
    """The motion in closed form, for any state, in every regime, to the last bits.

    The given numbers are taken as exact. The linear pendulum: Herrera et al. (2024), eq. 11; with
    friction and a drive in every regime (critical damping, resonance) to half a unit in the last
    place of θ, by divided differences of the exponential (McCurdy, Ng & Parlett 1984). The
    simple pendulum by Jacobi elliptic functions (DLMF 22.19(i)): swings, turns (counted, never
    wrapped), the separatrix and what lies next to it. The error is at most 4 * 2^-52 of
    max(|θ|, min(1, amplitude)) and of the largest |ω| of the motion, at any time.

    Args:
        system: a LinearPendulum or SimplePendulum.
        state: (θ0, ω0) at time t0, or an array (..., 2) of them [rad, rad/s].
        t: a time or times in any order, before t0 too, (n,) [s].
        t0: time of the state [s].
        derivatives: names of components of the start and of parameters to derive the states by, or
            "state", "parameters" or "all": the closed form in a hundred digits, derived.

    Returns:
        A trajectory with states (n, 2), or (..., n, 2) for states (..., 2); derivatives
        (..., n, 2, k).

    Raises:
        ValueError: for a system without a closed form, values that are not finite, an angle of
            2^50 rad or more, a speed of 2^900 natural frequencies, or a time more than 2^200 half
            periods away (linear: an amplitude of 2^900 rad, 2^50 half periods).
    """
    with_closed_form(system)
    start = states_array(state, system.component_units, finite=False)  # the core refuses others
    warn_of_degrees("state", state, start[..., 0])
    origin = finite_number("t0", t0, "s")
    times = finite_array("t", t, "s").reshape(-1)
    names = checked_derivatives(derivatives, system)
    states = exact_states(system, start, times, origin)
    return Trajectory(
        system,
        "exact",
        times,
        states,
        Request(state=start, t=times, t0=origin),
        derivatives=exact_derivatives(system, start, times, origin, names) if names else None,
        derivative_names=names,
    )


def time_at(system: System, state: ArrayLike, theta: ArrayLike) -> Any:
    """When the angle is first `theta`, from the state on [s].

    Args:
        system: a LinearPendulum or SimplePendulum.
        state: (θ0, ω0), or an array (..., 2) of them [rad, rad/s].
        theta: angle, turns counted; any shape that broadcasts against the states' (...) [rad].

    Returns:
        A float or an array of the broadcast shape: 0 where the state has that angle, infinite
        where the motion never does.

    Raises:
        ValueError: for a system without a closed form, values that are not finite, or a state
            too large, as for `exact`.
    """
    import numpy as np

    solvable = with_closed_form(system, periodic=True)
    start = states_array(state, system.component_units)
    solvable.check_start(start)
    warn_of_degrees("state", state, start[..., 0])
    angles = finite_array("theta", theta, "rad")
    shape = broadcast_shape(state=start.shape[:-1], theta=angles.shape)
    states = np.broadcast_to(start, (*shape, 2)).reshape(-1, 2)
    # mirrored to ω ≥ 0: a phase next to 0 keeps the digits that one next to π would lose
    forwards = np.where(states[:, 1] < 0, -1.0, 1.0)
    result = _engine.times_at(
        system._description(),
        states * forwards[:, np.newaxis],
        np.broadcast_to(angles, shape).ravel() * forwards,
    )
    return result.reshape(shape) if shape else float(result[0])


def action(system: System, state: ArrayLike) -> Any:
    """The action ∮ p dθ / 2π of the motion, over a swing or a turn [J s].

    (8/π) m √(g L³) (E − k'² K) in libration and (4/π) m √(g L³) k E(1/k) in rotation, with
    k² = sin²(θ0/2) + (ω0/2ωn)² (DLMF 22.19(i)); energy over ωn for the linear pendulum.

    Args:
        system: a LinearPendulum or SimplePendulum.
        state: (θ0, ω0), or an array (..., 2) of them [rad, rad/s].

    Returns:
        A float, or an array of the states' shape without the last axis.

    Raises:
        ValueError: for a system without a closed form, or values that are not finite.
    """
    solvable = with_closed_form(system, periodic=True)
    start = states_array(state, system.component_units)
    solvable.check_start(start)
    warn_of_degrees("state", state, start[..., 0])
    result = solvable.actions(start)
    return result if start.ndim > 1 else float(result)
