"""CSV files that a spreadsheet has saved: its marks are taken back, its rounding is refused."""

from __future__ import annotations

import csv
import io
import re
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

import pendula
from alike import same
from damage import RUNS
from pendula import SimplePendulum, exact, solve

if TYPE_CHECKING:
    from collections.abc import Callable

    from pendula import Trajectory

NUMBER = re.compile(r"\s*[+-]?\d+(\.\d*)?([eE][+-]?\d+)?\s*")


def shown(cell: str, digits: int, comma: str) -> str:
    """A cell as a spreadsheet writes it: what is a number is one, in its own format."""
    if not NUMBER.fullmatch(cell):
        return cell
    return f"{float(cell):.{digits}g}".replace("e", "E").replace(".", comma)


def resaved(text: str, separator: str, comma: str = ".", digits: int = 17) -> str:
    """A file that was opened as comma separated and saved with another separator.

    Rows are filled up with empty cells to the width of the first.
    """
    rows = list(csv.reader(io.StringIO(text, newline="")))
    width = max(map(len, rows))
    out = io.StringIO(newline="")
    writer = csv.writer(out, delimiter=separator, lineterminator="\r\n")
    for row in rows:
        cells = [shown(cell, digits, comma) for cell in row]
        writer.writerow(cells + [""] * (width - len(row)))
    return out.getvalue()


def one_cell_a_line(text: str) -> str:
    """A file whose lines a spreadsheet took for one cell each, as it wants semicolons."""
    out = io.StringIO(newline="")
    csv.writer(out, delimiter=";", lineterminator="\r\n").writerows(
        [[x] for x in text.splitlines()]
    )
    return out.getvalue()


def quoted(text: str) -> str:
    """Each cell of the table in quotes, and the recipe as one."""
    out = io.StringIO(newline="")
    first, *rest = text.splitlines()
    csv.writer(out, quoting=csv.QUOTE_ALL).writerows([[first], *csv.reader(rest)])
    return out.getvalue()


RESAVED: dict[str, Callable[[str], bytes]] = {
    "mark": lambda text: b"\xef\xbb\xbf" + text.encode(),
    "utf-16": lambda text: text.encode("utf-16"),
    "blank end": lambda text: f"{text}\n\r\n \n".replace(" \n", "\n").encode(),
    "empty rows": lambda text: f"{text},,,\n,,,\n".encode(),
    "windows lines": lambda text: text.replace("\n", "\r\n").encode(),
    "quotes": lambda text: quoted(text).encode(),
    "commas": lambda text: resaved(text, ",").encode(),
    "semicolons": lambda text: resaved(text, ";", ",").encode("utf-8-sig"),
    "semicolons, points": lambda text: resaved(text, ";").encode(),
    "tabs": lambda text: resaved(text, "\t", ",").encode("utf-16"),
    "one cell a line": lambda text: one_cell_a_line(text).encode("utf-8-sig"),
}


def text_of(run: Trajectory, folder: Path) -> str:
    run.save(folder / "run.csv")
    return (folder / "run.csv").read_bytes().decode()


@pytest.mark.parametrize("how", RESAVED)
@pytest.mark.parametrize("name", RUNS)
def test_numbers_that_are_unchanged_are_read(name: str, how: str, tmp_path: Path) -> None:
    run = RUNS[name]()
    path = tmp_path / "saved.csv"
    path.write_bytes(RESAVED[how](text_of(run, tmp_path)))
    same(pendula.load(path), run)
    again = pendula.rerun(path)
    assert again.states.tobytes() == run.states.tobytes()


@pytest.mark.parametrize("digits", [15, 10, 6])
@pytest.mark.parametrize(("separator", "comma"), [(",", "."), (";", ","), ("\t", ",")])
def test_rounded_numbers_are_refused_with_the_reason(
    separator: str, comma: str, digits: int, tmp_path: Path
) -> None:
    path = tmp_path / "saved.csv"
    path.write_text(resaved(text_of(RUNS["times"](), tmp_path), separator, comma, digits))
    for read in (pendula.load, pendula.rerun):
        with pytest.raises(
            ValueError, match="does not fit its checksum; its numbers have at mo"
        ) as e:
            read(path)
        assert "as spreadsheets round them: take the file as it was before" in str(e.value)
        assert "\n" not in str(e.value)


def test_a_recipe_that_is_rounded_is_refused_with_the_reason(tmp_path: Path) -> None:
    run = solve(SimplePendulum(), (1.2345678901234567, 0.1), [0.0, 0.0625])
    path = tmp_path / "saved.csv"
    path.write_text(resaved(text_of(run, tmp_path), ",", digits=15))
    with pytest.raises(ValueError, match="does not fit .*as spreadsheets round them"):
        pendula.load(path)


def test_numbers_of_few_digits_survive_rounding(tmp_path: Path) -> None:
    """At rest all of them are short."""
    run = exact(SimplePendulum(), (0.0, 0.0), np.arange(11) / 8)
    path = tmp_path / "saved.csv"
    path.write_text(resaved(text_of(run, tmp_path), ";", ",", digits=15))
    same(pendula.load(path), run)


def test_a_changed_number_is_damage_not_rounding(tmp_path: Path) -> None:
    text = text_of(RUNS["times"](), tmp_path)
    lines = text.splitlines(keepends=True)
    lines[9] = lines[9].replace("1", "2", 1)
    path = tmp_path / "saved.csv"
    path.write_text("".join(lines))
    with pytest.raises(ValueError, match="damaged") as error:
        pendula.load(path)
    assert "spreadsheets" not in str(error.value)


@pytest.mark.parametrize("number", range(1, 21))
def test_a_blank_row_inside_is_still_damage(number: int, tmp_path: Path) -> None:
    lines = text_of(RUNS["times"](), tmp_path).splitlines(keepends=True)
    path = tmp_path / "saved.csv"
    path.write_text("".join([*lines[: number + 1], "\n", *lines[number + 1 :]]))
    with pytest.raises(ValueError, match=f"is not whole: row {number} has 0 cells of 6"):
        pendula.load(path)
