"""The address of the laboratory: what stands after the # of a link is the recipe of a run.

    lab.html#system=double&form=rods&m1=1&…&state=2.0943951023931953,0,0,0&t_max=10&method=taylor

* Entries key=value are joined by &, each key once. Reserved characters are percent-encoded; a +
  is a plus sign, not a space.
* Keys are named as Python's arguments are: those of `address.json`, the parameters of the system's
  form, and the options of a run (step, tolerance, max_steps, certify, digits) of the catalogue.
* A number is decimal, with a point, finite, in SI units and radians. The shortest decimal form that
  gives the double back is written, so that a link carries every bit: -0 keeps its sign.
* A list has commas: the state is the components in the catalogue's order.
* What is left out is standard. A writer names every parameter but those that are zero and would
  be, left out.
* Nothing is clamped or ignored: an unknown key, a name that is none, a value out of range and an
  option that the method does not take are refused.
* The keys of the page (`address.json`, "page") choose what is shown; they do not change a run.

The page reads and writes the same: `tests/data/addresses.json` has the cases of both.
"""

from __future__ import annotations

import json
import re
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote

from pendula._checks import finite_number, number_pair, one_of
from pendula._engine import methods
from pendula._messages import ArgumentError

if TYPE_CHECKING:
    from collections.abc import Iterable

_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?", re.ASCII)
_WRITE = "write key=value pairs joined by &, such as {text}"
_EXAMPLE = "#system=simple&t_max=10"


def is_link(text: str) -> bool:
    """Whether it is a link rather than the path of a file, which may have a # in its name."""
    return "://" in text or (re.search(r"#\w+=", text) is not None and not Path(text).exists())


def entries_of(link: str) -> dict[str, str]:
    """The entries after the # of a link, decoded.

    Raises:
        ArgumentError: where there are none, or one is no pair, or stands twice.
    """
    if not isinstance(link, str):
        raise ArgumentError("", "must be text, got {value}", _WRITE, text=_EXAMPLE, value=link)
    _, mark, fragment = link.strip().partition("#")
    if not mark or not fragment:
        rule = "no recipe follows a #, got {value}"
        raise ArgumentError("", rule, _WRITE, text=_EXAMPLE, value=link)
    entries: dict[str, str] = {}
    for pair in fragment.split("&"):
        key, equals, value = pair.partition("=")
        if not key or not equals:
            raise ArgumentError(key or "an entry", "has no value", _WRITE, text=_EXAMPLE)
        if key in entries:
            raise ArgumentError(key, "stands twice", "leave one of the two out")
        entries[key] = _decoded(key, value)
    return entries


def number_of(key: str, text: str) -> float:
    """A number as links write it.

    Raises:
        ArgumentError: for anything else, and for what no double is near.
    """
    if not _NUMBER.fullmatch(text):
        rule = "must be a number in SI units and radians, such as 0.5 or 1e-9, got {value}"
        raise ArgumentError(key, rule, value=text)
    found = finite_number(key, float(text))
    if found == 0.0 and re.search("[1-9]", re.split("[eE]", text)[0]):
        rule = "must not be nearer to zero than the smallest number, got {value}"
        raise ArgumentError(key, rule, value=text)
    return found


def numbers_of(key: str, text: str) -> list[float]:
    """A list of numbers, as `number_of` each."""
    return [number_of(key, each) for each in text.split(",")]


def written(value: float | int) -> str:
    """A number in its shortest decimal form that gives its bits back."""
    if isinstance(value, int):
        return str(value)
    return repr(value).removesuffix(".0").replace("e+", "e")


def link_of(entries: Iterable[tuple[str, str]]) -> str:
    """The # and the entries, which need no encoding: names and numbers."""
    return "#" + "&".join(f"{key}={value}" for key, value in entries)


@cache
def rows(part: str) -> dict[str, dict[str, Any]]:
    """The keys of a part of `address.json`, "recipe" or "page", and what each is."""
    found = json.loads(Path(__file__).with_name("address.json").read_text(encoding="utf-8"))
    return {row.pop("key"): row for row in found[part]}


def check_page(key: str, text: str) -> None:
    """Refuse a value that a key of the page does not take.

    Raises:
        ArgumentError: naming the key and what it takes.
    """
    row = rows("page")[key]
    if row["kind"] == "choice":
        one_of(key, text, row["choices"])
    elif row["kind"] == "methods":
        _check_methods(key, text, row["most"])
    elif row["kind"] == "range":
        low, high = number_pair(key, numbers_of(key, text), "must be two numbers", "rad")
        if not low < high:
            raise ArgumentError(key, "must rise, got {value}", value=text)
    else:
        found = number_of(key, text)
        if not row["least"] <= found <= row["most"]:
            rule = "must lie between {least} and {most}, got {value}"
            raise ArgumentError(key, rule, least=row["least"], most=row["most"], value=found)


def _check_methods(key: str, text: str, most: int) -> None:
    """Refuse names that are no methods, and too many."""
    names = text.split(",")
    for name in names:
        one_of(key, name, ("exact", *(each.name for each in methods())))
    if len(names) > most or len(set(names)) < len(names):
        rule = "must name at most {most} methods, each once, got {value}"
        raise ArgumentError(key, rule, most=most, value=text)


def _decoded(key: str, value: str) -> str:
    try:
        return unquote(value, errors="strict")
    except UnicodeDecodeError:
        raise ArgumentError(key, "is not UTF-8 text, got {value}", value=value) from None
