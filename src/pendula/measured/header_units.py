"""Units as programs and people write them in headers, as factors to SI units."""

from __future__ import annotations

import re
from fractions import Fraction
from functools import cache

from pendula._unit_names import PI, RuleError, UnknownUnitError, unit_of

# Words of other languages than those of `pendula._unit_names`, and signs that programs write. In a
# header next to an angle, "grad" is German, Italian or Portuguese for degree; a gon is "gon".
_WORDS = {
    **dict.fromkeys(["grad", "grade", "gradi", "graus", "grau", "gr", "grados", "grado"], "deg"),
    **dict.fromkeys(["degre", "degres", "degs", "dg", "deg.", "grd", "o", "*", "d"], "deg"),
    **dict.fromkeys(["radianti", "radianes", "radiani", "radiano", "bogenmass", "rads"], "rad"),
    **dict.fromkeys(["sekunden", "sekunde", "sek", "secondes", "seconde", "secondi"], "s"),
    **dict.fromkeys(["secondo", "sec", "sec.", "secs", "segs", "seg", "seg."], "s"),
    **dict.fromkeys(["millisekunden", "millisecondes", "milisegundos", "millis", "msec"], "ms"),
    **dict.fromkeys(["microseconds", "micros", "us", "microsegundos"], "µs"),
    **dict.fromkeys(["metern", "mts", "mt", "mtrs"], "m"),
    **dict.fromkeys(["zentimeter", "centimetres", "centimetri", "cms"], "cm"),
    **dict.fromkeys(["pixel", "pixels", "pixeles", "pxs", "pix"], "px"),
}
_SIGNS = str.maketrans(
    {"−": "-", "⁻": "-", "¹": "1", "²": "2", "³": "3", "·": " ", "⋅": " ", "*": " ", "º": "°"}
)
# "ms^-2", "ms-2" and "m s-2" are metres by seconds squared: milliseconds have no such power.
_RUN_TOGETHER = re.compile(r"\b(m|cm|mm|rad|deg|°)\s*\.?\s*s(?:ec)?\^?\(?(-[12])\)?$")
_SI = {
    "s": {"s": 1},
    "rad": {"rad": 1},
    "rad/s": {"rad": 1, "s": -1},
    "m": {"m": 1},
    "m/s²": {"m": 1, "s": -2},
    "m/s": {"m": 1, "s": -1},
    "rad/s²": {"rad": 1, "s": -2},
    "N": {"kg": 1, "m": 1, "s": -2},
    "kg": {"kg": 1},
    "Hz": {"s": -1},
}
_DEGREES = re.compile(r"^(°|deg(rees?)?)\s*(?=/|$)")


@cache
def header_unit(text: str) -> tuple[str, Fraction] | None:
    """The SI unit of a unit's name, and what numbers in it are multiplied by.

    Args:
        text: as it stands in a header: "s", "deg", "m/s²", "°/s", "Grad", "px".

    Returns:
        The SI unit as `Measurement` writes it ("px" for pixels); None: it is no unit known here.
    """
    written = " ".join(text.translate(_SIGNS).split()).strip(".")
    word = _plain(written)
    if not written:
        return None
    if _WORDS.get(word) == "px" or word == "px":
        return "px", Fraction(1)
    if word == "g":  # of an acceleration; a mass in grams is never asked for
        return "m/s²", Fraction("9.80665")
    parts = re.split(r"\s*/\s*", written)
    written = "/".join(_WORDS.get(_plain(part), part) for part in parts)
    written = _RUN_TOGETHER.sub(lambda found: f"{found[1]}/s^{found[2][1:]}", written)
    try:
        factor, powers = unit_of(_DEGREES.sub("deg", written))
    except (RuleError, UnknownUnitError):
        return None
    for name, known in _SI.items():
        if powers == known:
            return name, factor
    return None


def is_degrees(factor: Fraction) -> bool:
    """Whether numbers with that factor are degrees."""
    return factor == PI / 180


def _plain(word: str) -> str:
    import unicodedata

    letters = unicodedata.normalize("NFD", word)
    return "".join(each for each in letters if not unicodedata.combining(each)).lower()
