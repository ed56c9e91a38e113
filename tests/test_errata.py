"""The errata as a whole: sound rows, one test for each, and the page made of them.

The rows themselves are shown in the files test_errata_*.py beside this one; the test of a row
bears its id (eq-04: test_eq_04).
"""

import ast
import re
import subprocess
import sys
from pathlib import Path

from pendula.study.errata import Language, errata, errata_page, right_as_printed

TESTS = Path(__file__).parent
LANGUAGES: tuple[Language, ...] = ("en", "es")


def formulas_of(text: str) -> list[str]:
    return re.findall(r"\$([^$]+)\$", text)


def names_of_tests(prefix: str) -> list[str]:
    """Read the names from the source, where a name given twice still shows."""
    files = sorted(TESTS.glob("test_errata_*.py"))
    trees = [ast.parse(file.read_text(encoding="utf-8")) for file in files]
    functions = [node for tree in trees for node in tree.body if isinstance(node, ast.FunctionDef)]
    return sorted(node.name for node in functions if node.name.startswith(prefix))


def test_every_row_has_one_test_and_every_test_a_row() -> None:
    rows = sorted(f"test_{row.id.replace('-', '_')}" for row in errata())
    assert len(rows) == 24
    assert names_of_tests("test_eq_") == rows


def test_every_equation_called_right_has_one_test() -> None:
    right = sorted(f"test_right_{number}" for number in right_as_printed())
    assert names_of_tests("test_right_") == right


def test_every_row_is_complete_in_both_languages() -> None:
    for row in errata():
        assert row.printed["en"] != row.correct["en"], row.id
        for text in (row.printed, row.correct):
            assert re.fullmatch(r"\$[^$]+\$", text.marked["en"]), row.id
        # The same formulas: of their words the sine alone has a name of its own in Spanish.
        for text in (row.equation, row.printed, row.correct, row.why):
            english, spanish = (formulas_of(text.marked[code]) for code in LANGUAGES)
            assert sorted(each.replace("sin", "sen") for each in english) == sorted(spanish), row.id
        assert row.why["en"] != row.why["es"], row.id
        assert row.why["en"][-1] == row.why["es"][-1] == ".", row.id
        for text in (row.equation, row.printed, row.correct, row.why):
            for words in (text["en"], text["es"]):
                assert words.strip(), row.id
                # These two would end a table's cell or begin a link.
                assert "|" not in words, row.id
                assert "](" not in words, row.id


def test_page_in_the_documentation_is_the_one_rendered() -> None:
    page = TESTS.parent / "docs" / "errata.md"
    assert page.read_text(encoding="utf-8") == errata_page()


def test_page_shows_every_row_in_both_languages() -> None:
    lines = errata_page().splitlines()
    for row in errata():
        for language in LANGUAGES:
            cells = (row.equation, row.printed, row.correct, row.why)
            assert f"| {' | '.join(cell[language] for cell in cells)} |" in lines


def test_command_writes_the_page() -> None:
    command = [sys.executable, "-m", "pendula.study.errata"]
    run = subprocess.run(command, capture_output=True, check=True, timeout=60)
    assert run.stdout.decode("utf-8") == errata_page()
