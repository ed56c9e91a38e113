"""A real pendulum: one rigid body with friction, a driving torque and a moving pivot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, TypedDict

from pendula.systems.base import STANDARD_GRAVITY
from pendula.systems.forms import SystemOfForms

if TYPE_CHECKING:
    from typing import Unpack


class Real(TypedDict, total=False):
    """Friction, drive and pivot; what is left out is 0, `pivot_direction` up and down."""

    viscous: float  # torque over angular velocity [N m s]
    coulomb: float  # torque of dry friction [N m]
    quadratic: float  # drag torque over angular velocity squared [N m s²]
    cubic: float  # torque over angular velocity cubed [N m s³]
    torque: float  # amplitude of the driving torque [N m]
    drive_frequency: float  # its angular frequency [rad/s]
    drive_phase: float  # its phase at t = 0 [rad]
    pivot_amplitude: float  # of the pivot's motion [m]
    pivot_frequency: float  # its angular frequency [rad/s]
    pivot_phase: float  # its phase at t = 0 [rad]
    pivot_direction: float  # of the pivot's motion, from the x axis [rad]


@dataclass(frozen=True, init=False, repr=False)
class DrivenPendulum(SystemOfForms):
    """One rigid body with friction, a driving torque and a moving pivot.

    I θ̈ = −m g c sin θ − b ω − τc sgn ω − d |ω| ω − r ω³ + τ cos(Ω t + φ) − m c (ẍ cos θ + ÿ sin θ)
    with the pivot at a (cos α, sin α) cos(Ωp t + φp). Make one with `bob`, `body` or `scaled`.

    Energy and positions are those seen from the pivot. With Coulomb or quadratic friction the
    motion is in pieces, between which the friction changes: `Trajectory.pieces`.
    """

    name: ClassVar[str] = "driven"

    @classmethod
    def bob(
        cls,
        length: float = 1.0,
        gravity: float = STANDARD_GRAVITY,
        mass: float = 1.0,
        **real: Unpack[Real],
    ) -> DrivenPendulum:
        """A point mass [kg] on a massless rod of a length [m].

        Args:
            length: from pivot to bob [m].
            gravity: [m/s²].
            mass: of the bob [kg].
            **real: friction, drive and pivot, see `Real`.
        """
        return cls.of_form("bob", {"length": length, "gravity": gravity, "mass": mass, **real})  # type: ignore[dict-item]

    @classmethod
    def body(
        cls,
        mass: float,
        centre: float,
        inertia: float,
        gravity: float = STANDARD_GRAVITY,
        **real: Unpack[Real],
    ) -> DrivenPendulum:
        """A rigid body.

        Args:
            mass: [kg].
            centre: distance from the pivot to the centre of mass [m].
            inertia: moment of inertia about the pivot [kg m²].
            gravity: [m/s²].
            **real: friction, drive and pivot, see `Real`.
        """
        own = {"mass": mass, "centre": centre, "inertia": inertia, "gravity": gravity}
        return cls.of_form("body", {**own, **real})  # type: ignore[dict-item]

    @classmethod
    def scaled(
        cls, q: float, a: float, drive_frequency: float, drive_phase: float = 0.0
    ) -> DrivenPendulum:
        """θ̈ + θ̇/q + sin θ = a cos(Ω t + φ), all numbers without units (Baker & Gollub 1996).

        Args:
            q: quality factor.
            a: amplitude of the drive.
            drive_frequency: Ω, in parts of the pendulum's own for small swings.
            drive_phase: φ at t = 0 [rad].
        """
        return cls("scaled", (q, a, drive_frequency, drive_phase))
