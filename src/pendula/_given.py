"""Numbers as they are given: with a unit of their own, or a mask, which numpy would drop."""

from __future__ import annotations

from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from numbers import Rational, Real
from typing import TYPE_CHECKING, Any

from pendula._messages import ArgumentError
from pendula._unit_names import RuleError, UnknownUnitError
from pendula.units import conversion, near, scaled

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from pendula._types import Array

    Units = str | Mapping[str, str]

_PLAIN = (float, int)
_NO_UNIT = ("", "1", "dimensionless")  # as xarray and pint say it


def plain(name: str, value: Any, units: Units) -> Any:
    """The numbers of a value, for numpy to make an array of.

    Where the value carries a unit, as those of pint, xarray, astropy and others do, they are
    converted, rounded once; so are the entries of lists and tuples.

    Args:
        name: of the argument.
        value: what was given for it.
        units: SI unit of the numbers; or that of each component by name, along the last axis.

    Raises:
        ArgumentError: for a unit of another kind, or an element that is masked.
        TypeError: for truth values, or several arrays in one.
    """
    if _is_plain(value) or (isinstance(value, list | tuple) and all(map(_is_plain, value))):
        return value
    if isinstance(value, list | tuple):
        return _entries(name, value, units)
    if isinstance(value, bool) or getattr(getattr(value, "dtype", None), "kind", "") == "b":
        raise TypeError("truth values are no numbers")
    _refuse_masked(name, value)
    if _holds_units(value):
        return plain(name, value.tolist(), units)
    numbers, unit = _parts(value)
    if numbers is value:
        return value
    if unit is None:
        return plain(name, numbers, units)
    return _converted(name, numbers, unit, units, of_pint=_is_of_pint(value))


def doubles(array: NDArray[Any]) -> Array:
    """An array's numbers as doubles, each rounded once: those of Fraction and Decimal too.

    Raises:
        TypeError: for anything else than numbers.
    """
    if array.dtype.kind == "O":
        import numpy as np

        found = [_double(each) for each in array.ravel()]
        return np.array(found, dtype=np.float64).reshape(array.shape)
    if array.dtype.kind not in "iuf" and array.size:
        raise TypeError("no numbers")
    return array.astype(float, copy=False)


def _double(value: Any) -> float:
    """A number that is an object, rounded once."""
    kind = getattr(getattr(value, "dtype", None), "kind", "f")
    if kind == "O" and value.ndim == 0:
        return _double(value.item())
    is_number = isinstance(value, Real | Decimal) and not isinstance(value, bool)
    if not is_number or kind not in "iuf":
        raise TypeError("no number")
    return float(value)


def carries_unit(value: Any) -> bool:
    """Whether the value, or an entry of it, carries a unit."""
    if _is_plain(value):
        return False
    if isinstance(value, list | tuple):
        return any(map(carries_unit, value))
    if _holds_units(value):
        return True
    numbers, unit = _parts(value)
    return unit is not None or (numbers is not value and carries_unit(numbers))


def _entries(name: str, value: list[Any] | tuple[Any, ...], units: Units) -> list[Any]:
    if isinstance(units, Mapping) and len(value) == len(units) and all(map(_is_scalar, value)):
        rows = zip(value, units.items(), strict=True)
        return [plain(name, each, {component: unit}) for each, (component, unit) in rows]
    return [plain(name, each, units) for each in value]


def _is_plain(value: Any) -> bool:
    """Whether it is a number without anything: most are."""
    return type(value) in _PLAIN


def _holds_units(value: Any) -> bool:
    """Whether it is an array of objects that carry units."""
    if getattr(getattr(value, "dtype", None), "kind", "") != "O" or not hasattr(value, "tolist"):
        return False
    return not hasattr(value, "magnitude") and carries_unit(value.tolist())


def _is_scalar(value: Any) -> bool:
    return not isinstance(value, list | tuple) and getattr(value, "ndim", 0) == 0


def _parts(value: Any) -> tuple[Any, str | None]:
    """Numbers and unit of what is made of both; the value itself and None for what is not."""
    attributes = getattr(value, "attrs", None)
    if isinstance(attributes, Mapping):  # xarray, pandas, h5py
        of_xarray = type(value).__module__.startswith("xarray")
        inner = getattr(value, "data", None) if of_xarray else _array(value)
        if inner is None:  # a Dataset: several arrays
            raise TypeError("no array")
        if _parts(inner)[1] is not None:  # pint-xarray
            return inner, None
        return inner, _text(attributes.get("units"))
    unit = getattr(value, "units", None)
    unit = getattr(value, "unit", None) if unit is None else unit
    if unit is None or callable(unit):
        return value, None
    if _is_of_pint(value):
        return value.magnitude, _text(format(unit, "D"))
    numbers = _array(value)  # astropy, unyt, netCDF4
    if numbers.ndim == 0 and numbers.dtype.kind == "O":  # a moment of pandas has a unit, too
        raise TypeError("no number")
    return numbers, _text(unit)


def _is_of_pint(value: Any) -> bool:
    return hasattr(value, "magnitude")


def _array(value: Any) -> Any:
    import numpy as np

    return np.array(value[...] if hasattr(value, "dimensions") else value, subok=False)


def _text(unit: Any) -> str | None:
    """The unit's name; None: it says nothing."""
    if isinstance(unit, bytes):
        unit = unit.decode(errors="replace")
    return None if unit is None or not str(unit).strip() else " ".join(str(unit).split())


def _converted(name: str, numbers: Any, written: str, units: Units, *, of_pint: bool) -> Any:
    """The numbers in their SI unit."""
    import numpy as np

    array = np.asarray(plain(name, numbers, ""))
    exact = array.dtype.kind == "O" and all(isinstance(x, Rational | Decimal) for x in array.flat)
    each = units if isinstance(units, Mapping) else {"": units}
    factors = {
        _factor(name, written, unit, component, of_pint=of_pint) for component, unit in each.items()
    }
    (factor,) = factors  # two kinds of unit cannot both be that of one
    if exact:
        products = [float(Fraction(each) * factor) for each in array.flat]
        return np.array(products).reshape(array.shape)
    if factor == 1 and array.dtype.kind in "iu":
        return array  # a whole number stays one
    return scaled(doubles(array), factor)


def _factor(name: str, written: str, unit: str, component: str, *, of_pint: bool) -> Fraction:
    text = "" if written in _NO_UNIT else written
    try:
        return conversion(text, unit, name, of_pint=of_pint)
    except UnknownUnitError as unknown:
        rule, way_out = "has the unknown unit {value}", near(unknown.unit, unit)
        way_out = way_out or (f"give numbers in {unit}" if unit else "give plain numbers")
        raise ArgumentError(name, rule, way_out, value=written) from None
    except RuleError as broken:
        rule, way_out = f"must {broken}, got the unit {{value}}", ""
        if component:
            rule = rule.replace("be ", f"have {component} ", 1)
            way_out = "give each component its unit, in a tuple, or plain numbers in rad and rad/s"
        raise ArgumentError(name, rule, way_out, value=written) from None


def _refuse_masked(name: str, value: Any) -> None:
    """Refuse masked elements, which have no value."""
    mask = getattr(value, "mask", None)
    if mask is None or callable(mask):
        return
    import numpy as np

    masked = np.asarray(mask)
    if masked.any():
        place = [int(i) for i in np.unravel_index(int(masked.argmax()), masked.shape)]
        where = f" at {name}{place}" if place else ""
        rule = "must have no masked elements, got one" + where
        raise ArgumentError(name, rule, "fill or drop them")
