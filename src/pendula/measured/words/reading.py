"""What `read` tells of a file, in either language: a recording keeps it as English sentences."""

from __future__ import annotations

import re
import tomllib
from functools import cache
from importlib import resources

from pendula._checks import one_of

_NUMBER = re.compile(r"-?\d+(\.\d+)?(e-?\d+)?")


def reading_note(sentence: str, language: str = "en") -> str:
    """A sentence of what was understood of a file, in a language; one not known is as it was.

    Raises:
        ValueError: for a language that there is none of.
    """
    if one_of("language", language, ("en", "es")) == "en":
        return sentence
    patterns, words = _spanish()
    for pattern, spanish in patterns:
        found = pattern.fullmatch(sentence)
        if found:
            return spanish.format(
                **{k: _said(each, words) for k, each in found.groupdict().items()}
            )
    return sentence


def _said(text: str, words: dict[str, str]) -> str:
    """A word, a number with its decimal comma, or a name as it stands in the file."""
    text = re.sub(r"\bcolumn (?=\d)", "columna ", text)
    return text.replace(".", ",") if _NUMBER.fullmatch(text) else words.get(text.strip(), text)


@cache
def _spanish() -> tuple[list[tuple[re.Pattern[str], str]], dict[str, str]]:
    """Patterns of the English sentences with the Spanish ones, and single words."""
    text = resources.files(__package__).joinpath("reading_es.toml").read_text(encoding="utf-8")
    known = tomllib.loads(text)
    return [(_pattern(each), said) for each, said in known["sentences"].items()], known["words"]


def _pattern(template: str) -> re.Pattern[str]:
    parts = re.split(r"\{(\w+)\}", template)
    literal = [
        re.escape(each) if i % 2 == 0 else f"(?P<{each}>.+?)" for i, each in enumerate(parts)
    ]
    return re.compile("".join(literal))
