"""Messages as data: what a rule says, filled in and named by whoever shows it.

A template names values in braces and arguments in angle brackets: "must not exceed the span of
{span} s from <t0> to the end, got {value}; give <step=0.001>", or "use <call=solve>". Python shows
`step=0.001`, the command `--step 0.001s`; each has a `Naming`. Any exception can carry a `Message`
as its first argument.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterable

_PLACES = re.compile(r"<([\w{}]+)(?:=([^<>]*))?>|\{(\w+)\}")
_BRACES = re.compile(r"\{(\w+)\}")
# details shown without quotes
_PLAIN = ("choices", "place", "constant", "system", "form", "other", "text", "path")
_LONGEST = 300  # characters of a value, or of another library's error
_MANY_DIGITS = re.compile(r"\d{40,}")  # no double is written with so many
_JOINED = {"choices": ", ", "any_of": " or "}


class Naming:
    """How Python shows arguments and values."""

    def argument(self, name: str) -> str:
        """An argument, by its name."""
        return name

    def given(self, name: str, value: str) -> str:
        """How an argument is given that value."""
        return f"{name}={value}"

    def call(self, name: str) -> str:
        """A function of the package, or a call that was made before."""
        return name

    def value(self, name: str, value: object) -> str:
        """A value, by its name in the template."""
        if isinstance(value, list | tuple) and name in _JOINED:
            return _JOINED[name].join(map(str, value))
        if isinstance(value, float) and name not in ("value", "t0", "span"):
            return f"{value:g}"
        return str(value) if name in _PLAIN else one_line(_MANY_DIGITS.sub(_few, _written(value)))


PYTHON = Naming()


class Message(str):
    """A sentence that can be made again with other names for the arguments.

    Attributes:
        argument: the one it is about; empty: none.
        rule: the template, without the argument in front.
        way_out: another template; empty: none.
        details: what the templates name.
    """

    __slots__ = ("argument", "details", "rule", "way_out")

    argument: str
    rule: str
    way_out: str
    details: dict[str, Any]

    def __new__(cls, argument: str, rule: str, way_out: str = "", **details: Any) -> Message:
        """The sentence in Python's words."""
        made = super().__new__(cls, _sentence(PYTHON, argument, rule, way_out, details))
        made.argument, made.rule, made.way_out, made.details = argument, rule, way_out, details
        return made

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled with its data: errors cross from workers to whoever waits for them."""
        return _message, (self.argument, self.rule, self.way_out, self.details)

    def named(self, naming: Naming) -> str:
        """The sentence in other names."""
        return _sentence(naming, self.argument, self.rule, self.way_out, self.details)


class ArgumentError(ValueError):
    """A bad argument: its name, the rule it breaks, the value, and the way out.

    Args:
        argument: its name.
        rule: a template that follows the name.
        way_out: another, after a semicolon.
        **details: what they name; `unit` is the argument's, shown as {in_unit}.
    """

    def __init__(self, argument: str, rule: str, way_out: str = "", **details: Any) -> None:
        self.message = Message(argument, rule, way_out, **details)
        super().__init__(self.message)

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickled with its data, of whichever subclass it is."""
        return _error, (type(self), self.message), vars(self)

    @property
    def argument(self) -> str:
        """Name of the argument."""
        return self.message.argument


def message_of(error: BaseException) -> str:
    """What an error says: a `Message`, where it carries one."""
    first = error.args[0] if error.args else ""
    return first if isinstance(first, Message) else str(error)


def meant(given: object, known: Iterable[str]) -> str:
    """The way out of a name that is none: the known one most like it; empty: none is."""
    import difflib

    names = {each.lower(): each for each in known}
    close = difflib.get_close_matches(str(given).lower(), names, n=1)
    return f"did you mean {names[close[0]]!r}?" if close else ""


def _written(value: object) -> str:
    try:
        return repr(value)
    except ValueError:  # Python writes no whole number of more than 4300 digits
        return "a number of thousands of digits"


def _few(digits: re.Match[str]) -> str:
    return f"{digits[0][:6]}… ({len(digits[0])} digits)"


def one_line(said: object) -> str:
    """What a library's error says, or a value is, of however many lines, in one, shortened."""
    text = str(said)
    line = " ".join(text.split()) if "\n" in text else text
    return line if len(line) <= _LONGEST else f"{line[:_LONGEST]} …"


def _message(argument: str, rule: str, way_out: str, details: dict[str, Any]) -> Message:
    return Message(argument, rule, way_out, **details)


def _error(kind: type[ArgumentError], message: Message) -> ArgumentError:
    return kind.__new__(kind, message)


def _sentence(
    naming: Naming, argument: str, rule: str, way_out: str, details: dict[str, Any]
) -> str:
    subject = naming.argument(argument)
    space = "" if not argument or rule.startswith(":") else " "
    sentence = f"{rule}; {way_out}" if way_out else rule
    return f"{subject}{space}{_filled(naming, sentence, details)}"


def _filled(naming: Naming, template: str, details: dict[str, Any]) -> str:
    unit = details.get("unit")

    def plain(text: str) -> str:
        return _BRACES.sub(lambda match: f"{details[match[1]]}", text)

    def filled(place: re.Match[str]) -> str:
        argument, given, name = place.groups()
        if name == "in_unit":
            return f" [{unit}]" if unit else ""
        if name:
            return naming.value(name, details[name]) if name in details else place[0]
        shown, equals, value = plain(
            argument if given is None else f"{argument}={given}"
        ).partition("=")
        if shown == "call":
            return naming.call(value)
        return naming.given(shown, value) if equals else naming.argument(shown)

    return _PLACES.sub(filled, template)
