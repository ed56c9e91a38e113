"""The pages hold what scripts/docs_facts.py writes: facts of the catalogue, and shared blocks."""

import importlib.util
import re
import shutil
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

import pendula
from test_readme import ROOT

SCRIPT = ROOT / "scripts" / "docs_facts.py"


def loaded() -> Any:
    spec = importlib.util.spec_from_file_location("docs_facts", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


docs_facts = loaded()
every_page = pytest.mark.parametrize(
    "page", docs_facts.pages(), ids=lambda page: str(page.relative_to(ROOT))
)


@pytest.fixture
def copied(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    docs = tmp_path / "docs"
    shutil.copytree(ROOT / "docs", docs)
    monkeypatch.setattr(docs_facts, "DOCS", docs)
    return docs


@every_page
def test_a_page_is_current(page: Path) -> None:
    assert page.read_text(encoding="utf-8") == docs_facts.filled(page), "run make docs-facts"


@every_page
def test_markers_come_in_pairs_and_hold_every_block(page: Path) -> None:
    """A block outside of them would stand twice, once a language."""
    text = page.read_text(encoding="utf-8")
    rest = docs_facts.MARKED.sub("", text)
    assert "<!--" not in rest
    assert "```" not in rest, "put the block into docs/code, and a marker in its place"


def test_every_block_of_docs_code_is_shown() -> None:
    text = "".join(page.read_text(encoding="utf-8") for page in docs_facts.pages())
    shown = set(re.findall(r"^<!-- code: (.+) -->$", text, re.MULTILINE))
    code = ROOT / "docs" / "code"
    blocks = {
        file.relative_to(code).with_suffix("").as_posix()
        for file in code.rglob("*")
        if file.suffix[1:] in docs_facts.FENCES
    }
    assert shown == blocks - {"ruff"}


def test_a_comment_is_in_the_language_of_the_page(copied: Path) -> None:
    (copied / "code" / "swing.py").write_text("a = 1  # it swings | oscila\nb = a | 2\n")
    for language, comment in (("en", "it swings"), ("es", "oscila")):
        block = docs_facts.blocks("swing", docs_facts.Words(language))
        assert block == f"```python\na = 1  # {comment}\nb = a | 2\n```"


def test_a_fact_that_changes_changes_the_pages(
    copied: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    changed = tuple(
        replace(each, order=5) if each.name == "rk4" else each for each in pendula.methods()
    )
    monkeypatch.setattr(docs_facts, "methods", lambda: changed)
    docs_facts.main()
    pages = [page for page in copied.rglob("*.md") if "| 5 | 4 |" in page.read_text("utf-8")]
    names = sorted(page.relative_to(copied).as_posix() for page in pages)
    both = ("methods.md", "methods/rk4.md")
    assert names == [f"{language}/{name}" for language in ("en", "es") for name in both]


def test_a_missing_translation_is_named(copied: Path) -> None:
    words = copied / "words.toml"
    text = words.read_text(encoding="utf-8")
    words.write_text(text.replace('"mass of rod 1"', '"mass of rod one"'), encoding="utf-8")
    docs_facts.filled(copied / "en" / "systems" / "double.md")
    with pytest.raises(LookupError, match="no Spanish for 'mass of rod 1'"):
        docs_facts.filled(copied / "es" / "systems" / "double.md")


def test_a_block_that_is_not_there_is_named(copied: Path) -> None:
    with pytest.raises(LookupError, match="docs/code has no exact/nothing"):
        docs_facts.blocks("exact/nothing", docs_facts.Words("en"))
