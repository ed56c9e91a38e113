"""A recipe in TOML: its tables, and on which line a mistake stands."""

from __future__ import annotations

import json
import math
import re
import tomllib
from collections.abc import Mapping
from contextlib import contextmanager
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from pendula._engine import option_unit
from pendula._messages import ArgumentError, Message, Naming, meant, message_of
from pendula.units import quantity

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    RecipeSource = str | PathLike[str] | Mapping[str, Any]

_DEEPEST = 50
_OLD_NAMES = {"t_max": "until"}  # what keys were called before; files with them are still read


class RecipeFile:
    """The tables of one file, and errors that name the file and the line.

    Args:
        name: of the file, for errors.
        text: what it holds.

    Raises:
        ValueError: for what is not TOML.
    """

    def __init__(self, name: str, text: str) -> None:
        self.name, self._text = name, text
        self._known: Mapping[str, Iterable[str]] = {}
        self.tables = {name: _renamed(table) for name, table in self._parsed().items()}

    @classmethod
    def read(cls, recipe: RecipeSource) -> RecipeFile:
        """The recipe in a file, or in a dict of its tables.

        Raises:
            ValueError: for what is not TOML, or not text.
            OSError: if the file cannot be read.
        """
        if isinstance(recipe, Mapping):
            made = cls("recipe", "")
            made.tables = {name: _renamed(table) for name, table in _plain(recipe).items()}
            return made
        if not isinstance(recipe, str | PathLike):
            rule = "must be the path of a TOML file, or a dict of its tables; got {value}"
            raise ArgumentError("recipe", rule, value=recipe)
        path = Path(recipe)
        try:
            return cls(str(path), path.read_text(encoding="utf-8-sig"))
        except FileNotFoundError:
            way_out = "give the path of a recipe in TOML"
            raise FileNotFoundError(f"there is no file {path}; {way_out}") from None
        except UnicodeDecodeError as error:
            line = path.read_bytes()[: error.start].count(b"\n") + 1
            raise ValueError(f"{path}, line {line}: not UTF-8 text; save it as UTF-8") from None

    def place(self, *keys: tuple[str, str]) -> str:
        """The file, and the line of the first of some (table, key) that it sets."""
        new_and_old = ((table, name) for table, key in keys for name in (key, _OLD_NAMES.get(key)))
        lines = [
            _line_of(self._text, table, name) for table, name in new_and_old if name is not None
        ]
        line = next(filter(None, lines), 0)
        return f"{self.name}, line {line}" if line else self.name

    def blame(self, section: str, keys: Iterable[str], message: str) -> ValueError:
        """The error to raise for some keys: with the file and the line."""
        return ValueError(f"{self.place(*((section, key) for key in keys))}: {message}")

    @contextmanager
    def blaming(self, section: str, *keys: str) -> Iterator[None]:
        """Add to errors raised inside the line of the key they are about, or else of these."""
        try:
            yield
        except ValueError as error:
            message = message_of(error)
            if isinstance(message, Message):
                keys = (message.argument, *keys) if message.argument else keys
                message = message.named(_Keys(section, self._known.get(section, ())))
            raise self.blame(section, keys, message) from None

    def check_tables(self, known: Iterable[str]) -> None:
        """Refuse tables that are not among those known, and keys outside of tables.

        Raises:
            ValueError: naming the nearest known one, or all.
        """
        for name, table in self.tables.items():
            if name not in known:
                unknown = f"unknown {'table' if isinstance(table, dict) else 'key'} {name!r}"
                raise self.blame(name, ("",), f"{unknown}; {suggestion(name, known)}")
            if not isinstance(table, dict):
                raise self.blame(name, ("",), f"{name} must be a table; write [{name}]")

    def check_keys(self, known: Mapping[str, Iterable[str]]) -> None:
        """Refuse keys of a table that are not among those known.

        Raises:
            ValueError: naming the nearest known one, or all.
        """
        self._known = known
        for name, keys in known.items():
            for key in self.tables.get(name, {}):
                if key not in keys:
                    unknown = f"unknown key {key!r} in [{name}]"
                    raise self.blame(name, (key,), f"{unknown}; {suggestion(key, keys)}")

    def quantity(self, section: str, key: str, unit: str, raw: str) -> float:
        """A quantity that stands at a key, in SI units.

        Raises:
            ValueError: for what is no quantity of this kind.
        """
        with self.blaming(section, key):
            return quantity(raw, unit, key)

    def _parsed(self) -> dict[str, Any]:
        try:
            tables = tomllib.loads(self._text)
            if _too_deep(tables):
                raise RecursionError
            return tables
        except tomllib.TOMLDecodeError as error:
            place = re.search(r"\s*\(at line (\d+), column (\d+)\)", str(error))
            line = int(place[1]) if place else len(self._text.splitlines())
            what = re.sub(r"\s*\(at [^)]*\)$", "", str(error))
            hint = _hint(self._text.splitlines()[line - 1 : line], what)
            raise ValueError(f"{self.name}, line {line}: not TOML: {what}; {hint}") from None
        except RecursionError:
            rule = f"tables and lists must be at most {_DEEPEST} within one another"
            raise ValueError(f"{self.name}: not a recipe: {rule}") from None


class _Keys(Naming):
    """Arguments as the keys of a table."""

    def __init__(self, section: str, known: Iterable[str]) -> None:
        self._section, self._known = section, tuple(known)

    def argument(self, name: str) -> str:
        """A key with its table; what is no key of it, as Python names it."""
        return f"{self._section}.{name}" if name in self._known else name

    def given(self, name: str, value: str) -> str:
        """A line of the table."""
        unit = option_unit(name)
        return f'{name} = "{value} {unit}"' if unit else f"{name} = {value}"


def _too_deep(tables: dict[str, Any]) -> bool:
    """Whether tables and lists lie deeper within one another than recursion could follow."""
    level: list[Any] = [tables]
    for _ in range(_DEEPEST):
        inside = (each.values() if isinstance(each, dict) else each for each in level)
        level = [each for part in inside for each in part if isinstance(each, dict | list)]
    return bool(level)


def _renamed(table: Any) -> Any:
    """A table with the names that its keys have now."""
    if not isinstance(table, dict):
        return table
    now = {old: new for new, old in _OLD_NAMES.items() if new not in table}
    return {now.get(key, key): value for key, value in table.items()}


def suggestion(name: str, known: Iterable[str]) -> str:
    """The known name that was meant, or all of them."""
    return meant(name, known) or f"there are {', '.join(known)}"


def _hint(lines: list[str], what: str) -> str:
    """The way out of a line that is not TOML."""
    line = lines[0].strip() if lines else ""
    if any(word in what for word in ("overwrite", "twice", "already", "mutate")):
        return "name each table and each key once"
    if set(line) & set("“”„«»‘’"):
        return 'use straight quotes, as in length = "50 cm"'
    if line.startswith("["):
        name = re.sub(r"[^\w.]", "", line.partition("#")[0]) or "run"
        return f"write a table's name in brackets, on a line of its own: [{name}]"
    if line and "=" not in line and line[0] not in "\"']}":
        return 'write each line as key = "value"'
    if line.count('"') % 2:
        return 'close the quotes, as in length = "50 cm"'
    return 'write text and quantities in quotes, as in length = "50 cm"'


def _plain(value: Any, depth: int = 0) -> Any:
    """Tables in a dict as TOML would give them: lists for tuples and arrays, Python's numbers."""
    if depth > _DEEPEST:
        rule = f"must have tables and lists at most {_DEEPEST} within one another"
        raise ArgumentError("recipe", rule)
    if isinstance(value, Mapping):
        return {str(key): _plain(each, depth + 1) for key, each in value.items()}
    if hasattr(value, "tolist"):  # numpy
        return value.tolist()
    if isinstance(value, list | tuple):
        return [_plain(each, depth + 1) for each in value]
    return value


def as_toml(value: Any) -> str:
    """A value of a recipe as TOML."""
    if isinstance(value, list):
        return "[" + ", ".join(map(as_toml, value)) + "]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {as_toml(each)}" for key, each in value.items()) + " }"
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    # Text, numbers and truth values are written in TOML as in JSON; a date is only ever shown.
    return json.dumps(value, ensure_ascii=False, default=str)


def _line_of(text: str, section: str, key: str) -> int:
    """The line (from 1) on which a recipe sets a key, or opens its table; 0 if it does neither."""
    table, opened = list[str](), 0
    for number, line in enumerate(text.splitlines(), start=1):
        header = re.match(r"\s*\[+\s*([^\]#]+?)\s*\]", line)
        if header:
            table = _parts(header[1])
            if key and table[:2] == [section, key]:
                return number
            opened = number if table == [section] and not key else opened
            continue
        name = re.match(r"""\s*([\w."' -]+?)\s*=""", line)
        if name:
            path = table + _parts(name[1])
            if path[:2] == [section, key] or path == [section]:
                return number
    return opened


def _parts(name: str) -> list[str]:
    """The parts of a dotted name."""
    return [part.strip(" \"'") for part in name.split(".")]
