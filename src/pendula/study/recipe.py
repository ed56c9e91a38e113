"""Reading a recipe: a TOML file that may name only what it changes."""

from __future__ import annotations

import re
import tomllib
from dataclasses import fields
from importlib import resources
from typing import TYPE_CHECKING, Any

from pendula._recipe_file import RecipeFile, as_toml
from pendula.study.checks import check
from pendula.study.schema import SECTIONS, Recipe, Rule, TextRule

if TYPE_CHECKING:
    from pendula._recipe_file import RecipeSource

    Tree = dict[str, dict[str, Any]]


def read_recipe(path: RecipeSource | None) -> Recipe:
    """The recipe in a file, or the study's own.

    Args:
        path: a TOML file, or a dict of its tables; what it leaves out is taken from the study's
            own recipe.

    Raises:
        ValueError: for a broken recipe: one line naming file, line, key, rule and value.
        OSError: if the file cannot be read.
    """
    default = resources.files("pendula.study").joinpath("default.toml").read_text("utf-8")
    reader = _Reader(path, tomllib.loads(default))
    parts = {name: reader.section(name) for name in SECTIONS}
    text = _resolved(default, reader.tree)
    recipe = Recipe(**parts, text=text, own=text != default, place=reader.place)
    check(recipe, reader.blame)
    return recipe


class _Reader:
    """One recipe file over the default one."""

    def __init__(self, path: RecipeSource | None, default: Tree) -> None:
        self._file = RecipeFile("default.toml", "") if path is None else RecipeFile.read(path)
        self._default = default
        self._file.check_tables(SECTIONS)
        self._file.check_keys(default)
        given = self._file.tables
        self.place, self.blame = self._file.place, self._file.blame
        self.tree: Tree = {name: default[name] | given.get(name, {}) for name in default}

    def section(self, name: str) -> Any:
        """One table of the recipe, every value converted to SI units and checked."""
        rows = fields(SECTIONS[name])
        return SECTIONS[name](
            **{f.name: self._value(name, f.name, f.metadata["rule"]) for f in rows}
        )

    def _value(self, section: str, key: str, rule: Rule | TextRule) -> Any:
        raw = self.tree[section][key]
        if not rule.many:
            return self._one(section, key, rule, raw)
        if not isinstance(raw, list) or not raw:
            raise self._wrong(section, key, "must be a list of at least one value", raw)
        return tuple(self._one(section, key, rule, each) for each in raw)

    def _one(self, section: str, key: str, rule: Rule | TextRule, raw: Any) -> float | str:
        if isinstance(rule, TextRule):
            return self._text(section, key, rule, raw)
        read = self._number if rule.unit is None else self._quantity
        value = read(section, key, rule, raw)
        if not rule.allows(value):
            raise self._wrong(section, key, f"must be {rule.range()}", raw)
        return value

    def _text(self, section: str, key: str, rule: TextRule, raw: Any) -> str:
        if broken := rule.broken_by(raw):
            raise self._wrong(section, key, broken, raw, rule.way_out(key, raw))
        return str(raw)

    def _number(self, section: str, key: str, rule: Rule, raw: Any) -> float:
        if rule.whole and isinstance(raw, float) and raw.is_integer():
            raw = int(raw)
        kinds = (int,) if rule.whole else (int, float)
        if not isinstance(raw, kinds) or isinstance(raw, bool):
            word = "a whole number" if rule.whole else "a number"
            raise self._wrong(section, key, f"must be {word}, without quotes", raw)
        return raw

    def _quantity(self, section: str, key: str, rule: Rule, raw: Any) -> float:
        if not isinstance(raw, str):
            raise self._wrong(section, key, "needs a quantity with its unit, in quotes", raw)
        return self._file.quantity(section, key, str(rule.unit), raw)

    def _wrong(self, section: str, key: str, rule: str, raw: Any, way_out: str = "") -> ValueError:
        example = f"{key} = {as_toml(self._default[section][key])}"
        way_out = way_out or f"the study's own is {example}"
        message = f"{section}.{key} {rule}, got {as_toml(raw)}; {way_out}"
        return self.blame(section, (key,), message)


def _resolved(default: str, tree: Tree) -> str:
    """The default recipe's text, comments and all, with the values of this one."""
    section, lines = "", []
    for line in default.splitlines():
        if header := re.match(r"\[(\w+)\]", line):
            section = header[1]
        key = re.match(r"(\w+) = ", line)
        lines.append(f"{key[1]} = {as_toml(tree[section][key[1]])}" if key else line)
    return "\n".join(lines) + "\n"
