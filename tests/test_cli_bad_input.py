"""Wrong use and failed runs: the exit code, exactly one line on stderr, and no file left."""

from __future__ import annotations

import errno
import os
import shlex
import signal
import sys
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING

import pytest

from pendula._checks import how_to_install
from pendula._engine import methods
from pendula.cli import main
from pendula.io import files

if TYPE_CHECKING:
    from pendula.run.trajectory import Trajectory

SOLVE = "solve simple --method rk4 --step 1ms --t-max 1s"
TAYLOR = "solve simple --t-max 1s"
DOUBLE = "solve double --method rk4 --step 1ms --t-max 1s"
BLOW_UP = "solve double --method euler --step 1s --t-max 1000s"
EXISTING = "there.csv"


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path(EXISTING).write_text("kept")


def told(arguments: list[str], code: int, capsys: pytest.CaptureFixture[str]) -> str:
    """The one line on stderr of a run that must fail and leave nothing behind."""
    before = kept()
    assert main(arguments) == code
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    assert printed.err.startswith("pendula: ")
    assert kept() == before
    return printed.err


def kept() -> dict[Path, str]:
    """What is in the folder."""
    return {path: path.read_text() if path.is_file() else "" for path in Path().iterdir()}


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (f"{SOLVE} --length -50cm", "--length must be positive [m], got -0.5"),
        (f"{SOLVE} --length 0", "--length must be positive [m], got 0.0"),
        (f"{SOLVE} --length nan", "--length must be a finite number [m], got 'nan'"),
        (f"{SOLVE} --theta inf", "--theta must be a finite number [rad], got 'inf'"),
        (f"{SOLVE} --length 0,5m", "--length: write 0.5m; a comma separates"),
        (f"{SOLVE} --step 0,5ms", "--step: write 0.5ms; a comma separates"),
        (f"{SOLVE} --every 0,1", "--every: write 0.1; a comma separates"),
        (
            f"{SOLVE} --length 30deg",
            "--length must be in m or a unit of the same kind, got '30deg'",
        ),
        (f"{SOLVE} --length 5quux", "--length has the unknown unit 'quux'"),
        (f"{SOLVE} --length", "'--length' requires an argument"),
        (f"{SOLVE} --length 50 cm", "a value with spaces needs quotes"),
        (f"{SOLVE} --lenght 1", "No such option '--lenght'. (Did you mean one of: "),
        (f"{SOLVE} --length 1e-308 --gravity 1e308", "cannot be computed with"),
        (f"{SOLVE} --step 0", "--step must be positive [s], got 0.0"),
        (f"{SOLVE} --step -1ms", "--step must be positive [s], got -0.001"),
        (f"{SOLVE} --step 2s", "--step must not exceed the span of 1.0 s"),
        (f"{SOLVE} --step 1e-300", "--step = 1e-300 s is too small for a span of 1.0 s: over 2^53"),
        (f"{SOLVE} --step 1e-12 -o x.csv", "--step = 1e-12 s makes 1e+12 outputs up to 1 s; give"),
        (f"{SOLVE} --t-max 0", "--t-max must differ from --t0 = 0.0 s"),
        (f"{SOLVE} --every 2s", "--every must not exceed the span of 1.0 s"),
        (f"{SOLVE} --every 0s", "--every must be positive [s], got 0.0"),
        (f"{SOLVE} --every 1e-12", "--every must give at most 100000000 outputs"),
        (f"{SOLVE} --method rk5", ", ".join(repr(each.name) for each in methods())),
        (
            "solve simple --step 1ms --t-max 1s",
            "--step is not taken by the adaptive method 'taylor', got 0.001; leave it out",
        ),
        (
            "solve simple --method rk4 --t-max 1s",
            "--step is needed by the fixed-step method 'rk4'; give --step 0.001s, say",
        ),
        (f"{SOLVE} --tolerance 1e-9", "--tolerance is not taken by the fixed-step method 'rk4'"),
        (f"{TAYLOR} --tolerance 1e-20", "got 1e-20; for more digits than a double has, take --dig"),
        (f"{TAYLOR} --tolerance small", "--tolerance "),
        (f"{TAYLOR} --tolerance 1e-9m", "--tolerance must be "),
        (f"{TAYLOR} --certify 3rad", "--certify must be an angle of at most 1 rad, got 3.0"),
        (f"{TAYLOR} --certify 1nm", "--certify must be in rad or a unit of the same kind"),
        (f"{TAYLOR} --certify 0rad", "--certify must be positive [rad], got 0.0"),
        (f"{TAYLOR} --digits 16", "--digits must be a whole number from 1 to 15, got 16"),
        (f"{TAYLOR} --digits nine", "Invalid value for '--digits': 'nine' is not a valid integer"),
        (f"{DOUBLE} --method verlet", "--method 'verlet' needs a system whose energy separates"),
        (f"{TAYLOR} --digits 9 --tolerance 1e-9", "--digits is not taken together with --toler"),
        (f"{SOLVE} --digits 9", "--digits is not taken together with --method rk4: it"),
        (f"{SOLVE} --event velocity-zero", "--event must be such as 'flip 1', 'angle 1 0deg risi"),
        (f"{TAYLOR} --event 'flip 3'", "the rod of an --event must be 1 or 2, counted from the pi"),
        (f"{TAYLOR} --event 'flip 2'", "the rod of an --event must be 1 for the simple pendulum"),
        (f"{TAYLOR} --event flap", "or 'tip-height 50cm falling end', got 'flap'"),
        (f"{SOLVE} -o no/such/x.csv", "cannot write no/such/x.csv"),
        (f"{SOLVE} -o {EXISTING}/x.csv", f"cannot write {EXISTING}/x.csv"),
        (f"{SOLVE} -o {EXISTING}", f"{EXISTING} exists; choose another name"),
        (f"{SOLVE} -o x.txt", "the file name must end in .csv, .nc, .parquet, .zarr, got 'x.txt'"),
        (f"{DOUBLE} --c1 5cm", "--c1 goes with --bodies; --rods takes --m1, --m2, --l1, --l2, --g"),
        (f"{DOUBLE} --bodies --c1 5cm", "--bodies needs --m1, --m2, --l1, --c2, --I1, --I2 too"),
        (f"{DOUBLE} --bodies --bobs", "--bobs and --bodies exclude one another"),
        ("solve", "name a system: linear, simple, double"),
        ("solve triple", "no system 'triple'; take one of linear, simple, double"),
        ("slove", "no command 'slove'; take one of solve, exact, rerun, period, methods, "),
        ("exact triple --at 1s", "no system 'triple'; take one of linear, simple"),
        ("exact double --at 1s", "no closed form; use pendula solve double, with --digits 12"),
        ("EXACT Double --at 1s", "no closed form; use pendula solve double, with --digits 12"),
        ("period double", "no period as a function of amplitude; pendula solve double gives"),
        ("map flip linear --t-max 1s", "which the linear pendulum does not have; use pendula map"),
        ("exact simple", "name the times with --at 1s,2s or with --t-max"),
        ("exact simple --at 1s --t-max 2s", "name the times with --at 1s,2s or with --t-max"),
        ("exact simple --at 1s --every 1s", "name the times with --at 1s,2s or with --t-max"),
        ("exact simple --at 0,5", "or 0.5 for one value with a decimal point"),
        ("exact simple --at 1s --theta 1e16rad", "the start must "),
        ("exact linear --at 1e80s", "--at must lie within 2^50 half periods of --t0"),
        ("exact linear --t-max 1e80s", "--t-max must lie within 2^50 half periods of --t0"),
        ("exact simple --at 1s,1e80s", "--at must lie within 2^200 half periods of --t0"),
        ("solve double --t-max 1e300s", "--t-max must be small enough to tell times apart"),
        ("solve simple --t0 1e17s --t-max 2e17s", "--t-max must be small enough to tell times"),
        ("period simple", "give amplitudes with --amplitude 30deg,60deg, or a state with --theta"),
        ("period simple --amplitude 1rad --omega 1rad/s", "give amplitudes with --amplitude"),
        ("period simple --amplitude 30,60deg", "'30' in the list '30,60deg' has no unit"),
        ("period simple --amplitude 200deg", "--amplitude must lie within [-pi, pi] [rad]"),
        ("period simple --amplitude 4rad", "over the top give --theta and --omega"),
        ("study", "Missing option '--out'"),
        (f"study --out {EXISTING}", f"{EXISTING} exists"),
        (f"study --out {EXISTING}/x/y", f"cannot write {EXISTING}/x/y"),
        ("study no.toml --out x", "'no.toml' does not exist"),
        ("study --out x --lang fr", "'fr' is not one of 'en', 'es'"),
    ],
)
def test_wrong_use_is_reported_in_one_line(
    line: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    printed = told(shlex.split(line), 2, capsys)
    assert message in printed
    for python in ("numpy", "linspace", "state=", "t=", "use solve", "step=", "digits="):
        assert python not in printed


@pytest.mark.parametrize("line", [f"{SOLVE} -o {EXISTING}", f"study --out {EXISTING}"])
def test_an_existing_result_is_told_with_the_way_out(
    line: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert "--force" in told(line.split(), 2, capsys)


def test_force_is_offered_only_where_it_helps(capsys: pytest.CaptureFixture[str]) -> None:
    assert "--force" not in told(f"study --out {EXISTING} --force".split(), 2, capsys)
    Path("folder.csv").mkdir()
    printed = told(f"{SOLVE} -o folder.csv --force".split(), 2, capsys)
    assert printed == "pendula: folder.csv exists and is a folder; choose another name\n"


def test_a_bad_output_is_told_before_the_run(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pendula.run.solve.solve", lambda *_, **__: pytest.fail("it ran"))
    told(f"{SOLVE} -o {EXISTING}".split(), 2, capsys)


@pytest.mark.parametrize(
    ("recipe", "message"),
    [
        ('[simple]\nlength = "50 cm"\nlenght = "60 cm"\n', "broken.toml, line 3: "),
        ('[simple]\n\n\nlength = "-50 cm"\n', "broken.toml, line 4: "),
        ('[simple]\nlength = "0,5 m"\n', "broken.toml, line 2: simple.length: write 0.5 m;"),
        ("[simple]\nlength = \n", "broken.toml, line 2: "),
    ],
)
def test_a_broken_recipe_is_told_with_its_line(
    recipe: str, message: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("broken.toml").write_text(recipe)
    assert message in told(["study", "broken.toml", "--out", "x"], 2, capsys)


@pytest.mark.parametrize("output", ["", " -o x.csv", " --every 10s -o x.csv"])
def test_a_run_that_blows_up_says_when_and_leaves_no_file(
    output: str, capsys: pytest.CaptureFixture[str]
) -> None:
    printed = told(f"{BLOW_UP}{output}".split(), 1, capsys)
    assert "euler stopped at t = " in printed
    assert " of 1000 s with step 1 s: the numbers grew beyond all bounds" in printed
    assert "take a smaller --step" in printed


@pytest.mark.parametrize(
    "line",
    [
        f"{SOLVE} --omega 1e9rad/s",
        f"{SOLVE} --omega 1e200rad/s",
        f"{SOLVE} --omega 1e9rad/s --every 100ms -o x.csv",
        f"{TAYLOR} --omega 1e9rad/s",
    ],
)
def test_an_angle_beyond_the_sine_is_told(line: str, capsys: pytest.CaptureFixture[str]) -> None:
    printed = told(line.split(), 1, capsys)
    assert printed.endswith(": an angle left the range of the sine (2^26 rad)\n")


@pytest.mark.parametrize(
    "line",
    [f"{SOLVE} --theta 1e9rad", f"{TAYLOR} --theta 67108864rad", f"{DOUBLE} --theta2 -1e9rad"],
)
def test_a_start_beyond_the_sine_is_refused(line: str, capsys: pytest.CaptureFixture[str]) -> None:
    printed = told(line.split(), 2, capsys)
    assert "the start must have angles below 2^26 rad = 67108864 rad, got " in printed


def test_a_linear_run_that_blows_up_has_no_sine(capsys: pytest.CaptureFixture[str]) -> None:
    line = "solve linear --method euler --step 1000s --t-max 1e9s"
    assert "the numbers grew beyond all bounds" in told(line.split(), 1, capsys)


def test_a_missing_extra_is_told_with_what_to_install(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    printed = told(f"{SOLVE} -o x.parquet".split(), 1, capsys)
    assert f"pyarrow is not installed; {how_to_install('io')}" in printed


@pytest.mark.parametrize(
    ("noted", "way_out"),
    [
        (
            '{"url": "file:///home/ana/pendula%20lab"}',
            'run: pip install "/home/ana/pendula lab[io]"',
        ),
        ('{"url": "https://x.org/p.git"}', 'in a clone of pendula run: pip install ".[io]"'),
        (None, 'in a clone of pendula run: pip install ".[io]"'),
    ],
)
def test_what_to_install_is_true_of_a_clone(
    noted: str | None, way_out: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    installed = SimpleNamespace(read_text=lambda _: noted)
    monkeypatch.setattr("importlib.metadata.distribution", lambda _: installed)
    assert how_to_install("io") == way_out


@pytest.mark.parametrize(
    ("failure", "message"),
    [
        (OSError(errno.ENOSPC, "No space left on device"), "No space left on device"),
        (OSError(errno.EIO, "Input/output error", "x.csv"), "x.csv: Input/output error"),
        (MemoryError(), "not enough memory; ask for fewer outputs with a larger --every"),
    ],
)
def test_a_failure_while_writing_leaves_no_file(
    failure: Exception,
    message: str,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def half(run: Trajectory, path: Path) -> None:
        path.write_text("half")
        raise failure

    monkeypatch.setitem(files.FORMATS, ".csv", (half, files.FORMATS[".csv"][1]))
    assert f"pendula: {message}\n" == told(f"{SOLVE} -o x.csv".split(), 1, capsys)


def test_ctrl_c_while_writing_leaves_no_file(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def half(run: Trajectory, path: Path) -> None:
        path.write_text("half")
        os.kill(os.getpid(), signal.SIGINT)

    monkeypatch.setitem(files.FORMATS, ".csv", (half, files.FORMATS[".csv"][1]))
    usual = signal.getsignal(signal.SIGINT)
    assert told(f"{SOLVE} -o x.csv".split(), 130, capsys) == "pendula: interrupted\n"
    assert signal.getsignal(signal.SIGINT) is usual


def test_a_study_that_breaks_down_is_told_in_one_line(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def run_study(*_: object, **__: object) -> Path:
        raise RuntimeError("the reference run broke down at t = 1 s")

    monkeypatch.setattr("pendula.study.run_study", run_study)
    assert "the reference run broke down" in told(["study", "--out", "x"], 1, capsys)
