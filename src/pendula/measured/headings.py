"""What a column's header means: the quantity, its axis, body and run, and its unit."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise

from pendula.measured import heading_words as words
from pendula.measured.header_units import header_unit

_GREEK = str.maketrans(
    {
        **dict.fromkeys("θΘϑ", " theta "),
        **dict.fromkeys("φϕΦ", " phi "),
        **{"ω": " omega ", "α": " alpha ", "β": " beta ", "ψ": " psi ", "ß": "ss"},
    }
)
_BRACKETS = re.compile(r"\(([^()]*)\)|\[([^\[\]]*)\]|\{([^{}]*)\}")
_BEHIND = re.compile(r"^(.+?)(?:\s*/\s*|\s+in\s+|\s+en\s+|\s*,\s*|\s+)([^\s/,]+(?:/[^\s/]+)?)$")
_OF_ACCELERATION = re.compile(r"(?:a|acc|acce|gf)[xyz]")
_OF_RATE = re.compile(r"(?:w|g|gyr|gyro|omega|rot)[xyz]")
_DOTTED = re.compile("[θφϕϑ]\u0307")
_RUN_NUMBER = re.compile(r"#\s*(\d+)")
_ORDINAL = re.compile(r"\b(\d+)(?:st|nd|rd|th|ra|da|er|ª|º|°)\b")
_SUFFIXES = {"deg", "rad", "degrees", "grados", "radians", "radianes", "px", "mm", "cm", "grad"}
_SHORT_SUFFIXES = {"s", "m", "ms", "pixels", "degree", "degs", "sec", "n"}
_TIMES = {"ms", "s", "sec", "seg", "seconds", "segundos", "sekunden", "secondes", "millis"}
_MULTIPLE = re.compile(rf"\b(\d+)\s*[x×*]?\s*{words.SWINGS}\b")
_OF_MULTIPLE = re.compile(r"\bt[_ ]?(5|10|15|20|25|30|40|50|100)\b")
_KINDS_OF_UNITS = {
    **{"s": "time", "rad": "angle", "rad/s": "rate", "m/s²": "acceleration", "N": "force"},
    **{"m/s": "other", "rad/s²": "other", "kg": "other", "Hz": "other"},
}


@dataclass(frozen=True)
class Heading:
    """What a header means.

    Attributes:
        kind: "time", "frame", "angle", "rate", "x", "y", "acceleration", "force", "length",
            "amplitude", "period", "trial" (a run of a stopwatch), "gate" (a light barrier's
            state), "other" (known, of no use here); empty: unknown.
        axis: "x", "y" or "z", of a sensor; empty: none.
        absolute: the size of a vector.
        index: of the body, or the run, that a number in it names.
        run: the run that it names outright; empty: none.
        unit: in SI, "px" for pixels; empty: none is told.
        factor: what the numbers are multiplied by for that unit.
        written: the unit as it is written, known or not.
        weak: a name that also means something else.
        computed: simulated or fitted, not measured.
        upright: an angle counted from the upright position.
        linear: an acceleration from which gravity was taken off.
        swings: of how many a time is.
    """

    kind: str = ""
    axis: str = ""
    absolute: bool = False
    index: str = ""
    run: str = ""
    unit: str = ""
    factor: Fraction = Fraction(1)
    written: str = ""
    weak: bool = False
    computed: bool = False
    upright: bool = False
    linear: bool = False
    swings: int | None = None


def heading_of(label: str, *, unit: str = "", group: str = "") -> Heading:
    """What a label means.

    Args:
        label: the header's cell.
        unit: a cell below it that holds the unit; empty: the label may hold one.
        group: what stands above it.
    """
    if not label and not unit:
        return Heading()
    front, colon, behind = label.partition(": ")
    text = behind if colon else label
    text, written = _without_unit(text)
    written = unit.strip("()[]{} ") or written
    known = header_unit(written) if written else None
    tokens = _tokens(text)
    if not written:
        written = _implied(tokens)
        known = header_unit(written) if written else None
    found = _meaning(text, tokens, known[0] if known else "")
    if known:
        found = replace(found, unit=known[0], factor=known[1])
    run = found.run or _run_of(front if colon else "") or _run_of(group)
    index = found.index or _letter(_tokens(group))
    return replace(found, run=run, index=index, written=written)


def sensor_of(name: str) -> Heading | None:
    """What a sensor measures, by the name of its file or sheet; None: it names none."""
    said = set(_tokens(name))
    linear = bool(said & words.LINEAR)
    if said & words.RATE:
        return Heading("rate")
    return Heading("acceleration", linear=linear) if said & words.ACCELERATION else None


def _without_unit(text: str) -> tuple[str, str]:
    """The text without its unit, and the unit as written."""
    for found in _BRACKETS.finditer(text):
        inside = next(filter(None, found.groups()), "")
        if header_unit(inside):
            return text[: found.start()] + " " + text[found.end() :], inside
    unknown = _BRACKETS.search(text.strip())
    if unknown and unknown.end() == len(text.strip()):
        return text[: unknown.start()], next(filter(None, unknown.groups()), "")
    tokens = re.split(r"_+", text.strip().lower())
    for i, token in enumerate(tokens[1:], start=1):
        after = tokens[i + 1] if i + 1 < len(tokens) else ""
        if token in _SUFFIXES or (token in _SHORT_SUFFIXES and i == len(tokens) - 1):
            per = after in ("s", "sec")
            rest = [*tokens[:i], *tokens[i + 1 + per :]]
            return "_".join(rest), f"{token}/s" if per else token
    behind = _BEHIND.match(text.strip())
    if behind and (len(behind[2]) > 1 or "/" in text or "°" in behind[2] or " in " in text):
        unit = header_unit(behind[2])
        if unit and behind[2].lower() not in words.POSITION | words.TIME:
            return behind[1], behind[2]
        if unit and re.search(r"/|\sin\s|\sen\s|,", text):
            return behind[1], behind[2]
    return text, ""


def _implied(tokens: list[str]) -> str:
    """The unit that a label is itself, "ms", or that a program always means; empty: none."""
    if any(re.fullmatch(r"gf[xyz]?", each) for each in tokens):
        return "g"
    return tokens[0] if len(tokens) == 1 and tokens[0] in _TIMES else ""


def _tokens(text: str) -> list[str]:
    """Its words, small, without accents; a number at a word's end is a word of its own."""
    dotted = _DOTTED.sub("thetadot", unicodedata.normalize("NFD", text))
    spaced = re.sub(r"(?<=[a-z])(?=[A-Z](?:[a-z]{2}|$|[^A-Za-z]))", " ", dotted.translate(_GREEK))
    letters = unicodedata.normalize("NFKD", spaced)
    plain = "".join(each for each in letters if not unicodedata.combining(each)).lower()
    return re.findall(r"[a-z]+|\d+", plain)


def _meaning(text: str, tokens: list[str], unit: str) -> Heading:
    """The kind, from the words first, then from the unit."""
    said = set(tokens)
    index = next((each for each in tokens if each.isdigit()), "") or _letter(tokens)
    run = _run_of(text)
    swings = _swings_of(text.lower(), tokens)
    axis = _axis_of(tokens)
    found = Heading(
        axis=axis,
        absolute=bool(said & words.ABSOLUTE),
        index="" if run or swings else index,
        run=run,
        computed=any(
            each.startswith(words.SIMULATED) and each not in words.NOT_SIMULATED for each in said
        ),
        upright=bool(said & words.UPRIGHT),
        linear=bool(said & words.LINEAR),
        swings=swings,
    )
    kind = _kind(text.strip(), said, unit, axis, swings)
    if kind.endswith("?"):
        return replace(found, kind=kind[:-1], weak=True)
    if kind in ("x", "y"):
        return replace(found, kind=kind, weak="pixel" in said or bool(said & {"pixelx", "pixely"}))
    return replace(found, kind=kind)


def _kind(text: str, said: set[str], unit: str, axis: str, swings: int | None) -> str:
    """The kind that words and unit name; a question mark behind it: it is weak."""
    of_unit = _KINDS_OF_UNITS.get(unit, "")
    starting = said & words.AMPLITUDE or (said & words.START and said & words.ANGLE)
    angle = "angle?" if said & words.WEAK_ANGLE else "angle"
    timed = _kind_of_time(text, said, swings) if unit in ("", "s") else ""
    found = (
        ("other", said & words.ERROR),
        (timed, timed),
        ("other", of_unit == "rate" and said & words.OTHER and not said & words.RATE),
        ("other", of_unit == "time"),
        (of_unit, of_unit not in ("", "angle")),
        ("amplitude", starting),
        (angle, of_unit == "angle"),
        ("other", unit not in ("", "m", "px")),
        (_kind_of_place(said, axis), unit),
        (_kind_by_words(said, axis), True),
    )
    return next(kind for kind, holds in found if holds)


def _kind_of_time(text: str, said: set[str], swings: int | None) -> str:
    """The kind of a column whose unit is that of a time, or not told."""
    if swings is not None or said & words.PERIOD or text == "T":
        return "period"
    if said & words.TIME and not said & (words.NOT_TIME | words.VELOCITY | words.ANGLE):
        return "time"
    counted = {each for each in said if each.isdigit() or each in ("st", "nd", "rd", "th", "ra")}
    return "trial" if said & words.RUN and not said - words.RUN - counted else ""


def _kind_of_place(said: set[str], axis: str) -> str:
    """The kind of a column whose unit is a length or a pixel."""
    if said & words.LENGTH and not axis:
        return "length"
    return axis if axis in ("x", "y") and not said & words.VELOCITY else "other"


def _kind_by_words(said: set[str], axis: str) -> str:
    """The kind by the words alone."""
    angular = said & (words.ANGULAR | words.ANGLE)
    moving = said & {*words.VELOCITY, "v"}
    turning = said & words.RATE or any(map(_OF_RATE.fullmatch, said))
    accelerated = said & words.ACCELERATION or any(map(_OF_ACCELERATION.fullmatch, said))
    whole = axis or said & words.ABSOLUTE or len(said) == 1
    place = axis if axis in ("x", "y") else "other"
    found = (
        ("rate", turning or (angular and said & words.VELOCITY)),
        ("other", angular and (accelerated or said & {"v", "p"})),
        ("angle?", angular and said & {"a", "b"}),  # Tracker's θ_a, or the angle of a body a
        ("angle", angular),
        ("acceleration", accelerated and whole),
        ("force", said & words.FORCE),
        (place, axis and not moving and not said & (words.OTHER - words.POSITION)),
        ("length", said & words.LENGTH),
        ("angle?", said & words.WEAK_ANGLE),
        ("frame", said & words.FRAME and not axis),
        ("gate", said & words.GATE),
        ("other", said & words.OTHER or axis),
        ("", True),
    )
    return next(kind for kind, holds in found if holds)


def _axis_of(tokens: list[str]) -> str:
    """The axis that a word is, or ends or begins with: "x", "ax", "gyroX", "wx", "pixelx"."""
    for each in tokens:
        if each in ("x", "y", "z"):
            return each
    for each in tokens:
        if re.fullmatch(r"(a|acc|acce|g|gyr|gyro|w|pos|pixel|c|omega|gf|rot)[xyz]", each):
            return each[-1]
        if re.fullmatch(r"[xy](m|pos|p|c|coord|cm)", each):
            return each[0]
    return ""


def _letter(tokens: list[str]) -> str:
    """A body named by a letter: "mass A", "x_b"; or by a number."""
    if any(each.isdigit() for each in tokens):
        return next(each for each in tokens if each.isdigit())
    return next((each for each in tokens if each in ("a", "b", "c") and len(tokens) > 1), "")


def _run_of(text: str) -> str:
    """The run that a text names: "Run 1", "Série #37", "2nd run"."""
    tokens = _tokens(text)
    number = _RUN_NUMBER.search(text) or _ORDINAL.search(text.lower())
    if number:
        return number[1]
    for name, after in pairwise(tokens):
        if name in words.RUN and (after.isdigit() or len(after) == 1):
            return after
    return ""


def _swings_of(text: str, tokens: list[str]) -> int | None:
    """Of how many swings a time is, where the text says so."""
    found = _MULTIPLE.search(text) or _OF_MULTIPLE.search(text)
    if found:
        return int(found[1])
    for name, after in pairwise(tokens):
        if name in words.NUMBERS and re.fullmatch(words.SWINGS, after):
            return words.NUMBERS[name]
    return None
