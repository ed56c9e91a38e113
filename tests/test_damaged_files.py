"""Damaged files: `load` and `rerun` refuse them in one line, or give the very numbers saved."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import h5py
import pandas as pd
import pytest
import zarr

import pendula
from alike import same
from damage import RUNS, Saved
from pendula import LinearPendulum, exact
from pendula.io.files import FORMATS

if TYPE_CHECKING:
    from collections.abc import Callable


every_run = pytest.mark.parametrize("name", RUNS)
every_format = pytest.mark.parametrize("ending", FORMATS)


@pytest.fixture(scope="module")
def saved(tmp_path_factory: pytest.TempPathFactory) -> Saved:
    return Saved(tmp_path_factory.mktemp("saved"))


def refused(path: Path, message: str) -> None:
    """By `load` and by `rerun`, in one line that names the file."""
    for read in (pendula.load, pendula.rerun):
        with pytest.raises(ValueError, match=message) as error:
            read(path)
        assert str(path) in str(error.value)
        assert "\n" not in str(error.value)


# ---- the rows of a table ----

OUT_OF_ORDER = r"row \d, at .* s, does not follow|t \[s\] does not fit its checksum$"


def nan_at_first(row: str) -> str:
    """The row with another time."""
    return "nan" + row[row.index(",") :]


def edited(saved: Saved, name: str, path: Path, edit: Callable[[list[str]], list[str]]) -> None:
    recipe, header, *rows = (saved.folder / f"{name}.csv").read_text("utf-8").splitlines()
    path.write_text("\n".join([recipe, header, *edit(rows), ""]), encoding="utf-8")


@every_run
@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda rows: rows[:8], r"is damaged: it holds 8 of 21 times; the last is"),
        (lambda rows: [], r"is damaged: it holds 0 of 21 times$"),
        (lambda rows: rows[:7] + rows[9:], r"it holds 19 of 21 times; those after row 7 are miss"),
        (lambda rows: rows[1:], r"it holds 20 of 21 times"),
        (lambda rows: rows[:5] + rows[4:], r"it holds 22 of 21 times$"),
        (lambda rows: rows[::-1], OUT_OF_ORDER + "|row 1, at .* start"),
        (lambda rows: [*rows[:3], rows[4], rows[3], *rows[5:]], OUT_OF_ORDER),
        (lambda rows: [*rows[:3], rows[4], *rows[4:]], OUT_OF_ORDER),
        (lambda rows: [*rows[:3], nan_at_first(rows[3]), *rows[4:]], "no finite number in row 4$"),
        (lambda rows: [*rows[:9], rows[9] + ",0", *rows[10:]], r"not whole: row 10 has \d cells"),
        (lambda rows: [*rows[:9], "", *rows[10:]], r"is not whole: row 10 has 0 cells of"),
    ],
    ids=["cut", "empty", "middle", "first", "twice", "reversed", "swapped", "repeated", "nan",
         "longer", "blank"],
)  # fmt: skip
def test_rows_that_are_not_those_saved(
    name: str, edit: Any, message: str, saved: Saved, tmp_path: Path
) -> None:
    edited(saved, name, tmp_path / "run.csv", edit)
    refused(tmp_path / "run.csv", message)


@every_run
def test_a_cell_that_is_another_number(name: str, saved: Saved, tmp_path: Path) -> None:
    """Each column, what follows from the states too; and the sign of zero."""
    header = (saved.folder / f"{name}.csv").read_text("utf-8").splitlines()[1].split(",")

    def changed(column: int, to: str) -> Any:
        def edit(rows: list[str]) -> list[str]:
            cells = rows[6].split(",")
            cells[column] = to
            return [*rows[:6], ",".join(cells), *rows[7:]]

        return edit

    for column, label in enumerate(header):
        edited(saved, name, tmp_path / "run.csv", changed(column, "0.34999999999999"))
        what = "does not follow|does not fit" if column == 0 else "does not fit its checksum"
        refused(tmp_path / "run.csv", what)
        edited(saved, name, tmp_path / "run.csv", changed(column, "nan"))
        place = r"is no finite number in row 7$|does not fit its checksum$"
        refused(tmp_path / "run.csv", label.replace("[", r"\[") + " " + f"({place})")


def test_zero_has_a_sign_and_a_number_that_is_none_comes_back(tmp_path: Path) -> None:
    run = exact(LinearPendulum(), (0.0, -0.0), [0.0, 1.0])
    run.save(tmp_path / "run.csv")
    same(pendula.load(tmp_path / "run.csv"), run)
    text = (tmp_path / "run.csv").read_text("utf-8")
    assert ",-0.0," in text
    (tmp_path / "run.csv").write_text(text.replace(",-0.0,", ",0.0,"), encoding="utf-8")
    refused(tmp_path / "run.csv", "does not fit its checksum")


def test_a_table_is_still_a_table(saved: Saved) -> None:
    """That pandas reads as it comes."""
    frame = pd.read_csv(saved.folder / "times.csv", comment="#")
    assert frame["theta [rad]"].to_numpy().tobytes() == saved["times"].theta.tobytes()


# ---- the other formats ----


@every_run
@every_format
def test_a_recipe_that_was_changed(name: str, ending: str, saved: Saved, tmp_path: Path) -> None:
    """Any number in it, also one that only `rerun` uses; and a checksum by another name."""
    path = tmp_path / f"run{ending}"
    for old, new in (
        ("9.80665", "9.80666"),
        ("reached_end", "step_limit" if name != "exact" else "event"),
        ('"t0": ', '"t0": 1'),
        ('"checksum"', '"checksun"'),
        ('"n_times": 21', '"n_times": 20'),
        ('"max_steps": null', '"max_steps": 1   '),
    ):
        rewritten(saved.folder / f"{name}{ending}", path, old, new)
        refused(path, "its recipe does not fit the recipe's checksum|checksum at its end")


def rewritten(source: Path, path: Path, old: str, new: str) -> None:
    """With a recipe in which some text is another."""
    from pendula.io import files

    shutil.rmtree(path) if path.is_dir() else path.unlink(missing_ok=True)
    shutil.copytree(source, path) if source.is_dir() else shutil.copy(source, path)
    with files.FORMATS[path.suffix][1](source) as stored:
        recipe = stored.recipe
    assert old in recipe
    changed = recipe.replace(old, new)
    if path.suffix == ".csv":
        path.write_text(path.read_text("utf-8").replace(recipe, changed), encoding="utf-8")
    elif path.suffix == ".nc":
        with h5py.File(path, "r+") as file:
            file.attrs["pendula"] = changed
    elif path.suffix == ".zarr":
        zarr.open_group(path, mode="r+").attrs["pendula"] = changed
    else:
        import pyarrow.parquet

        table = pyarrow.parquet.read_table(path)
        pyarrow.parquet.write_table(table.replace_schema_metadata({"pendula": changed}), path)


@pytest.mark.parametrize("part", ["t/c", "theta/c", "energy_error/c", "omega", "zarr.json"])
def test_a_store_that_lacks_a_part(part: str, saved: Saved, tmp_path: Path) -> None:
    path = tmp_path / "run.zarr"
    shutil.copytree(saved.folder / "times.zarr", path)
    shutil.rmtree(path / part) if (path / part).is_dir() else (path / part).unlink()
    refused(path, r"lacks 1 of its 1 chunks|the column omega \[rad/s\] is missing|cannot be read")


def test_sizes_are_compared_before_they_are_believed(saved: Saved, tmp_path: Path) -> None:
    """Petabytes of times, in an instant and without memory for them."""
    path = tmp_path / "run.zarr"
    for file, old, new in (
        ("t/zarr.json", '"shape": [\n    21', '"shape": [\n    210000000000000'),
        ("theta/zarr.json", '"shape": [\n    21', '"shape": [\n    210000000000000'),
        ("theta/zarr.json", '"chunk_shape": [\n        21', '"chunk_shape": [\n        1'),
    ):
        shutil.copytree(saved.folder / "times.zarr", path, dirs_exist_ok=True)
        text = (path / file).read_text("utf-8")
        assert old in text
        (path / file).write_text(text.replace(old, new), encoding="utf-8")
        refused(path, r"of 21 times|is not of the length|lacks 20 of its 21 chunks")
    with h5py.File(tmp_path / "run.nc", "w") as made, h5py.File(saved.folder / "times.nc") as old_:
        made.attrs["pendula"] = old_.attrs["pendula"]
        for name, each in old_.items():
            made.create_dataset(name, (10**14,), "f8").attrs["units"] = each.attrs["units"]
    refused(tmp_path / "run.nc", "is damaged: it holds 100000000000000 of 21 times")
    with h5py.File(tmp_path / "run.nc", "r+") as made:
        del made["t"]
        made["t"] = saved["times"].t
        made["t"].attrs["units"] = "s"
    refused(tmp_path / "run.nc", "theta .rad. is not of the length of the others")


def test_a_size_of_nothing_in_a_netcdf_file_does_not_hang(saved: Saved, tmp_path: Path) -> None:
    """In the heap of its texts, over which HDF5 goes until an object is the last."""
    data = bytearray((saved.folder / "times.nc").read_bytes())
    data = data[: data.rindex(b"\npendula blake2b")]  # as of an earlier version, or edited since
    (tmp_path / "run.nc").write_bytes(data)
    same(pendula.load(tmp_path / "run.nc"), saved["times"])
    place = data.index(b"GCOL") + 16
    size = int.from_bytes(data[place + 8 : place + 16], "little")
    data[place + 16 + -(-size // 8) * 8 + 8] ^= 0x40  # of the second object
    (tmp_path / "run.nc").write_bytes(data)
    code = "import pendula, sys\ntry: pendula.load(sys.argv[1])\nexcept ValueError as e: print(e)"
    command = [sys.executable, "-c", code, str(tmp_path / "run.nc")]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=True)
    assert "run.nc is damaged: sizes inside it do not fit" in done.stdout


def test_a_netcdf_file_that_hdf5_wrote_to_is_read(saved: Saved, tmp_path: Path) -> None:
    """A title is no damage; another number is."""
    path = tmp_path / "run.nc"
    shutil.copy(saved.folder / "times.nc", path)
    with h5py.File(path, "r+") as file:
        file.attrs["title"] = "A swing"
    same(pendula.load(path), saved["times"])
    with h5py.File(path, "r+") as file:
        file["omega"][4] += 1e-12
    refused(path, r"is damaged: omega \[rad/s\] does not fit its checksum")


def test_the_recipe_says_how_many_and_which(saved: Saved) -> None:
    first = (saved.folder / "times.csv").read_text("utf-8").splitlines()[0]
    known = json.loads(first.removeprefix("# pendula: "))
    assert known["n_times"] == 21
    assert list(known["columns"])[:3] == ["t [s]", "theta [rad]", "omega [rad/s]"]
    assert list(known)[-1] == "checksum"
