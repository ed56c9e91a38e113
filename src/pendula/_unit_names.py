"""Names of units, and what one of each is in SI units, exactly.

The everyday ones are known here, in English and Spanish; any other is looked up with pint, which
takes half a second to load. Nothing is evaluated.
"""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pint

    Unit = tuple[Fraction, dict[str, int]]  # factor to SI, and the powers of m, kg, s, rad

PI = Fraction("3.14159265358979323846264338327950288419716939937510")

# Factor, SI unit, and the names. A test holds those that pint knows against it.
_ROWS = (
    (Fraction(1), "m", "m meter meters metre metres metro metros"),
    (Fraction(1, 100), "m", "cm centimeter centimeters centimetre centimetres"),
    (Fraction(1, 100), "m", "centímetro centímetros centimetro centimetros"),
    (Fraction(1, 1000), "m", "mm millimeter millimeters millimetre millimetres"),
    (Fraction(1, 1000), "m", "milímetro milímetros milimetro milimetros"),
    (Fraction(1000), "m", "km"),
    (Fraction(1), "s", "s sec secs second seconds segundo segundos"),
    (Fraction(1, 1000), "s", "ms millisecond milliseconds milisegundo milisegundos"),
    (Fraction(1, 10**6), "s", "us microsecond microseconds microsegundo microsegundos"),
    (Fraction(60), "s", "min minute minutes minuto minutos"),
    (Fraction(3600), "s", "h hour hours hora horas"),
    (Fraction(1), "kg", "kg kilogram kilograms kilogramo kilogramos"),
    (Fraction(1, 1000), "kg", "g gram grams gramo gramos"),
    (Fraction(1), "rad", "rad rads radian radians radián radianes"),
    # º: the ordinal sign, which Spanish keyboards have in place of the degree's
    (PI / 180, "rad", "deg ° º degree degrees grado grados"),
    (2 * PI, "rad", "turn turns rev revolution revolutions vuelta vueltas revolución revoluciones"),
    (PI / 200, "rad", "gon gons gradian gradians gradián gradianes"),
    (PI / 10800, "rad", "arcmin arcminute arcminutes"),
    (PI / 648000, "rad", "arcsec arcsecond arcseconds"),
)
EVERYDAY = {name: (factor, base) for factor, base, names in _ROWS for name in names.split()}
_EITHER = ("grad", "grads")  # German "Grad" is a degree, English "grad" a gon
# Of an angle; with a larger prefix "Grad" would be 10^9 rad.
_ANGLE_PREFIXES = ("", "milli", "micro", "nano")
_PINT_BASES = {"meter": "m", "gram": "kg", "second": "s", "radian": "rad"}
_LONGEST_SYMBOL = 3  # letters; longer names are words, whose case says nothing
_FACTOR = re.compile(
    r"(?P<sign>\s*[*·⋅/]\s*|\s+|^)(?P<name>[^\W\d]+|°)(?:\s*(?:\^|\*\*)\s*)?(?P<power>[-+]?[1-9])?"
)


class RuleError(Exception):
    """What a quantity or its unit must be."""


class UnknownUnitError(Exception):
    """A name that is no unit."""

    def __init__(self, unit: str) -> None:
        super().__init__(unit)
        self.unit = unit


@cache
def unit_of(text: str) -> Unit:
    """A product of powers of named units, such as "m/s^2" or "1/s".

    Returns:
        The factor to SI, and the powers of the SI units.

    Raises:
        RuleError: for what is no such product, or a name with two meanings.
        UnknownUnitError: for a name that is no unit.
    """
    factor, powers, position = Fraction(1), dict[str, int](), 0
    if re.match(r"1\s*/", text):
        position = 1
    while position < len(text):
        found = _FACTOR.match(text, position)
        if not found:
            raise RuleError("be one number and one unit")
        power = int(found["power"] or 1) * (-1 if "/" in found["sign"] else 1)
        one, bases = _named(found["name"])
        factor *= one**power
        for base, exponent in bases.items():
            powers[base] = powers.get(base, 0) + exponent * power
        position = found.end()
    return factor, {base: power for base, power in powers.items() if power}


def _named(name: str) -> Unit:
    word = name if len(name) <= _LONGEST_SYMBOL else name.lower()
    if word.lower() in _EITHER:
        raise RuleError(f"be in deg or gon: {name} can mean either")
    if word in EVERYDAY:
        factor, base = EVERYDAY[word]
        return factor, {base: 1}
    return looked_up(name)


def looked_up(name: str) -> Unit:
    """A unit as pint knows it.

    Raises:
        UnknownUnitError: for none, or one of another kind.
    """
    try:
        registry = _registry()
        root = registry.Quantity(Fraction(1), name).to_root_units()
        powers = {_PINT_BASES.get(base, base): Fraction(str(n)) for base, n in root.unit_items()}
        prefix = registry.parse_unit_name(name)[0][0]
    except Exception:  # pint raises what its parser stumbles over: AttributeError, TypeError, …
        raise UnknownUnitError(name) from None
    if not powers or any(power.denominator != 1 for power in powers.values()):
        raise UnknownUnitError(name)  # percent, decibel, franklin: no length, angle or mass
    whole = {base: power.numerator for base, power in powers.items()}
    if whole == {"rad": 1} and prefix not in _ANGLE_PREFIXES:
        raise UnknownUnitError(name)
    return root.magnitude * Fraction(1, 1000) ** whole.get("kg", 0), whole


@cache
def _registry() -> pint.UnitRegistry[Fraction]:
    import pint

    return pint.UnitRegistry(non_int_type=Fraction)
