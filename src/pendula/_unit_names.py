"""Names of units, and what one of each is in SI units, exactly.

Text is read with the names listed here alone, in English and Spanish: a full registry knows
abbreviations that mean something else to a student, such as "gr", "mil" or "hs". The units of a
pint quantity are those of pint. Nothing is evaluated.
"""

from __future__ import annotations

import re
import unicodedata
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import pint

    Unit = tuple[Fraction, dict[str, int]]  # factor to SI, and the powers of m, kg, s, rad

PI = Fraction("3.14159265358979323846264338327950288419716939937510")
_MILLI = Fraction(1, 1000)
_POUND = Fraction("0.45359237")
_GRAVITY = Fraction("9.80665")
_M, _KG, _S, _RAD, _PER_S, _RAD_PER_S, _M_PER_S2, _N, _J, _J_S = (
    {"m": 1},
    {"kg": 1},
    {"s": 1},
    {"rad": 1},
    {"s": -1},
    {"rad": 1, "s": -1},
    {"m": 1, "s": -2},
    {"kg": 1, "m": 1, "s": -2},
    {"kg": 1, "m": 2, "s": -2},
    {"kg": 1, "m": 2, "s": -1},
)

# Symbols, whose case counts, and words, whose case and accents do not. A test holds them against
# pint.
_ROWS: tuple[tuple[Fraction, dict[str, int], str, str], ...] = (
    (Fraction(1, 10**6), _M, "", "micron microns micra micras"),
    (Fraction("0.0254"), _M, "in", "inch inches pulgada pulgadas"),
    (Fraction("0.3048"), _M, "ft", "foot feet pie pies"),
    (Fraction("0.9144"), _M, "yd", "yard yards yarda yardas"),
    (Fraction("1609.344"), _M, "mi", "mile miles milla millas"),
    (Fraction(1), _S, "sec secs seg segs", ""),
    (_MILLI, _S, "", "msec"),
    (Fraction(60), _S, "min", "minute minutes minuto minutos mins"),
    (Fraction(3600), _S, "h hr hrs", "hour hours hora horas"),
    (Fraction(86400), _S, "d", "day days dia dias"),
    (Fraction(604800), _S, "", "week weeks semana semanas"),
    (Fraction(1), _KG, "", "kilo kilos"),
    (Fraction(1000), _KG, "t", "tonne tonnes metric_ton metric_tons tonelada toneladas"),
    (_POUND, _KG, "lb lbs", "pound pounds"),
    (_POUND / 16, _KG, "oz", "ounce ounces"),
    (_POUND / 7000, _KG, "", "grain grains"),
    (_POUND * 14, _KG, "", "stone stones"),
    (_POUND * _GRAVITY / Fraction("0.3048"), _KG, "", "slug slugs"),
    # º: the ordinal sign, which Spanish keyboards have in place of the degree's
    (PI / 180, _RAD, "deg ° º", "degree degrees grado grados"),
    (2 * PI, _RAD, "rev", "turn turns revs revolution revolutions revolucion revoluciones"),
    (2 * PI, _RAD, "", "cycle cycles vuelta vueltas giro giros ciclo ciclos"),
    (PI / 200, _RAD, "gon", "gons gones gradian gradians gradianes"),
    (PI / 10800, _RAD, "", "arcmin arcmins arcminute arcminutes"),
    (PI / 648000, _RAD, "", "arcsec arcsecs arcsecond arcseconds"),
    (Fraction(1), _RAD, "", "rads"),
    (2 * PI, _RAD_PER_S, "rps", ""),
    (PI / 30, _RAD_PER_S, "rpm", ""),
    (PI / 180, _RAD_PER_S, "dps", ""),
    (Fraction(1), _J, "Nm", ""),  # a torque; nm is a length
    (_MILLI, _J, "mNm", ""),
    (Fraction(1), _J_S, "Nms", ""),
    (_GRAVITY, _M_PER_S2, "g_0 g_n", "standard_gravity"),
    (_POUND * _GRAVITY, _N, "lbf", ""),
    (_GRAVITY, _N, "kgf kp", "kilopond kilopondio kilopondios"),
    (Fraction(1, 10**5), _N, "dyn", "dyne dynes dina dinas"),
    (Fraction(1, 10**7), _J, "erg", "ergs ergio ergios"),
)
# The same, before which these prefixes go. Of others the symbol is another's misprint: of Ms or Mm
# ms and mm, of hs, in Spanish, h.
_PREFIXED: tuple[tuple[Fraction, dict[str, int], str, str, str], ...] = (
    (Fraction(1), _M, "n µ m c d da h k", "m", "meter meters metre metres metro metros"),
    (_MILLI, _KG, "n µ m c d da h k", "g", "gram grams gramme grammes gramo gramos"),
    (Fraction(1), _S, "n µ m", "s", "second seconds segundo segundos"),
    (Fraction(1), _RAD, "n µ m", "rad", "radian radians radianes"),
    (Fraction(1), _PER_S, "m k", "Hz", "hertz hercio hercios"),
    (Fraction(1, 100), _M_PER_S2, "n µ m", "Gal", "galileo galileos"),
    (Fraction(1), _N, "n µ m k", "N", "newton newtons"),
    (Fraction(1), _J, "n µ m k", "J", "joule joules julio julios"),
)
_PREFIXES: dict[str, tuple[Fraction, str, str]] = {  # by symbol: factor, symbols, words
    "n": (Fraction(1, 10**9), "n", "nano"),
    "µ": (Fraction(1, 10**6), "µ μ u", "micro"),
    "m": (_MILLI, "m", "milli mili"),
    "c": (Fraction(1, 100), "c", "centi"),
    "d": (Fraction(1, 10), "d", "deci"),
    "da": (Fraction(10), "da", "deca deka"),
    "h": (Fraction(100), "h", "hecto"),
    "k": (Fraction(1000), "k", "kilo"),
}
_LARGER = ("mega", "giga", "tera", "peta", "exa", "zetta", "yotta")  # and smaller; not taken
_SMALLER = ("pico", "femto", "atto", "zepto", "yocto")
_PREFIX_WORDS = (
    *_LARGER,
    *_SMALLER,
    *(word for *_, words in _PREFIXES.values() for word in words.split()),
)


def _tables() -> tuple[dict[str, Unit], dict[str, Unit]]:
    """Units by symbol and by word."""
    symbols, words = dict[str, "Unit"](), dict[str, "Unit"]()
    rows = [(*row[:2], *row[3:]) for row in _PREFIXED]
    rows += [row for each in _PREFIXED for row in _with_prefixes(*each)]
    for factor, powers, symbol, word in (*rows, *_ROWS):
        symbols.update(dict.fromkeys(symbol.split(), (factor, powers)))
        words.update(dict.fromkeys(word.split(), (factor, powers)))
    return symbols, words


def _with_prefixes(
    factor: Fraction, powers: dict[str, int], prefixes: str, symbol: str, words: str
) -> Iterator[tuple[Fraction, dict[str, int], str, str]]:
    for each in prefixes.split():
        multiple, symbols, before = _PREFIXES[each]
        longer = " ".join(one + word for one in before.split() for word in words.split())
        yield factor * multiple, powers, " ".join(s + symbol for s in symbols.split()), longer


_SYMBOLS, _WORDS = _tables()
NAMES: dict[str, Unit] = {**_SYMBOLS, **_WORDS}

_EITHER = {  # name and the units that it can mean
    # German "Grad" is a degree, English "grad" and "grade" a gon, Spanish "grado" a degree; keys of
    # calculators
    **dict.fromkeys(["grad", "grads", "grade", "grades", "grd", "gra"], "deg or gon"),
    **dict.fromkeys(["gr", "grs"], "g or grain"),  # Spanish gramos, English grain
}
# units of those names differ by country or trade, months and years by the calendar
_SEVERAL = {
    "mil",
    "mils",
    "milesima",
    "milesimas",
    "ton",
    "tons",
    "libra",
    "libras",
    "onza",
    "onzas",
}
_SEVERAL |= {"onza", "onzas", "quintal", "quintales", "grano", "granos"}
_SEVERAL |= {"mes", "meses", "month", "months", "ano", "anos", "year", "years"}
_PHRASES = tuple(  # what people write in several words
    (re.compile(pattern, re.IGNORECASE), written)
    for pattern, written in (
        (r"\b(minutos? (de arco|sexagesimal(es)?)|minutes? of arc)\b", "arcmin"),
        (r"\b(segundos? (de arco|sexagesimal(es)?)|seconds? of arc)\b", "arcsec"),
        (r"\barc[ -](min\w*|sec\w*)", r"arc\1"),
        (r"\bgrados? sexagesimal(es)?\b", "deg"),
        (r"\bgrados? centesimal(es)?\b", "gon"),
        (r"\bsquare (\w+)", r"\1^2"),
        (r" (al cuadrado|cuadrados?|squared)\b", "^2"),
        (r"(^| )(por|per) ", "/"),
    )
)
# Of an angle; with a larger prefix "Grad" would be 10^9 rad.
_ANGLE_PREFIXES = ("", "milli", "micro", "nano")
_PINT_BASES = {"meter": "m", "gram": "kg", "second": "s", "radian": "rad"}
_OF_CYCLES = re.compile(r"\w*?(hz|hertz|hercios?)", re.IGNORECASE)
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
    """A product of powers of named units, such as "m/s^2", "1/s" or "metros por segundo".

    Returns:
        The factor to SI, and the powers of the SI units.

    Raises:
        RuleError: for what is no such product, or a name with two meanings.
        UnknownUnitError: for a name that is no unit.
    """
    text = " ".join(text.split())
    for pattern, written in _PHRASES:
        text = pattern.sub(written, text)
    return _product(text, named)


@cache
def pint_unit(text: str) -> Unit:
    """The unit of a pint quantity, as pint writes it; returns and errors as of `unit_of`."""
    return _product(text, looked_up)


def _product(text: str, one_named: Callable[[str], Unit]) -> Unit:
    factor, powers, position = Fraction(1), dict[str, int](), 0
    if re.match(r"1\s*/", text):
        position = 1
    while position < len(text):
        found = _FACTOR.match(text, position)
        if not found:
            raise RuleError("be one number and one unit")
        power = int(found["power"] or 1) * (-1 if "/" in found["sign"] else 1)
        one, bases = one_named(found["name"])
        factor *= one**power
        for base, exponent in bases.items():
            powers[base] = powers.get(base, 0) + exponent * power
        position = found.end()
    return factor, {base: power for base, power in powers.items() if power}


def turns_of(written: str, name: str) -> Fraction:
    """The radians of a cycle where a frequency is given in Hz; of other values 1."""
    cycles = name.endswith("frequency") and _OF_CYCLES.fullmatch(written.strip())
    return 2 * PI if cycles else Fraction(1)


def named(name: str) -> Unit:
    """One of the units that text is read with.

    Raises:
        RuleError: for a name with several meanings.
        UnknownUnitError: for any other.
    """
    plain = _without_accents(name)
    word = plain.lower()
    if word in _EITHER:
        raise RuleError(f"be in {_EITHER[word]}: {name} can mean either")
    if word in _SEVERAL:
        raise RuleError(f"not be in {name}, which has several meanings")
    found = _SYMBOLS.get(plain) or _WORDS.get(word)
    if found is None:
        raise UnknownUnitError(name)
    return found


def _without_accents(name: str) -> str:
    letters = unicodedata.normalize("NFD", name)
    return "".join(letter for letter in letters if not unicodedata.combining(letter))


def prefix_of(word: str) -> str:
    """The prefix that a word begins with; empty: none."""
    found = next((each for each in _PREFIX_WORDS if _without_accents(word).startswith(each)), "")
    return {"mili": "milli", "deka": "deca"}.get(found, found)


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
