"""What the catalogue says of systems, methods, options and rules, as data."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Mapping

    from pendula._types import MethodName


@dataclass(frozen=True)
class Parameter:
    """A parameter of a system: name, SI unit, range and meaning.

    Where it is left out it has its standard value, or that of the parameter `same_as`; with
    neither it is required.
    """

    name: str
    unit: str
    standard: float | None
    range: str  # positive, not_negative or any
    meaning: str
    same_as: str

    @property
    def needed(self) -> bool:
        """Whether a value has to be named."""
        return self.standard is None and not self.same_as


@dataclass(frozen=True)
class Component:
    """A component of a state: name, SI unit, the start taken where none is named, and meaning."""

    name: str
    unit: str
    standard: float
    meaning: str


@dataclass(frozen=True)
class Form:
    """One way to describe a system."""

    name: str
    meaning: str
    parameters: tuple[Parameter, ...]


@dataclass(frozen=True)
class Capabilities:
    """What a system is capable of.

    Attributes:
        conservative: its energy is constant.
        autonomous: its equations do not depend on time.
        closed_form: `exact` has its solution.
        period: its motions have one, as a function of amplitude or state.
        mapped: flip and divergence maps are made of it.
        periodic: angles a whole turn apart are the same position; the equations take their sines.
        degrees_of_freedom: how many angles it has.
    """

    conservative: bool
    autonomous: bool
    closed_form: bool
    period: bool
    mapped: bool
    periodic: bool
    degrees_of_freedom: int


@dataclass(frozen=True)
class SystemEntry:
    """A system of the catalogue."""

    name: str
    components: tuple[Component, ...]
    forms: tuple[Form, ...]
    can: Capabilities

    def form_index(self, form: str) -> int:
        """Place of the form of that name."""
        return self._places[form]

    @cached_property
    def units(self) -> Mapping[str, str]:
        """SI units of a state's components, by their names."""
        return MappingProxyType({each.name: each.unit for each in self.components})

    @cached_property
    def _places(self) -> dict[str, int]:
        return {each.name: i for i, each in enumerate(self.forms)}


@dataclass(frozen=True)
class Method:
    """A method of the catalogue.

    Attributes:
        name: what `solve` takes.
        order: of convergence.
        evaluations_per_step: of the right-hand side; None: it iterates.
        adaptive: whether it takes a tolerance instead of a step.
        symplectic: whether a step preserves the symplectic form.
        needs: the facet of a system that it needs.
        systems: names of the systems it works for.
        source: where it was published.
        stability_polynomial: what a step makes of y' = λ y, coefficients of the powers of λ h from
            the lowest on; empty where it is none.
    """

    name: MethodName
    order: int
    evaluations_per_step: int | None
    adaptive: bool
    symplectic: bool
    needs: str
    systems: tuple[str, ...]
    source: str
    stability_polynomial: tuple[float, ...]


@dataclass(frozen=True)
class OptionRow:
    """An option of a run.

    Attributes:
        name: of the argument.
        unit: SI; empty: a pure number.
        whole: whether it is a whole number.
        least: of its range; 0: above 0.
        most: of its range.
        example: a value.
        taken_by: which methods take it.
        meaning: one phrase.
        otherwise: what is done where it is not given.
    """

    name: str
    unit: str
    whole: bool
    least: float
    most: float
    example: float
    taken_by: str
    meaning: str
    otherwise: str


@dataclass(frozen=True)
class RuleRow:
    """The sentences of a rule, after the argument's name, and the ways out: templates."""

    english: str
    way_out_in_english: str
    spanish: str
    way_out_in_spanish: str
