"""Quantities as people write them, read as SI numbers: "50 cm" is 0.5, "30deg" is π/6.

Values are rounded once; of π only after the number is a double, so that "119.7deg" is what
`pendula.degrees` makes of 119.7. A number without a unit is in SI units, but that an angle needs
one: radians are seldom what is meant. A quantity is one number and one unit.
"""

from __future__ import annotations

import difflib
import re
import unicodedata
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from pendula._messages import ArgumentError
from pendula._unit_names import (
    NAMES,
    PI,
    RuleError,
    UnknownUnitError,
    pint_unit,
    prefix_of,
    turns_of,
    unit_of,
)

if TYPE_CHECKING:
    from pendula._types import Array

_EXAMPLES = {
    "m": ("50", "cm"),
    "s": ("10", "ms"),
    "rad": ("30", "deg"),
    "rad/s": ("90", "deg/s"),
    "kg": ("500", "g"),
    "m/s^2": ("9.81", "m/s^2"),
    "kg m^2": ("0.1", "kg m^2"),
    "N m": ("0.1", "N m"),
    "N m s": ("0.1", "N m s"),
    "N m s^2": ("0.1", "N m s^2"),
    "N m s^3": ("0.1", "N m s^3"),
    "": ("0.5", ""),
}
_EXAMPLE = "write {text}, say"

_LONGEST = 100  # characters
_CLOSE = 0.65  # so alike are a name and its misprint
_PLAIN_SIGNS = str.maketrans("−⁻¹²³⁴⁵⁶⁷⁸⁹", "--123456789")
_NUMBER = re.compile(
    r"(?P<number>[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?)"
    r"(?P<pi>\s*\*?\s*(?:pi|π)(?!\w))?\s*(?P<unit>.*)",
    re.DOTALL,
)
_NOT_FINITE = re.compile(r"[-+]?(nan|inf|infinity)\b", re.IGNORECASE)
_DECIMAL_COMMA = re.compile(r"[^,.]*[0-9],[0-9][^,.]*")
_SPLIT = 2.0**27 + 1.0  # halves the digits of a double (Veltkamp 1968)
_SMALLEST = 1e-290  # below it a product's rounding error has no double


def quantity(text: str, unit: str, name: str) -> float:
    """One quantity in SI units, correctly rounded.

    Args:
        text: a number and a unit, such as "50 cm", "9.81 m/s²" or "-10°"; a bare number is in SI,
            and no angle, unless it is 0.
        unit: the SI unit, such as "m", "rad/s", "m/s^2" or "kg m^2"; "" for a plain number.
        name: what the message calls the value.

    Raises:
        ValueError: one line naming the value, the rule, what was given and the way out.
    """
    if "," in text:
        if _DECIMAL_COMMA.fullmatch(text):
            point = _with_unit(text.strip().replace(",", "."), unit)
            way_out = "a comma separates entries of a list"
            raise ArgumentError(name, ": write {text}", way_out, text=point)
        rule = "takes one value, got {value}"
        raise ArgumentError(name, rule, _EXAMPLE, value=_shortened(text), text=example_of(unit))
    return float(_value(text, unit, name))


def quantities(text: str, unit: str, name: str) -> list[float]:
    """A list of quantities in SI units: "30deg,60deg". Each of several carries its own unit.

    Arguments and errors as for `quantity`.
    """
    return [float(each) for each in _values(text, unit, name)]


def half_turns(text: str, name: str) -> list[Fraction]:
    """A list of angles in half turns, before any rounding: "180deg" is 1, and "3.14rad" less.

    Arguments and errors as for `quantities`.
    """
    return [each / PI for each in _values(text, "rad", name)]


def conversion(written: str, unit: str, name: str, *, of_pint: bool = False) -> Fraction:
    """What numbers in a unit that is written out have to be multiplied by for another.

    Args:
        written: the unit.
        unit: the other, in SI.
        name: of the value: a frequency in Hz counts whole turns.
        of_pint: whether pint wrote it, whose names it has.

    Raises:
        RuleError: for a unit of another kind.
        UnknownUnitError: for a name that is no unit.
    """
    wanted = unit_of(unit)
    read = pint_unit if of_pint else unit_of
    factor, powers = read(written.translate(_PLAIN_SIGNS))
    turns = turns_of(written, name)
    if unit == "rad/s" and turns != 1:
        return factor * turns
    if powers != wanted[1] and (powers or unit != "rad"):  # an arc over its radius is an angle
        raise RuleError(_kind(unit))
    return factor / wanted[0]


def scaled(values: Array, factor: Fraction) -> Array:
    """Products of doubles and a number, correctly rounded, in the shape of the doubles.

    They are formed from two doubles of the factor without error (Dekker 1971); those that what is
    left out could round otherwise (Ziv 1991), and the smallest, are rounded as fractions.
    """
    import numpy as np

    if factor == 1:
        return values
    head = float(factor)
    tail = float(factor - Fraction(head))
    flat = np.ravel(values)
    finite = np.isfinite(flat)
    digits, powers = np.frexp(np.where(finite, flat, 0.0))
    product = digits * head
    (a, b), (c, d) = _halves(digits), _halves(head)
    rest = ((a * c - product) + a * d + b * c) + b * d + digits * tail
    margin = abs(product) * 2.0**-98  # some 2^-104 are left out
    rounded = product + (rest - margin)
    with np.errstate(over="ignore", under="ignore"):
        result = np.ldexp(rounded, powers)
    same = ~finite | (flat == 0.0)
    unsure = (rounded != product + (rest + margin)) | (abs(result) < _SMALLEST)
    for i in np.flatnonzero(unsure & ~same):
        result[i] = float(Fraction(float(flat[i])) * factor)
    result[same] = flat[same]
    return np.asarray(result).reshape(np.shape(values))


def _halves(x: Any) -> tuple[Any, Any]:
    """Two doubles of half the digits whose sum it is (Veltkamp 1968)."""
    high = _SPLIT * x - (_SPLIT * x - x)
    return high, x - high


def _values(text: str, unit: str, name: str) -> list[Fraction]:
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
    given = next((each["unit"] for each in found if each and each["unit"]), _likely(unit))
    each_its_own = ",".join(
        entry + (" rad" if "pi" in entry else given) if entry in bare else entry
        for entry in entries
    )
    halves = len(entries) == 2 and entries[0] in bare and entries[1][:1].isdigit()
    one = _with_unit(".".join(entries), unit) if halves else ""
    decimal = f", or {one} for one value with a decimal point" if one.count(".") == 1 else ""
    raise ArgumentError(
        name,
        ": {entry} in the list {value} has no unit, each entry carries its own",
        "write {text}",
        entry=bare[0],
        value=_shortened(text),
        text=each_its_own + decimal,
    )


def _value(text: str, unit: str, name: str) -> Fraction:
    details = {"value": _shortened(text), "text": example_of(unit)}
    try:
        written = unicodedata.normalize("NFC", text).strip().translate(_PLAIN_SIGNS)
        return _read(written, unit, name)
    except UnknownUnitError as unknown:
        rule, way_out = "has the unknown unit {unknown} in {value}", near(unknown.unit, unit)
        way_out = way_out or _EXAMPLE
        raise ArgumentError(name, rule, way_out, unknown=unknown.unit, **details) from None
    except RuleError as broken:
        raise ArgumentError(name, f"must {broken}, got {{value}}", _EXAMPLE, **details) from None
    except _BareAngleError:
        written = text.strip()
        details["text"] = " or ".join(written + each for each in (_likely(unit), unit))
        raise ArgumentError(name, "needs a unit, got {value}", "write {text}", **details) from None


class _BareAngleError(Exception):
    """An angle without a unit."""


def _read(text: str, unit: str, name: str) -> Fraction:
    if not text or len(text) > _LONGEST:
        raise RuleError("be one quantity")
    if _NOT_FINITE.match(text):
        raise RuleError("be a finite number" + (f" [{unit}]" if unit else ""))
    found = _NUMBER.fullmatch(text)
    if not found:
        raise RuleError("begin with a number")
    return _converted(found, unit, name)


def _converted(found: re.Match[str], unit: str, name: str) -> Fraction:
    wanted = unit_of(unit)
    factor, powers = unit_of(found["unit"]) if found["unit"] else wanted
    turns = turns_of(found["unit"], name)
    if unit == "rad/s" and turns != 1:
        factor, powers = factor * turns, wanted[1]
    if powers != wanted[1]:
        raise RuleError(_kind(unit))
    nearly = float(found["number"])
    if nearly in (float("inf"), float("-inf")):
        raise RuleError("not be beyond the largest number")
    if "rad" in powers and nearly and not found["unit"] and not found["pi"]:
        raise _BareAngleError
    exact = Fraction(found["number"]) if nearly else Fraction(0)
    if found["pi"]:
        exact *= PI
    elif _of_pi(factor):
        exact = Fraction(nearly)
    exact *= factor / wanted[0]
    try:
        value = float(exact)
    except OverflowError:
        raise RuleError("not be beyond the largest number") from None
    if value == 0.0 and found["number"].lower().partition("e")[0].strip("+-0."):
        raise RuleError("not be nearer to zero than the smallest number")
    return exact


def _kind(unit: str) -> str:
    return f"be in {unit} or a unit of the same kind" if unit else "be a number without a unit"


def _of_pi(factor: Fraction) -> bool:
    """Whether π is a part of it: in its own digits it is a short fraction then."""
    return (factor / PI).denominator < PI.numerator


def _likely(unit: str) -> str:
    """The unit that a number without one is likely meant in."""
    return unit.replace("rad", "deg")


def _with_unit(text: str, unit: str) -> str:
    """The text, with its likely unit where it needs one and has none."""
    found = _NUMBER.fullmatch(text)
    bare = found and not found["unit"] and not found["pi"]
    return text + _likely(unit) if bare and "rad" in unit else text


def near(unknown: str, unit: str) -> str:
    """A question for the unit of that kind that was meant; empty where none is near."""
    bases = set(re.findall(r"[a-z]+", unit))
    wanted, word = unit_of(unit)[1], unknown.lower()
    prefix = prefix_of(word)
    known = [
        name
        for name, (_, powers) in NAMES.items()
        if (powers == wanted or (len(powers) == 1 and bases.issuperset(powers)))
        and prefix in ("", prefix_of(name))
    ]
    close = difflib.get_close_matches(word, known, n=2, cutoff=_CLOSE)
    return f"did you mean {' or '.join(close)}?" if close else ""


def example_of(unit: str, gap: str = "") -> str:
    """A quantity of that unit, as people write it, with this between number and unit."""
    number, name = _EXAMPLES.get(unit, ("0.5", unit.removeprefix("1")))
    return f"{number}{'' if name.startswith('/') else gap}{name}"


def _shortened(text: str) -> str:
    return text if len(text) <= 40 else f"{text[:40]}…"
