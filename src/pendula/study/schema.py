"""What a recipe holds: each key with its unit and range in one row. Values are in SI units."""

from __future__ import annotations

import math
import unicodedata
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any

from pendula._recipe_file import suggestion

if TYPE_CHECKING:
    from collections.abc import Callable


@dataclass(frozen=True)
class Rule:
    """What a value must be: more than `low`, less than `high`; a list of such, or one."""

    unit: str | None = None
    """SI unit of a quantity; None for a plain number."""
    low: float = -math.inf
    high: float = math.inf
    whole: bool = False
    many: bool = False
    words: str = ""
    """The range in words, where its numbers are no good to read."""

    def allows(self, value: float) -> bool:
        """Whether a number is within the range."""
        return self.low < value < self.high

    def range(self) -> str:
        """The range in words."""
        unit = f" {self.unit}" if self.unit else ""
        if self.words:
            return self.words
        if self.high == math.inf:
            return f"more than {self.low:g}{unit}"
        return f"between {self.low:g} and {self.high:g}{unit}"


@dataclass(frozen=True)
class TextRule:
    """What a text must be: one of the `choices`, or one line; a list of such, or one."""

    choices: tuple[str, ...] = ()
    many: bool = False

    def broken_by(self, value: Any) -> str:
        """What a value must be and is not; empty: it is."""
        if not isinstance(value, str):
            return "must be text, in quotes"
        if self.choices:
            return "" if value in self.choices else "must be known names"
        one_line = not any(unicodedata.category(each) in _NO_TEXT for each in value)
        return "" if one_line else "must be one line, without control characters"

    def way_out(self, key: str, value: Any) -> str:
        """What to write instead of a value that breaks the rule."""
        if self.choices:
            return suggestion(str(value), self.choices)
        return f'write {key} = "Two pendulums", say'


# Control characters, ends of lines, and halves of characters, which no file can hold.
_NO_TEXT = ("Cc", "Cs", "Zl", "Zp")
# The sections of the report, each a file of the text, in their order.
REPORT = ("equations", "linear", "elliptic", "methods", "double", "work", "errata")


def _value(rule: Rule | TextRule) -> Any:
    return field(metadata={"rule": rule})


_LENGTH = Rule("m", low=0)
_MASS = Rule("kg", low=0)
_GRAVITY = Rule("m/s^2", low=0)
_TIME = Rule("s", low=0)
_AMPLITUDE = Rule("rad", low=0, high=math.pi, words="between 0 and 180 deg")
_AMPLITUDES = replace(_AMPLITUDE, many=True)
# Angles a run can go on from for long: a sine is exact to |θ| < 2²⁶ rad, ten million turns.
_TURNS = 360 * math.tau
_ANGLE = Rule("rad", low=-_TURNS, high=_TURNS, words="between -360 and 360 turns")
_RATE = Rule("rad/s", low=-1e4, high=1e4)
_PARTS = Rule(low=0, high=1, many=True)
_SWINGS = Rule(low=0, high=101, whole=True, many=True)
_TERMS = Rule(low=0, high=1001, whole=True, many=True)


@dataclass(frozen=True)
class Report:
    """What the report is called, who wrote it, and what it says."""

    title: str = _value(TextRule())
    author: str = _value(TextRule())
    sections: tuple[str, ...] = _value(TextRule(choices=REPORT, many=True))


@dataclass(frozen=True)
class Simple:
    """The simple pendulum, its two releases from rest, and the runs."""

    length: float = _value(_LENGTH)
    mass: float = _value(_MASS)
    gravity: float = _value(_GRAVITY)
    gentle: float = _value(_AMPLITUDE)
    large: float = _value(_AMPLITUDE)
    t_max: float = _value(_TIME)
    step: float = _value(_TIME)
    output: float = _value(_TIME)


@dataclass(frozen=True)
class LinearModel:
    """Where small angles stop being small."""

    amplitudes: tuple[float, ...] = _value(_AMPLITUDES)
    swings: tuple[int, ...] = _value(_SWINGS)
    errors: tuple[float, ...] = _value(_PARTS)


@dataclass(frozen=True)
class Period:
    """The table of periods."""

    amplitudes: tuple[float, ...] = _value(_AMPLITUDES)
    terms: tuple[int, ...] = _value(_TERMS)


@dataclass(frozen=True)
class Elliptic:
    """Series against arithmetic-geometric mean."""

    amplitudes: tuple[float, ...] = _value(_AMPLITUDES)
    error: float = _value(Rule(low=1e-15, high=1))
    largest_terms: int = _value(Rule(low=0, high=5_000_001, whole=True))


@dataclass(frozen=True)
class Convergence:
    """The methods' order."""

    t_max: float = _value(_TIME)
    steps: tuple[float, ...] = _value(Rule("s", low=0, many=True))


@dataclass(frozen=True)
class Work:
    """What the errors of all methods cost."""

    swings: int = _value(Rule(low=0, high=21, whole=True))
    points: int = _value(Rule(low=1, high=41, whole=True))


@dataclass(frozen=True)
class Double:
    """Two uniform rods, their start, and the runs."""

    m1: float = _value(_MASS)
    m2: float = _value(_MASS)
    l1: float = _value(_LENGTH)
    l2: float = _value(_LENGTH)
    gravity: float = _value(_GRAVITY)
    theta1: float = _value(_ANGLE)
    theta2: float = _value(_ANGLE)
    omega1: float = _value(_RATE)
    omega2: float = _value(_RATE)
    t_max: float = _value(_TIME)
    step: float = _value(_TIME)
    output: float = _value(_TIME)
    path_until: float = _value(_TIME)
    reference_step: float = _value(_TIME)
    tolerance: float = _value(Rule("rad", low=0))


@dataclass(frozen=True)
class Recipe:
    """Everything the study's numbers follow from."""

    report: Report
    simple: Simple
    linear_model: LinearModel
    period: Period
    elliptic: Elliptic
    convergence: Convergence
    work: Work
    double: Double
    text: str
    """The complete recipe as TOML; read again, it gives the same numbers bit for bit."""
    own: bool
    """Whether it differs from the study's own."""
    place: Callable[..., str] = field(compare=False)
    """The file, and the line of the first of some (table, key) that the file sets."""


SECTIONS: dict[str, type[Any]] = {
    "report": Report,
    "simple": Simple,
    "linear_model": LinearModel,
    "period": Period,
    "elliptic": Elliptic,
    "convergence": Convergence,
    "work": Work,
    "double": Double,
}
