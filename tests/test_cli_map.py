"""`pendula map`: what it computes, its files and pictures, how it is stopped and gone on with."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
import xarray as xr

from commands import interrupted, unfolded
from pendula import DoublePendulum, chunks, divergence_map, flip_map

if TYPE_CHECKING:
    from commands import Call

RODS = DoublePendulum.rods()
PI = math.pi
FLIP = "map flip double --size 10x12 --t-max 5s"


# ---- the same as in Python ----


@pytest.mark.parametrize("ending", ["zarr", "nc"])
def test_the_file_holds_the_map(call: Call, ending: str) -> None:
    code, printed, error = call(f"{FLIP} -o flips.{ending}")
    assert (code, error) == (0, "")
    assert printed.startswith(f"flips.{ending}: 10 x 12 cells; ")
    expected = flip_map(RODS, (-PI, PI), (-PI, PI), (10, 12), 5.0)
    path = f"flips.{ending}"
    found = chunks.opened(path) if ending == "zarr" else xr.open_dataset(path, engine="h5netcdf")
    with found:
        xr.testing.assert_identical(found.load(), expected)
    assert [path.name for path in Path().iterdir()] == [f"flips.{ending}"]


def test_every_option_of_a_flip_map(call: Call) -> None:
    line = (
        "map flip double --bobs --m2 300g --l1 50cm --theta1=1rad:2rad --theta2 -1pi:90deg "
        "--size 5 --t-max 0.1min --which 2 --tolerance 1e-6 --no-resolve --threads 2 -o flips.zarr"
    )
    assert call(line)[0] == 0
    system = DoublePendulum.bobs(m2=0.3, l1=0.5)
    ranges = (1.0, 2.0), (-PI, PI / 2)
    expected = flip_map(system, *ranges, (5, 5), 6.0, 2, tolerance=1e-6, resolve=False)
    xr.testing.assert_identical(chunks.opened("flips.zarr").load(), expected)


def test_every_option_of_a_divergence_map(call: Call) -> None:
    line = (
        "map divergence double --theta1=0:90deg --theta2=-1rad:1rad --size 4x3 --t-max 2s "
        "--separation 1e-6deg --tolerance 1e-9 -o growth.nc"
    )
    code, printed, _ = call(line)
    assert code == 0
    assert re.fullmatch(
        r"growth.nc: 4 x 3 cells; mean rate of divergence \S+ to \S+ 1/s, \S+ on average\n",
        unfolded(printed),
    )
    ranges = (0.0, PI / 2), (-1.0, 1.0)
    apart = math.radians(1e-6)
    expected = divergence_map(RODS, *ranges, (4, 3), 2.0, separation=apart, tolerance=1e-9)
    with xr.open_dataset("growth.nc", engine="h5netcdf") as found:
        xr.testing.assert_identical(found.load(), expected)


def test_the_summary_counts_the_cells(call: Call) -> None:
    code, printed, _ = call(FLIP)
    assert code == 0
    data = flip_map(RODS, (-PI, PI), (-PI, PI), (10, 12), 5.0)
    shares = [
        f"{float((data.flipped_rod > 0).mean()):.1%} flipped",
        f"{float(data.forbidden.mean()):.1%} forbidden",
        f"{float((data.flip_time.isnull() & ~data.forbidden).mean()):.1%} neither until 5 s",
        f"{float((~data.resolved).mean()):.1%} not verified",
    ]
    first = float(data.flip_time.min())
    assert (
        unfolded(printed)
        == f"10 x 12 cells; {', '.join(shares)}; earliest flip after {first:.6g} s\n"
    )
    assert list(Path().iterdir()) == []
    _, printed, _ = call("map flip double --theta1=-9deg:9deg --size 3x9 --t-max 1s --no-resolve")
    assert (
        unfolded(printed) == "3 x 9 cells; 0.0% flipped, 100.0% forbidden, 0.0% neither until 1 s\n"
    )


@pytest.mark.parametrize("kind", ["flip", "divergence"])
@pytest.mark.parametrize(("ending", "start"), [("png", b"\x89PNG"), ("svg", b"<?xml")])
def test_the_picture(call: Call, kind: str, ending: str, start: bytes) -> None:
    code, printed, _ = call(f"map {kind} double --size 9 --t-max 2s --picture m.{ending} --lang es")
    assert code == 0
    assert unfolded(printed).splitlines()[1] == f"m.{ending}"
    assert Path(f"m.{ending}").read_bytes().startswith(start)


# ---- what is there already ----


def test_a_store_is_gone_on_with_or_started_again_only_when_asked(call: Call) -> None:
    assert call(f"{FLIP} -o flips.zarr")[0] == 0
    times = Path("flips.zarr/flip_time/c.0.0")
    before = times.read_bytes()
    times.unlink()
    code, _, error = call(f"{FLIP} -o flips.zarr")
    assert code == 2
    assert "flips.zarr exists; pass --resume to resume it, --force to overwrite it" in error
    assert not times.exists()
    assert call(f"{FLIP} -o flips.zarr --resume")[0] == 0
    assert times.read_bytes() == before
    code, _, error = call("map flip double --size 10x12 --t-max 6s -o flips.zarr --resume")
    assert code == 2
    assert "holds another computation: t_max is 5.0 there and 6.0 here" in error
    assert call("map flip double --size 10x12 --t-max 6s -o flips.zarr --force")[0] == 0
    assert json.loads(chunks.opened("flips.zarr").pendula)["t_max"] == 6.0
    assert call("map flip double --size 8 --t-max 6s -o new.zarr --resume")[0] == 0  # none is there


@pytest.mark.parametrize("name", ["-o old.nc", "--picture old.png"])
def test_files_are_replaced_only_when_told(call: Call, name: str) -> None:
    path = Path(name.split()[1])
    path.write_text("old")
    code, _, error = call(f"{FLIP} {name}")
    assert code == 2
    assert error == f"pendula: {path} exists; choose another name, or pass --force\n"
    assert path.read_text() == "old"
    assert call(f"{FLIP} {name} --force")[0] == 0
    assert path.read_bytes() != b"old"


def test_a_picture_in_the_way_of_going_on(call: Call) -> None:
    Path("old.png").write_text("old")
    code, _, error = call(f"{FLIP} -o flips.zarr --resume --picture old.png")
    assert (code, error) == (2, "pendula: old.png exists; remove it, or name another\n")


# ---- wrong use ----


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("map", "name a map: flip, divergence"),
        ("map heat", "no map 'heat'; take one of flip, divergence"),
        ("map flip", "name a system: double"),
        ("map flip simple --t-max 1s", "which the simple pendulum does not have"),
        ("map flip double", "Missing option '--t-max'"),
        (f"{FLIP} --size 0", "--size must be a whole number from 1 to 1000000, got 0"),
        (f"{FLIP} --size 3x4x5", "--size must be cells such as 500x500, or 500 for a square"),
        (f"{FLIP} --size many", "--size must be cells such as 500x500"),
        (f"{FLIP} --theta1 1", "--theta1 must be a range such as -180deg:180deg, got '1'"),
        (f"{FLIP} --theta1 1:2:3", "--theta1 must be a range such as"),
        (f"{FLIP} --theta1 -90:90deg", "--theta1 needs a unit, got '-90'; write -90deg or -90rad"),
        (f"{FLIP} --theta2 2rad:1rad", "--theta2 must be a range (lo, hi) with lo < hi [rad]"),
        (f"{FLIP} --theta2 1s:2s", "--theta2"),
        (f"{FLIP} --t-max 0s", "--t-max must be positive [s], got 0.0"),
        (f"{FLIP} --t-max soon", "--t-max"),
        (f"{FLIP} --which 3", "--which must be rod 1 or 2"),
        (
            f"{FLIP} --tolerance 1e-14",
            "for another run with a thousandth of it, got 1e-14; take a ",
        ),
        (f"{FLIP} --tolerance 1e-14", "--no-resolve"),
        (f"{FLIP} --threads 0", "--threads must be a whole number from 1 to 1024"),
        (f"{FLIP} --length 3m", "No such option"),
        (f"{FLIP} --c1 3m", "--c1 goes with"),
        (f"{FLIP} -o flips.csv", "--output must end in .zarr or .nc, got 'flips.csv'"),
        (f"{FLIP} -o flips.png", "got 'flips.png'; for a picture name --picture flips.png"),
        (f"{FLIP} -o no/flips.zarr", "is not a folder; make it first"),
        (f"{FLIP} -o no/flips.nc", "is not a folder; make it first"),
        (f"{FLIP} --theta1=-180:180", "--theta1 needs a unit, got '-180'; write -180deg"),
        (f"{FLIP} --picture flips.gif", "--picture must end in one of .png, .svg, .pdf"),
        (f"{FLIP} --resume", "--resume needs a .zarr store"),
        (f"{FLIP} --resume -o flips.nc", "--resume needs a .zarr store"),
        (f"{FLIP} --resume --force -o flips.zarr", "--resume and --force exclude one another"),
        ("map divergence double --t-max 1s --separation 1deg", "--separation must lie between"),
        ("map divergence double --t-max 1s --which 1", "No such option"),
    ],
)
def test_wrong_use_is_one_line(call: Call, line: str, message: str) -> None:
    code, printed, said = call(line)
    assert (code, printed) == (2, "")
    assert message in said
    assert said.count("\n") == 1
    assert list(Path().iterdir()) == []


def test_no_scheduler_is_one_line(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("pendula.many.chunks.cluster._PATIENCE", "0.5s")
    code, printed, said = call(f"{FLIP} --scheduler nowhere:1 -o flips.zarr")
    assert (code, printed) == (1, "")
    assert said.startswith("pendula: no Dask scheduler answers at 'nowhere:1'")
    assert said.count("\n") == 1
    assert list(Path().iterdir()) == []


def test_too_little_memory_is_one_line(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.setattr("pendula.many.maps.flip_map", full)
    code, _, said = call(FLIP)
    assert code == 1
    assert said == (
        "pendula: not enough memory for so many cells; write them to a store: -o map.zarr\n"
    )


# ---- Ctrl-C ----


MAP_THAT_TELLS = """
import sys
from pendula.cli import main
from pendula.many.maps import cells, flip
cells.LARGEST_CHUNK = 50
compute, first = flip.FlipMap.__call__, iter(["ready"])
def reporting(*given):
    print(*(word + chr(10) for word in first), end="", flush=True)
    return compute(*given)
flip.FlipMap.__call__ = reporting
sys.exit(main(sys.argv[1:]))
"""


@pytest.mark.parametrize("output", ["-o flips.zarr", "-o flips.nc", "--picture flips.png"])
def test_ctrl_c_tells_how_to_go_on(output: str, tmp_path: Path) -> None:
    line = f"map flip double --size 4000 --t-max 100s --threads 1 {output}"
    first = tmp_path / "flips.zarr" / "resolved"
    when = (lambda: len(list(first.glob("c.*"))) > 3) if "zarr" in output else 0.0
    code, printed, error = interrupted(tmp_path, line, when, MAP_THAT_TELLS)
    assert (code, printed) == (130, "")
    last = error.splitlines()[-1]
    if output != "-o flips.zarr":
        words = "nothing is written; a .zarr store would be resumable"
        assert last == f"pendula: interrupted; {words}"
        assert list(tmp_path.iterdir()) == []
        return
    found = re.fullmatch(
        r"pendula: interrupted; (\d+) of 6400 chunks are in flips.zarr; "
        r"resume with the same command and --resume",
        last,
    )
    assert found is not None, last
    kept = [path.name for path in (tmp_path / "flips.zarr/resolved").glob("c.*")]
    assert 0 < int(found[1]) == len(kept) < 6400
    assert "unfinished" in chunks.opened(tmp_path / "flips.zarr").attrs
