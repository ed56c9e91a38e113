"""The errata of the paper: the rows of errata.toml, and the page made of them.

Source: Herrera, Avila, Martinez, Acuña, "Solución analítica y numérica del péndulo simple y
doble", 2024. To write the page again: ``python -m pendula.study.errata > docs/errata.md``.
"""

import sys
import tomllib
from dataclasses import dataclass
from functools import cache
from importlib import resources
from typing import Any, Literal

from pendula.study.formulas import in_typst

__all__ = ["Erratum", "Language", "Text", "errata", "errata_page", "right_as_printed"]

Language = Literal["en", "es"]

PAPER = (
    "Herrera, Avila, Martinez, Acuña, "
    "*Solución analítica y numérica del péndulo simple y doble*, 2024"
)


@dataclass(frozen=True, slots=True)
class Text:
    """The same words in English and in Spanish; ``text["es"]`` picks one."""

    marked: dict[Language, str]
    """With the formulas between dollar signs."""

    def __getitem__(self, language: Language) -> str:
        """As plain text."""
        return self.marked[language].replace("$", "")

    def typst(self, language: Language) -> str:
        """As the typesetter of the report reads it."""
        return in_typst(self.marked[language])


@dataclass(frozen=True, slots=True)
class Erratum:
    """One misprint: where it stands, the form printed, the right one, and one sentence why."""

    id: str
    equation: Text
    printed: Text
    correct: Text
    why: Text


@dataclass(frozen=True, slots=True)
class _Words:
    """What the page says around its table in one language."""

    title: str
    intro: str
    columns: tuple[str, str, str, str]
    right: str


_PAGE: dict[Language, _Words] = {
    "en": _Words(
        title="Errata of the paper",
        intro=(
            f"The paper is {PAPER}.\n\n"
            "Its equations were derived again, which brought these misprints to light. For each\n"
            "row a test shows that the printed form is wrong and that the correct form holds.\n"
            "Notation: τ = 2π, ωₙ = √(g/L), k = sin(θ₀/2); a dot is a time derivative."
        ),
        columns=("Equation", "As printed", "Correct", "Reason"),
        right="Checked in the same way and correct as printed:",
    ),
    "es": _Words(
        title="Erratas del artículo",
        intro=(
            f"El artículo es {PAPER}.\n\n"
            "Al deducir de nuevo sus ecuaciones aparecieron estas erratas. Para cada fila, una\n"
            "prueba muestra que la forma impresa es incorrecta y la corregida, correcta.\n"
            "Notación: τ = 2π, ωₙ = √(g/L), k = sen(θ₀/2); un punto es una derivada temporal."
        ),
        columns=("Ecuación", "Impreso", "Correcto", "Motivo"),
        right="Comprobadas del mismo modo y correctas tal como están impresas:",
    ),
}


def errata() -> tuple[Erratum, ...]:
    """Return every erratum of the paper, in the order of the page."""
    return tuple(
        Erratum(
            id=row["id"],
            equation=_text(row["equation"]),
            printed=_text(row["printed"]),
            correct=_text(row["correct"]),
            why=_text(row["why"]),
        )
        for row in _table()["erratum"]
    )


def right_as_printed() -> tuple[int, ...]:
    """Return the numbers of the equations that were checked and found right."""
    return tuple(_table()["right_as_printed"])


def errata_page() -> str:
    """Return the documentation page docs/errata.md: English first, then Spanish."""
    header = (
        "<!-- Made from src/pendula/study/errata.toml by:\n"
        "     python -m pendula.study.errata > docs/errata.md -->"
    )
    # An anchor of our own: sites differ in what they make of the accent in the heading.
    return (
        f"{header}\n\n[Español](#es)\n\n{_section('en', '#')}\n\n"
        f'<a id="es"></a>\n\n{_section("es", "##")}\n'
    )


def _section(language: Language, level: str) -> str:
    words = _PAGE[language]
    rows = [
        (row.equation[language], row.printed[language], row.correct[language], row.why[language])
        for row in errata()
    ]
    lines = [words.columns, ("---",) * len(words.columns), *rows]
    table = "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
    right = ", ".join(f"({number})" for number in right_as_printed())
    return f"{level} {words.title}\n\n{words.intro}\n\n{table}\n\n{words.right} {right}."


@cache
def _table() -> dict[str, Any]:
    file = resources.files("pendula.study").joinpath("errata.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def _text(value: str | dict[Language, str]) -> Text:
    """Read a table with en and es, or a string for both, in which the sine alone differs."""
    if isinstance(value, str):
        return Text({"en": value, "es": value.replace("sin", "sen")})
    return Text(value)


if __name__ == "__main__":
    # Bytes, since a terminal's own encoding may lack θ.
    sys.stdout.buffer.write(errata_page().encode("utf-8"))
