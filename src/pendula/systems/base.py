"""What all pendulums have in common: a frozen, checked description. The physics is in the core."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, ClassVar

from pendula import _engine
from pendula._checks import states_array

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from pendula._types import Array


STANDARD_GRAVITY = 9.80665  # m/s², 3rd CGPM (1901)


class System:
    """What all pendulums have in common."""

    name: ClassVar[str]
    form: str
    classes: ClassVar[dict[str, type[System]]] = {}  # by the catalogue's name

    def __init_subclass__(cls) -> None:
        if "name" in vars(cls):
            System.classes[cls.name] = cls

    @classmethod
    def of_form(cls, form: str, parameters: dict[str, float]) -> System:
        """The system of that form with these parameters."""
        return cls(**parameters)

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
        return _engine.rows("rhs", self._description(), self._directions(states))

    def positions(self, states: ArrayLike) -> Array:
        """The bob, or the end of each rod, (..., d/2, 2) [m]: pivot at the origin, y upward."""
        given = states_array(states, self.components)
        return _engine.rows("positions", self._description(), _engine.within_range_of_sine(given))

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
        return _engine.energies(self._description(), self._directions(states))

    def _directions(self, states: ArrayLike) -> Array:
        """The states, as the sine can take them, where angles are directions and nothing more."""
        return _engine.within_range_of_sine(states_array(states, self.components))

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


def check_system(system: object) -> None:
    """Refuse what is no pendulum.

    Raises:
        ValueError: for anything else than a System.
    """
    if not isinstance(system, System):
        raise ValueError(
            f"system must be a pendulum such as SimplePendulum(length=1.0), got {system!r}"
        )
