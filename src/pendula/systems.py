"""The pendulums: frozen, validated descriptions. The physics itself is in the core."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar

from pendula import _engine, elliptic
from pendula._checks import finite_array, one_of, positive_number, states_array

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    Array = NDArray[np.float64]

STANDARD_GRAVITY = 9.80665  # m/s², 3rd CGPM (1901)


class System:
    """What all pendulums have in common."""

    name: ClassVar[str]
    form: str

    @property
    def parameters(self) -> dict[str, float]:
        """The parameters by name, in SI units."""
        return {row.name: getattr(self, row.name) for row in self._rows()}

    @property
    def components(self) -> tuple[str, ...]:
        """Names of a state's components."""
        return tuple(each.name for each in _engine.system_entries()[self.name].components)

    @property
    def constants(self) -> dict[str, float]:
        """The constants that the equations of motion are written in."""
        return _engine.constants(self._description())

    def rhs(self, states: ArrayLike) -> Array:
        """Time derivatives (..., d) of states (..., d) [rad/s, rad/s²]."""
        return _engine.rows("rhs", self._description(), states_array(states, self.components))

    def positions(self, states: ArrayLike) -> Array:
        """The bob, or the end of each rod, (..., d/2, 2) [m]: pivot at the origin, y upward."""
        return _engine.rows("positions", self._description(), states_array(states, self.components))

    def kinetic_energy(self, states: ArrayLike) -> Array:
        """Kinetic energy (...) of states (..., d) [J]."""
        return self._energies(states)[0]

    def potential_energy(self, states: ArrayLike) -> Array:
        """Potential energy (...) of states (..., d), zero at the lowest point [J]."""
        return self._energies(states)[1]

    def energy(self, states: ArrayLike) -> Array:
        """Total energy (...) of states (..., d), zero at rest at the lowest point [J]."""
        kinetic, potential = self._energies(states)
        return kinetic + potential

    def description(self) -> dict[str, Any]:
        """The system as data that JSON can hold; `system_from` takes it back."""
        return {"name": self.name, "form": self.form, "parameters": self.parameters}

    def _energies(self, states: ArrayLike) -> tuple[Array, Array]:
        return _engine.energies(self._description(), states_array(states, self.components))

    def _rows(self) -> tuple[_engine.Parameter, ...]:
        entry = _engine.system_entries()[self.name]
        return entry.forms[entry.form_index(self.form)].parameters

    def _description(self) -> _engine.Description:
        return _engine.describe(self.name, self.form, tuple(self.parameters.values()))

    def _check_constants(self) -> None:
        """Parameters in range can still be too large or too small together."""
        for name, value in self.constants.items():
            if not math.isfinite(value) or (value <= 0 and name not in {"C", "E"}):
                raise ValueError(
                    f"the parameters {self.parameters} cannot be computed with: "
                    f"their constant {name} is {value!r}; take values nearer to 1"
                )


@dataclass(frozen=True)
class _OneBob(System):
    form: ClassVar[str] = ""  # type: ignore[misc]  # the one form there is

    length: float = 1.0
    gravity: float = STANDARD_GRAVITY
    mass: float = 1.0

    def __post_init__(self) -> None:
        for row in self._rows():
            value = positive_number(row.name, getattr(self, row.name), row.unit)
            object.__setattr__(self, row.name, value)
        self._check_constants()

    @property
    def natural_frequency(self) -> float:
        """ωn = √(g/L) [rad/s]."""
        return math.sqrt(self.gravity / self.length)


@dataclass(frozen=True)
class LinearPendulum(_OneBob):
    """The linear pendulum, θ̈ = −(g/L) θ: the small-angle model, harmonic for every amplitude.

    Args:
        length: from pivot to bob [m].
        gravity: [m/s²].
        mass: of the bob [kg].

    Raises:
        ValueError: for a value that is not positive and finite.
    """

    name: ClassVar[str] = "linear"

    def period(self, amplitude: ArrayLike | None = None, *, state: ArrayLike | None = None) -> Any:
        """2π/ωn [s], the same for every amplitude or state; shaped as they are."""
        import numpy as np

        one = 2.0 * math.pi / self.natural_frequency
        shape: tuple[int, ...] = ()
        if amplitude is not None:
            shape = finite_array("amplitude", amplitude, "rad").shape
        elif state is not None:
            shape = states_array(state, self.components).shape[:-1]
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

        k, kc = self._modulus(amplitude, state)
        rotation = k > 1.0
        reciprocal = 1.0 / np.where(rotation, k, 1.0)
        integral = elliptic.K(kc=kc * reciprocal)
        result = np.where(rotation, 2.0, 4.0) * reciprocal * integral / self.natural_frequency
        return result if result.ndim else float(result)

    def _modulus(self, amplitude: ArrayLike | None, state: ArrayLike | None) -> tuple[Array, Array]:
        """The modulus k and |k'|, each from its own formula: neither may cancel near k = 1."""
        import numpy as np

        if (amplitude is None) == (state is None):
            raise ValueError("period takes an amplitude or state=(theta0, omega0), one of the two")
        if amplitude is not None:
            angles = finite_array("amplitude", amplitude, "rad")
            if (np.abs(angles) > math.pi).any():
                largest = float(np.abs(angles).max())
                raise ValueError(
                    f"amplitude must lie within [-pi, pi] [rad], got {largest!r}; "
                    "for a motion over the top give state=(theta0, omega0)"
                )
            k, kc = _engine.modulus_of_amplitude(angles.ravel())
            return k.reshape(angles.shape), kc.reshape(angles.shape)
        states = states_array(state, self.components)  # type: ignore[arg-type]
        speed = states[..., 1] / (2.0 * self.natural_frequency)
        sine, cosine = np.sin(0.5 * states[..., 0]), np.cos(0.5 * states[..., 0])
        return np.hypot(sine, speed), np.sqrt(np.abs((cosine - speed) * (cosine + speed)))


@dataclass(frozen=True)
class NormalModes:
    """Small oscillations about the lowest point, the slow mode first.

    Attributes:
        frequencies: angular frequencies, (2,) [rad/s].
        shapes: row i holds (θ1, θ2) of mode i, of length one, θ1 not negative, (2, 2).
    """

    frequencies: tuple[float, float]
    shapes: tuple[tuple[float, float], tuple[float, float]]


@dataclass(frozen=True)
class DoublePendulum(System):
    """The planar double pendulum; make one with `rods`, `bobs` or `bodies`.

    T = ½A ω1² + ½B ω2² + C ω1 ω2 cos(θ1−θ2), V = D (1 − cos θ1) + E (1 − cos θ2), with the
    constants A … E that each form gives (`constants`). Rods: Herrera et al. (2024), eqs. 35–50, corrected.
    """

    form: str
    values: tuple[float, ...]
    name: ClassVar[str] = "double"

    def __post_init__(self) -> None:
        forms = tuple(each.name for each in _engine.system_entries()[self.name].forms)
        one_of("form", self.form, forms)
        if len(self.values) != len(self._rows()):
            raise ValueError(
                f"values must hold the {len(self._rows())} parameters of {self.form}, "
                f"got {len(self.values)}; use DoublePendulum.{self.form}(...)"
            )
        checked = tuple(
            positive_number(row.name, value, row.unit, zero=row.zero_allowed)
            for row, value in zip(self._rows(), self.values, strict=True)
        )
        object.__setattr__(self, "values", checked)
        self._check_constants()

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
    def parameters(self) -> dict[str, float]:
        """The parameters of the form by name, in SI units."""
        return dict(zip((row.name for row in self._rows()), self.values, strict=True))

    def __repr__(self) -> str:
        arguments = ", ".join(f"{name}={value!r}" for name, value in self.parameters.items())
        return f"DoublePendulum.{self.form}({arguments})"

    def normal_modes(self) -> NormalModes:
        """Frequencies and shapes of small oscillations.

        λ = ω² solves (AB − C²) λ² − (AE + BD) λ + DE = 0; the discriminant as a sum of squares and
        the smaller root from the product of both lose no digits.
        """
        A, B, C, D, E, determinant, _ = self.constants.values()
        root = math.sqrt((A * E - B * D) ** 2 + 4.0 * C * C * D * E)
        fast = (A * E + B * D + root) / (2.0 * determinant)
        slow = 2.0 * D * E / (A * E + B * D + root)
        return NormalModes(
            (math.sqrt(slow), math.sqrt(fast)),
            (_mode_shape(A, B, C, D, E, slow), _mode_shape(A, B, C, D, E, fast)),
        )


def _mode_shape(
    A: float, B: float, C: float, D: float, E: float, square: float
) -> tuple[float, float]:
    """Null vector of the stiffness less ω² times the mass matrix, by its larger row."""
    first, second = (square * C, D - square * A), (E - square * B, square * C)
    x, y = max(first, second, key=lambda row: math.hypot(*row))
    length = math.copysign(math.hypot(x, y), x if x != 0.0 else y)
    return x / length, y / length


def system_from(description: dict[str, Any]) -> System:
    """The system that `System.description` described.

    Raises:
        ValueError: for an unknown name or form, or parameters out of range.
    """
    name = one_of("system", description.get("name"), _engine.system_entries())
    parameters = description["parameters"]
    if name == DoublePendulum.name:
        form = one_of("form", description.get("form"), ("rods", "bobs", "bodies"))
        return getattr(DoublePendulum, form)(**parameters)  # type: ignore[no-any-return]
    return {each.name: each for each in (LinearPendulum, SimplePendulum)}[name](**parameters)
