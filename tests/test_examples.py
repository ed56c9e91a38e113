"""Every example runs, without a warning, and says something."""

import runpy
import sys
from pathlib import Path

import pytest

from test_readme import ROOT

EXAMPLES = sorted((ROOT / "examples").glob("*.py"))


@pytest.mark.parametrize("example", EXAMPLES, ids=lambda example: example.name)
def test_an_example_runs(
    example: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sys, "argv", [str(example)])
    runpy.run_path(str(example), run_name="__main__")
    printed = capsys.readouterr()
    assert printed.out.strip()
    assert not printed.err


def test_there_are_examples_and_the_documentation_tells_of_each() -> None:
    page = (ROOT / "docs" / "en" / "getting-started.md").read_text(encoding="utf-8")
    assert EXAMPLES
    for example in EXAMPLES:
        assert f"python examples/{example.name} " in page


@pytest.mark.parametrize(
    "example",
    ["parting.py", "near_the_separatrix.py", "decays.py", "kapitza.py", "period_doubling.py"],
)
def test_a_picture_is_the_same_file_each_time(example: str, tmp_path: Path) -> None:
    draw = runpy.run_path(str(ROOT / "examples" / example))["main"]
    for name in ("one.svg", "two.svg"):
        draw(str(tmp_path / name))
    assert (tmp_path / "one.svg").read_bytes() == (tmp_path / "two.svg").read_bytes()
