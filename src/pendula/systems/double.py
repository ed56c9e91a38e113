"""The planar double pendulum: two rods, two bobs, or any two rigid bodies."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, NamedTuple

from pendula.systems.base import STANDARD_GRAVITY
from pendula.systems.forms import SystemOfForms


@dataclass(frozen=True)
class NormalModes:
    """Small oscillations about the lowest point, the slow mode first.

    Attributes:
        frequencies: angular frequencies, (2,) [rad/s].
        shapes: row i holds (θ1, θ2) of mode i, of length one, θ1 not negative, (2, 2).
    """

    frequencies: tuple[float, float]
    shapes: tuple[tuple[float, float], tuple[float, float]]


@dataclass(frozen=True, init=False, repr=False)
class DoublePendulum(SystemOfForms):
    """The planar double pendulum; make one with `rods`, `bobs` or `bodies`.

    T = ½A ω1² + ½B ω2² + C ω1 ω2 cos(θ1−θ2), V = D (1 − cos θ1) + E (1 − cos θ2), with the
    constants A … E that each form gives (`constants`). Rods: Herrera et al. (2024), eqs. 35–50.
    """

    name: ClassVar[str] = "double"

    @classmethod
    def rods(
        cls,
        m1: float = 1.0,
        m2: float = 1.0,
        l1: float = 1.0,
        l2: float = 1.0,
        gravity: float = STANDARD_GRAVITY,
    ) -> DoublePendulum:
        """Two uniform rods of masses m1, m2 [kg] and lengths l1, l2 [m]: the paper's pendulum."""
        return cls("rods", (m1, m2, l1, l2, gravity))

    @classmethod
    def bobs(
        cls,
        m1: float = 1.0,
        m2: float = 1.0,
        l1: float = 1.0,
        l2: float = 1.0,
        gravity: float = STANDARD_GRAVITY,
    ) -> DoublePendulum:
        """Two point masses m1, m2 [kg] on massless rods of lengths l1, l2 [m]."""
        return cls("bobs", (m1, m2, l1, l2, gravity))

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
    ) -> DoublePendulum:
        """Any two rigid bodies.

        Args:
            m1: mass of body 1 [kg]; m2 of body 2.
            m2: mass of body 2 [kg].
            l1: from the pivot to the joint [m].
            c1: from the pivot to the centre of mass of body 1 [m].
            c2: from the joint to the centre of mass of body 2 [m].
            I1: moment of inertia of body 1 about its centre of mass [kg m²].
            I2: moment of inertia of body 2 about its centre of mass [kg m²].
            gravity: [m/s²].
            l2: length of body 2, for drawing and tip events only [m]; None: c2.
        """
        return cls("bodies", (m1, m2, l1, c1, c2, I1, I2, gravity, c2 if l2 is None else l2))

    @property
    def fastest_frequency(self) -> float:
        """Of the fast mode of small oscillations [rad/s]."""
        return self.normal_modes().frequencies[1]

    @property
    def slowest_frequency(self) -> float:
        """Of the slow mode of small oscillations [rad/s]."""
        return self.normal_modes().frequencies[0]

    def normal_modes(self) -> NormalModes:
        """Frequencies and shapes of small oscillations.

        λ = ω² solves (AB − C²) λ² − (AE + BD) λ + DE = 0; the discriminant as a sum of squares and
        the smaller root from the product of both lose no digits. With u1 = √D θ1, u2 = √E θ2 the
        modes are the axes of a symmetric matrix, at right angles. The products of four constants
        may leave the range of doubles where the frequencies do not: they keep their exponents
        apart.
        """
        constants = self.constants
        A, B, C, D, E = (constants[name] for name in "ABCDE")
        first, second = _Product.of(A, E), _Product.of(B, D)  # the second is never zero
        unit = max(first.exponent, second.exponent) if first.mantissa else second.exponent
        a, b = first.over(unit), second.over(unit)
        c = _Product.of(C, C, D, E).root(-2 * unit)  # C √(DE)
        total = a + b + math.hypot(a - b, 2.0 * c)
        slow, determinant = _Product.of(D, E), _Product.of(constants["determinant_floor"])
        return NormalModes(
            (
                _root(2.0 * slow.mantissa / total, slow.exponent - unit),
                _root(0.5 * total / determinant.mantissa, unit - determinant.exponent),
            ),
            _mode_shapes(a, b, c, D, E) if E else ((0.0, 1.0), (1.0, 0.0)),
        )


class _Product(NamedTuple):
    """mantissa · 2^exponent, of any size."""

    mantissa: float
    exponent: int

    @classmethod
    def of(cls, *factors: float) -> _Product:
        mantissas, exponents = zip(*map(math.frexp, factors), strict=True)
        return cls(math.prod(mantissas), sum(exponents))

    def over(self, exponent: int) -> float:
        """In units of 2^exponent, which must not be much smaller."""
        return math.ldexp(self.mantissa, self.exponent - exponent)

    def root(self, shift: int) -> float:
        """The square root after 2^shift times as much."""
        return _root(self.mantissa, self.exponent + shift)


def _root(mantissa: float, exponent: int) -> float:
    """√(mantissa · 2^exponent), which is in range where its square is not."""
    return math.ldexp(math.sqrt(mantissa * (1 + exponent % 2)), exponent // 2)


def _mode_shapes(
    a: float, b: float, c: float, D: float, E: float
) -> tuple[tuple[float, float], tuple[float, float]]:
    """The axes of ((a, c), (c, b)), the longer first, in the angles, of length one each."""
    # sines of both angles that the axes make: the cosine of an angle near π/2 has no digits
    across, along = (math.sin(math.atan2(2.0 * c, x) / 2.0) for x in (a - b, b - a))
    larger = math.sqrt(max(D, E))
    to_first, to_second = math.sqrt(D) / larger, math.sqrt(E) / larger
    return (
        _unit(along * to_second, across * to_first),
        _unit(across * to_second, -along * to_first),
    )


def _unit(x: float, y: float) -> tuple[float, float]:
    length = math.hypot(x, y)
    return x / length, y / length
