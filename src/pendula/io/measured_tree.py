"""Recordings and fits as data that JSON can hold, the arrays apart, and back to the same bits."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from typing import TYPE_CHECKING, Any

from pendula.measured.compare import Compared, Comparison
from pendula.measured.fitted import Fit, FittedRecording, Horizon, Quantity
from pendula.measured.measurement import Measurement, PeriodTable
from pendula.measured.periods import AppliedCorrection, PeriodFit
from pendula.measured.words import Note
from pendula.systems import System, system_from

if TYPE_CHECKING:
    from pendula._types import Array

_CLASSES: dict[str, Any] = {
    each.__name__: each
    for each in (
        AppliedCorrection,
        Compared,
        Comparison,
        Fit,
        FittedRecording,
        Horizon,
        Measurement,
        Note,
        PeriodFit,
        PeriodTable,
        Quantity,
    )
}
# Dimensions of arrays, by the class and the field that holds them.
_DIMENSIONS = {
    ("Measurement", "values"): ("t", "column"),
    ("Fit", "covariance"): ("parameter", "other_parameter"),
    ("Fit", "correlation"): ("parameter", "other_parameter"),
    ("FittedRecording", "quarters"): ("quarter", "parameter"),
    ("FittedRecording", "start"): ("component",),
    ("FittedRecording", "autocorrelation"): ("column",),
    ("PeriodTable", "repeats"): ("row", "repeat"),
}
_USUAL = {
    "Measurement": ("t",),
    "Fit": ("parameter",),
    "FittedRecording": ("t", "column"),
    "PeriodTable": ("row",),
    "PeriodFit": ("row",),
}
_OF_PARAMETERS = ("values", "standard_errors", "plain_standard_errors")


class Encoder:
    """Makes data of an object.

    Attributes:
        arrays: (dimensions, values) of each array, by name.
    """

    def __init__(self) -> None:
        self.arrays: dict[str, tuple[tuple[str, ...], Array]] = {}
        self._known: dict[int, str] = {}

    def data(self, value: Any, place: str = "", dimensions: tuple[str, ...] = ()) -> Any:
        """JSON-able data of a value; arrays are names, to be found in `arrays`.

        Args:
            value: of a recording or a fit.
            place: where it stands within, which names arrays.
            dimensions: of an array.
        """
        if isinstance(value, float) and not math.isfinite(value):
            return {"number": str(float(value))}
        if value is None or isinstance(value, bool | int | float | str):
            return value
        if isinstance(value, System):
            return {"system": self.data(value.description(), place)}
        if type(value).__name__ in _CLASSES:
            return self._object(value, place)
        return self._several(value, place, dimensions)

    def _several(self, value: Any, place: str, dimensions: tuple[str, ...]) -> Any:
        """Values by name, in a row, or in an array."""
        if isinstance(value, Mapping):
            items = value.items()
            within = {n: self.data(each, _within(place, n), dimensions) for n, each in items}
            return {"mapping": within}
        if isinstance(value, tuple | list):
            return [self.data(each, _within(place, i)) for i, each in enumerate(value)]
        prefix = place.rpartition(".")[0]
        self.arrays[place] = tuple(_within(prefix, n) for n in dimensions[: value.ndim]), value
        return {"array": place}

    def _object(self, value: Any, place: str) -> Any:
        """One of the classes; the same object twice is told once."""
        if id(value) in self._known:
            return {"same": self._known[id(value)]}
        self._known[id(value)] = place
        kind = type(value).__name__
        names = [each.name for each in fields(value)] if is_dataclass(value) else value._fields
        within = {
            name: self.data(getattr(value, name), _within(place, name), _dimensions(kind, name))
            for name in names
        }
        return {"is": kind, "fields": within}


def _within(place: str, name: object) -> str:
    return f"{place}.{name}" if place else str(name)


def _dimensions(kind: str, field: str) -> tuple[str, ...]:
    if kind == "PeriodFit" and field in _OF_PARAMETERS:
        return ("parameter",)
    return _DIMENSIONS.get((kind, field), _USUAL.get(kind, ()))


class Decoder:
    """Makes the object of its data.

    Args:
        arrays: by name.
    """

    def __init__(self, arrays: Mapping[str, Array]) -> None:
        self._arrays = arrays
        self._known: dict[str, Any] = {}

    def value(self, data: Any, place: str = "") -> Any:
        """The value that the data are of; lists are tuples.

        Raises:
            KeyError, TypeError, ValueError: for data of something else.
        """
        if isinstance(data, list):
            return tuple(self.value(each, _within(place, i)) for i, each in enumerate(data))
        if not isinstance(data, dict):
            return data
        if "is" in data:
            made = self._by_name(data["fields"], place)
            self._known[place] = _CLASSES[data["is"]](**made)
            return self._known[place]
        ((kind, told),) = data.items()
        return _KINDS[kind](self, told, place)

    def _by_name(self, told: Mapping[str, Any], place: str) -> dict[str, Any]:
        return {name: self.value(each, _within(place, name)) for name, each in told.items()}

    def _array(self, told: str, _: str) -> Array:
        return self._arrays[told]

    def _same(self, told: str, _: str) -> Any:
        return self._known[told]

    def _system(self, told: Any, place: str) -> System:
        return system_from(self.value(told, place))

    def _number(self, told: str, _: str) -> float:
        return float(told)


_KINDS: dict[str, Callable[[Decoder, Any, str], Any]] = {
    "number": Decoder._number,
    "array": Decoder._array,
    "same": Decoder._same,
    "system": Decoder._system,
    "mapping": Decoder._by_name,
}
