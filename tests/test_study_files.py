"""What the study leaves on the disk when all goes well, and when something does not."""

from __future__ import annotations

import csv
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import pytest

pytest.importorskip("matplotlib")
pytest.importorskip("typst")

from pendula._checks import how_to_install
from pendula.study import run_study
from pendula.study.figures import Figures

if TYPE_CHECKING:
    from commands import Call


def _recipe(until: str = "5 s", output: str = "20 ms", more: str = "") -> str:
    return f"""
[simple]
until = "2 s"
output = "20 ms"
[elliptic]
largest_terms = 1000
[convergence]
steps = ["4 ms", "2 ms", "1 ms"]
[double]
until = "{until}"
output = "{output}"
{more}
"""


@pytest.fixture
def quick(tmp_path: Path) -> Path:
    recipe = tmp_path / "quick.toml"
    recipe.write_text(_recipe())
    return recipe


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """A study without figures, whose report says only its language."""

    def write_report(folder: Path, told: dict[str, Any], _: object) -> None:
        (folder / "report.html").write_text(told["language"])
        (folder / "report.pdf").write_bytes(b"%PDF-")

    monkeypatch.setattr(Figures, "write", lambda *_: iter((1.0,)))
    monkeypatch.setattr("pendula.study.report.write_report", write_report)


def _nothing_left(folder: Path) -> bool:
    return [path.name for path in folder.iterdir()] == ["quick.toml"]


@pytest.mark.parametrize("error", [KeyboardInterrupt(), OSError(28, "No space left on device")])
def test_a_study_broken_off_leaves_nothing(
    quick: Path, monkeypatch: pytest.MonkeyPatch, error: BaseException
) -> None:
    def broken(*_: object) -> NoReturn:
        assert not _nothing_left(quick.parent)  # the data are there already
        raise error

    monkeypatch.setattr("pendula.plot.svg", broken)
    with pytest.raises(type(error)):
        run_study(quick, quick.parent / "out", "en")
    assert _nothing_left(quick.parent)


@pytest.mark.usefixtures("undrawn")
def test_an_old_study_stays_until_the_new_one_is_complete(
    quick: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = quick.parent / "some" / "where" / "out"
    assert run_study(quick, out, "en") == out
    with pytest.raises(FileExistsError, match="exists already"):
        run_study(quick, out, "es")
    with monkeypatch.context() as patch:
        patch.setattr("pendula.study.report.write_report", lambda *_: 1 / 0)
        with pytest.raises(ZeroDivisionError):
            run_study(quick, out, "es", overwrite=True)
    assert (out / "report.html").read_text() == "en"
    run_study(quick, out, "es", overwrite=True)
    assert (out / "report.html").read_text() == "es"
    assert [path.name for path in out.parent.iterdir()] == ["out"]


@pytest.mark.usefixtures("undrawn")
def test_an_empty_folder_may_be_overwritten(quick: Path) -> None:
    (quick.parent / "out").mkdir()
    run_study(quick, quick.parent / "out", "en", overwrite=True)
    assert (quick.parent / "out" / "recipe.toml").exists()


def test_overwriting_replaces_studies_only(quick: Path) -> None:
    other = quick.parent / "letters"
    other.mkdir()
    (other / "to_my_love.txt").write_text("…")
    link = quick.parent / "link"
    link.symlink_to(other)
    for target in (other, other / "to_my_love.txt", link):
        with pytest.raises(FileExistsError, match="is not a study"):
            run_study(quick, target, "en", overwrite=True)
    assert (other / "to_my_love.txt").exists()


def test_a_place_that_cannot_be_written_is_named(quick: Path) -> None:
    with pytest.raises(OSError, match=r"cannot write a study there.*quick\.toml"):
        run_study(quick, quick / "out", "en")


def test_mistakes_are_told_before_anything_is_computed(
    quick: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pendula.study.runs.compute", lambda _: pytest.fail("computed"))
    out = quick.parent / "out"
    with pytest.raises(FileExistsError, match="exists already"):
        run_study(None, quick, "en")
    with pytest.raises(ValueError, match="language must be one of en, es; got 'fr'"):
        run_study(quick, out, "fr")
    monkeypatch.setitem(sys.modules, "typst", None)
    with pytest.raises(ImportError, match=re.escape(how_to_install("report"))):
        run_study(quick, out, "en")
    quick.write_text("[simple]\nstep = 1")
    with pytest.raises(ValueError, match=r"quick\.toml, line 2"):
        run_study(quick, out, "en")
    assert _nothing_left(quick.parent)


def test_a_run_that_breaks_down_is_reported_not_hidden(quick: Path) -> None:
    broken = _recipe("40 s", "25 ms", 'step = "1 s"\nreference_step = "5 ms"')
    quick.write_text(
        broken.replace('until = "2 s"', 'until = "200 s"\nlength = "10 cm"\nstep = "1 s"')
    )
    out = run_study(quick, quick.parent / "out", "es")
    html = " ".join((out / "report.html").read_text(encoding="utf-8").split())
    assert re.search(r"Euler diverge en <math><mi>𝑡</mi></math> = \d", html)
    assert re.search(r"En el péndulo lineal, Heun diverge en <math><mi>𝑡</mi></math> = \d", html)
    with (out / "data" / "double_methods.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert rows[0]["euler theta1 [rad]"] != ""
    assert rows[-1]["euler theta1 [rad]"] == ""
    assert rows[-1]["reference theta1 [rad]"] != ""


def test_a_reference_that_breaks_down_ends_the_study(quick: Path) -> None:
    quick.write_text(_recipe("500 s", "25 ms", 'step = "5 s"\nreference_step = "5 s"'))
    with pytest.raises(RuntimeError) as caught:
        run_study(quick, quick.parent / "out", "en")
    message = str(caught.value)
    assert message.startswith(f"{quick}, line 13: double.reference_step must be short enough")
    assert "got 5 s" in message
    assert "take a smaller one than 5 s" in message
    assert "\n" not in message
    assert _nothing_left(quick.parent)


@pytest.mark.filterwarnings("ignore::pendula.StiffWarning")
@pytest.mark.parametrize(
    ("text", "told"),
    [
        (
            '[double]\nl1 = "1e-12 m"\nt_max = "0.5 ms"\noutput = "50 ns"\nstep = "0.1 ms"\n',
            "line 2: the finest of convergence.steps must be short",
        ),
        ('[double]\nomega1 = "9e3 rad/s"\nstep = "50 ms"\nreference_step = "50 ms"\n', "line 4: "),
    ],
)
def test_a_reference_that_breaks_down_at_once_is_told_with_its_line(
    quick: Path, text: str, told: str
) -> None:
    quick.write_text(text)
    with pytest.raises(RuntimeError) as caught:
        run_study(quick, quick.parent / "out", "en")
    assert str(caught.value).startswith(f"{quick}, {told}")
    assert _nothing_left(quick.parent)


@pytest.mark.usefixtures("undrawn")
def test_rods_at_rest_are_said_to_be_so(quick: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    seen = []

    def write_report(folder: Path, told: dict[str, Any], _: object) -> None:
        seen.append(told["double"]["at_rest"])

    monkeypatch.setattr("pendula.study.report.write_report", write_report)
    for rate in ("0 rad/s", "1 rad/s"):
        rest = f'theta1 = "0 deg"\ntheta2 = "0 deg"\nomega2 = "{rate}"'
        quick.write_text(_recipe("1 s", more=rest))
        run_study(quick, quick.parent / rate[0], "en")
    assert seen == [True, False]


def test_the_command_writes_figures_for_other_programs_too(quick: Path, call: Call) -> None:
    """One study for all that is asked of its figures, as it takes seconds to draw."""
    code, printed, _ = call(f"study {quick} --out out --figures pdf --figures png")
    assert (code, printed) == (0, "out/report.html\n")
    figures = Path("out/figures")
    starts = {"svg": b"<?xml", "pdf": b"%PDF-", "png": b"\x89PNG"}
    names = {path.stem for path in figures.glob("*.svg")}
    assert len(names) == 15
    written = {path.name for path in figures.iterdir()}
    assert written == {f"{name}.{kind}" for name in names for kind in starts}
    for path in figures.iterdir():
        assert path.read_bytes().startswith(starts[path.suffix[1:]])
    # letters are letters: the typesetter has none of its own for them, and would take others
    report = Path("out/report.pdf").read_bytes()
    assert b"+DejaVuSans" in report.replace(b"+DejaVuSansMono", b"")
    for figure in figures.glob("*.svg"):
        assert "<text" in figure.read_text(encoding="utf-8")
    code, _, told = call("study --out other --figures gif")
    assert code == 2
    assert "'gif' is not one of 'pdf', 'png'" in told


@pytest.mark.usefixtures("undrawn")
def test_an_unknown_kind_of_figures_is_refused_at_once(quick: Path) -> None:
    for wrong in ("gif", ("pdf", "eps")):
        with pytest.raises(ValueError, match="figures must be one of pdf, png; got"):
            run_study(quick, quick.parent / "out", "en", figures=wrong)
    assert _nothing_left(quick.parent)
