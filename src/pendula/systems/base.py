"""What all pendulums have in common: a frozen, checked description. The physics is in the core."""

from __future__ import annotations

import math
import sys
from copy import copy
from dataclasses import replace
from typing import TYPE_CHECKING, Any, ClassVar, cast

from pendula import _engine
from pendula._checks import finite_number, number, states_array
from pendula._messages import ArgumentError
from pendula._rules import broken, refuse
from pendula._tables import html_table
from pendula.systems.energies import energies

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from numpy.typing import ArrayLike

    from pendula._types import Array


STANDARD_GRAVITY: float = next(  # of the catalogue [m/s²]
    row.standard
    for entry in _engine.system_entries().values()
    for row in entry.forms[0].parameters
    if row.name == "gravity" and row.standard is not None
)


class System:
    """What all pendulums have in common. Those of one form are data classes of their parameters."""

    name: ClassVar[str]  # in the catalogue
    other_names: ClassVar[tuple[str, ...]] = ()  # of more general descriptions, for some parameters
    form: str
    classes: ClassVar[dict[str, type[System]]] = {}  # by the catalogue's name

    def __init_subclass__(cls) -> None:
        if "name" in vars(cls):
            System.classes |= dict.fromkeys((cls.name, *cls.other_names), cls)

    def __post_init__(self) -> None:
        for row in self._rows():
            value = number(row.name, getattr(self, row.name), row.unit)
            object.__setattr__(self, row.name, value)
        self._check()

    @classmethod
    def of_form(cls, form: str, parameters: dict[str, float]) -> System:
        """The system of that form with these parameters."""
        return cls(**parameters)

    @property
    def can(self) -> _engine.Capabilities:
        """What the system can: whether it conserves energy, has a closed form, a period …."""
        return _engine.system_entries()[self.name].can

    @property
    def parameters(self) -> dict[str, float]:
        """The parameters by name, in SI units."""
        return {row.name: getattr(self, row.name) for row in self._rows()}

    @property
    def components(self) -> tuple[str, ...]:
        """Names of a state's components."""
        return tuple(each.name for each in _engine.system_entries()[self.name].components)

    @property
    def component_units(self) -> Mapping[str, str]:
        """SI units of a state's components, by their names."""
        return _engine.system_entries()[self.name].units

    @property
    def constants(self) -> dict[str, float]:
        """The constants that the equations of motion are written in."""
        return _engine.constants(self._description())

    @property
    def energy_scale(self) -> float:
        """An energy of the motion's size, never zero [J]."""
        return _engine.scales(self._description())[0]

    @property
    def largest_frequency(self) -> float:
        """A bound of the frequencies of small oscillations, hardly above the largest [rad/s]."""
        return _engine.scales(self._description())[1]

    @property
    def fastest_frequency(self) -> float:
        """Of the fastest small oscillation [rad/s]."""
        return self.largest_frequency

    @property
    def slowest_frequency(self) -> float:
        """Of the slowest small oscillation [rad/s]."""
        return self.fastest_frequency

    def most_general(self) -> System:
        """The same system by the most general description of its class."""
        if self.name == (self.name, *self.other_names)[-1]:
            return self
        general = copy(self)
        object.__setattr__(general, "name", self.other_names[-1])
        return general

    def rhs(self, states: ArrayLike, t: float = 0.0) -> Array:
        """Time derivatives (..., d) of states (..., d) at time t [rad/s, rad/s²]."""
        at = finite_number("t", t, "s")
        return _engine.rhs(self._description(), self._directions(states), at)

    def positions(self, states: ArrayLike) -> Array:
        """The bob, or the end of each rod, (..., d/2, 2) [m]: pivot at the origin, y upward."""
        given = states_array(states, self.component_units)
        return _engine.positions(self._description(), _engine.within_range_of_sine(given))

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

    def _repr_html_(self) -> str:
        """What a notebook shows: the parameters, each with its unit and meaning."""
        title, values = repr(self).partition("(")[0], self.parameters
        return html_table(
            title,
            ((row.name, f"{values[row.name]:g} {row.unit}", row.meaning) for row in self._rows()),
        )

    def description(self) -> dict[str, Any]:
        """The system as data that JSON can hold; `system_from` takes it back."""
        return {"name": self.name, "form": self.form, "parameters": self.parameters}

    def _energies(self, states: ArrayLike) -> tuple[Array, Array]:
        return energies(self._description(), self._directions(states))

    def _directions(self, states: ArrayLike) -> Array:
        """The states, as the sine can take them, where angles are directions and nothing more."""
        given = states_array(states, self.component_units)
        return _engine.within_range_of_sine(given) if self.can.periodic else given

    def _rows(self) -> tuple[_engine.Parameter, ...]:
        entry = _engine.system_entries()[self.name]
        return entry.forms[entry.form_index(self.form)].parameters

    def _description(self) -> _engine.Description:
        return _engine.describe(self.name, self.form, tuple(self.parameters.values()))

    def _check(self) -> None:
        """Refuse parameters out of range, or too large or too small together."""
        refuse(_engine.check_system(self._description()))
        constants, whole = self.constants, all(self.parameters.values())
        for name, value in constants.items():
            # what is below the normal doubles has lost digits, or all of them
            if abs(value) < sys.float_info.min and (value or whole):
                raise broken("parameters", "constants", constant=name, value=value)


class ClosedForm(System):
    """A system whose motion `exact` has in closed form."""

    largest_start: ClassVar[float]  # angle of a start [rad]
    most_half_periods: ClassVar[float]  # that times are counted in

    @property
    def natural_frequency(self) -> float:
        """Of small oscillations [rad/s]."""
        raise NotImplementedError

    def actions(self, states: Array) -> Array:
        """∮ p dθ / 2π of the motions through states (..., 2), (...) [J s]."""
        import numpy as np

        rows = np.ascontiguousarray(states.reshape(-1, 2))
        return _engine.actions(self._description(), rows).reshape(states.shape[:-1])

    def check_start(self, states: Array) -> None:
        """Refuse states (..., 2) for which the closed form has no accurate digit.

        Raises:
            ValueError: for an angle of 2^50 rad or more (linear: 2^900), or a speed of 2^900
                natural frequencies.
        """
        angles, speeds = abs(states[..., 0]), abs(states[..., 1])
        if (angles >= self.largest_start).any():
            raise ArgumentError(
                "state",
                "must have an angle below 2^{text} rad, got {value}",
                "take whole turns off",
                text=round(math.log2(self.largest_start)),
                value=float(angles.max()),
            )
        most = _engine.LARGEST_START_SPEED * self.natural_frequency
        if (speeds >= most).any():
            rule = f"must have an angular velocity below {most:.3g} rad/s, got {{value}}"
            raise ArgumentError("state", rule, value=float(speeds.max()))


def systems_that(
    can: Callable[[_engine.Capabilities], bool] = lambda _: True,
) -> list[_engine.SystemEntry]:
    """The systems that there is a class for, with a capability; or all.

    Each stands there once, by its first name, with the parameters of its most general description.
    """
    entries = _engine.system_entries()
    classes = [System.classes[name] for name in entries if name in System.classes]
    return [
        replace(entries[one.name], forms=entries[(one.name, *one.other_names)[-1]].forms)
        for one in dict.fromkeys(classes)
        if can(entries[one.name].can)
    ]


def class_names_that(can: Callable[[_engine.Capabilities], bool]) -> list[str]:
    """The names of their classes."""
    return [System.classes[entry.name].__name__ for entry in systems_that(can)]


def with_closed_form(system: object, *, periodic: bool = False) -> ClosedForm:
    """The system, which has a closed form; `periodic`: of motions that repeat themselves.

    Raises:
        ValueError: where it has none, or is no system.
    """
    one = check_system(system)
    if periodic and one.can.closed_form and not one.can.period:
        rule = "must be without friction and drive, got {value}: no motion then repeats itself"
        raise ArgumentError("system", rule, value=system)
    if not one.can.closed_form:
        raise ArgumentError(
            "system",
            "must be a {any_of}, got {value}: no closed form is known",
            "use <call=solve>, with <digits=12> for guaranteed digits",
            any_of=class_names_that(lambda can: can.closed_form),
            value=system,
        )
    return cast("ClosedForm", one)


def check_system(system: object) -> System:
    """The system, which has to be a pendulum.

    Raises:
        ValueError: for anything else than a System.
    """
    if not isinstance(system, System):
        rule = "must be a pendulum such as SimplePendulum(length=1.0), got {value}"
        made = isinstance(system, type) and issubclass(system, System)
        way_out = "make one of the class, with its parameters in brackets" if made else ""
        raise ArgumentError("system", rule, way_out, value=system)
    return system
