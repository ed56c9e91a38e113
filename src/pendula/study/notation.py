"""Numbers as a reader of the language writes them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pendula.plot.labels import Labels

_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_THIN = "\u202f"  # narrow no-break space: between thousands, and before ×


class Numbers:
    """Writes numbers with a language's decimal sign and a true minus."""

    def __init__(self, words: Labels) -> None:
        self._decimal, self._local = words.decimal, words.local

    def plain(self, value: float, digits: int = 3) -> str:
        """With so many significant digits; powers of ten for the very large and very small."""
        if not math.isfinite(value):
            return "—"
        if value == 0:
            return "0"
        mantissa, exponent = f"{value:.{digits - 1}e}".split("e")
        power = int(exponent)
        if -4 <= power < 6:
            return self.fixed(value, max(digits - 1 - power, 0))
        ten = f"10{str(power).translate(_SUPERSCRIPTS)}"
        return ten if mantissa == "1" else f"{self._local(mantissa)}{_THIN}×{_THIN}{ten}"

    def fixed(self, value: float, decimals: int) -> str:
        """With so many decimals."""
        if not math.isfinite(value):
            return "—"
        grouped = f"{value:,.{decimals}f}".replace(",", _THIN)
        # Four digits are read at a glance, and stand together in both languages.
        return self._local(grouped if abs(value) >= 1e4 else grouped.replace(_THIN, ""))

    def short(self, value: float, digits: int = 4) -> str:
        """With at most so many significant digits: 0.5, not 0.5000; for values someone chose."""
        if not 1e-4 <= abs(value) < 1e6:
            return self.plain(value, digits)
        text = self.plain(value, digits)
        return text.rstrip("0").rstrip(self._decimal) if self._decimal in text else text

    def degrees(self, angle: float, digits: int = 3) -> str:
        """A measured angle [rad] in degrees, with their sign."""
        return _with_sign(self.plain(math.degrees(angle), digits))

    def chosen_degrees(self, angle: float) -> str:
        """An angle [rad] that someone chose: 5°, not 5.00°."""
        return _with_sign(self.short(math.degrees(angle), 6))

    def duration(self, seconds: float) -> str:
        """A step [s], in milliseconds where it is short."""
        if seconds < 0.1:
            return f"{self.short(seconds * 1e3, 7)}\u00a0ms"
        return f"{self.short(seconds, 7)}\u00a0s"

    def percent(self, part: float) -> str:
        """A part of one as a percentage."""
        return f"{self.short(part * 100)}\u00a0%"


def _with_sign(number: str) -> str:
    # After a power of ten the sign would pass for part of the exponent.
    return f"{number}{_THIN}°" if number[-1] in "⁰¹²³⁴⁵⁶⁷⁸⁹" else f"{number}°"
