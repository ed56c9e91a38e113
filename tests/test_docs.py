"""The documentation: links, languages, tables and versions are what the project is."""

import json
import re
import subprocess
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

import pendula
from pendula._engine import system_entries
from pendula.cli.app import _pendula
from pendula.many.sweep.reading import _RUN
from pendula.study.errata import errata
from test_docs_facts import docs_facts
from test_readme import ROOT, blocks

DOCS = ROOT / "docs"
LANGUAGES = ("en", "es")
PAGES = [*ROOT.glob("*.md"), *DOCS.rglob("*.md")]
CATALOGUE: dict[str, list[str]] = {
    "methods": [each.name for each in pendula.methods()],
    "systems": list(system_entries()),
}
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
every_language = pytest.mark.parametrize("language", LANGUAGES)


def text_of(path: Path) -> str:
    return path.read_text(encoding="utf-8")


def pages_of(language: str) -> list[str]:
    folder = DOCS / language
    return sorted(path.relative_to(folder).as_posix() for path in folder.rglob("*.md"))


TRANSLATED = pages_of("en")


def table_rows(text: str) -> Iterator[list[str]]:
    """The cells of every row of every table, headers included."""
    for line in text.splitlines():
        if line.startswith("|") and not re.fullmatch(r"[| -]+", line):
            yield [cell.strip() for cell in line.strip("|").split("|")]


def quoted(cell: str) -> list[str]:
    return re.findall(r"`([^`]+)`", cell)


# ---- links ----


def anchors(page: Path) -> set[str]:
    """What a link may lead to within a page: its headings, as GitHub spells them, and its names."""
    text = re.sub(r"^```.*?^```$", "", text_of(page), flags=re.MULTILINE | re.DOTALL)
    headings = re.findall(r"^#+ (.+)$", text, re.MULTILINE)
    spelled = {re.sub(r"[^\w\- ]", "", each.lower()).replace(" ", "-") for each in headings}
    return spelled | set(re.findall(r'<a id="([^"]+)"', text))


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    text = re.sub(r"^```.*?^```$", "", text_of(page), flags=re.MULTILINE | re.DOTALL)
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        if link.startswith("https://"):
            continue
        file, _, anchor = link.partition("#")
        target = (page.parent / file).resolve() if file else page
        assert target.exists(), link
        assert not anchor or anchor in anchors(target), link


@every_language
def test_the_contents_name_every_page(language: str) -> None:
    """Those of a folder are named on the page that is called like the folder."""
    for name in TRANSLATED:
        other = next(each for each in LANGUAGES if each != language)
        page = text_of(DOCS / language / name)
        above = name.rpartition("/")[0] or "index"
        assert name == "index.md" or f"({name})" in text_of(DOCS / language / f"{above}.md")
        up = "../" * (name.count("/") + 1)
        assert f"({up}{other}/{name})" in page, f"{name} does not lead to its translation"


# ---- two languages ----


def test_both_languages_have_the_same_pages() -> None:
    assert pages_of("es") == TRANSLATED


@pytest.mark.parametrize("name", TRANSLATED)
def test_both_languages_have_the_same_shape(name: str) -> None:
    english, spanish = (text_of(DOCS / language / name) for language in LANGUAGES)
    levels = [re.findall(r"^(#+) ", each, re.MULTILINE) for each in (english, spanish)]
    assert levels[0] == levels[1]
    links = [len(re.findall(r"\]\(", each)) for each in (english, spanish)]
    assert links[0] == links[1]
    assert [len(row) for row in table_rows(english)] == [len(row) for row in table_rows(spanish)]


# ---- tables that have to be what the program is ----


@every_language
@pytest.mark.parametrize("folder", ["methods", "systems"])
def test_every_method_and_system_has_a_page(language: str, folder: str) -> None:
    """With its facts, and for a method with how it is used."""
    for name in CATALOGUE[folder]:
        text = text_of(DOCS / language / folder / f"{name}.md")
        assert text.startswith(f"# {name}\n")
        assert f"\n<!-- facts: {folder[:-1]} {name} -->\n" in text
        assert folder == "systems" or f'"{name}"' in text.partition("```python")[2]


@pytest.mark.parametrize("folder", ["methods", "systems"])
def test_no_page_is_about_what_is_gone(folder: str) -> None:
    told = [Path(name).stem for name in TRANSLATED if name.startswith(f"{folder}/")]
    assert sorted(told) == sorted(CATALOGUE[folder])


@every_language
def test_the_table_of_commands_is_the_commands(language: str) -> None:
    first = text_of(DOCS / language / "command-line.md").partition("\n## ")[0]
    told = [quoted(row[0])[0] for row in table_rows(first) if quoted(row[0])]
    assert told == list(_pendula.commands)


@every_language
def test_the_table_of_keys_is_the_recipe(language: str) -> None:
    default = tomllib.loads(text_of(ROOT / "src/pendula/study/default.toml"))
    told: dict[str, list[str]] = {}
    section = ""
    for row in table_rows(text_of(DOCS / language / "study.md")):
        if len(row) == 3 and (keys := quoted(row[1])):
            section = quoted(row[0])[0].strip("[]") if row[0] else section
            told.setdefault(section, []).extend(keys)
    assert {name: sorted(keys) for name, keys in told.items()} == {
        name: sorted(keys) for name, keys in default.items()
    }


@every_language
def test_the_table_of_run_is_the_recipe_of_a_sweep(language: str) -> None:
    table = text_of(DOCS / language / "sweep.md").partition("| `[run]` |")[2].partition("\n\n")[0]
    told = [quoted(row[0])[0] for row in table_rows(table) if quoted(row[0])]
    assert sorted(told) == sorted(_RUN)


@every_language
@pytest.mark.parametrize(("page", "count"), [("exact.md", 14), ("numerics.md", 6)])
def test_the_bounds_are_the_constants(language: str, page: str, count: int) -> None:
    rows = [
        row[-3:]
        for row in table_rows(text_of(DOCS / language / page))
        if len(row) > 3 and quoted(row[-2])
    ]
    assert len(rows) == count
    for bound, name, file in rows:
        assert re.search(
            rf"\b{quoted(name)[0]} =\s+{re.escape(bound)}(?![\w.*])", text_of(ROOT / file)
        ), f"{name} is not {bound} in {file}"


@every_language
def test_the_tests_that_are_named_exist(language: str) -> None:
    for file in re.findall(r"(?:core/)?tests/[\w./]+", text_of(DOCS / language / "numerics.md")):
        assert (ROOT / file.rstrip(".")).exists(), file


def test_dependencies_are_told_exactly() -> None:
    project, groups = PROJECT["project"], PROJECT["dependency-groups"]
    wanted = {
        "Build": [*PROJECT["build-system"]["requires"], *groups["build"]],
        "Run": project["dependencies"],
        "Development": groups["dev"],
        "Laboratory": groups["lab"],
        "Page of the laboratory": json.loads(text_of(ROOT / "web/package.json"))["devDependencies"],
        "Benchmarks": groups["bench"],
    }
    wanted |= {f"Extra {name}": each for name, each in project["optional-dependencies"].items()}
    told = {}
    for part in text_of(DOCS / "dependencies.md").split("\n## ")[1:]:
        heading, _, text = part.partition("\n")
        rows = [row for row in table_rows(text) if row[0] != "package"]
        assert all(len(row) == 2 and row[1] for row in rows)
        told[heading] = sorted(row[0] for row in rows)
    names = {
        group: sorted({re.split(r"[<>=\[;]", each)[0] for each in requirements})
        for group, requirements in wanted.items()
    }
    assert told == names


# ---- versions, citation, contributing ----


def test_the_version_is_the_same_everywhere() -> None:
    latest = re.search(r"^## \[([\d.]+)\] - (\S+)$", text_of(ROOT / "CHANGELOG.md"), re.MULTILINE)
    assert latest is not None
    citation = text_of(ROOT / "CITATION.cff")
    assert latest[1] == pendula.__version__ == PROJECT["project"]["version"]
    assert f"\nversion: {latest[1]}\n" in citation
    assert f"\ndate-released: {latest[2]}\n" in citation


@pytest.mark.parametrize("file", ["README.md", "CITATION.cff", "docs/en/index.md"])
def test_the_paper_is_cited(file: str) -> None:
    text = " ".join(text_of(ROOT / file).split())
    for word in ("Herrera", "Avila", "Martinez", "Acuña", "péndulo simple y doble", "2024"):
        assert word in text


def test_the_readme_counts_the_errata() -> None:
    assert f"{len(errata())} corrected misprints" in text_of(ROOT / "README.md")


def test_the_method_that_contributing_adds_can_be_added(tmp_path: Path) -> None:
    """Its header compiles, and its change fits the catalogue."""
    found = {each.language: each.text for each in blocks(ROOT / "CONTRIBUTING.md")}
    catalogue = text_of(ROOT / "core/include/pendula/catalog.hpp").splitlines()
    for line in found["diff"].splitlines():
        if line.startswith((" ", "-")) and not line.startswith("---"):
            start = line[1:].partition("<")[0]  # the list itself may have grown
            assert any(each.startswith(start) for each in catalogue), start
    source = tmp_path / "ralston.cpp"
    check = "static_assert(pendula::MethodEntry<pendula::ralston>);"
    code = found["cpp"].replace("#pragma once", '#include "pendula/catalog.hpp"')
    source.write_text(f"{code}\n{check}\n", encoding="utf-8")
    include = f"-I{ROOT / 'core/include'}"
    subprocess.run(["g++", "-std=c++20", "-fsyntax-only", include, str(source)], check=True)


# ---- what keeps the pages pleasant ----


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_pages_are_short(page: Path) -> None:
    by_hand = docs_facts.MARKED.sub("", text_of(page))
    assert page.name == "errata.md" or len(by_hand.splitlines()) <= 130


def test_pictures_are_light() -> None:
    pictures = list((DOCS / "images").iterdir())
    assert pictures
    shown = "".join(map(text_of, PAGES))
    for picture in pictures:
        assert picture.stat().st_size < 150_000
        assert f"images/{picture.name})" in shown
