"""What is told of a file is told in Spanish too: every sentence that reading can write."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

import pendula.measured
from pendula.measured import read
from pendula.measured.words.reading import reading_note
from recordings import recording

_ROOM = Path(pendula.measured.__file__).parent


def sentences() -> list[str]:
    """What `log.note` is given in the source, with something in place of its values."""
    found = []
    for path in sorted(_ROOM.glob("*.py")):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(node, ast.Call) or not isinstance(node.func, ast.Attribute):
                continue
            if node.func.attr in ("note", "noted"):
                found += [text for each in node.args for text in texts(each)]
    return found


def texts(node: ast.expr) -> list[str]:
    """What an expression of text can be."""
    if isinstance(node, ast.Constant):
        return [node.value] if isinstance(node.value, str) else []
    if isinstance(node, ast.IfExp):
        return [*texts(node.body), *texts(node.orelse)]
    if isinstance(node, ast.BinOp):
        return [a + b for a in texts(node.left) for b in texts(node.right)]
    if isinstance(node, ast.JoinedStr):
        found = [""]
        for part in node.values:
            said = texts(part) if isinstance(part, ast.Constant) else filled(part)
            found = [a + b for a in found for b in said]
        return found
    return []


def filled(part: ast.expr) -> list[str]:
    """What stands in place of a value."""
    assert isinstance(part, ast.FormattedValue)
    source = ast.unparse(part.value)
    choices = texts(part.value) if isinstance(part.value, ast.IfExp) else []
    known = {
        "sizes": ["their size shows it", "none is larger than angles in radians are"],
        "per": ["one swing", "10 swings: divided by that"],
        "beside": ["; not used: 'b'"],
        "turned": [", with its sign turned"],
        "sort": ["with gravity: L ω² + g cos θ"],
    }
    return choices or known.get(source, ["7.5"])


def test_every_sentence_of_the_source_has_its_spanish_one() -> None:
    found = sentences()
    assert len(found) > 40
    for sentence in found:
        spanish = reading_note(sentence, "es")
        assert spanish != sentence, sentence
        assert reading_note(sentence, "en") == sentence
        assert not re.search(r"\b(the|from|are|told|taken)\b", spanish), spanish


def test_names_and_numbers_are_kept() -> None:
    sentence = "Times from 't.1 (s)', counted from 1970: from the first sample on."
    assert "'t.1 (s)'" in reading_note(sentence, "es")
    assert reading_note("3 gaps, the longest of 0.25 s: left as they are.", "es") == (
        "3 huecos, el mayor de 0,25 s: se dejan como están."
    )
    with pytest.raises(ValueError, match="language must be one of en, es"):
        reading_note(sentence, "fr")


@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("single_three_runs_semicolon_degrees.csv", {"run": 1}),
        ("single_no_header_degrees.csv", {}),
        ("phone_linear_acceleration.csv", {}),
        ("phyphox_single.xls", {}),
        ("double_tracked.trk", {"as_angle": True, "t": (0.1, 1.0)}),
        ("double_pixels_no_header_no_time.csv", {"frame_rate": 501, "as_angle": True}),
        ("periods_stopwatch.csv", {"swings": 10}),
    ],
)
def test_stored_recordings_are_told_in_spanish(name: str, given: dict[str, object]) -> None:
    for note in read(recording(name), **given).notes:  # type: ignore[arg-type]
        assert reading_note(note, "es") != note
