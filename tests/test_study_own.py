"""A recipe of one's own: its title, author and sections, and no story of the paper."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

from pendula.study import report, run_study
from pendula.study.schema import REPORT
from report_page import Page, page

TITLE, AUTHOR = "Dos péndulos & <uno> *más*", "Ada Ñáñez"
QUICK: dict[str, Any] = {
    "simple": {"length": "70 cm", "large": "100 deg", "t_max": "2 s", "output": "20 ms"},
    "elliptic": {"largest_terms": 1000},
    "convergence": {"steps": ["4 ms", "2 ms", "1 ms"]},
    "work": {"swings": 1, "points": 2},
    "double": {"l2": "30 cm", "t_max": "2 s", "theta1": "70 deg"},
}
STORY = re.compile(r"Herrera|Avila|paper|artículo|errata|not survived|no se conserva", re.I)
OPENS = {"en": "In 2024 L. Herrera", "es": "En 2024 L. Herrera"}
HEADINGS = {
    "en": ["The pendulums and their equations", "Linear against non-linear",
           "The series against the arithmetic-geometric mean", "The methods against the exact",
           "The double pendulum", "The cost of accuracy", "Errata of the paper"],
    "es": ["Los péndulos y sus ecuaciones", "Lineal frente a no lineal",
           "La serie frente a la media", "Los métodos frente a la solución", "El péndulo doble",
           "El coste de la exactitud", "Erratas del artículo"],
}  # fmt: skip


def own(tmp_path: Path, language: str, **given: Any) -> Path:
    return run_study(QUICK | {"report": given}, tmp_path / "own", language)


def opening(found: Page) -> str:
    """What is read before the contents."""
    return re.split(r"\bContents\b|Índice", found.words)[0]


def sections(folder: Path, language: str) -> list[str]:
    """Those that have a heading, in their order."""
    source = (folder / "report.html").read_text(encoding="utf-8")
    found = "".join(re.findall(r"<h2[^>]*>.*?</h2>", source))
    return [n for n, words in zip(REPORT, HEADINGS[language], strict=True) if words in found]


@pytest.mark.parametrize("language", ["en", "es"])
def test_title_author_and_sections_are_ones_own(tmp_path: Path, language: str) -> None:
    folder = own(tmp_path, language, title=TITLE, author=AUTHOR, sections=["double", "linear"])
    found, source = page(folder), (folder / "report.html").read_text(encoding="utf-8")
    assert found.words.count(TITLE) == 2  # of the tab and of the page
    assert found.words.count(AUTHOR) == 1
    assert f'<meta name="author" content="{AUTHOR}">' in source
    assert sections(folder, language) == ["linear", "double"]
    assert found.classes.count("player") == 2
    assert found.tags.count("img") == 9
    assert re.findall(r'"(\w+)":{"lengths"', source) == ["gentle", "double"]
    document = (folder / "report.pdf").read_bytes()
    for words in (TITLE.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;"), AUTHOR):
        assert words.encode() in document


@pytest.mark.parametrize(
    ("language", "says"),
    [
        (
            "en",
            ("a length of 0.7 m", "at 5° and at 100°", "lengths of 1 m and 0.3 m", "at 70° and"),
        ),
        ("es", ("una longitud de 0,7 m", "en 5° y en 100°", "longitudes 1 m y 0,3 m", "en 70° y")),
    ],
)
def test_it_opens_with_ones_own_pendulums(
    tmp_path: Path, language: str, says: tuple[str, ...]
) -> None:
    folder = own(tmp_path, language)
    found = page(folder)
    assert not STORY.findall(opening(found))
    assert all(each in opening(found) for each in says)
    assert sections(folder, language) == list(REPORT)  # what is left out is as in the study


@pytest.mark.parametrize("language", ["en", "es"])
def test_the_studys_own_report_tells_the_papers_story(tmp_path: Path, language: str) -> None:
    folder = run_study(None, tmp_path / "study", language)
    found = page(folder)
    assert OPENS[language] in opening(found)
    assert report.catalogue(language)["title"] in found.words
    assert "author" not in found.classes
    assert sections(folder, language) == list(REPORT)


@pytest.mark.parametrize("language", ["en", "es"])
def test_every_section_can_stand_alone(
    tmp_path: Path, language: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """None refers to what only another one has."""
    write, seen = report.write_report, list[Any]()

    def keep(folder: Path, facts: dict[str, Any], motions: dict[str, Any]) -> None:
        seen.append((facts, motions))
        write(folder, facts, motions)

    monkeypatch.setattr(report, "write_report", keep)
    folder = own(tmp_path, language)
    ((facts, motions),) = seen
    for name in REPORT:
        alone = {"report": facts["report"] | {"sections": [name]}}
        write(folder, facts | alone, motions)
        assert sections(folder, language) == [name]
        assert not STORY.findall(opening(page(folder)))
