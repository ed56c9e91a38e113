"""`pendula solve` with the methods that choose their steps: events, trust, and a bar."""

from __future__ import annotations

import json
import math
import re
import sys
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import pendula
from commands import unfolded
from pendula import _engine
from pendula.cli import main, progress
from pendula.cli.events import event_of, words_of
from pendula.events import angle, flip, tip_height, velocity_zero

if TYPE_CHECKING:
    from collections.abc import Callable

    Call = Callable[[str], list[str]]

RODS = pendula.DoublePendulum.rods()
START = [row.standard for row in _engine.system_entries()["double"].components]


@pytest.fixture
def call(lines_of: Call) -> Call:
    """Run the command in an empty folder, successfully: the lines it prints."""
    return lines_of


def told_of(lines: list[str]) -> str:
    """The first paragraph in one line."""
    return unfolded("\n".join(lines)).partition("\n")[0]


def test_no_method_is_taylor_at_its_best(call: Call) -> None:
    line = told_of(call("solve double --t-max 5s -o run.csv"))
    run = pendula.solve(RODS, START, 5.0)
    read = pendula.load("run.csv")
    assert read.states.tobytes() == run.states.tobytes()
    assert line.startswith(
        f"run.csv: {run.n_steps + 1} times; taylor, tolerance 2.22e-16: {run.n_steps} steps, "
        f"{run.n_evaluations} evaluations, reached_end, "
    )


def test_every_spaces_the_outputs_of_any_method(call: Call) -> None:
    line = call("solve double --t-max 1s --every 250ms --tolerance 1e-9 -o run.csv")[0]
    read = pendula.load("run.csv")
    assert read.t.tolist() == [0.0, 0.25, 0.5, 0.75, 1.0]
    assert read.request.tolerance == 1e-9
    assert "taylor, tolerance 1e-09: " in line


def test_events_are_a_table_below_the_run(call: Call) -> None:
    lines = call(
        'solve double --t-max 7s --every 1s --event "flip 2 rising" --event "angle 1 20deg" '
        '--event "tip-height 5 m"'
    )
    asked = flip(2, 1), angle(1, math.radians(20)), tip_height(5.0)
    run = pendula.solve(RODS, START, np.arange(8.0), events=asked)
    below = lines.index("")
    assert "taylor, tolerance" in "".join(lines[below - 2 : below])
    rest = lines[below + 1 :]
    for name, found in zip(("flip 2 rising", "angle 1 "), run.events[:2], strict=True):
        title, first, second, *rest = rest
        assert title.startswith(name)
        assert title.endswith(f": {found.times.size} times")
        assert first.split() == ["theta1", "theta2", "omega1", "omega2"]
        assert second.split() == ["n", "t", "[s]", "[rad]", "[rad]", "[rad/s]", "[rad/s]"]
        own, rest = rest[: found.times.size], rest[found.times.size :]
        rows = [line.split() for line in own]
        assert [int(row[0]) for row in rows] == list(range(1, found.times.size + 1))
        assert [float(row[1]) for row in rows] == pytest.approx(found.times, rel=1e-9)
        assert [float(row[3]) for row in rows] == pytest.approx(found.states[:, 1], rel=1e-5)
    assert rest == ["tip-height 5m: none"]


def test_an_event_may_end_the_run(call: Call) -> None:
    lines = call("solve double --t-max 10s --event 'flip 2 end 2' -o run.csv")
    run = pendula.load("run.csv")
    assert "taylor, tolerance 2.22e-16: " in lines[0]
    assert ", event, largest relative energy error" in told_of(lines)
    assert run.outcome == "event"
    assert run.request.events == (flip(2, 0, 2),)
    assert run.t[-1] == run.events[0].times[1]


@pytest.mark.parametrize(
    ("words", "event"),
    [
        ("flip 1", flip(1)),
        ("flip 2 falling end", flip(2, -1, True)),
        ("angle 1 0deg rising", angle(1, 0.0, 1)),
        ("angle 2 -0.5 pi every-turn end 7", angle(2, -math.pi / 2, 0, 7, every_turn=True)),
        ("angle 1 every-turn rising 0.25 rad", angle(1, 0.25, 1, every_turn=True)),
        ("velocity-zero 2", velocity_zero(2)),
        ("  velocity-zero  1  end 3  rising ", velocity_zero(1, 1, 3)),
        ("tip-height 50cm falling end", tip_height(0.5, -1, True)),
        ("tip-height -0.1 m", tip_height(-0.1)),
    ],
)
def test_an_event_is_read_and_told_in_words(words: str, event: Any) -> None:
    assert event_of(words) == event
    assert event_of(words_of(event)) == event


@pytest.mark.parametrize("given", ["1nrad", "1e-9rad", "'1e-9 rad'"])
def test_certify_says_until_when(given: str, call: Call) -> None:
    lines = call(f"solve double --t-max 60s --every 20s --certify {given} -o run.csv")
    assert lines[0].startswith("run.csv: 4 times; taylor")
    until = re.fullmatch(r"accurate to 1e-09 rad until ([\d.]+) s", lines[-1])
    assert until is not None
    read = pendula.load("run.csv")
    assert float(until[1]) == pytest.approx(read.trust_horizon, rel=1e-5)
    assert 5 < float(until[1]) < 60


def test_certify_says_throughout(call: Call) -> None:
    lines = call("solve simple --t-max 5s --method rk4 --step 1ms --certify 1urad -o run.csv")
    assert lines[-1] == "accurate to 1e-06 rad throughout"
    assert pendula.load("run.csv").trust_horizon == math.inf
    recipe = Path("run.csv").read_text().splitlines()[0].partition(": ")[2]
    assert json.loads(recipe, parse_constant=pytest.fail)["trust_horizon"] == "inf"


def test_digits_say_what_they_took(call: Call) -> None:
    lines = call("solve double --t-max 2s --every 1s --digits 12 -o run.csv")
    read = pendula.load("run.csv")
    assert read.precision is not None
    assert told_of(lines).startswith(
        "run.csv: 3 times; taylor, 12 guaranteed digits: "
        f"computed with {read.precision} digits, reached_end, "
    )
    again = pendula.rerun("run.csv")
    assert again.states.tobytes() == read.states.tobytes()
    assert again.precision == read.precision


# ---- wrong use ----

SHORT = ("solve", "simple", "--t-max", "1s")


def told(capsys: pytest.CaptureFixture[str]) -> str:
    """The one line on stderr."""
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    return printed.err


@pytest.mark.parametrize(
    "words",
    [
        *("", "flip", "flip one", "flip 1 upwards", "flip 1 1rad", "flip 1 every-turn"),
        *("angle 1", "angle 1deg", "angle 1 rising", "velocity-zero 1 0rad/s", "tip-height"),
        *("tip-height rising", "flip 1 end end", "flip 1 5 end", "Flip 1"),
    ],
)
def test_an_event_that_is_misread_is_told_with_examples(
    words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*SHORT, "--event", words]) == 2
    printed = told(capsys)
    assert (
        "--event must be such as 'flip 1', 'angle 1 0deg rising', 'velocity-zero 2' or" in printed
    )
    assert f"got {words!r}" in printed


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("flip 2", "the rod of an --event must be 1 for the simple pendulum, got 2"),
        ("angle 1 5cm", "--event must be in rad or a unit of the same kind, got '5cm'"),
        ("tip-height 0,5m", "--event: write 0.5m; a comma separates"),
        ("flip 1 end 0", "--event: the number after end must be a whole number from 1 to"),
    ],
)
def test_an_event_out_of_range_is_told(
    words: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main([*SHORT, "--event", words]) == 2
    assert message in told(capsys)


def test_events_need_a_method_that_has_them(capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*SHORT, "--method", "rk4", "--step", "1ms", "--event", "flip 1"]) == 2
    assert "events are not taken by the fixed-step method 'rk4'" in told(capsys)


def test_own_steps_that_are_too_many_are_told_with_the_way_out(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def limited(*given: Any, **options: Any) -> Any:
        run = solve(*given, **options, max_steps=20)
        return replace(run, request=replace(run.request, max_steps=None))

    solve = pendula.solve
    monkeypatch.setattr("pendula.run.solve.solve", limited)  # else it takes ten million
    assert main(["solve", "double", "--t-max", "1e12s"]) == 1
    printed = told(capsys)
    assert "taylor stopped at t = " in printed
    assert "set the time between outputs with --every" in printed


# ---- a bar ----


class Terminal:
    """A stream that says it is one."""

    def __init__(self) -> None:
        self.text = ""

    def write(self, text: str) -> int:
        self.text += text
        return len(text)

    def flush(self) -> None:
        pass

    def isatty(self) -> bool:
        return True


def test_a_bar_comes_after_a_moment_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    with progress.late_bar("taylor") as told:
        assert told is not None
        told(0.5)
        assert terminal.text == ""
        monkeypatch.setattr(progress, "_MOMENT", -1.0)
        told(0.6)
    assert "taylor" in terminal.text


def test_no_bar_is_shown_elsewhere() -> None:
    with progress.late_bar("taylor") as told:
        assert told is None
