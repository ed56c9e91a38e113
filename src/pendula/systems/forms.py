"""Systems that are described in one of several forms, each with parameters of its own."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from pendula import _engine
from pendula._checks import number, one_of
from pendula._messages import ArgumentError
from pendula.systems.base import System

if TYPE_CHECKING:
    from typing import Self


@dataclass(frozen=True, init=False, repr=False)
class SystemOfForms(System):
    """A system that a class method makes, by the name of its form."""

    form: str
    values: tuple[float, ...]

    def __init__(self, form: str = "", values: tuple[float, ...] = (), **others: object) -> None:
        entry = _engine.system_entries()[self.name]
        if others or not isinstance(form, str) or not form:
            made = ", ".join(f".{each.name}(…) of {each.meaning}" for each in entry.forms)
            raise ArgumentError("", f"{type(self).__name__} is made by one of {{text}}", text=made)
        object.__setattr__(self, "form", form)
        object.__setattr__(self, "values", values)
        self.__post_init__()

    def __post_init__(self) -> None:
        forms = tuple(each.name for each in _engine.system_entries()[self.name].forms)
        one_of("form", self.form, forms)
        if not isinstance(self.values, tuple) or len(self.values) != len(self._rows()):
            raise ArgumentError(
                "values",
                f"must hold the {len(self._rows())} parameters of {self.form}, got {{value}}",
                f"use {type(self).__name__}.{self.form}(...)",
                value=self.values,
            )
        checked = tuple(
            number(row.name, value, row.unit)
            for row, value in zip(self._rows(), self.values, strict=True)
        )
        object.__setattr__(self, "values", checked)
        self._check()

    @classmethod
    def of_form(cls, form: str, parameters: dict[str, float]) -> Self:
        """The system of that form with these parameters; the others have their standard values."""
        entry = _engine.system_entries()[cls.name]
        one_of("form", form, (each.name for each in entry.forms))
        rows = entry.forms[entry.form_index(form)].parameters
        for name in parameters:
            one_of("parameters", name, [row.name for row in rows])
        values: dict[str, float] = {}
        for row in rows:
            otherwise = values.get(row.same_as, row.standard)
            value = parameters.get(row.name, otherwise)
            if value is None:
                raise ArgumentError(row.name, f"is needed by {cls.__name__}.{form}")
            values[row.name] = value
        return cls(form, tuple(values.values()))

    @property
    def parameters(self) -> dict[str, float]:
        """The parameters of the form by name, in SI units."""
        return dict(zip((row.name for row in self._rows()), self.values, strict=True))

    def _description(self) -> _engine.Description:
        return _engine.describe(self.name, self.form, self.values)

    def __getattr__(self, name: str) -> float:
        if name.startswith("_") or name == "values" or name not in self.parameters:
            raise AttributeError(f"{type(self).__name__} has no attribute {name!r}")
        return self.parameters[name]

    def __repr__(self) -> str:
        arguments = ", ".join(f"{name}={value!r}" for name, value in self._named().items())
        return f"{type(self).__name__}.{self.form}({arguments})"

    def _named(self) -> dict[str, object]:
        """The parameters, without friction and drive that there is none of."""
        return {
            row.name: value
            for row, value in zip(self._rows(), self.values, strict=True)
            if value != row.standard or (row.standard != 0.0 and row.range != "any")
        }
