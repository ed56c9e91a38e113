"""The planar double pendulum with friction in its joints."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from pendula._messages import ArgumentError
from pendula.systems.base import STANDARD_GRAVITY
from pendula.systems.double import DoublePendulum
from pendula.systems.forms import SystemOfForms

Pair = tuple[float, float]
_NONE = (0.0, 0.0)
_IN_JOINTS = ("viscous", "coulomb")


@dataclass(frozen=True, init=False, repr=False)
class DampedDoublePendulum(SystemOfForms):
    """The double pendulum with friction in its joints; make one with `rods`, `bobs` or `bodies`.

    Friction exerts −b1 ω1 − τ1 sgn ω1 in the pivot, and −b2 v − τ2 sgn v with the relative velocity
    v = ω2 − ω1 in the joint. With Coulomb friction the joints slip and stick:
    `Trajectory.pieces`.
    """

    name: ClassVar[str] = "damped-double"

    @classmethod
    def rods(
        cls,
        m1: float = 1.0,
        m2: float = 1.0,
        l1: float = 1.0,
        l2: float = 1.0,
        gravity: float = STANDARD_GRAVITY,
        *,
        viscous: Pair = _NONE,
        coulomb: Pair = _NONE,
    ) -> DampedDoublePendulum:
        """Two uniform rods of masses m1, m2 [kg] and lengths l1, l2 [m].

        Args:
            m1: mass of rod 1 [kg]; m2 of rod 2.
            m2: mass of rod 2 [kg].
            l1: length of rod 1 [m]; l2 of rod 2.
            l2: length of rod 2 [m].
            gravity: [m/s²].
            viscous: friction torque over velocity (b1, b2) in the pivot and in the joint [N m s].
            coulomb: torque of dry friction (τ1, τ2) [N m].
        """
        return cls._with_friction(DoublePendulum.rods(m1, m2, l1, l2, gravity), viscous, coulomb)

    @classmethod
    def bobs(
        cls,
        m1: float = 1.0,
        m2: float = 1.0,
        l1: float = 1.0,
        l2: float = 1.0,
        gravity: float = STANDARD_GRAVITY,
        *,
        viscous: Pair = _NONE,
        coulomb: Pair = _NONE,
    ) -> DampedDoublePendulum:
        """Two point masses on massless rods; see `rods`."""
        return cls._with_friction(DoublePendulum.bobs(m1, m2, l1, l2, gravity), viscous, coulomb)

    @classmethod
    def bodies(
        cls,
        m1: float,
        m2: float,
        l1: float,
        c1: float,
        c2: float,
        I1: float,
        I2: float,
        gravity: float = STANDARD_GRAVITY,
        l2: float | None = None,
        *,
        viscous: Pair = _NONE,
        coulomb: Pair = _NONE,
    ) -> DampedDoublePendulum:
        """Any two rigid bodies, see `DoublePendulum.bodies`, with friction as of `rods`."""
        ideal = DoublePendulum.bodies(m1, m2, l1, c1, c2, I1, I2, gravity, l2)
        return cls._with_friction(ideal, viscous, coulomb)

    @classmethod
    def _with_friction(
        cls, ideal: DoublePendulum, viscous: Pair, coulomb: Pair
    ) -> DampedDoublePendulum:
        for name, pair in (("viscous", viscous), ("coulomb", coulomb)):
            if isinstance(pair, str) or not hasattr(pair, "__len__") or len(pair) != 2:
                rule = "must be two numbers, of the pivot and of the joint, got {value}"
                raise ArgumentError(name, rule, value=pair)
        return cls(ideal.form, (*ideal.values, *viscous, *coulomb))

    def _named(self) -> dict[str, object]:
        ideal = {name: x for name, x in self.parameters.items() if name[:-1] not in _IN_JOINTS}
        pairs = {name: getattr(self, name) for name in _IN_JOINTS}
        return {**ideal, **{name: pair for name, pair in pairs.items() if any(pair)}}

    @property
    def viscous(self) -> Pair:
        """Friction torque over velocity in the pivot and in the joint [N m s]."""
        return self.parameters["viscous1"], self.parameters["viscous2"]

    @property
    def coulomb(self) -> Pair:
        """Torque of dry friction in the pivot and in the joint [N m]."""
        return self.parameters["coulomb1"], self.parameters["coulomb2"]
