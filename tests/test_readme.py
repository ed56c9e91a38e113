"""The README and the documentation keep their word: their code and commands are run.

A `text` block after a `python` block is what it prints; in a `console` block the lines after a
command are. `...` stands for anything within a line, and alone on a line for any lines. A `toml`
block whose first line is a comment with a file's name is that file.
"""

import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parent.parent
# The Spanish pages have the same code, from docs/code.
PAGES = [
    ROOT / "README.md",
    ROOT / "CONTRIBUTING.md",
    *sorted((ROOT / "docs" / "en").rglob("*.md")),
]
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LANGUAGES = {"console", "cpp", "diff", "python", "text", "toml"}


@dataclass(frozen=True)
class Block:
    """A fenced block of a page."""

    language: str
    text: str
    line: int


def blocks(page: Path) -> list[Block]:
    text = page.read_text(encoding="utf-8")
    return [Block(m[1], m[2], text.count("\n", 0, m.start()) + 1) for m in BLOCK.finditer(text)]


def matches(shown: str, real: str) -> bool:
    """Whether what a page shows is what was printed, apart from the width of spaces."""
    pattern = "".join(
        r"(?:[^\n]*\n)*?" if line == "..." else re.escape(line).replace(r"\.\.\.", "[^\n]*") + r"\n"
        for line in _lines(shown)
    )
    return re.fullmatch(pattern, "".join(f"{line}\n" for line in _lines(real))) is not None


def _lines(text: str) -> list[str]:
    # a last digit more or less moves a column: spaces count as one
    return [" ".join(line.split()) for line in text.strip("\n").splitlines()]


def commands(text: str) -> Iterator[tuple[str, str]]:
    """Each command of a console block with the output shown below it."""
    for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        command, _, shown = part.partition("\n")
        yield command, shown


def check_setup(command: str) -> bool:
    """Whether a command sets something up; such are not run, but what they name has to exist."""
    words = command.partition("#")[0].split()
    if words[0] == "make":
        targets = re.findall(r"^(\w[\w-]*):", (ROOT / "Makefile").read_text("utf-8"), re.MULTILINE)
        assert set(words[1:]) <= set(targets), f"no such target: {command}"
    elif words[:2] == ["pip", "install"]:
        project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
        named = {extra for group in re.findall(r"\[(.*?)\]", command) for extra in group.split(",")}
        assert named <= set(project["optional-dependencies"]), f"no such extra: {command}"
    elif words[0] == "source":
        assert words[1] == ".venv/bin/activate", f"made by no target: {command}"
    else:
        return False
    return True


class Reader:
    """Does what a page says, from top to bottom, in a folder that has nothing but the examples."""

    def __init__(self, page: Path, folder: Path) -> None:
        self.page, self.folder = page, folder
        self.names: dict[str, Any] = {"__name__": "page"}
        shutil.copytree(ROOT / "examples", folder / "examples")
        tools = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        self.environment = os.environ | {"PATH": tools, "PYTHONUTF8": "1", "COLUMNS": "80"}

    def read(self) -> None:
        printed: str | None = None
        for block in blocks(self.page):
            where = f"{self.page.name}:{block.line}"
            assert block.language in LANGUAGES, where
            if block.language == "text":
                assert printed is not None, f"{where}: text without the code that prints it"
                self.compare(block.text, printed, where)
            printed = None
            if block.language == "python":
                printed = self.python(block, where)
            elif block.language == "console":
                self.console(block, where)
            elif block.language == "toml" and (name := re.match(r"# (\S+\.toml)\n", block.text)):
                (self.folder / name[1]).write_text(block.text, encoding="utf-8")

    def python(self, block: Block, where: str) -> str:
        code = compile("\n" * block.line + block.text, self.page, "exec")
        with contextlib.redirect_stdout(io.StringIO()) as printed, contextlib.chdir(self.folder):
            exec(code, self.names)
        return printed.getvalue()

    def console(self, block: Block, where: str) -> None:
        code, unasked = 0, ""
        for command, shown in commands(block.text):
            if command == "echo $?":
                self.compare(shown, str(code), f"{where}: exit code")
                unasked = ""
                continue
            assert not unasked, f"{where}: {unasked}"
            if check_setup(command):
                continue
            done = subprocess.run(
                ["sh", "-c", command],
                cwd=self.folder,
                env=self.environment,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                encoding="utf-8",
                check=False,
            )
            code = done.returncode
            unasked = f"{command} ended with {code}: {done.stdout}" if code else ""
            if shown.strip():
                self.compare(shown, done.stdout, f"{where}: {command}")
        assert not unasked, f"{where}: {unasked}"

    @staticmethod
    def compare(shown: str, real: str, where: str) -> None:
        assert matches(shown, real), f"{where} shows\n{shown}\nbut it is\n{real}"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_a_page_keeps_its_word(page: Path, tmp_path: Path) -> None:
    Reader(page, tmp_path).read()


def test_the_readme_shows_the_two_commands_and_python() -> None:
    first_screen = "\n".join((ROOT / "README.md").read_text(encoding="utf-8").splitlines()[:45])
    assert "$ make study" in first_screen
    assert "$ make test" in first_screen
    assert "```python" in first_screen
    assert "![" in first_screen


@pytest.mark.parametrize(
    "page",
    [
        "```python\nprint(1)\n```\n\n```text\n2\n```\n",
        "```text\n2\n```\n",
        "```python\nimport no_such_module\n```\n",
        "```console\n$ pendula period simple --amplitude 30deg\n29deg\n```\n",
        "```console\n$ pendula period triple\n```\n",
        "```console\n$ pendula --version\n$ echo $?\n2\n```\n",
        "```console\n$ make coffee\n```\n",
        '```console\n$ pip install ".[everything]"\n```\n',
        "```pyhton\n```\n",
    ],
)
def test_a_page_that_does_not_is_found_out(page: str, tmp_path: Path) -> None:
    (tmp_path / "page.md").write_text(page, encoding="utf-8")
    reader = Reader(tmp_path / "page.md", tmp_path)
    with pytest.raises((AssertionError, ImportError)):
        reader.read()


@pytest.mark.parametrize(
    ("shown", "real", "same"),
    [
        ("a\nb\n", "a  \nb", True),
        ("a\nb", "a\nc", False),
        ("a b", "  a    b", True),
        ("a b", "ab", False),
        ("1.23...", "1.2345", True),
        ("1.23...\n4", "1.2345\n6\n4", False),
        ("a\n...\nd", "a\nb\nc\nd\n", True),
        ("a\n...\nd", "a\nd", True),
        ("a\n...", "b\na\n", False),
        ("a.c", "abc", False),
    ],
)
def test_an_ellipsis_stands_for_anything(shown: str, real: str, same: bool) -> None:
    assert matches(shown, real) is same
