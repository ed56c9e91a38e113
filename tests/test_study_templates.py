"""The report's text: both languages say the same things, and say no number by themselves."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from pendula.study import report

TEMPLATES = Path(report.__file__).parent / "templates"
TEXTS = sorted(path.name for path in (TEMPLATES / "en").glob("*.typ"))
MARKS = re.compile(
    r"formula\.[\w-]+|^=+ |@[a-z]+-[\w-]+|#(?:plate|replay|tabular)\(\"[\w-]+|"
    r"[a-z]+\.[a-z_]+(?:\.[a-z_]+)*",
    re.MULTILINE,
)


@pytest.mark.parametrize("name", TEXTS)
def test_both_languages_say_the_same_things(name: str) -> None:
    found = [
        sorted(MARKS.findall((TEMPLATES / language / name).read_text(encoding="utf-8")))
        for language in ("en", "es")
    ]
    assert found[0] == found[1]
    assert found[0]


def test_both_languages_have_the_same_files_and_words() -> None:
    files = [sorted(p.name for p in (TEMPLATES / each).iterdir()) for each in ("en", "es")]
    assert files[0] == files[1]
    english, spanish = (report.catalogue(language) for language in ("en", "es"))
    assert english.keys() == spanish.keys()
    for part in ("progress", "systems", "replay"):
        assert english[part].keys() == spanish[part].keys()


@pytest.mark.parametrize("language", ["en", "es"])
def test_no_measured_number_stands_in_the_text(language: str) -> None:
    for name in TEXTS:
        text = (TEMPLATES / language / name).read_text(encoding="utf-8")
        # Left out: code and comments, formulas, and the full turn.
        text = re.sub(r"^(//|#let|#import).*|\$[^$]*\$|360°", "", text, flags=re.MULTILINE)
        assert not re.findall(r"\d\s*(?:°|%|s\b|ms\b)", text), name
