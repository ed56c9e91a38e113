"""Numbers with their uncertainty, as they are printed: no more digits than are known."""

from __future__ import annotations

import math
from dataclasses import dataclass
from decimal import ROUND_HALF_EVEN, Context, Decimal

from pendula._checks import finite_number, number, one_of, positive_number
from pendula._messages import ArgumentError

LANGUAGES = ("en", "es")

_ONE_DIGIT_FROM, _TEN_FROM = 355, 950  # of the three leading digits of the uncertainty
_SMALLEST_PLAIN, _LARGEST_PLAIN = -3, 5  # powers of ten that are written out
_FINEST = 2.0**-52  # of a double: it is known no better than this part of itself
_MOST_DIGITS = 17  # no double holds more
_EXACT = Context(prec=800)  # a double and its last digit, however far apart they lie
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


@dataclass(frozen=True)
class Rounded:
    """A value and its uncertainty, both ending at the same decimal place.

    Attributes:
        value: its digits, as text with a decimal point.
        uncertainty: as `value`; empty: the value is exact.
        exponent: of the power of ten that multiplies both.
    """

    value: str
    uncertainty: str
    exponent: int

    def text(self, unit: str = "", *, language: str = "en") -> str:
        """Both in one line, such as "9.81 ± 0.03 m/s²"; in Spanish with a decimal comma."""
        numbers = f"{self.value} ± {self.uncertainty}" if self.uncertainty else self.value
        if self.exponent:
            both = f"({numbers})" if self.uncertainty else numbers
            numbers = f"{both} × 10{str(self.exponent).translate(_RAISED)}"
        if one_of("language", language, LANGUAGES) == "es":
            numbers = numbers.replace(".", ",")
        return f"{numbers.replace('-', '−')} {unit}".strip()


def rounded(value: float, uncertainty: float, *, coverage: float = 1.0) -> Rounded:
    """Round an uncertainty by the rule of the Particle Data Group, and the value to its last digit.

    Of the three leading digits of the uncertainty 100 to 354 give two digits, 355 to 949 one, and
    950 to 999 are rounded up to 1000, with two (Particle Data Group, Review of Particle Physics,
    Introduction, section 5.3). Halves are rounded to even.

    Args:
        value: what is printed, in any unit.
        uncertainty: its standard uncertainty, in the same unit; 0: the value is exact; infinite or
            NaN: nothing is known. One below the resolution of doubles is taken for that.
        coverage: the factor k of the expanded uncertainty U = k u (JCGM 100:2008, 6.2.1), which is
            then what is rounded and shown.

    Raises:
        ValueError: for a value that is not finite, an uncertainty below 0, or a factor that is not
            positive.
    """
    found = finite_number("value", value)
    spread = number("uncertainty", uncertainty) * positive_number("coverage", coverage)
    if spread < 0:
        rule = "must be 0 or more, got {value}"
        raise ArgumentError("uncertainty", rule, "give the size of the error", value=spread)
    if not math.isfinite(spread):
        return Rounded(f"{found:.3g}", "∞", 0)
    if spread == 0:
        return Rounded(f"{found:.{_MOST_DIGITS - 2}g}", "", 0)
    spread = max(spread, _FINEST * abs(found))
    place = _last_place(spread)
    exact, error = _at(Decimal(found), place), _at(Decimal(spread), place)
    exponent = _power_of_ten(exact, error, place)
    digits = max(0, exponent - place)
    return Rounded(_digits(exact, exponent, digits), _digits(error, exponent, digits), exponent)


def with_uncertainty(
    value: float,
    uncertainty: float,
    unit: str = "",
    *,
    coverage: float = 1.0,
    language: str = "en",
) -> str:
    """`rounded` as text, such as "9.81 ± 0.03 m/s²"; "(k = 2)" behind it tells a coverage factor.

    Args:
        value: as for `rounded`.
        uncertainty: as for `rounded`.
        unit: what follows the numbers.
        coverage: as for `rounded`.
        language: "en" or "es": the decimal mark.

    Raises:
        ValueError: as for `rounded`, or for an unknown language.
    """
    text = rounded(value, uncertainty, coverage=coverage).text(unit, language=language)
    if coverage == 1.0:
        return text
    factor = f"{coverage:.3g}".replace(".", "," if language == "es" else ".")
    return f"{text} (k = {factor})"


def _last_place(spread: float) -> int:
    """The power of ten of the last digit that the uncertainty leaves."""
    mantissa, exponent = f"{spread:.2e}".split("e")
    leading, power = int(mantissa.replace(".", "")), int(exponent)
    if leading >= _TEN_FROM:
        return power  # 0.96 becomes 1.0: its second digit is at the old first
    return power if leading >= _ONE_DIGIT_FROM else power - 1


def _at(exact: Decimal, place: int) -> Decimal:
    return exact.quantize(Decimal(1).scaleb(place), ROUND_HALF_EVEN, context=_EXACT)


def _power_of_ten(value: Decimal, error: Decimal, place: int) -> int:
    """The power of ten in front of both; 0 where both can be written out."""
    power = max(each.adjusted() for each in (value, error) if each)
    return power if place > 0 or power < _SMALLEST_PLAIN or power > _LARGEST_PLAIN else 0


def _digits(exact: Decimal, exponent: int, digits: int) -> str:
    scaled = exact.scaleb(-exponent, context=_EXACT)
    return f"{scaled + 0:.{digits}f}"  # + 0 takes the sign off a zero
