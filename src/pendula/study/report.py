"""The report: one text in each language, set as one HTML file and as PDF."""

from __future__ import annotations

import json
import shutil
import tomllib
from importlib import resources
from pathlib import Path
from typing import Any

from pendula._checks import extra

# The typesetter reads only below its root: the study's folder, where this one stands for a while.
_BUILD = "build"


def catalogue(language: str) -> dict[str, Any]:
    """The words that the study needs outside its text, in one language."""
    file = resources.files("pendula.study").joinpath("templates", language, "words.toml")
    return tomllib.loads(file.read_text(encoding="utf-8"))


def write_report(
    folder: Path, facts: dict[str, Any], motions: dict[str, Any], *, main: str = "report.typ"
) -> None:
    """Set report.html and report.pdf in a folder that has the study's figures.

    Args:
        folder: where `figures/` is.
        facts: what the text says in numbers, from `pendula.study.facts`.
        motions: what the page replays, from `pendula.study.motions`.
        main: the template that the text begins with.

    Raises:
        MissingExtraError: without the package typst.
    """
    typst = extra("typst", "report")
    letters = Path(extra("matplotlib", "report").get_data_path(), "fonts", "ttf")  # of the figures
    build = folder / _BUILD
    with resources.as_file(resources.files("pendula.study").joinpath("templates")) as templates:
        shutil.copytree(templates, build)
    (build / "facts.json").write_text(json.dumps(facts), encoding="utf-8")
    # "</" would end the script element that holds the motions.
    compact = json.dumps(motions, separators=(",", ":")).replace("</", "<\\/")
    (build / "motions.json").write_text(compact, encoding="utf-8")
    for format_ in ("html", "pdf"):
        # Warnings are kept back: all there is says that HTML output is young.
        typst.compile_with_warnings(
            str(build / main),
            output=str(folder / f"report.{format_}"),
            root=str(folder),
            format=format_,
            ignore_system_fonts=True,
            font_paths=[str(letters)],
            sys_inputs={"format": format_},
            timestamp=0,
        )
    shutil.rmtree(build)
    page = folder / "report.html"
    page.write_text(_accents(page.read_text(encoding="utf-8")), encoding="utf-8", newline="\n")


def _accents(html: str) -> str:
    """Dots that stand above their letter: browsers set a combining one beside it."""
    return html.replace("<mo>\u0307</mo>", "<mo>\u02d9</mo>").replace(
        "<mo>\u0308</mo>", "<mo>\u00a8</mo>"
    )
