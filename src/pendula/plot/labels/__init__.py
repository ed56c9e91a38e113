"""The words on figures, one file a language beside this one."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any

from pendula._checks import one_of

LANGUAGES = ("en", "es")


@dataclass(frozen=True)
class Labels:
    """The catalogue of one language: `labels.axis["time"]`, and its decimal sign."""

    language: str
    decimal: str
    run: dict[str, str]
    axis: dict[str, str]
    curve: dict[str, str]
    case: dict[str, str]

    def name(self, run: str) -> str:
        """The name of a run: a method's, "exact", "linear" or "reference"."""
        return self.run.get(run, run)

    def plain(self, number: float, digits: int = 3) -> str:
        """A number with so many significant digits, without an exponent."""
        text = f"{number:#.{digits}g}".rstrip(".")
        if "e" in text:
            text = f"{number:.0f}" if abs(number) >= 1 else f"{number:.{digits + 6}f}".rstrip("0")
        return self.local(text)

    def local(self, text: str) -> str:
        """A number that is text already, with a true minus and the language's decimal sign."""
        return text.replace("-", "−").replace(".", self.decimal)


@cache
def labels(language: str) -> Labels:
    """The catalogue of a language; ValueError names the languages there are."""
    name = one_of("language", language, LANGUAGES)
    text = resources.files(__name__).joinpath(f"{name}.toml").read_text(encoding="utf-8")
    catalogue: dict[str, Any] = tomllib.loads(text)
    return Labels(language=language, **catalogue)
