"""Sentences about fits and models, one file a language beside this one."""

from __future__ import annotations

import math
import re
import tomllib
from dataclasses import dataclass, field
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING

from pendula._checks import one_of

if TYPE_CHECKING:
    from collections.abc import Mapping

LANGUAGES = ("en", "es")
_MINUS = "−"
_NUMBER = re.compile(r"\d+\.\d+")


@dataclass(frozen=True)
class Note:
    """Something that has to be known about a fit, as data that either language words.

    Attributes:
        key: of the sentence, in words/en.toml and words/es.toml.
        details: what it names: numbers, names of parameters and models.
    """

    key: str
    details: Mapping[str, float | str | tuple[str, ...]] = field(default_factory=dict)

    def sentence(self, language: str = "en") -> str:
        """The sentence in a language.

        Raises:
            ValueError: for a language that there is none of.
        """
        words = _words(language)
        shown = {name: _shown(value, words) for name, value in self.details.items()}
        return words["notes"][self.key].format(**shown)

    def __str__(self) -> str:
        return self.sentence()


def worded(name: str, language: str = "en") -> str:
    """A name of a parameter, model or part of one in a language."""
    return _shown(name, _words(language))


@cache
def _words(language: str) -> dict[str, dict[str, str]]:
    name = one_of("language", language, LANGUAGES)
    text = resources.files(__name__).joinpath(f"{name}.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


def _shown(value: object, words: Mapping[str, Mapping[str, str]]) -> str:
    if isinstance(value, tuple):
        return words["lists"]["join"].join(_shown(each, words) for each in value)
    if value == math.inf:
        return "∞"
    if isinstance(value, float):
        return f"{value:.3g}".replace("-", _MINUS).replace(".", words["lists"]["decimal"])
    if _NUMBER.fullmatch(str(value)):  # with all the digits that are to be shown
        return str(value).replace(".", words["lists"]["decimal"])
    return " + ".join(_name(part, words["names"]) for part in str(value).split(" + "))


def _name(name: str, names: Mapping[str, str]) -> str:
    """A name in words, with the number of its recording or joint behind it."""
    plain, bracket, number = name.partition("[")
    joint = plain[-1:] if plain not in names and plain[:-1] in names else ""
    kind = plain.removesuffix(joint) if joint else plain
    return " ".join(part for part in (names.get(kind, kind), joint) if part) + bracket + number
