import json
import math
import os
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import pendula
from alike import same
from pendula import DoublePendulum, LinearPendulum, SimplePendulum, exact, solve
from pendula._checks import how_to_install
from pendula._writing import replacing
from pendula.events import angle, flip, tip_height, velocity_zero
from pendula.io import UncheckedFileWarning, files
from pendula.io.attributes import attributes

RUNS = {
    "rods": lambda: solve(DoublePendulum.rods(1, 2, 0.7), (2, 2.5, 0, 0), 1.0, "rk4", step=1e-3),
    "bodies": lambda: solve(
        DoublePendulum.bodies(1, 2, 0.5, 0.2, 0.3, 0.01, 0.02),
        (1, 0, 0, 0),
        [0.1, 0.25],
        "heun",
        step=0.1,
    ),
    "backward": lambda: solve(SimplePendulum(), (1, 0), -1.0, "euler", t0=0.1, step=0.01),
    "limited": lambda: solve(SimplePendulum(), (1, 0), 1.0, "rk4", step=0.01, max_steps=7),
    "limited times": lambda: solve(
        SimplePendulum(), (1, 0), [0.2, 0.25, 0.7], "rk4", step=0.1, max_steps=3
    ),
    "no time": lambda: solve(SimplePendulum(), (1, 0), [0.5, 1], "rk4", step=0.1, max_steps=3),
    "blown up": lambda: solve(
        DoublePendulum.rods(), (2, 1, 0, 0), np.arange(1.0, 50.0), "euler", step=1
    ),
    "taylor": lambda: solve(DoublePendulum.rods(), (2, 2.5, 0, 0), 3.0),
    "taylor times": lambda: solve(
        SimplePendulum(), (1, 0), [-0.5, -1.0], t0=0.25, tolerance=1e-9, max_steps=10**6
    ),
    "taylor limited": lambda: solve(SimplePendulum(), (1, 0), [0.2, 9.0], max_steps=3),
    "events": lambda: solve(
        DoublePendulum.rods(),
        (2, 2.5, 0, 0),
        np.linspace(0, 20, 51),
        events=[flip(1), angle(2, -0.1, 1), velocity_zero(2), tip_height(-0.7, -1, 9)],
    ),
    "exact": lambda: exact(SimplePendulum(0.3), (2.9, 0), np.linspace(0, 9, 40), t0=0.5),
    "linear": lambda: exact(LinearPendulum(0.3), (0.1, 0.7), [5.0, 1.0]),
}
every_run = pytest.mark.parametrize("run", RUNS.values(), ids=RUNS)
every_format = pytest.mark.parametrize("ending", list(files.FORMATS))


@every_run
@every_format
def test_a_file_holds_the_run_and_runs_again(run, ending: str, tmp_path: Path) -> None:  # type: ignore[no-untyped-def]
    trajectory, path = run(), tmp_path / f"run{ending}"
    trajectory.save(path)
    same(pendula.load(path), trajectory)
    same(pendula.rerun(path), trajectory)
    assert [each.name for each in tmp_path.iterdir()] == [path.name]


@every_format
def test_dense_output_comes_back_with_a_file(ending: str, tmp_path: Path) -> None:
    run = RUNS["events"]()
    assert run.outcome == "event"
    run.save(tmp_path / f"run{ending}")
    t = np.linspace(run.t[-1], 0.0, 33)
    assert pendula.load(tmp_path / f"run{ending}").at(t).tobytes() == run.at(t).tobytes()


@every_format
@pytest.mark.parametrize("horizon", [math.inf, 1.25, None])
def test_what_a_run_is_trusted_to_comes_back(
    ending: str, horizon: float | None, tmp_path: Path
) -> None:
    """As JSON that any reader takes: it has no infinity."""
    plain = RUNS["taylor"]()
    asked = replace(plain.request, certify=horizon and 1e-9)
    run = replace(
        plain, request=asked, trust_horizon=horizon, precision=None if horizon is None else 75
    )
    run.save(tmp_path / f"run{ending}")
    same(pendula.load(tmp_path / f"run{ending}"), run)
    assert not {"Infinity", "NaN"} & set(re.findall(r"\w+", attributes(run)))


@pytest.mark.parametrize("asked", [{"certify": 1e-9}, {"digits": 9}])
def test_a_trusted_run_is_asked_for_again(
    asked: dict[str, float], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = []

    def solve_again(*arguments: object, **options: object) -> None:
        given.append(options)

    run = RUNS["taylor"]()
    tolerance = None if "digits" in asked else run.request.tolerance
    request = replace(run.request, **asked, tolerance=tolerance)  # type: ignore[arg-type]
    replace(run, request=request).save(tmp_path / "run.csv")
    monkeypatch.setattr("pendula.run.solve.solve", solve_again)
    pendula.rerun(tmp_path / "run.csv")
    assert given[0]["tolerance"] == tolerance
    assert {name: given[0][name] for name in asked} == asked


@every_format
def test_nothing_is_overwritten_unasked(ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"run{ending}"
    RUNS["linear"]().save(path)
    with pytest.raises(FileExistsError, match=r"exists; choose another name"):
        RUNS["exact"]().save(path)
    same(pendula.load(path), RUNS["linear"]())
    RUNS["exact"]().save(path, overwrite=True)
    same(pendula.load(path), RUNS["exact"]())
    assert len(list(tmp_path.iterdir())) == 1


def test_the_header_of_a_csv_has_units(tmp_path: Path) -> None:
    RUNS["rods"]().save(tmp_path / "run.csv")
    recipe, header, first, *_ = (tmp_path / "run.csv").read_text(encoding="utf-8").splitlines()
    assert json.loads(recipe.removeprefix("# pendula: "))["system"]["parameters"]["m2"] == 2.0
    assert header == (
        "t [s],theta1 [rad],theta2 [rad],omega1 [rad/s],omega2 [rad/s],"
        "kinetic_energy [J],potential_energy [J],energy_error [1]"
    )
    assert first.startswith("0.0,2.0,2.5,0.0,0.0,0.0,")


def test_several_exact_solutions_need_a_dataset(tmp_path: Path) -> None:
    many = exact(SimplePendulum(), [(1, 0), (2, 0)], [0.0, 1.0, 2.0])
    many.save(tmp_path / "many.nc")
    assert pendula.load(tmp_path / "many.nc").states.tobytes() == many.states.tobytes()
    assert many.to_xarray()["theta"].dims == ("trajectory", "t")
    with pytest.raises(ValueError, match="takes one motion, got 2"):
        many.save(tmp_path / "many.csv")
    assert [each.name for each in tmp_path.iterdir()] == ["many.nc"]


def test_tables_are_labelled() -> None:
    run = RUNS["rods"]()
    dataset, frame = run.to_xarray(), run.to_pandas()
    assert dataset["omega2"].attrs["units"] == "rad/s"
    assert dataset["t"].attrs["units"] == "s"
    assert (dataset["theta1"].values == run.theta[:, 0]).all()
    assert list(frame.columns[:2]) == ["t [s]", "theta1 [rad]"]
    assert len(frame) == run.t.size


@pytest.mark.parametrize("name", ["run", "run.txt", "run.csv.gz"])
def test_another_ending_is_refused(name: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"must end in \.csv, \.nc, \.parquet, \.zarr, got"):
        RUNS["linear"]().save(tmp_path / name)
    with pytest.raises(ValueError, match="must end in"):
        pendula.load(tmp_path / name)


HEAD = json.dumps({"pendula": "0", "system": SimplePendulum().description(), "method": "rk4",
                   "state": [1.0, 0.0], "t": 1.0, "t0": 0.0, "step": 1.0, "max_steps": None,
                   "outcome": "reached_end", "n_steps": 1, "n_evaluations": 4})  # fmt: skip
COLUMNS = "t [s],theta [rad],omega [rad/s]"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("a,b\n1,2\n", "was not written by pendula"),
        (f'# pendula: {{"system": 3}}\n{COLUMNS}\n0,1,2\n', "does not hold a trajectory"),
        (f"# pendula: {HEAD}\n", "is not whole"),
        (f"# pendula: {HEAD}\n{COLUMNS}\n0,1,2\n1,2\n", "is not whole"),
        (f"# pendula: {HEAD}\n{COLUMNS}\n0,1,abc\n", "something else than numbers: .*abc"),
        (f"# pendula: {HEAD}\nt [s],x [m]\n0,1\n", "lacks the columns"),
        (f"# pendula: {HEAD.replace('rk4', 'rk5')}\n{COLUMNS}\n0,1,2\n", "method must be one of"),
        (f"# pendula: {HEAD.replace('[1.0, 0.0]', '[1.0]')}\n{COLUMNS}\n0,1,2\n", "components"),
    ],
)
def test_a_spoilt_file_is_refused_by_name(text: str, message: str, tmp_path: Path) -> None:
    path = tmp_path / "other.csv"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=message) as error:
        pendula.load(path)
    assert str(path) in str(error.value)


def test_a_whole_file_of_that_kind_is_read(tmp_path: Path) -> None:
    path = tmp_path / "other.csv"
    path.write_text(f"# pendula: {HEAD}\n{COLUMNS}\n0,1,0\n1,0.5,2\n", encoding="utf-8")
    with pytest.warns(UncheckedFileWarning, match="other.csv is of a version that wrote no checks"):
        assert pendula.load(path).states.tolist() == [[1.0, 0.0], [0.5, 2.0]]


@pytest.mark.parametrize("ending", [".nc", ".parquet", ".zarr"])
def test_a_broken_binary_file_is_refused_by_name(ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"broken{ending}"
    if ending == ".zarr":
        path.mkdir()
    else:
        path.write_bytes(b"not a file of that format")
    with pytest.raises(ValueError, match=f"broken{ending} cannot be read"):
        pendula.load(path)
    with pytest.raises(FileNotFoundError, match="no such file"):
        pendula.load(tmp_path / f"nowhere{ending}")


def test_an_unwritable_path_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="is not a folder; make it first"):
        RUNS["linear"]().save(tmp_path / "no" / "run.csv")
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(NotADirectoryError, match="is not a folder"):
        RUNS["linear"]().save(tmp_path / "file" / "run.csv")


def test_a_link_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "dangling.csv").symlink_to(tmp_path / "real.csv")
    with pytest.raises(FileExistsError, match="exists"):
        RUNS["linear"]().save(tmp_path / "dangling.csv")
    RUNS["linear"]().save(tmp_path / "dangling.csv", overwrite=True)
    assert (tmp_path / "dangling.csv").is_symlink()
    same(pendula.load(tmp_path / "real.csv"), RUNS["linear"]())


def test_a_folder_does_not_become_a_file(tmp_path: Path) -> None:
    (tmp_path / "run.csv").mkdir()
    (tmp_path / "run.zarr").write_text("kept", encoding="utf-8")
    for name in ("run.csv", "run.zarr"):
        with pytest.raises(FileExistsError, match="choose another name"):
            RUNS["linear"]().save(tmp_path / name, overwrite=True)
    assert sorted(each.name for each in tmp_path.iterdir()) == ["run.csv", "run.zarr"]


@pytest.mark.parametrize("folder", [False, True])
def test_a_failed_write_leaves_what_was_there(folder: bool, tmp_path: Path) -> None:
    target = tmp_path / "result"
    if folder:
        target.mkdir()
        (target / "old").write_text("old", encoding="utf-8")
    else:
        target.write_text("old", encoding="utf-8")

    def fail() -> None:
        with replacing(target, overwrite=True) as unfinished:
            unfinished.mkdir() if folder else unfinished.write_text("new", encoding="utf-8")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        fail()
    old = target / "old" if folder else target
    assert old.read_text(encoding="utf-8") == "old"
    assert [each.name for each in tmp_path.iterdir()] == ["result"]


def test_a_missing_extra_is_named(tmp_path: Path) -> None:
    """With the packages of the extra hidden, the base install still writes CSV."""
    code = f"""
import sys
for hidden in ("pandas", "xarray", "pyarrow", "h5netcdf", "zarr"):
    sys.modules[hidden] = None
import pendula
run = pendula.exact(pendula.SimplePendulum(), (1, 0), [0.0, 1.0])
run.save({os.fspath(tmp_path / "run.csv")!r})
for ending in ("nc", "parquet", "zarr"):
    try:
        run.save({os.fspath(tmp_path)!r} + "/run." + ending)
    except ImportError as error:
        print(error)
"""
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.count(f"is not installed; {how_to_install('io')}") == 3
    assert [each.name for each in tmp_path.iterdir()] == ["run.csv"]
