"""Reading a recipe: a TOML file that may name only what it changes."""

from __future__ import annotations

import difflib
import json
import math
import re
import tomllib
from dataclasses import fields
from importlib import resources
from typing import TYPE_CHECKING, Any

from pendula.study.checks import check
from pendula.study.schema import SECTIONS, Recipe, Rule
from pendula.units import quantity

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    Tree = dict[str, dict[str, Any]]


def read_recipe(path: Path | None) -> Recipe:
    """The recipe in a file, or the study's own.

    Args:
        path: a TOML file; what it leaves out is taken from the study's own recipe.

    Raises:
        ValueError: for a broken recipe: one line naming file, line, key, rule and value.
        OSError: if the file cannot be read.
    """
    default = resources.files("pendula.study").joinpath("default.toml").read_text("utf-8")
    reader = _Reader(path, tomllib.loads(default))
    parts = {name: reader.section(name) for name in SECTIONS}
    recipe = Recipe(**parts, text=_resolved(default, reader.tree), place=reader.place)
    check(recipe, reader.blame)
    return recipe


class _Reader:
    """One recipe file over the default one; knows on which line a key stands."""

    def __init__(self, path: Path | None, default: Tree) -> None:
        self._name = str(path) if path else "default.toml"
        self._text = _text(path) if path else ""
        self._default = default
        given = self._parse()
        self._check_names(given)
        self.tree: Tree = {name: default[name] | given.get(name, {}) for name in default}

    def section(self, name: str) -> Any:
        """One table of the recipe, every value converted to SI units and checked."""
        rows = fields(SECTIONS[name])
        return SECTIONS[name](
            **{f.name: self._value(name, f.name, f.metadata["rule"]) for f in rows}
        )

    def place(self, *keys: tuple[str, str]) -> str:
        """The file, and the line of the first of some (table, key) that it sets."""
        lines = [_line_of(self._text, *each) for each in keys]
        line = next(filter(None, lines), 0)
        return f"{self._name}, line {line}" if line else self._name

    def blame(self, section: str, keys: Iterable[str], message: str) -> ValueError:
        """The error to raise for some keys: with the file and the line."""
        return ValueError(f"{self.place(*((section, key) for key in keys))}: {message}")

    def error(self, section: str, key: str, message: str) -> ValueError:
        """The error to raise for a key."""
        return self.blame(section, (key,), message)

    def _parse(self) -> dict[str, Any]:
        try:
            return tomllib.loads(self._text)
        except tomllib.TOMLDecodeError as error:
            place = re.search(r"\s*\(at line (\d+), column (\d+)\)", str(error))
            line = int(place[1]) if place else len(self._text.splitlines())
            what = re.sub(r"\s*\(at [^)]*\)$", "", str(error))
            hint = 'write text and quantities in quotes, as in length = "50 cm"'
            raise ValueError(f"{self._name}, line {line}: not TOML: {what}; {hint}") from None

    def _check_names(self, given: dict[str, Any]) -> None:
        for section, table in given.items():
            if section not in SECTIONS:
                unknown = f"unknown {'table' if isinstance(table, dict) else 'key'} {section!r}"
                raise self.error(section, "", f"{unknown}; {_suggestion(section, SECTIONS)}")
            if not isinstance(table, dict):
                raise self.error(section, "", f"{section} must be a table; write [{section}]")
            for key in table:
                if key not in self._default[section]:
                    hint = _suggestion(key, self._default[section])
                    raise self.error(section, key, f"unknown key {key!r} in [{section}]; {hint}")

    def _value(self, section: str, key: str, rule: Rule) -> Any:
        raw = self.tree[section][key]
        if not rule.many:
            return self._one(section, key, rule, raw)
        if not isinstance(raw, list) or not raw:
            raise self._wrong(section, key, "must be a list of at least one value", raw)
        return tuple(self._one(section, key, rule, each) for each in raw)

    def _one(self, section: str, key: str, rule: Rule, raw: Any) -> float:
        read = self._number if rule.unit is None else self._quantity
        value = read(section, key, rule, raw)
        if not rule.allows(value):
            raise self._wrong(section, key, f"must be {rule.range()}", raw)
        return value

    def _number(self, section: str, key: str, rule: Rule, raw: Any) -> float:
        kinds = (int,) if rule.whole else (int, float)
        if not isinstance(raw, kinds) or isinstance(raw, bool):
            word = "a whole number" if rule.whole else "a number"
            raise self._wrong(section, key, f"must be {word}, without quotes", raw)
        return raw

    def _quantity(self, section: str, key: str, rule: Rule, raw: Any) -> float:
        if not isinstance(raw, str):
            raise self._wrong(section, key, "needs a quantity with its unit, in quotes", raw)
        try:
            return quantity(raw, str(rule.unit), f"{section}.{key}")
        except ValueError as error:
            raise self.error(section, key, str(error)) from None

    def _wrong(self, section: str, key: str, rule: str, raw: Any) -> ValueError:
        example = f"{key} = {_toml(self._default[section][key])}"
        message = f"{section}.{key} {rule}, got {_toml(raw)}; the study's own is {example}"
        return self.error(section, key, message)


def _text(path: Path) -> str:
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        line = path.read_bytes()[: error.start].count(b"\n") + 1
        raise ValueError(f"{path}, line {line}: not UTF-8 text; save it as UTF-8") from None


def _suggestion(name: str, known: Iterable[str]) -> str:
    close = difflib.get_close_matches(name, known, n=1)
    return f"did you mean {close[0]!r}?" if close else f"there are {', '.join(known)}"


def _line_of(text: str, section: str, key: str) -> int:
    """The line (from 1) on which a recipe sets a key, or opens its table; 0 if it does neither."""
    table, opened = "", 0
    for number, line in enumerate(text.splitlines(), start=1):
        header = re.match(r"\s*\[+\s*([^\]#]+?)\s*\]", line)
        if header:
            table = header[1].strip("\"'")
            opened = number if table == section and not key else opened
            continue
        name = re.match(r"""\s*([\w."' -]+?)\s*=""", line)
        if not name:
            continue
        parts = [part.strip(" \"'") for part in name[1].split(".")]
        path = ([table] if table else []) + parts
        if path in ([section, key], [section]):
            return number
    return opened


def _resolved(default: str, tree: Tree) -> str:
    """The default recipe's text, comments and all, with the values of this one."""
    section, lines = "", []
    for line in default.splitlines():
        if header := re.match(r"\[(\w+)\]", line):
            section = header[1]
        key = re.match(r"(\w+) = ", line)
        lines.append(f"{key[1]} = {_toml(tree[section][key[1]])}" if key else line)
    return "\n".join(lines) + "\n"


def _toml(value: Any) -> str:
    """A value of a recipe as TOML."""
    if isinstance(value, list):
        return "[" + ", ".join(map(_toml, value)) + "]"
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    # Text, numbers and truth values are written in TOML as in JSON; a date is only ever shown.
    return json.dumps(value, ensure_ascii=False, default=str)
