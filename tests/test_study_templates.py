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
    for part in ("progress", "systems", "replay", "measured", "quantities", "corrections"):
        assert english[part].keys() == spanish[part].keys()


@pytest.mark.parametrize("language", ["en", "es"])
def test_every_figure_and_table_of_the_double_pendulum_is_spoken_of(language: str) -> None:
    text = (TEMPLATES / language / "double.typ").read_text(encoding="utf-8")
    for kind, name in re.findall(r'^#(plate|tabular)\("([\w-]+)"', text, re.MULTILINE):
        label = {"plate": "fig", "tabular": "tab"}[kind]
        assert f"@{label}-{name}" in text


@pytest.mark.parametrize("language", ["en", "es"])
def test_no_figure_floats_into_the_errata(language: str) -> None:
    text = (TEMPLATES / language / "errata.typ").read_text(encoding="utf-8")
    assert text.index("#before-next()") < text.index("\n= ")


@pytest.mark.parametrize("language", ["en", "es"])
def test_the_text_claims_no_more_than_holds(language: str) -> None:
    text = "".join((TEMPLATES / language / name).read_text(encoding="utf-8") for name in TEXTS)
    # Differences may become small again; a hollow mark may be fine enough and yet not fitted.
    wrong = {
        "en": r"from then on its angles|hollow ones are too|what it costs\.\*|swings?\b(?! it)",
        "es": r"desde entonces sus ángulos|demasiado gruesos o|lo que vale\.|oscilaci|barra",
    }[language]
    text = re.sub(r"\.swings|the pendulum swings", "", text)
    assert not re.findall(wrong, text)


@pytest.mark.parametrize(
    ("number", "text"), [("1 000 000", "1 000 000 de"), ("20 000", "20 000"), ("7", "7")]
)
def test_millions_take_a_de_in_spanish(tmp_path: Path, number: str, text: str) -> None:
    typst = pytest.importorskip("typst")
    thin = "\N{NARROW NO-BREAK SPACE}"
    (tmp_path / "layout.typ").write_text((TEMPLATES / "layout.typ").read_text("utf-8"), "utf-8")
    (tmp_path / "facts.json").write_text('{"words": {}}')
    main = tmp_path / "main.typ"
    written = number.replace(" ", thin)
    main.write_text(f'#import "layout.typ": with-de\n|#with-de("{written}")|', "utf-8")
    page, _ = typst.compile_with_warnings(str(main), format="html", sys_inputs={"format": "html"})
    told = page.decode("utf-8").split("|")[1].replace("&#x202f;", thin)
    assert told.replace(thin, " ") == text


@pytest.mark.parametrize("script", ["pendulums.js", "replay.js"])
def test_functions_of_the_page_fit_a_screen(script: str) -> None:
    lines = (TEMPLATES / script).read_text(encoding="utf-8").splitlines()
    starts = [i for i, line in enumerate(lines) if line.startswith("function ")]
    assert len(starts) > 6
    for start in starts:
        assert lines.index("}", start) - start < 40, lines[start]


@pytest.mark.parametrize("language", ["en", "es"])
def test_no_measured_number_stands_in_the_text(language: str) -> None:
    for name in TEXTS:
        text = (TEMPLATES / language / name).read_text(encoding="utf-8")
        # Left out: code and comments, formulas, and the full turn.
        text = re.sub(r"^(//|#let|#import).*|\$[^$]*\$|360°", "", text, flags=re.MULTILINE)
        assert not re.findall(r"\d\s*(?:°|%|s\b|ms\b)", text), name


@pytest.mark.parametrize(
    ("language", "period", "steps"),
    [("en", "a fraction of the linear period $T_0$", "largest over all steps"),
     ("es", "una fracción del período lineal $T_0$", "todos los pasos")],
)  # fmt: skip
def test_tables_and_figures_say_what_their_largest_are_taken_of(
    language: str, period: str, steps: str
) -> None:
    text = {name: (TEMPLATES / language / name).read_text(encoding="utf-8") for name in TEXTS}
    assert period in text["linear.typ"]
    assert "$T\\/T_0 - 1$" in text["linear.typ"]
    assert text["double.typ"].count(steps) == 2
    assert text["methods.typ"].count(steps) == 1
    for name in ("linear.typ", "methods.typ", "double.typ", "equations.typ"):
        assert re.search(r"(every|cada) #[sd]\.output|#s\.output\], \[#d\.output", text[name])


@pytest.mark.parametrize("name", TEXTS)
@pytest.mark.parametrize("language", ["en", "es"])
def test_a_number_and_its_unit_stay_on_one_line(language: str, name: str) -> None:
    apart = re.compile(r"#(?!let|if|else)[\w.]+ (?:m|kg|s|ms|rad|rad/s|m/s²)\b")
    assert not apart.findall((TEMPLATES / language / name).read_text(encoding="utf-8"))
