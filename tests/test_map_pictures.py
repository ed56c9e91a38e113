"""Pictures of maps at their resolution, in any colours, from memory, stores and the command."""

from __future__ import annotations

import base64
import io
import re
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib.image
import numpy as np
import pytest
import xarray as xr
from matplotlib.figure import Figure

from pendula import DoublePendulum, chunks, divergence_map, flip_map, maps, plot
from test_plot_maps import DIMS, centres, flips, texts

if TYPE_CHECKING:
    from commands import Call

FLIP = "map flip double --size 8x6 --t-max 3s"
RODS = DoublePendulum.rods()
KINDS: dict[str, Any] = {"flip": flip_map, "divergence": divergence_map}


def noise(n1: int, n2: int, width: float = 1.0) -> xr.Dataset:
    """A map in which each cell has another colour than its neighbours, `width` rad wide."""
    times = 1.0 + (np.arange(n1)[:, None] * 7 + np.arange(n2) * 3) % 10
    return xr.Dataset(
        {"flip_time": (DIMS, times), "forbidden": (DIMS, np.zeros((n1, n2), bool))},
        coords={
            "theta1": ("theta1", centres(0.0, width, n1)),
            "theta2": ("theta2", centres(0.0, 1.0, n2)),
        },
        attrs={"t_max": 20.0},
    )


def image_of(figure: Figure) -> np.ndarray:
    """The cells as they are drawn, the top row first."""
    shown = figure.axes[0].get_images()[0].get_array()
    rows: np.ndarray = np.asarray(shown)[::-1]
    return rows


def as_png(png: bytes) -> np.ndarray:
    read: Any = matplotlib.image.imread(io.BytesIO(png))
    bytes_of: np.ndarray = np.rint(255 * read[..., :3]).astype(int)
    return bytes_of


def holds(picture: np.ndarray, cells: np.ndarray, factors: tuple[int, int]) -> bool:
    """Whether the picture holds each cell as so many pixels, but for the frame around them."""
    wanted = cells.repeat(factors[0], axis=0).repeat(factors[1], axis=1).astype(int)[3:-3, 3:-3]
    height, width = wanted.shape[:2]
    for top in range(picture.shape[0] - height + 1):
        found = (picture[top, : -width + 1] == wanted[0, 0]).all(axis=-1)
        for left in np.flatnonzero(found):
            if (abs(picture[top : top + height, left : left + width] - wanted) <= 1).all():
                return True
    return False


# ---- resolution ----


@pytest.mark.parametrize(
    ("shape", "width", "factors"),
    [((1100, 1100), 1.0, (1, 1)), ((300, 300), 1.0, (4, 4)), ((150, 300), 0.5, (4, 4))],
)
def test_each_cell_of_a_picture_has_as_many_whole_pixels(
    shape: tuple[int, int], width: float, factors: tuple[int, int]
) -> None:
    figure = plot.flip_map(noise(*shape, width))
    cells = image_of(figure)
    assert cells.shape[:2] == shape[::-1]
    for _ in range(2):  # drawing it leaves it as it was
        assert holds(as_png(plot.picture(figure, "png")), cells, factors)
    buffer = io.BytesIO()
    figure.savefig(buffer, format="png")
    assert holds(as_png(buffer.getvalue()), cells, factors)


def test_no_cell_is_lost_where_cells_are_not_square() -> None:
    figure = plot.flip_map(noise(700, 1500))
    height, width = as_png(plot.picture(figure, "png")).shape[:2]
    box = figure.axes[0].get_position()
    assert box.width * width >= 700
    assert box.height * height >= 1500


def test_vector_pictures_hold_the_cells_themselves() -> None:
    figure = plot.flip_map(noise(2000, 2000))
    assert b"/Width 2000" in plot.picture(figure, "pdf")
    found = re.findall(rb'href="data:image/png;base64,([^"]+)"', plot.svg(figure))
    sizes = {as_png(base64.b64decode(each)).shape[:2] for each in found}
    assert (2000, 2000) in sizes


def test_dots_an_inch_are_those_asked_for() -> None:
    figure = plot.flip_map(noise(30, 30))
    assert as_png(plot.picture(figure, "png", 50)).shape[1] == 320
    assert as_png(plot.picture(figure, "png", 100)).shape[1] == 640


# ---- look ----


@pytest.mark.parametrize("kind", ["flip", "divergence"])
def test_colours_title_and_ticks_are_chosen(kind: str) -> None:
    data = KINDS[kind](RODS, (2.0, 2.4), (2.0, 2.4), (8, 8), 4.0)
    plain, other = (plot.stored_map(data, colormap=name) for name in ("inferno", "gray"))
    grey = image_of(other)
    assert (abs(np.diff(grey.astype(int), axis=-1)) <= 1).any()
    assert not (image_of(plain) == grey).all()
    figure = plot.stored_map(data, title="Two rods", ticks="pi", language="es")
    assert "Two rods" in texts(figure)
    assert "ángulo θ₁ [rad]" in texts(figure)


def test_an_unknown_colormap_is_one_line_with_a_way_out() -> None:
    draw: Any
    for draw, data in ((plot.flip_map, flips()), (plot.stored_map, flips())):
        with pytest.raises(ValueError, match="colormap must be .* got 'virids'; take viridis, say"):
            draw(data, colormap="virids")
    with pytest.raises(ValueError, match="take inferno, viridis, cividis or gray, say"):
        plot.flip_map(flips(), colormap="")


@pytest.mark.parametrize("kind", ["flip", "divergence"])
def test_a_map_is_drawn_into_given_axes(kind: str) -> None:
    data = KINDS[kind](RODS, (2.0, 2.4), (2.0, 2.4), (8, 8), 4.0)
    figure = Figure(figsize=(9, 4), layout="constrained")
    left, right = figure.subplots(1, 2)
    draw: Any = {"flip": plot.flip_map, "divergence": plot.divergence_map}[kind]
    assert draw(data, ax=right, title="right", language="es") is right
    assert not left.get_images()
    np.testing.assert_array_equal(
        right.get_images()[0].get_array(), draw(data).axes[0].get_images()[0].get_array()
    )
    assert right.get_title() == "right"
    figure.savefig(io.BytesIO(), format="png")


# ---- stored maps ----


@pytest.mark.parametrize("ending", ["zarr", "nc"])
@pytest.mark.parametrize("kind", ["flip", "divergence"])
def test_show_draws_what_map_drew_without_computing(
    call: Call, kind: str, ending: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    look = ["--colormap", "viridis", "--ticks", "pi", "--lang", "es", "--title", "Vuelcos"]
    line = f"map {kind} double --size 8x6 --t-max 3s -o m.{ending} --picture first.png"
    assert call(" ".join([line, *look]))[0] == 0
    monkeypatch.setattr("pendula.many.tasks.run_task", None)
    code, printed, told = call(" ".join([f"show m.{ending} --picture again.png", *look]))
    assert (code, told) == (0, "")
    assert printed.endswith("again.png\n")
    assert Path("again.png").read_bytes() == Path("first.png").read_bytes()


def test_an_open_map_is_what_was_computed(tmp_path: Path) -> None:
    store = tmp_path / "m.zarr"
    made = flip_map(RODS, (2.0, 2.4), (2.0, 2.4), (4, 3), 2.0, store=store)
    xr.testing.assert_identical(maps.open_map(store).load(), made.load())
    with pytest.raises(FileNotFoundError, match="no such file"):
        maps.open_map(tmp_path / "none.nc")
    (tmp_path / "bad.nc").write_text("no")
    with pytest.raises(ValueError, match="cannot be read as a map"):
        maps.open_map(tmp_path / "bad.nc")


def test_a_map_that_is_not_finished_is_not_drawn(call: Call) -> None:
    """Cells that are not computed are no cells without a flip."""
    assert call(f"{FLIP} -o m.zarr")[0] == 0
    root = Path("m.zarr/zarr.json")
    note = '"unfinished": "chunks are missing", "pendula"'
    root.write_text(root.read_text().replace('"pendula"', note, 1))
    assert "unfinished" in chunks.opened("m.zarr").attrs
    draw: Any
    for draw in (plot.flip_map, plot.stored_map):
        with pytest.raises(ValueError, match="must be finished.*; run the call that made the st"):
            draw(chunks.opened("m.zarr"))
    code, _, told = call("show m.zarr --picture m.png")
    assert code == 2
    assert told.endswith("run the command that made the store again with --resume\n")
    assert not Path("m.png").exists()


def test_a_store_of_something_else_is_no_map(call: Call) -> None:
    from chunked import waves

    chunks.run(waves(), "waves.zarr")
    code, printed, told = call("show waves.zarr --picture m.png")
    assert (code, printed) == (2, "")
    assert told.startswith("pendula: waves.zarr was not written by pendula")
    with pytest.raises(ValueError, match="dataset must hold flip_time, growth, .* or sali, got"):
        plot.stored_map(chunks.opened("waves.zarr"))


# ---- wrong use, before anything is computed or loaded ----


@pytest.mark.parametrize(
    ("options", "told"),
    [
        ("--picture m.png --colormap virids", "--colormap must be the name of a colormap"),
        ("--picture m.png --ticks turns", "'turns' is not one of 'degrees', 'pi'"),
        ("--picture m.png --dpi 7", "--dpi must be a whole number from 20 to 4800, got 7"),
        ("--picture m.svg --dpi 300", "--dpi is for a .png, which has dots; m.svg has none"),
        ("--dpi 300", "--dpi goes with --picture; name the picture"),
        ("--title flips", "--title goes with --picture; name the picture"),
        ("--colormap gray", "--colormap goes with --picture; name the picture"),
        ("--ticks pi", "--ticks goes with --picture; name the picture"),
    ],
)
@pytest.mark.parametrize("command", [FLIP, "show m.zarr"])
def test_a_look_that_cannot_be_is_one_line(
    call: Call, command: str, options: str, told: str
) -> None:
    code, printed, said = call(f"{command} {options}")
    assert (code, printed) == (2, "")
    assert told in said
    assert said.count("\n") == 1
    assert list(Path().iterdir()) == []


def test_the_resolution_of_other_pictures_is_chosen_too(call: Call) -> None:
    line = "compare simple --theta 1rad --t-max 1s --methods rk4,taylor --points 3"
    assert call(f"{line} --picture a.png --dpi 50")[0] == 0
    assert as_png(Path("a.png").read_bytes()).shape[1] == 320


@pytest.mark.parametrize(
    "line",
    [
        "map flip double --size 0 --t-max 1s --picture m.png",
        "map flip double --size many --t-max 1s -o m.zarr",
        "map flip double --theta1 1 --t-max 1s -o m.nc",
        "map flip double --which 3 --t-max 1s",
        "map divergence double --t-max 1s --separation 1deg --picture m.png",
        "map flip double --size 5 --t-max 1s --scheduler tcp://nowhere:1 --which 3",
        "solve double --theta1 1rad --t-max 1s --tolerance 7 -o m.nc",
        "solve double --theta1 1rad --t-max 1s --method rk4 -o m.parquet",
        "compare double --theta1 1rad --t-max 1s --methods nix --picture m.png",
        "study --lang xx --out m",
        "show none.zarr --dpi 3",
    ],
)
def test_arguments_are_refused_before_large_packages_are_loaded(line: str, tmp_path: Path) -> None:
    heavy = ("xarray", "pandas", "matplotlib.figure", "zarr", "distributed", "pyarrow", "typst")
    code = (
        "import sys; from pendula.cli import main\n"
        f"code = main({line.split()!r})\n"
        f"print(code, *sorted(set({heavy!r}) & set(sys.modules)))"
    )
    options: dict[str, Any] = {"cwd": tmp_path, "text": True, "capture_output": True}
    done = subprocess.run([sys.executable, "-c", code], check=True, **options)
    assert done.stdout == "2\n"
    assert done.stderr.count("\n") == 1
