"""Quantities as people write them, read as SI numbers: "50 cm" is 0.5, "30deg" is π/6.

Values are rounded once. A number without a unit is in SI units. The everyday units are known here;
any other is looked up with pint, which takes half a second to load. Nothing is evaluated: a
quantity is one number and one unit.
"""

from __future__ import annotations

import difflib
import re
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING

from pendula._messages import ArgumentError

if TYPE_CHECKING:
    import pint

    Unit = tuple[Fraction, dict[str, int]]  # factor to SI, and the powers of m, kg, s, rad

PI = Fraction("3.14159265358979323846264338327950288419716939937510")

# Name → (factor, SI unit). A test holds each of them against pint.
EVERYDAY: dict[str, tuple[Fraction, str]] = {
    "m": (Fraction(1), "m"),
    "cm": (Fraction(1, 100), "m"),
    "mm": (Fraction(1, 1000), "m"),
    "km": (Fraction(1000), "m"),
    "s": (Fraction(1), "s"),
    "ms": (Fraction(1, 1000), "s"),
    "us": (Fraction(1, 10**6), "s"),
    "min": (Fraction(60), "s"),
    "h": (Fraction(3600), "s"),
    "kg": (Fraction(1), "kg"),
    "g": (Fraction(1, 1000), "kg"),
    "rad": (Fraction(1), "rad"),
    "deg": (PI / 180, "rad"),
    "°": (PI / 180, "rad"),
    "º": (PI / 180, "rad"),  # the ordinal sign, which Spanish keyboards have in its place
    "degree": (PI / 180, "rad"),
    "degrees": (PI / 180, "rad"),
    "turn": (2 * PI, "rad"),
    "turns": (2 * PI, "rad"),
}
_OTHERS = ("meter", "second", "minute", "hour", "gram", "kilogram", "radian", "inch", "ft", "rpm")
_EXAMPLES = {
    "m": ("50", "cm"),
    "s": ("10", "ms"),
    "rad": ("30", "deg"),
    "rad/s": ("90", "deg/s"),
    "kg": ("500", "g"),
    "m/s^2": ("9.81", "m/s^2"),
    "kg m^2": ("0.1", "kg m^2"),
    "": ("0.5", ""),
}
_EXAMPLE = "write {text}, say"
_PINT_BASES = {"meter": "m", "gram": "kg", "second": "s", "radian": "rad"}

_LONGEST = 100  # characters
_PLAIN_SIGNS = str.maketrans("−⁻¹²³⁴⁵⁶⁷⁸⁹", "--123456789")
_NUMBER = re.compile(
    r"(?P<number>[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)"
    r"(?P<pi>\s*\*?\s*(?:pi|π)(?!\w))?\s*(?P<unit>.*)",
    re.DOTALL,
)
_NOT_FINITE = re.compile(r"[-+]?(nan|inf|infinity)\b", re.IGNORECASE)
_DECIMAL_COMMA = re.compile(r"[^,.]*[0-9],[0-9][^,.]*")
_FACTOR = re.compile(
    r"(?P<sign>\s*[*·⋅/]\s*|\s+|^)(?P<name>[^\W\d]+|°)(?:\s*(?:\^|\*\*)\s*)?(?P<power>[-+]?[1-9])?"
)


def quantity(text: str, unit: str, name: str) -> float:
    """One quantity in SI units, correctly rounded.

    Args:
        text: a number and a unit, such as "50 cm", "9.81 m/s²" or "-10°"; a bare number is in SI.
        unit: the SI unit, such as "m", "rad/s", "m/s^2" or "kg m^2"; "" for a plain number.
        name: what the message calls the value.

    Raises:
        ValueError: one line naming the value, the rule, what was given and the way out.
    """
    if "," in text:
        if _DECIMAL_COMMA.fullmatch(text):
            point = text.strip().replace(",", ".")
            way_out = "a comma separates entries of a list"
            raise ArgumentError(name, ": write {text}", way_out, text=point)
        rule = "takes one value, got {value}"
        raise ArgumentError(name, rule, _EXAMPLE, value=_shortened(text), text=example_of(unit))
    return _value(text, unit, name)


def quantities(text: str, unit: str, name: str) -> list[float]:
    """A list of quantities in SI units: "30deg,60deg". Each of several carries its own unit.

    Arguments and errors as for `quantity`.
    """
    entries = [entry.strip() for entry in text.split(",")]
    if len(entries) > 1:
        _check_list(entries, text, unit, name)
    return [_value(entry, unit, name) for entry in entries]


def _check_list(entries: list[str], text: str, unit: str, name: str) -> None:
    """Entries without a unit could be halves of a decimal comma: they are refused."""
    if not all(entries):
        rule = "has an empty entry between commas, got {value}"
        raise ArgumentError(name, rule, value=_shortened(text))
    found = [_NUMBER.fullmatch(entry.translate(_PLAIN_SIGNS)) for entry in entries]
    bare = [entry for entry, each in zip(entries, found, strict=True) if each and not each["unit"]]
    if not bare or not unit:
        return
    given = next((each["unit"] for each in found if each and each["unit"]), unit)
    each_its_own = ",".join(
        entry + (" rad" if "pi" in entry else given) if entry in bare else entry
        for entry in entries
    )
    halves = len(entries) == 2 and entries[0] in bare and entries[1][:1].isdigit()
    one = ".".join(entries) if halves else ""
    decimal = f", or {one} for one value with a decimal point" if one.count(".") == 1 else ""
    raise ArgumentError(
        name,
        ": {entry} in the list {value} has no unit, each entry carries its own",
        "write {text}",
        entry=bare[0],
        value=_shortened(text),
        text=each_its_own + decimal,
    )


def _value(text: str, unit: str, name: str) -> float:
    details = {"value": _shortened(text), "text": example_of(unit)}
    try:
        return _read(text.strip().translate(_PLAIN_SIGNS), unit)
    except _UnknownUnitError as unknown:
        rule, way_out = "has the unknown unit {unknown} in {value}", _near(unknown.unit) or _EXAMPLE
        raise ArgumentError(name, rule, way_out, unknown=unknown.unit, **details) from None
    except _RuleError as broken:
        raise ArgumentError(name, f"must {broken}, got {{value}}", _EXAMPLE, **details) from None


def _read(text: str, unit: str) -> float:
    if not text or len(text) > _LONGEST:
        raise _RuleError("be one quantity")
    if _NOT_FINITE.match(text):
        raise _RuleError("be a finite number" + (f" [{unit}]" if unit else ""))
    found = _NUMBER.fullmatch(text)
    if not found:
        raise _RuleError("begin with a number")
    return _converted(found, unit)


class _RuleError(Exception):
    """What a quantity must be."""


class _UnknownUnitError(Exception):
    """A name that is no unit."""

    def __init__(self, unit: str) -> None:
        super().__init__(unit)
        self.unit = unit


def _converted(found: re.Match[str], unit: str) -> float:
    wanted = _unit(unit) if unit else (Fraction(1), {})
    factor, powers = _unit(found["unit"]) if found["unit"] else wanted
    if powers != wanted[1]:
        what = f"in {unit} or a unit of the same kind" if unit else "a number without a unit"
        raise _RuleError(f"be {what}")
    nearly = float(found["number"])
    if nearly in (float("inf"), float("-inf")):
        raise _RuleError("not be beyond the largest number")
    exact = Fraction(found["number"]) if nearly else Fraction(0)
    if found["pi"]:
        exact *= PI
    try:
        value = float(exact * factor / wanted[0])
    except OverflowError:
        raise _RuleError("not be beyond the largest number") from None
    if value == 0.0 and found["number"].lower().partition("e")[0].strip("+-0."):
        raise _RuleError("not be nearer to zero than the smallest number")
    return value


@cache
def _unit(text: str) -> Unit:
    """A product of powers of named units: factor to SI, and the powers of the SI units."""
    factor, powers, position = Fraction(1), dict[str, int](), 0
    while position < len(text):
        found = _FACTOR.match(text, position)
        if not found:
            raise _RuleError("be one number and one unit")
        power = int(found["power"] or 1) * (-1 if "/" in found["sign"] else 1)
        one, bases = _named(found["name"])
        factor *= one**power
        for base, exponent in bases.items():
            powers[base] = powers.get(base, 0) + exponent * power
        position = found.end()
    return factor, {base: power for base, power in powers.items() if power}


def _named(name: str) -> Unit:
    if name in EVERYDAY:
        factor, base = EVERYDAY[name]
        return factor, {base: 1}
    return looked_up(name)


def looked_up(name: str) -> Unit:
    """A unit as pint knows it."""
    try:
        root = _registry().Quantity(Fraction(1), name).to_root_units()
        powers = {_PINT_BASES.get(base, base): Fraction(str(n)) for base, n in root.unit_items()}
    except Exception:  # pint raises what its parser stumbles over: AttributeError, TypeError, …
        raise _UnknownUnitError(name) from None
    if not powers or any(power.denominator != 1 for power in powers.values()):
        raise _UnknownUnitError(name)  # percent, decibel, franklin: no length, angle or mass
    whole = {base: power.numerator for base, power in powers.items()}
    return root.magnitude * Fraction(1, 1000) ** whole.get("kg", 0), whole


@cache
def _registry() -> pint.UnitRegistry[Fraction]:
    import pint

    return pint.UnitRegistry(non_int_type=Fraction)


def _near(unknown: str) -> str:
    close = difflib.get_close_matches(unknown.lower(), (*EVERYDAY, *_OTHERS), n=2)
    return f"did you mean {' or '.join(close)}?" if close else ""


def example_of(unit: str, gap: str = "") -> str:
    """A quantity of that unit, as people write it, with this between number and unit."""
    number, name = _EXAMPLES.get(unit, ("1", unit))
    return f"{number}{gap}{name}"


def _shortened(text: str) -> str:
    return text if len(text) <= 40 else f"{text[:40]}…"
