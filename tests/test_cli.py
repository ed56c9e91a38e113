"""The command's subcommands: what they print and what they write."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import TYPE_CHECKING

import click
import numpy as np
import pytest

import pendula
from commands import unfolded
from pendula import _engine
from pendula.cli import app
from pendula.cli.plots import curve
from pendula.cli.solve import _own_times
from pendula.run._times import spaced
from pendula.systems import systems_that

if TYPE_CHECKING:
    from collections.abc import Callable

    from commands import Call


def options_of(*path: str) -> dict[str, click.Parameter]:
    command: click.Command = app._pendula
    for name in path:
        assert isinstance(command, click.Group)
        command = command.commands[name]
    return {option: each for each in command.params for option in each.opts}


def test_version_and_help(call: Call) -> None:
    assert call("--version") == (0, f"pendula {pendula.__version__}\n", "")
    code, printed, told = call("")
    assert (code, told) == (0, "")
    for name in ("solve", "exact", "period", "methods", "compare", "study"):
        assert re.search(rf"^  {name} ", printed, re.MULTILINE)
        assert call(f"{name} --help")[0] == 0


@pytest.mark.parametrize("entry", systems_that(), ids=lambda entry: entry.name)
def test_the_catalogue_gives_the_options(entry: _engine.SystemEntry) -> None:
    rows = {row.name for form in entry.forms for row in form.parameters}
    state = {row.name for row in entry.components}
    forms = {form.name for form in entry.forms} if len(entry.forms) > 1 else set()
    options = options_of("solve", entry.name)
    own = {"t0", "t-max", "method", "every", "output", "force", "event", "events-file"}
    own |= {row.name.replace("_", "-") for row in _engine.option_rows()}
    assert {name[2:] for name in options if name.startswith("--")} == {
        name.replace("_", "-") for name in rows | state | forms | own
    }
    method = options["--method"].type
    assert isinstance(method, click.Choice)
    assert list(method.choices) == [each.name for each in _engine.methods()]
    for row in (row for form in entry.forms for row in form.parameters):
        option = options[f"--{row.name.replace('_', '-')}"]
        assert isinstance(option, click.Option)
        help = option.help or ""
        assert row.meaning in help
        standard = math.degrees(row.standard or 0.0) if row.unit == "rad" else row.standard
        unit = "deg" if row.unit == "rad" else row.unit
        assert row.standard is None or f"[default: {standard:g} {unit}]" in help


@pytest.mark.parametrize("row", _engine.option_rows(), ids=lambda row: row.name)
def test_the_core_gives_the_options_of_a_run(row: _engine.OptionRow) -> None:
    option = options_of("solve", "simple")[f"--{row.name.replace('_', '-')}"]
    assert isinstance(option, click.Option)
    assert option.help == f"{row.meaning}, e.g. {row.example:.7g}{row.unit} [{row.otherwise}]"


def test_the_old_name_of_the_end_is_taken(call: Call) -> None:
    old, new = (call(f"solve simple --{name} 1s --every 500ms") for name in ("until", "t-max"))
    assert old == new
    assert old[0] == 0


def test_a_limit_of_steps_is_an_option(call: Call) -> None:
    code, printed, told = call("solve simple --t-max 1s --max-steps 3")
    assert (code, printed) == (1, "")
    assert told.endswith(" of 1 s: it took the 3 steps that were allowed\n")
    assert call("solve simple --t-max 1s --max-steps 300")[0] == 0


def test_the_table_of_methods_is_the_catalogue(call: Call) -> None:
    _, printed, _ = call("methods")
    top, sources = printed.split("\n\nSources:\n")
    first, second, *lines = top.splitlines()
    assert first.split() == ["dense", "evals"]
    assert re.split("  +", second) == [
        *("name", "order", "kind", "symplectic", "output", "per step", "systems"),
    ]
    assert [line.split()[0] for line in lines] == [each.name for each in _engine.methods()]
    assert unfolded(sources).splitlines() == [
        f"{each.name}: {each.source}" for each in _engine.methods()
    ]
    for line, each in zip(lines, _engine.methods(), strict=True):
        systems = line.split("  ")[-1].strip()
        assert systems in ("all", "ideal", "linear, simple")
        assert {"all": 6, "ideal": 3, "linear, simple": 2}[systems] == len(each.systems)
        assert int(line.split()[1]) == each.order
        assert line.split()[2] == ("adaptive" if each.adaptive else "fixed")
        assert line.split()[4] == ("yes" if each.adaptive else "no")


def test_periods_are_printed_to_the_last_digit(call: Call) -> None:
    code, printed, _ = call("period simple --length 50cm --amplitude 30deg,60deg")
    assert code == 0
    header, *rows = printed.splitlines()
    assert header.split() == ["amplitude", "amplitude", "[rad]", "period", "[s]", "T/T0"]
    system = pendula.SimplePendulum(length=0.5)
    small = 2 * math.pi / system.natural_frequency
    for row, degrees in zip(rows, (30, 60), strict=True):
        name, *numbers = row.split()
        amplitude, period, ratio = map(float, numbers)
        assert name == f"{degrees}deg"
        assert amplitude == pytest.approx(math.radians(degrees), rel=3e-16)
        assert period == system.period([amplitude])[0]
        assert ratio == period / small


def test_the_period_through_a_state(call: Call) -> None:
    """A rotation, and the separatrix."""
    _, printed, _ = call("period simple --length 50cm --theta 30deg --omega 20rad/s")
    theta, omega, period, ratio = map(float, printed.splitlines()[-1].split())
    system = pendula.SimplePendulum(0.5)
    assert period == system.period(state=(theta, omega))
    assert ratio < 1
    assert call("period simple --length 1m --gravity 1m/s^2 --theta 0deg --omega 2rad/s")[
        1
    ].splitlines()[-1].split()[2:] == ["inf", "inf"]


def test_the_linear_period_does_not_depend_on_the_amplitude(call: Call) -> None:
    _, printed, _ = call("period linear --amplitude 1deg,90deg")
    assert [row.split()[-1] for row in printed.splitlines()[1:]] == ["1.0", "1.0"]


def test_a_saved_run_is_the_run(call: Call) -> None:
    line = (
        "solve double --bobs --m1 2kg --l2 50cm --theta1 1rad --theta2 -10deg --omega2 -1rad/s "
        "--method heun --step 10ms --t-max 2s -o run.csv"
    )
    code, printed, told = call(line)
    assert (code, told) == (0, "")
    assert printed.startswith("run.csv: 201 times; heun, step 0.01 s: 200 steps, 400 evaluations")
    assert unfolded(printed).count("\n") == 1
    read = pendula.load("run.csv")
    system = pendula.DoublePendulum.bobs(m1=2.0, l2=0.5)
    state = (1.0, -0.17453292519943295, 0.0, -1.0)
    same = pendula.solve(system, state, 2.0, "heun", step=0.01)
    assert read.system == system
    assert np.array_equal(read.t, same.t)
    assert np.array_equal(read.states, same.states)
    assert [path.name for path in Path().iterdir()] == ["run.csv"]


def test_force_replaces_a_file(call: Call) -> None:
    Path("run.csv").write_text("old")
    assert call("exact linear --at 1s -o run.csv --force")[0] == 0
    assert pendula.load("run.csv").t.tolist() == [1.0]


def test_every_spaces_the_outputs(call: Call) -> None:
    call("solve simple --method rk4 --step 1ms --t0 1s --t-max 2.05s --every 100ms -o run.csv")
    read = pendula.load("run.csv")
    assert read.t == pytest.approx([*(1.0 + 0.1 * n for n in range(11)), 2.05], abs=1e-15)
    assert read.t[-1] == 2.05


@pytest.mark.parametrize(
    ("t0", "t_max", "every", "times"),
    [
        (0.0, 0.4, 0.1, [0.0, 0.1, 0.2, 0.3, 0.4]),  # 3 × 0.1 would be 0.30000000000000004
        (0.1, 0.3, 0.1, [0.1, 0.2, 0.3]),
        (0.0, 0.1, 0.04, [0.0, 0.04, 0.08, 0.1]),
        (1.0, 0.0, 0.5, [1.0, 0.5, 0.0]),
        (0.0, 3 * math.pi, math.pi, [0.0, math.pi, 2 * math.pi, 3 * math.pi]),
        (0.0, 1e300, 5e299, [0.0, 5e299, 1e300]),
    ],
)
def test_outputs_lie_on_decimal_times(
    t0: float, t_max: float, every: float, times: list[float]
) -> None:
    assert spaced(t0, t_max, every).tolist() == times


def test_a_printed_run_keeps_every_so_many_steps() -> None:
    times = np.asarray(_own_times(0.0, 20.0, 1e-4, thin=True))
    assert len(times) == 20_001
    assert times[1] == 1e-3
    assert _own_times(0.0, 20.0, 1e-4, thin=False) == 20.0


def test_a_printed_run_is_short(call: Call) -> None:
    code, printed, told = call("solve double --method rk4 --step 100us --t-max 20s")
    assert (code, told) == (0, "")
    lines = printed.splitlines()
    assert len(lines) <= 40
    assert max(map(len, lines)) <= 80
    assert [float(line.split()[0]) for line in lines[1:12]] == [2.0 * n for n in range(11)]
    last = unfolded(printed).splitlines()[-1]
    assert last.startswith("rk4, step 0.0001 s: 200000 steps, 800000 evaluations, reached_end, ")
    assert float(lines[-1].split()[-1]) < 1e-10


def test_a_printed_run_has_the_numbers_of_the_interface(call: Call) -> None:
    _, printed, _ = call(
        "solve simple --length 50cm --theta 1rad --method rk4 --step 10ms --t-max 1s"
    )
    last = [float(number) for number in printed.splitlines()[11].split()]
    run = pendula.solve(pendula.SimplePendulum(length=0.5), (1.0, 0.0), 1.0, "rk4", step=0.01)
    assert last[0] == 1.0
    assert last[1:3] == pytest.approx(run.states[-1], rel=1e-12)
    assert last[3] == pytest.approx(run.energy_error[-1], rel=0.1)


def test_exact_prints_each_time_asked_for(call: Call) -> None:
    at = ",".join(f"{n}s" for n in range(30, 0, -1))
    _, printed, _ = call(f"exact simple --theta 1rad --at {at}")
    rows = printed.splitlines()[1:31]
    run = pendula.exact(pendula.SimplePendulum(), (1.0, 0.0), np.arange(30.0, 0.0, -1.0))
    assert [float(row.split()[1]) for row in rows] == pytest.approx(run.theta, rel=1e-12)


def test_bodies_take_their_own_parameters(call: Call) -> None:
    given = "--m1 1 --m2 1 --l1 1 --c1 50cm --c2 0.5 --I1 0.25 --I2 0"
    code, _, _ = call(
        f"solve double --bodies {given} --method rk4 --step 10ms --t-max 1s -o run.csv"
    )
    assert code == 0
    described = json.loads(Path("run.csv").read_text().splitlines()[0].partition(": ")[2])["system"]
    assert described["form"] == "bodies"
    assert described["parameters"]["I1"] == 0.25
    assert described["parameters"]["l2"] == 0.5


def test_a_curve_goes_from_corner_to_corner() -> None:
    t = np.linspace(0.0, 2.0, 300)
    top, bottom, times = curve(t, 3.0 * t, width=10, height=2).splitlines()
    assert top.startswith("        6 │")
    assert bottom.startswith("        0 │")
    assert times.split() == ["0", "2", "s"]
    left, right = top.partition("│")[2], bottom.partition("│")[2]
    assert left[:4] == "\u2800" * 4
    assert left[-1] != "\u2800"
    assert right[-4:] == "\u2800" * 4
    assert right[0] != "\u2800"


def test_a_constant_has_a_curve() -> None:
    lines = curve(np.array([0.0, 1.0]), np.array([2.0, 2.0]), width=5, height=2).splitlines()
    assert lines[0].endswith("⠉⠉⠉⠉⠉")


def test_study_hands_on_what_was_asked_for(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    seen: list[object] = []

    def run_study(
        recipe: Path | None,
        out: Path,
        language: str,
        *,
        figures: tuple[str, ...],
        measured: object,
        overwrite: bool,
        progress: Callable[[str, float], None],
    ) -> Path:
        seen.extend([recipe, out, language, figures, measured, overwrite])
        for share in (0.0, 0.25, 0.5):
            progress("drawing" if share else "solving", share)
        return out

    monkeypatch.setattr("pendula.study.run_study", run_study)
    Path("mine.toml").touch()
    code, printed, told = call("study mine.toml --out folder --lang es --figures png --force")
    assert (code, printed) == (0, f"{Path('folder/report.html')}\n")
    assert told.splitlines() == ["  0% solving", " 25% drawing"]
    assert seen == [Path("mine.toml"), Path("folder"), "es", ("png",), None, True]
