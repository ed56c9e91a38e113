"""What a notebook shows: the one of the examples is run in a kernel, cell by cell."""

from __future__ import annotations

import base64
import re
import sys
import warnings
from html.parser import HTMLParser
from importlib import import_module
from typing import Any

import numpy as np
import pytest
from nbclient import NotebookClient

import pendula._progress as progress_bars
from pendula import (
    DoublePendulum,
    LinearPendulum,
    SimplePendulum,
    ensemble,
    events,
    exact,
    flip_map,
    plot,
    solve,
)
from pendula._tables import html_table
from pendula.analysis import work_precision
from test_readme import ROOT

RODS = DoublePendulum.rods()
nbformat: Any = import_module("nbformat")  # whose functions have no types
NOTEBOOK = ROOT / "examples" / "notebook.ipynb"
Output = dict[str, Any]


def run(notebook: Any) -> Any:
    with warnings.catch_warnings(action="ignore"):  # those of the client's own packages
        NotebookClient(notebook, timeout=300).execute()
    return notebook


@pytest.fixture(scope="module")
def cells() -> list[Any]:
    """The cells of the example, each with what it shows."""
    told: list[Any] = run(nbformat.read(NOTEBOOK, as_version=4)).cells
    return told


def shown(cells: list[Any], source: str) -> list[Output]:
    """What the cell that ends with this line shows."""
    (cell,) = (each for each in cells if each.source.splitlines()[-1] == source)
    outputs: list[Output] = cell.outputs
    assert not [each for each in outputs if each["output_type"] in ("error", "stream")]
    return outputs


def test_the_example_is_kept_without_outputs_and_the_pages_tell_of_it() -> None:
    kept = nbformat.read(NOTEBOOK, as_version=4)
    assert not [cell for cell in kept.cells if cell.get("outputs")]
    for language in ("en", "es"):
        page = (ROOT / "docs" / language / "getting-started.md").read_text(encoding="utf-8")
        assert "examples/notebook.ipynb" in page


@pytest.mark.parametrize(
    "source", ["run.plot()", 'plot.flip_map(flips, ticks="pi", title="Time until a rod flips")']
)
def test_a_plot_as_the_last_line_is_one_picture(cells: list[Any], source: str) -> None:
    (output,) = shown(cells, source)
    assert base64.b64decode(output["data"]["image/png"]).startswith(b"\x89PNG")
    assert output["metadata"]["image/png"]["width"] == 640


def test_what_is_drawn_into_axes_is_shown_once(cells: list[Any]) -> None:
    last = 'plot.flip_map(flips, ax=right, colormap="viridis", language="es")'
    pictures = [each for each in shown(cells, last) if "image/png" in each["data"]]
    assert len(pictures) == 1


@pytest.mark.parametrize(
    ("source", "told"),
    [
        ("rods", ("DoublePendulum.rods", "9.80665 m/s^2", "mass of rod 1")),
        ("run", ("Trajectory by taylor", "t = 0 … 20 s", "reached_end", "theta1 = 2.0944 rad")),
        ("flips", ("xarray.Dataset", "flip_time")),
        ("ensemble(rods, starts, 10.0, progress=True)", ("Ensemble by taylor", "1000 reached_end")),
    ],
)
def test_objects_show_themselves(cells: list[Any], source: str, told: tuple[str, ...]) -> None:
    html = shown(cells, source)[-1]["data"]["text/html"]
    for text in told:
        assert text in html


def test_a_bar_is_seen_and_full_at_the_end(cells: list[Any]) -> None:
    bar = shown(cells, "flips")[0]
    assert bar["output_type"] == "display_data"
    assert '<progress value="1.0000" max="1"' in bar["data"]["text/html"]
    assert bar["data"]["text/plain"].startswith("flip map 100%, ")


def test_a_bar_moves_and_a_refused_call_shows_none() -> None:
    code = """
import IPython.display, pendula
from pendula._progress import with_bar
moves = []
class Handle:
    def update(self, data, raw): moves.append(data["text/plain"])
IPython.display.display = lambda data, raw, display_id: moves.append(data["text/plain"]) or Handle()
@with_bar("work")
def work(*, progress):
    import time
    for i in range(4):
        progress("part", i / 4); time.sleep(0.15)
work(progress=True)
print(moves[:4])
moves.clear()
try: pendula.flip_map(None, (0, 1), (0, 1), (3, 3), 1.0, progress=True)
except ValueError: print(moves)
"""
    (cell,) = run(nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(code)])).cells
    first, second = "".join(each["text"] for each in cell.outputs).splitlines()
    pattern = r"\['work: part 0%', 'work: part 25%, \d+ s left', 'work: part 50%, \d+ s left', .*\]"
    assert re.fullmatch(pattern, first)
    assert second == "[]"


# ---- without a notebook ----


class Tags(HTMLParser):
    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.seen: list[str] = []
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag: str, attrs: object) -> None:
        self.open.append(tag)
        self.seen.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def _shows() -> list[Any]:
    falling = solve(RODS, (2.0, 2.0, 0.0, 0.0), -3.0)
    crossed = solve(RODS, (2.0, 2.0, 0.0, 0.0), 9.0, events=[events.flip(2)], certify=1e-6)
    broken = solve(SimplePendulum(), (1.0, 0.0), 9.0, "rk4", step=1e-3, max_steps=5)
    grid = exact(SimplePendulum(), [[1.0, 0.0], [2.0, 0.0]], [0.0, 1.0])
    none = ensemble(RODS, np.empty((0, 4)), 1.0)
    two = [SimplePendulum(1.0), SimplePendulum(2.0)]
    both = ensemble(two, (1.0, 0.0), [1.0, 2.0], certify=1e-6, events=[events.angle(1, 0.0)])
    systems = [LinearPendulum(), SimplePendulum(), DoublePendulum.bobs(), RODS]
    empty = exact(SimplePendulum(), (1.0, 0.0), [])
    wild = solve(LinearPendulum(1e-3), (1.0, 0.0), 10.0, "euler", step=0.02)
    return [falling, crossed, broken, wild, grid, none, both, empty, *systems]


def test_every_object_is_a_plain_table() -> None:
    for each in _shows():
        html = each._repr_html_()
        assert set(Tags(html).seen) == {"table", "caption", "strong", "tbody", "tr", "th", "td"}
        assert type(each).__name__ in html


def test_text_in_tables_is_escaped() -> None:
    html = html_table("<b>", [("<script>", "a & b", '"')])
    assert "<b>" not in html
    assert "&lt;script&gt;" in html
    assert "a &amp; b" in html


@pytest.mark.parametrize("state", [(2.0, 2.0, 0.0, 0.0), (1.0, 0.0)])
def test_a_run_is_drawn_into_given_axes_in_a_language(state: tuple[float, ...]) -> None:
    from matplotlib.figure import Figure

    system = RODS if len(state) == 4 else SimplePendulum()
    one = solve(system, state, 3.0)
    ax = Figure().subplots()
    assert one.plot(ax=ax, language="es") is ax
    assert ax.get_xlabel() == "tiempo t [s]"
    assert len(ax.get_lines()) == len(state) // 2
    three = Figure().subplots(3, 1)
    assert plot.trajectory(one, ax=three) is three
    assert all(each.get_lines() for each in three)
    assert "ángulo" in one.plot(language="es").axes[0].get_ylabel()
    wrong: Any
    for wrong in (Figure().subplots(2, 1), [1], []):
        with pytest.raises(ValueError, match="ax must be axes of matplotlib, one for the angles"):
            one.plot(ax=wrong)


def test_a_figure_needs_no_pyplot() -> None:
    assert plot.trajectory(solve(RODS, (2.0, 2.0, 0.0, 0.0), 3.0))._repr_png_()[0]  # type: ignore[attr-defined]
    assert (
        "matplotlib.pyplot" not in sys.modules or not sys.modules["matplotlib.pyplot"].get_fignums()
    )


def _works(progress: Any) -> None:
    ensemble(RODS, np.ones((3, 4)), 1.0, progress=progress)
    solve(RODS, np.ones(4), 1.0, progress=progress)
    flip_map(RODS, (2.0, 2.4), (2.0, 2.4), (3, 3), 1.0, progress=progress)
    work_precision(SimplePendulum(), (1.0, 0.0), 1.0, ["rk4"], points=2, progress=progress)


@pytest.mark.parametrize("asked", [True, False])
def test_where_there_is_no_place_for_a_bar_there_is_none(
    asked: bool, capsys: pytest.CaptureFixture[str]
) -> None:
    _works(asked)
    assert capsys.readouterr() == ("", "")


def test_a_terminal_has_bars_too(monkeypatch: pytest.MonkeyPatch) -> None:
    told: list[tuple[str, float]] = []

    class Bar:
        def __enter__(self) -> Any:
            return lambda label, share: told.append((label, share))

        def __exit__(self, *_: object) -> None: ...

    monkeypatch.setattr(progress_bars, "terminal_bar", Bar)
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    _works(True)
    names = {label.partition(":")[0] for label, _ in told}
    assert {"ensemble", "flip map", "compare"} <= names
    assert ("compare: rk4", 0.5) in told
