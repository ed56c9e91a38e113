"""The arguments of a fit, checked."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pendula._checks import finite_number, number_pair, one_of, positive_number
from pendula._messages import ArgumentError
from pendula.measured.measurement import Measurement
from pendula.measured.model import FRICTIONS
from pendula.measured.problem import Sampled

if TYPE_CHECKING:
    from pendula.measured.model import Row

UNCERTAINTIES = ("corrected", "profile", "bootstrap")
SIGNS = ("physical", "free")
_PARTS = ("undamped", "linear", *FRICTIONS)
_LINEAR = ("linear", "undamped", "viscous")
_FEWEST = 8  # samples


@dataclass(frozen=True)
class Known:
    """A quantity that was measured otherwise.

    Attributes:
        value: in SI units.
        sigma: its standard uncertainty.
    """

    value: float
    sigma: float = 0.0


def model_parts(model: object, argument: str = "system") -> tuple[bool, tuple[str, ...]]:
    """Whether a model is the linear one, and its kinds of friction in their usual order.

    Args:
        model: names joined by +, such as "viscous + coulomb", or a sequence of them; "undamped":
            no friction; "linear" among them: −ω0² θ in place of −ω0² sin θ.
        argument: its name.

    Raises:
        ValueError: for another name, or for linear with friction that is not viscous.
    """
    if isinstance(model, str):
        names = [each.strip() for each in model.replace("-", "").lower().split("+")]
    elif isinstance(model, Iterable):
        names = list(model)
    else:
        names = [model]  # type: ignore[list-item]  # which is refused below
    for name in names:
        one_of(argument, name, _PARTS)
    if "linear" in names and not set(names) <= set(_LINEAR):
        raise ArgumentError(
            argument,
            'must be "linear" or "linear + viscous" where it is linear, got {value}',
            "leave linear out",
            value=model,
        )
    return "linear" in names, tuple(each for each in FRICTIONS if each in names)


def model_name(linear: bool, frictions: Iterable[str]) -> str:
    """The name of a model."""
    parts = (*(["linear"] if linear else []), *frictions)
    return " + ".join(parts) or "undamped"


def measurements_of(given: object) -> tuple[Measurement, ...]:
    """One recording or several, all of one kind.

    Raises:
        ValueError: for anything else.
    """
    several = (given,) if isinstance(given, Measurement) else given
    if not isinstance(several, Iterable) or isinstance(several, str):
        several = (several,)
    found = tuple(several)
    if not found or not all(isinstance(each, Measurement) for each in found):
        rule = "must be a Measurement or several, got {value}"
        raise ArgumentError(
            "measurement", rule, "read one with <call=pendula.measured.read>(path)", value=given
        )
    kinds = sorted({f"{each.quantity} of {each.bodies}" for each in found})
    if len(kinds) > 1:
        rule = "must be of one kind, got {text}"
        raise ArgumentError("measurement", rule, "fit each kind alone", text=" and ".join(kinds))
    return found


def sampled(measurement: Measurement, t: object) -> Sampled:
    """The samples within a window of time that have a value at all.

    Args:
        measurement: a recording.
        t: (from, to) [s]; None: all of it.

    Raises:
        ValueError: for too few samples, or an acceleration or position that is not fitted as such.
    """
    import numpy as np

    low, high = -np.inf, np.inf
    if t is not None:
        low, high = _window(t)
    times, values = measurement.t, measurement.values
    there = (times >= low) & (times <= high) & np.isfinite(values).any(axis=1) & np.isfinite(times)
    found = Sampled(measurement, np.ascontiguousarray(times[there]), np.array(values[there]))
    if len(found.t) < _FEWEST:
        raise ArgumentError(
            "measurement" if t is None else "t",
            "must hold at least {least} samples to be fitted, got {value}",
            least=_FEWEST,
            value=len(found.t),
        )
    if (np.nanmax(found.values, axis=0) == np.nanmin(found.values, axis=0)).any():
        rule = "must hold a motion: one of its columns is {value} all the time"
        raise ArgumentError("measurement", rule, value=float(np.nanmin(found.values[:, 0])))
    if (np.diff(found.t) <= 0.0).any():
        first = int((np.diff(found.t) <= 0.0).argmax())
        rule = "must have rising times, got {value} s after {other} s"
        way_out = "leave out or correct that sample"
        raise ArgumentError(
            "measurement", rule, way_out, value=float(found.t[first + 1]), other=found.t[first]
        )
    return found


def _window(window: object) -> tuple[float, float]:
    rule = "must be two rising times (from, to){in_unit}"
    low, high = number_pair("t", window, rule, "s")
    if not low < high:
        raise ArgumentError("t", f"{rule}, got {{value}}", value=window, unit="s")
    return low, high


def known(name: str, given: object, unit: str) -> Known | None:
    """A known value, with its uncertainty where it has one.

    Args:
        name: of the argument.
        given: a number, or (value, sigma); None: not known.
        unit: SI.

    Raises:
        ValueError: for a value that is not positive, or a negative uncertainty.
    """
    if given is None or isinstance(given, Known):
        return given
    if isinstance(given, tuple | list):
        if len(given) != 2:
            rule = "must be a value or (value, sigma){in_unit}, got {value}"
            raise ArgumentError(name, rule, value=given, unit=unit)
        return Known(
            positive_number(name, given[0], unit), positive_number(name, given[1], unit, zero=True)
        )
    return Known(positive_number(name, given, unit))


def named_values(argument: str, given: object, rows: Iterable[Row]) -> dict[str, float]:
    """Values of parameters by name.

    Args:
        argument: its name.
        given: a mapping; None: none.
        rows: the parameters there are.

    Raises:
        ValueError: for a name that there is none of, or a value that is not finite.
    """
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        rule = "must be values by the names of parameters, got {value}"
        raise ArgumentError(
            argument, rule, 'such as <{other}={{"coulomb": 0}}>', other=argument, value=given
        )
    units = {row.name: row.unit for row in rows}
    found = {}
    for name, value in given.items():
        one_of(argument, name, units)
        found[str(name)] = finite_number(argument, value)
    return found


def names_of(argument: str, given: Any, rows: Iterable[Row]) -> tuple[str, ...]:
    """Names of parameters.

    Raises:
        ValueError: for a name that there is none of.
    """
    choices = [row.name for row in rows]
    several = (given,) if isinstance(given, str) else tuple(given)
    return tuple(one_of(argument, name, choices) for name in several)
