"""One bob on a rod: the linear and the simple pendulum."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from pendula import _engine
from pendula._angles import warn_of_degrees
from pendula._checks import finite_array, number, states_array
from pendula._messages import ArgumentError
from pendula._rules import refuse
from pendula.systems.base import STANDARD_GRAVITY, ClosedForm

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from pendula._types import Array


@dataclass(frozen=True)
class _OneBob(ClosedForm):
    form: ClassVar[str] = ""  # type: ignore[misc]  # the one form there is

    length: float = 1.0
    gravity: float = STANDARD_GRAVITY
    mass: float = 1.0

    @property
    def natural_frequency(self) -> float:
        """ωn = √(g/L) [rad/s]."""
        return math.sqrt(self.gravity / self.length)


@dataclass(frozen=True, repr=False)
class LinearPendulum(_OneBob):
    """The linear pendulum: the small-angle model, with viscous friction and a harmonic drive.

    m L² (θ̈ + (g/L) θ) = −b ω + τ cos(Ω t + φ). Without friction and drive, as it is by default, it
    is harmonic for every amplitude; with them it is the catalogue's "driven-linear".

    Args:
        length: from pivot to bob [m].
        gravity: [m/s²].
        mass: of the bob [kg].
        viscous: friction torque over angular velocity, b [N m s].
        torque: amplitude of the driving torque, τ [N m].
        drive_frequency: its angular frequency Ω [rad/s].
        drive_phase: its phase φ at t = 0 [rad].

    Raises:
        ValueError: for a value that is not finite, or out of its range.
    """

    name: ClassVar[str] = "linear"
    other_names: ClassVar[tuple[str, ...]] = ("driven-linear",)
    viscous: float = 0.0
    torque: float = 0.0
    drive_frequency: float = 0.0
    drive_phase: float = 0.0
    largest_start: ClassVar[float] = _engine.LARGEST_START_SPEED
    most_half_periods: ClassVar[float] = _engine.COUNTED_HALF_PERIODS

    def __post_init__(self) -> None:
        driven = self.other_names[0]
        rows = _engine.system_entries()[driven].forms[0].parameters
        values = tuple(number(row.name, getattr(self, row.name), row.unit) for row in rows)
        refuse(_engine.check_system(_engine.describe(driven, "", values)))
        for row, value in zip(rows, values, strict=True):
            object.__setattr__(self, row.name, value)
        if self.viscous or self.torque:
            object.__setattr__(self, "name", driven)
        super().__post_init__()

    def __repr__(self) -> str:
        arguments = ", ".join(f"{name}={value!r}" for name, value in self.parameters.items())
        return f"LinearPendulum({arguments})"

    def period(self, amplitude: ArrayLike | None = None, *, state: ArrayLike | None = None) -> Any:
        """2π/ωn [s], the same for every amplitude or state; shaped as they are.

        Raises:
            ValueError: with friction or a drive: no motion then repeats itself for every start.
        """
        import numpy as np

        if not self.can.period:
            rule = "must be without friction and drive to have a period, got {value}"
            raise ArgumentError("system", rule, value=self)
        one = float(_engine.periods(self._description(), np.zeros((1, 2)))[0])
        shape: tuple[int, ...] = ()
        if amplitude is not None:
            shape = finite_array("amplitude", amplitude, "rad").shape
        elif state is not None:
            shape = states_array(state, self.component_units).shape[:-1]
        return np.full(shape, one) if shape else one


@dataclass(frozen=True)
class SimplePendulum(_OneBob):
    """The simple pendulum, θ̈ = −(g/L) sin θ: a point mass on a massless rod, any angle.

    Args:
        length: from pivot to bob [m].
        gravity: [m/s²].
        mass: of the bob [kg].

    Raises:
        ValueError: for a value that is not positive and finite.
    """

    name: ClassVar[str] = "simple"
    largest_start: ClassVar[float] = _engine.LARGEST_START_ANGLE
    most_half_periods: ClassVar[float] = _engine.MOST_HALF_PERIODS

    def period(self, amplitude: ArrayLike | None = None, *, state: ArrayLike | None = None) -> Any:
        """Period of the motion of that amplitude, or through that state [s].

        T = 4 K(k) / ωn in libration, 2 K(1/k) / (k ωn) for a whole turn in rotation, infinite on
        the separatrix; k² = sin²(θ0/2) + (ω0/2ωn)². DLMF 22.19(i).

        Args:
            amplitude: largest angle of a libration, within [−π, π] [rad]; any shape.
            state: (θ0, ω0) or an array (..., 2) of them [rad, rad/s].

        Returns:
            A float, or an array of the amplitude's shape, or of the states' without the last axis.

        Raises:
            ValueError: for neither or both arguments, or an amplitude beyond π.
        """
        import numpy as np

        if (amplitude is None) == (state is None):
            raise ArgumentError(
                "", "period takes an <amplitude> or <state=(theta0, omega0)>, one of the two"
            )
        if amplitude is not None:
            states = self._releases(amplitude)
        else:
            states = states_array(state, self.component_units)  # type: ignore[arg-type]
            self.check_start(states)
            warn_of_degrees("state", state, states[..., 0])
        rows = np.ascontiguousarray(states.reshape(-1, 2))
        result = _engine.periods(self._description(), rows)
        return result.reshape(states.shape[:-1]) if states.ndim > 1 else float(result[0])

    def _releases(self, amplitude: ArrayLike) -> Array:
        """The states of largest angle."""
        import numpy as np

        angles = finite_array("amplitude", amplitude, "rad")
        if (np.abs(angles) > math.pi).any():
            largest = float(angles.flat[int(np.abs(angles).argmax())])
            raise ArgumentError(
                "amplitude",
                "must lie within [-pi, pi] [rad], got {value}",
                "for a motion over the top give <state=(theta0, omega0)>",
                value=largest,
            )
        return np.stack([angles, np.zeros_like(angles)], axis=-1)
