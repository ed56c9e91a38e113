"""Fills in what the pages of the documentation take from elsewhere.

A page of docs/en or docs/es holds pairs of markers, and between them what this script writes:

    <!-- facts: method rk4 -->    a table of the catalogue, in the page's language
    <!-- end of facts -->

    <!-- code: exact/states -->   the blocks docs/code/exact/states.py, .console, .toml and .txt
    <!-- end of code -->

So a fact stands once, in the catalogue, and a block once, in docs/code. Spanish for the catalogue's
English is in docs/words.toml; a comment of a block gives both: `# swings | oscila`.
"""

from __future__ import annotations

import math
import re
import sys
import tomllib
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TypeVar

from click.testing import CliRunner

from pendula._engine import Component, Method, Parameter, SystemEntry, methods, system_entries
from pendula.cli.app import _pendula

DOCS = Path(__file__).resolve().parent.parent / "docs"
LANGUAGES = ("en", "es")
MARKED = re.compile(r"^<!-- (facts|code): (.+) -->\n(?:.*\n)*?<!-- end of \1 -->$", re.MULTILINE)
FENCES = {"py": "python", "console": "console", "toml": "toml", "txt": "text"}
COMMENT = re.compile(r"^(.*# )(.+) \| (.+)$", re.MULTILINE)


class Verbatim(str):
    """Text of a cell that is the same in every language."""

    __slots__ = ()


Row = TypeVar("Row")
Cell = bool | float | str | tuple[str, ...]
Columns = Mapping[str, Callable[[Row], Cell]]


class Words:
    """The words of a language for the catalogue's English."""

    def __init__(self, language: str) -> None:
        self.language = language
        self._spanish = tomllib.loads((DOCS / "words.toml").read_text(encoding="utf-8"))

    def __call__(self, phrase: str) -> str:
        """A phrase in the language.

        Raises:
            LookupError: naming a phrase that has no translation.
        """
        if self.language == "en":
            return phrase
        if phrase not in self._spanish:
            raise LookupError(f"docs/words.toml has no Spanish for {phrase!r}")
        translated: str = self._spanish[phrase]
        return translated

    def cell(self, value: Cell) -> str:
        """A cell of a table."""
        if isinstance(value, bool):
            return self("yes" if value else "no")
        if isinstance(value, tuple):
            return ", ".join(value)
        if isinstance(value, str):
            return value if isinstance(value, Verbatim) else self(value)
        return f"{value:.7g}".replace(".", "," if self.language == "es" else ".")


def _unit(unit: str) -> str:
    return unit.replace("^2", "²")


def _default(row: Parameter | Component) -> Cell:
    if row.standard is None:
        same = isinstance(row, Parameter) and row.same_as
        return Verbatim(f"`{same}`") if same else "required"
    if row.unit == "rad":
        return Verbatim(f"{math.degrees(row.standard):.7g}°".replace("-", "−"))
    return row.standard


# ---- the columns of each table: a new one is a line here, and its heading in words.toml ----

METHOD: Columns[Method] = {
    "order": lambda each: each.order,
    "evaluations/step": lambda each: each.evaluations_per_step or "iterated",
    "step": lambda each: "adaptive" if each.adaptive else "fixed",
    "symplectic": lambda each: each.symplectic,
    "systems": lambda each: each.systems,
    "source": lambda each: Verbatim(each.source),
}
LINKED_METHOD: Columns[Method] = {
    "name": lambda each: Verbatim(f"[{each.name}](methods/{each.name}.md)"),
    **METHOD,
}
_RANGES = {"positive": "> 0", "not_negative": "≥ 0", "any": "ℝ"}
SYSTEM: Columns[SystemEntry] = {
    "name": lambda each: Verbatim(f"[{each.name}](systems/{each.name}.md)"),
    "forms": lambda each: tuple(f"`{form.name}`" for form in each.forms if form.name) or "one",
    "state": lambda each: tuple(f"`{row.name}`" for row in each.components),
    "methods": lambda each: tuple(m.name for m in methods() if each.name in m.systems),
}
PARAMETER: Columns[Parameter] = {
    "name": lambda each: Verbatim(f"`{each.name}`"),
    "unit": lambda each: Verbatim(_unit(each.unit)),
    "default": _default,
    "range": lambda each: Verbatim(_RANGES[each.range]),
    "meaning": lambda each: each.meaning,
}
COMPONENT: Columns[Component] = {
    "name": lambda each: Verbatim(f"`{each.name}`"),
    "unit": lambda each: Verbatim(_unit(each.unit)),
    "default": _default,
    "meaning": lambda each: each.meaning,
}


# ---- what a marker of facts may name ----


def table(columns: Columns[Row], rows: Iterable[Row], words: Words) -> str:
    """A table with a row for each."""
    lines = [
        [words(heading) for heading in columns],
        ["---"] * len(columns),
        *([words.cell(value(row)) for value in columns.values()] for row in rows),
    ]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)


def _system(name: str, words: Words) -> str:
    entry, parts = system_entries()[name], []
    for form in entry.forms:
        own = f", `{form.name}`" if form.name else ""
        parts.append(f"{words('Parameters')}{own} ({words(form.meaning)}):")
        parts.append(table(PARAMETER, form.parameters, words))
    state = table(COMPONENT, entry.components, words)
    return "\n\n".join([*parts, f"{words('State')}:", state])


def _method(name: str, words: Words) -> str:
    return table(METHOD, [each for each in methods() if each.name == name], words)


def _command(name: str, words: Words) -> str:
    printed = CliRunner().invoke(_pendula, name.split()).output
    return f"```console\n$ pendula {name}\n{printed}```"


FACTS: Mapping[str, Callable[[str, Words], str]] = {
    "methods": lambda _, words: table(LINKED_METHOD, methods(), words),
    "method": _method,
    "systems": lambda _, words: table(SYSTEM, system_entries().values(), words),
    "system": _system,
    "command": _command,
}


# ---- pages ----


def blocks(name: str, words: Words) -> str:
    """The blocks of docs/code that bear a name, with the comments of the language.

    Raises:
        LookupError: where there is none.
    """
    found = []
    for ending, language in FENCES.items():
        file = DOCS / "code" / f"{name}.{ending}"
        if file.exists():
            text = file.read_text(encoding="utf-8")
            if ending != "txt":
                text = COMMENT.sub(r"\1\2" if words.language == "en" else r"\1\3", text)
            found.append(f"```{language}\n{text}```")
    if not found:
        raise LookupError(f"docs/code has no {name}")
    return "\n\n".join(found)


def filled(page: Path) -> str:
    """The text that a page has to have.

    Raises:
        LookupError: where a marker names nothing, a block is missing, or a translation.
    """
    words = Words(page.relative_to(DOCS).parts[0])

    def fill(marked: re.Match[str]) -> str:
        kind, name = marked[1], marked[2]
        if kind == "code":
            content = blocks(name, words)
        else:
            table_of, _, row = name.partition(" ")
            content = FACTS[table_of](row, words)
        return f"<!-- {kind}: {name} -->\n\n{content}\n\n<!-- end of {kind} -->"

    return MARKED.sub(fill, page.read_text(encoding="utf-8"))


def pages() -> list[Path]:
    """The pages there are in two languages."""
    return sorted(page for language in LANGUAGES for page in (DOCS / language).rglob("*.md"))


def main() -> int:
    """Write the pages anew and print those that changed."""
    for page in pages():
        text = filled(page)
        if text != page.read_text(encoding="utf-8"):
            page.write_text(text, encoding="utf-8")
            print(page.relative_to(DOCS.parent))
    return 0


if __name__ == "__main__":
    sys.exit(main())
