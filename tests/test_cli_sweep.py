"""`pendula sweep`: its files, its progress, how it is stopped and gone on with."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pandas
import pytest
import xarray as xr

from chunked import files
from commands import interrupted
from pendula import sweep
from pendula._checks import how_to_install
from pendula.chunks import opened
from pendula.cli.progress import work_bar
from pendula.many.sweep.rows import MISSING

if TYPE_CHECKING:
    from commands import Call

RECIPE = """
[system]
kind = "double"
[state]
theta1 = { uniform = ["-180 deg", "180 deg"] }
[run]
t_max = "2 s"
every = "0.5 s"
tolerance = 1e-10
draws = 30
chunk = 10
"""


@pytest.fixture
def call(call: Call, monkeypatch: pytest.MonkeyPatch) -> Call:
    """The command in a folder with a recipe, and no progress of a machine that is busy."""
    monkeypatch.setattr("pendula.cli.progress._MOMENT", 600.0)
    Path("rods.toml").write_text(RECIPE, encoding="utf-8")
    return call


def folder() -> list[str]:
    return sorted(path.name for path in Path().iterdir())


def test_a_store_is_what_python_makes(call: Call) -> None:
    done = call("sweep rods.toml -o rods.zarr --threads 1")
    assert done == (0, "rods.zarr: 30 rows of 5 times; 30 reached_end\n", "")
    xr.testing.assert_identical(opened("rods.zarr").load(), sweep("rods.toml"))


def test_a_parquet_file_opens_in_pandas(call: Call) -> None:
    code, printed, _ = call("sweep rods.toml -o rods.parquet")
    assert (code, printed) == (0, "rods.parquet: 30 rows of 5 times; 30 reached_end\n")
    frame = pandas.read_parquet("rods.parquet")
    assert len(frame) == 30
    assert frame["theta1 [rad]"][7][0] == frame["theta1_start [rad]"][7]
    assert folder() == ["rods.parquet", "rods.toml"]


def test_each_outcome_is_counted(call: Call) -> None:
    limited = RECIPE.replace("draws", "max_steps = 45\ndraws")
    Path("rods.toml").write_text(limited, encoding="utf-8")
    _, printed, _ = call("sweep rods.toml -o rods.zarr")
    ends = opened("rods.zarr")["outcome"].values.tolist()
    reached, limit = ends.count("reached_end"), ends.count("step_limit")
    assert 0 < reached < reached + limit == 30
    ends = sorted([(reached, "reached_end"), (limit, "step_limit")], reverse=True)
    assert printed.endswith("; " + ", ".join(f"{n} {name}" for n, name in ends) + "\n")


def test_an_existing_store_is_gone_on_with_or_started_again_only_if_asked_to(call: Call) -> None:
    assert call("sweep rods.toml -o rods.zarr --resume")[0] == 0  # there is none yet
    whole = files(Path("rods.zarr"))
    code, printed, error = call("sweep rods.toml -o rods.zarr")
    assert (code, printed) == (2, "")
    assert error == (
        "pendula: rods.zarr exists; pass --resume to resume it, --force to overwrite it, "
        "or choose another name\n"
    )
    Path("rods.zarr/energy/c.1.0").unlink()
    assert call("sweep rods.toml -o rods.zarr --resume")[0] == 0
    assert files(Path("rods.zarr")) == whole
    Path("rods.toml").write_text(RECIPE.replace("1e-10", "1e-6"), encoding="utf-8")
    code, _, error = call("sweep rods.toml -o rods.zarr --resume")
    assert code == 2
    assert "sweep.tolerance is 1e-10 there and 1e-06 here; choose another name, or pass" in error
    assert "pass --force\n" in error
    assert files(Path("rods.zarr")) == whole
    assert call("sweep rods.toml -o rods.zarr --force")[0] == 0
    assert files(Path("rods.zarr")) != whole


def test_an_existing_parquet_file_is_replaced_only_if_asked_to(call: Call) -> None:
    Path("rods.parquet").write_text("old")
    code, _, error = call("sweep rods.toml -o rods.parquet")
    assert (code, Path("rods.parquet").read_text()) == (2, "old")
    assert error == "pendula: rods.parquet exists; choose another name, or pass --force\n"
    assert call("sweep rods.toml -o rods.parquet --force")[0] == 0
    assert Path("rods.parquet").read_bytes().startswith(b"PAR1")


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("sweep", "Missing argument 'RECIPE'"),
        ("sweep rods.toml", "Missing option '-o' / '--output'"),
        ("sweep none.toml -o rods.zarr", "'none.toml' does not exist"),
        ("sweep bad.toml -o rods.zarr", "bad.toml, line 3: unknown key 'lenght' in [system]"),
        ("sweep rods.toml -o rods.nc", "--output must end in .zarr or .parquet, got 'rods.nc'"),
        ("sweep rods.toml -o s3://b/rods.parquet", "--output must be a path to write Parquet"),
        ("sweep rods.toml -o no/rods.zarr", "no is not a folder; make it first"),
        ("sweep rods.toml -o no/rods.parquet", "no is not a folder; make it first"),
        ("sweep rods.toml -o rods.zarr --resume --force", "--resume and --force exclude"),
        ("sweep rods.toml -o rods.parquet --resume", "--resume needs a .zarr store"),
        ("sweep rods.toml -o rods.zarr --threads 0", "--threads must be a whole number from 1"),
        ("sweep rods.toml -o rods.zarr --threads x", "'x' is not a valid integer"),
    ],
)
def test_wrong_use_is_one_line(call: Call, line: str, message: str) -> None:
    bad = RECIPE.replace("[state]", 'lenght = "1 m"\n[state]').lstrip()
    Path("bad.toml").write_text(bad, encoding="utf-8")
    code, printed, error = call(line)
    assert (code, printed) == (2, "")
    assert error.count("\n") == 1
    assert error.startswith("pendula: ")
    assert message in error
    assert folder() == ["bad.toml", "rods.toml"]


@pytest.mark.parametrize(
    ("module", "line", "install"),
    [
        ("xarray", "-o rods.zarr", "io"),
        ("zarr", "-o rods.zarr", "io"),
        ("pyarrow.parquet", "-o rods.parquet", "io"),
        ("distributed", "-o rods.zarr --scheduler tcp://x:1", "cluster"),
        ("fsspec.core", "-o s3://bucket/rods.zarr", "cluster"),
    ],
)
def test_a_missing_extra_is_one_line(
    call: Call, monkeypatch: pytest.MonkeyPatch, module: str, line: str, install: str
) -> None:
    monkeypatch.setitem(sys.modules, module, None)
    code, printed, error = call(f"sweep rods.toml {line}")
    package = module.partition(".")[0]
    assert (code, printed) == (1, "")
    assert error == f"pendula: {package} is not installed; {how_to_install(install)}\n"


def test_an_object_stores_own_package_that_is_missing_is_named(
    call: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("fsspec")
    monkeypatch.setitem(sys.modules, "s3fs", None)
    code, printed, error = call("sweep rods.toml -o s3://bucket/rods.zarr")
    assert (code, printed) == (1, "")
    assert error == "pendula: s3://bucket/rods.zarr cannot be reached: Install s3fs to access S3\n"


def test_a_scheduler_that_is_not_there_is_one_line(
    call: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr("pendula.many.chunks.cluster._PATIENCE", "0.3s")
    code, printed, error = call("sweep rods.toml -o rods.zarr --scheduler tcp://127.0.0.1:9")
    assert (code, printed) == (1, "")
    assert error.startswith("pendula: no Dask scheduler answers at 'tcp://127.0.0.1:9'")
    assert error.count("\n") == 1
    assert folder() == ["rods.toml"]


def test_a_cluster_that_is_lost_is_one_line(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    def lost(*_: object, **__: object) -> None:
        raise RuntimeError("the cluster dropped the work; what is complete is kept")

    monkeypatch.setattr("pendula.many.sweep.running.run", lost)
    code, _, error = call("sweep rods.toml -o rods.zarr")
    assert (code, error) == (
        1,
        "pendula: the cluster dropped the work; what is complete is kept\n",
    )


def test_too_little_memory_names_the_chunk(call: Call, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise MemoryError

    monkeypatch.setattr("pendula.many.sweep.running.run", full)
    code, _, error = call("sweep rods.toml -o rods.zarr")
    assert code == 1
    assert (
        error == "pendula: not enough memory; take fewer rows a chunk in the recipe: [run] chunk\n"
    )


# ---- progress ----


def test_progress_tells_rate_and_remaining_time_of_this_run(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = [0.0]
    monkeypatch.setattr("pendula.cli.progress.time.monotonic", lambda: clock[0])
    with work_bar("sweep", 1000, "rows") as progress:
        for share in (0.4, 0.45, 0.5, 0.52, 0.6, 1.0):  # 0.4 was there
            progress(share)
            clock[0] += 0.5
    assert capsys.readouterr().err.splitlines() == [
        " 50% sweep: 500 of 1000 rows, 100 rows/s, 0:00:05 left",
        " 60% sweep: 600 of 1000 rows, 100 rows/s, 0:00:04 left",
        "100% sweep: 1000 of 1000 rows, 240 rows/s",
    ]


def test_a_slow_rate_keeps_its_digits(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = [0.0]
    monkeypatch.setattr("pendula.cli.progress.time.monotonic", lambda: clock[0])
    with work_bar("map", 1000, "cells") as progress:
        progress(0.0)
        clock[0] = 400.0
        progress(0.1)
    assert capsys.readouterr().err == " 10% map: 100 of 1000 cells, 0.25 cells/s, 1:00:00 left\n"


# ---- Ctrl-C ----

LONG = RECIPE.replace("draws = 30\nchunk = 10", "draws = 20000\nchunk = 500")
LONG = LONG.replace('t_max = "2 s"', 't_max = "20 s"')


def test_ctrl_c_tells_how_to_go_on_and_it_ends_in_the_same_bytes(
    call: Call, tmp_path: Path
) -> None:
    Path("rods.toml").write_text(LONG, encoding="utf-8")
    begun = tmp_path / "rods.zarr" / "outcome" / "c.2"
    code, printed, error = interrupted(tmp_path, "sweep rods.toml -o rods.zarr", begun.exists)
    done = len(list(Path("rods.zarr/outcome").glob("c.*")))
    assert 0 < done < 40
    assert done == (opened("rods.zarr")["outcome"].values != MISSING).sum() / 500
    assert (code, printed) == (130, "")
    assert error.splitlines()[-1] == (
        f"pendula: interrupted; {done} of 40 chunks are in rods.zarr; "
        "resume with the same command and --resume"
    )
    left = set(files(tmp_path / "rods.zarr"))
    code, printed, _ = call("sweep rods.toml -o rods.zarr --resume")
    assert (code, printed) == (0, "rods.zarr: 20000 rows of 41 times; 20000 reached_end\n")
    assert left < set(files(tmp_path / "rods.zarr"))
    assert call("sweep rods.toml -o calm.zarr")[0] == 0
    assert files(tmp_path / "rods.zarr") == files(tmp_path / "calm.zarr")
    shutil.rmtree(tmp_path / "calm.zarr")


def test_ctrl_c_leaves_no_part_of_a_parquet_file(call: Call, tmp_path: Path) -> None:
    Path("rods.toml").write_text(LONG, encoding="utf-8")
    code, printed, error = interrupted(
        tmp_path,
        "sweep rods.toml -o rods.parquet",
        lambda: any(tmp_path.glob(".rods.*.unfinished.parquet")),
    )
    assert (code, printed) == (130, "")
    assert error.splitlines()[-1].startswith("pendula: interrupted; nothing is written")
    assert folder() == ["rods.toml"]
