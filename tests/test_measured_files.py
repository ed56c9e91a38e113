"""Recordings and fits in files: the same back, fitted again to the same bits, damage told."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import fields, is_dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import pendula
import recordings
from commands import Call, unfolded
from pendula.measured import (
    Apparatus,
    Measurement,
    PeriodTable,
    compare_models,
    fit,
    fit_periods,
    read,
)
from recordings import DEGREES, RATE, SWING, TIMES, rows, text
from simulated import clean

ENDINGS = (".json", ".nc")
every_ending = pytest.mark.parametrize("ending", ENDINGS)
TABLE = PeriodTable(
    np.array([1.42, 1.55, 1.79, 2.01]),
    np.array([0.5, 0.6, 0.8, 1.0]),
    repeats=np.array([[1.41, 1.43], [1.55, np.nan], [1.78, 1.8], [2.0, 2.02]]),
)


def same(one: Any, other: Any, where: str = "") -> None:
    """Compare two objects bit for bit, field by field."""
    assert type(one) is type(other), where
    if is_dataclass(one):
        for each in fields(one):
            same(getattr(one, each.name), getattr(other, each.name), f"{where}.{each.name}")
    elif isinstance(one, np.ndarray):
        np.testing.assert_array_equal(one.view(np.uint64), other.view(np.uint64), where)
        assert one.shape == other.shape, where
    elif isinstance(one, dict):
        assert list(one) == list(other), where
        for name in one:
            same(one[name], other[name], f"{where}.{name}")
    elif isinstance(one, tuple):
        assert len(one) == len(other), where
        for i, pair in enumerate(zip(one, other, strict=True)):
            same(*pair, f"{where}[{i}]")
    else:
        assert repr(one) == repr(other), where


def kinds() -> dict[str, Any]:
    """One of each that can be saved."""
    made = clean(viscous=0.05)
    t = np.arange(300) / 200.0
    double = pendula.DampedDoublePendulum.bobs(1.0, 0.5, 0.3, 0.25, viscous=(2e-3, 1e-3))
    angles = pendula.solve(double, (1.5, 1.0, 0.0, 0.0), t).states[:, :2] + 1e-3 * np.sin(
        1e3 * t[:, np.newaxis]
    )
    two = Measurement(t, angles, "angle", ("theta1", "theta2"), "rad", bodies=2)
    missing = replace(made, values=np.where(made.t[:, np.newaxis] > 3.0, np.nan, made.values))
    bob = pendula.DrivenPendulum.bob(0.8, 9.6, viscous=0.01)
    return {
        "recording": replace(missing, geometry={"length": 0.8}, notes=("θ, ω₀",)),
        "model": fit(made, "viscous + coulomb", length=(0.8, 0.001), t=(1.0, 8.0)),
        "several": fit([made, made], "viscous", shared=("viscous",)),
        "bob": fit(made, bob, bounds={"gravity": (9.0, 10.0)}),
        "untold": fit(made, bob, free=("mass", "gravity", "viscous")),
        "compared": compare_models(made, ("viscous", "viscous + coulomb", "linear"), length=0.8),
        "windows": fit(two, "viscous", windows=0.8),
        "double": fit(two, double, free=("gravity",)),
        "table": TABLE,
        "periods": fit_periods(TABLE, apparatus=Apparatus(bob_radius=0.01), length_error=1e-3),
    }


@pytest.fixture(scope="module")
def things() -> dict[str, Any]:
    return kinds()


FITS = ("model", "several", "bob", "untold", "windows", "double", "periods", "compared")
NAMES = ("recording", "table", *FITS)


@every_ending
@pytest.mark.parametrize("name", NAMES)
def test_what_is_saved_is_read_back_bit_for_bit(
    things: dict[str, Any], name: str, ending: str, tmp_path: Path
) -> None:
    path = tmp_path / f"saved{ending}"
    things[name].save(path)
    same(pendula.load(path), things[name])
    with pytest.raises(FileExistsError, match="exists; choose another name, or pass overwrite"):
        things[name].save(path)


@every_ending
@pytest.mark.parametrize("name", FITS)
def test_a_fit_is_made_again_with_the_same_bits(
    things: dict[str, Any], name: str, ending: str, tmp_path: Path
) -> None:
    path = tmp_path / f"saved{ending}"
    things[name].save(path)
    same(pendula.rerun(path), things[name])


def test_a_recording_is_read_again_from_its_file(tmp_path: Path) -> None:
    source, saved = tmp_path / "swing.csv", tmp_path / "swing.json"
    source.write_text(text("t [s],angle [deg]", rows(TIMES, DEGREES)), encoding="utf-8")
    made = read(source, t=(1.0, 5.0))
    made.save(saved)
    recordings.same(pendula.rerun(saved), made)
    source.write_text(text("t [s],angle [deg]", rows(TIMES, 2.0 * DEGREES)), encoding="utf-8")
    with pytest.raises(ValueError, match=r"swing\.csv is not the file it was read from"):
        pendula.rerun(saved)
    source.unlink()
    with pytest.raises(FileNotFoundError):
        pendula.rerun(saved)
    clean().save(saved, overwrite=True)
    with pytest.raises(ValueError, match="cannot be run again: its recording is of no file"):
        pendula.rerun(saved)


def damaged_copies(whole: bytes) -> Iterator[bytes]:
    """A file with one bit turned over, at several places, or cut off."""
    for place in range(10, len(whole), len(whole) // 40):
        yield whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :]
    for size in (0, 1, len(whole) // 2, len(whole) - 3):
        yield whole[:size]


@every_ending
def test_damage_is_told_in_one_line_or_changes_nothing(
    things: dict[str, Any], ending: str, tmp_path: Path
) -> None:
    """A last digit may be another and still stand for the same double."""
    path, told = tmp_path / f"saved{ending}", list[str]()
    things["model"].save(path)
    for content in damaged_copies(path.read_bytes()):
        path.write_bytes(content)
        try:
            same(pendula.load(path), things["model"])
        except ValueError as error:
            told.append(str(error))
    assert len(told) > 35
    assert all(f"saved{ending}" in each and "\n" not in each for each in told)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("[]", "holds no recording or fit that pendula saved"),
        ("{}", "holds no recording or fit that pendula saved: 'checksum'"),
        ('{"measured": 1}', "holds no recording or fit that pendula saved"),
        ("{", "holds no recording or fit that pendula saved"),
        ("[" * 100_000, "holds no recording or fit that pendula saved"),
    ],
)
def test_foreign_json_is_told_in_one_line(content: str, said: str, tmp_path: Path) -> None:
    path = tmp_path / "other.json"
    path.write_text(content, encoding="utf-8")
    with pytest.raises(ValueError, match=said) as error:
        pendula.load(path)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    "content", [{"is": "os.system", "fields": {}}, {"same": "x"}, {"is": "Fit", "fields": {}}, 3]
)
def test_what_no_version_writes_is_told_in_one_line(content: Any, tmp_path: Path) -> None:
    from pendula.io.checksums import of_recipe

    known: dict[str, Any] = {"pendula": "9", "measured": "Fit", "content": content, "arrays": {}}
    path = tmp_path / "other.json"
    path.write_text(json.dumps({**known, "checksum": of_recipe(known)}), encoding="utf-8")
    with pytest.raises(ValueError, match=r"of another version of pendula, 9|holds no Fit"):
        pendula.load(path)


def test_other_endings_name_those_there_are(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"must end in \.json, \.nc, got 'swing.csv'"):
        clean().save(tmp_path / "swing.csv")
    with pytest.raises(FileNotFoundError, match="no such file"):
        pendula.load(tmp_path / "none.json")
    assert list(tmp_path.iterdir()) == []


def test_tables_have_names_and_units(things: dict[str, Any]) -> None:
    made = things["recording"]
    assert list(made.to_pandas()) == ["t [s]", "theta [rad]"]
    dataset = made.to_xarray()
    assert dataset["theta"].attrs["units"] == "rad"
    np.testing.assert_array_equal(dataset["theta"], made.values[:, 0])
    np.testing.assert_array_equal(dataset["t"], made.t)
    found = things["model"]
    table = found.to_pandas()
    assert list(table.index) == list(found.names)
    assert table.loc["viscous", "value"] == found["viscous"].value
    assert table.loc["viscous", "unit"] == "1/s"
    dataset = found.to_xarray()
    np.testing.assert_array_equal(dataset["covariance"], found.covariance)
    np.testing.assert_array_equal(dataset["residuals"], found.residuals)
    assert dataset["value"].sel(parameter="viscous") == found["viscous"].value
    table = things["compared"].to_pandas()
    assert list(table.index) == ["viscous", "viscous + coulomb", "linear"]
    dataset = things["compared"].to_xarray()
    assert dataset.attrs["preferred"] == "viscous"
    assert dataset["bic"].sel(model="viscous") == table.loc["viscous", "bic"] == 0.0
    assert dataset["rms"].attrs["units"] == "rad"
    assert things["several"].to_xarray()["fitted2"].dims == ("t2", "column2")
    assert list(TABLE.to_pandas()) == ["length [m]", "period [s]"]
    assert list(TABLE.to_xarray().sizes) == ["row"]
    assert things["periods"].to_pandas().loc["gravity", "unit"] == "m/s²"
    assert things["periods"].to_xarray()["residual"].dims == ("row",)


def test_a_recording_is_drawn() -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    made = Measurement(TIMES, SWING[:, np.newaxis], "angle", ("theta",), "rad")
    (line,) = made.plot(language="es").axes[0].lines
    np.testing.assert_allclose(np.asarray(line.get_ydata()), DEGREES)
    assert made.plot(language="es").axes[0].get_ylabel() == "ángulo θ [°]"
    two = Measurement(TIMES, np.stack([SWING, RATE], axis=1), "position", ("x", "y"), "m")
    assert [ax.get_ylabel() for ax in two.plot().axes] == ["x [m]", "y [m]"]


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("model", "dry friction"),
        ("periods", "gravity g"),
        ("compared", "The record is described by this model: viscous friction"),
        ("recording", "quantity: angle: theta [rad]"),
        ("table", "periods: 4, 1.42 … 2.01 s"),
    ],
)
def test_the_command_shows_what_is_saved(
    things: dict[str, Any], name: str, said: str, call: Call, tmp_path: Path
) -> None:
    for ending in ENDINGS:
        path = tmp_path / f"saved{ending}"
        things[name].save(path)
        picture = "" if name == "table" else f" --picture {tmp_path / 'drawn.svg'} --force"
        code, printed, _ = call(f"show {path}{picture}")
        assert code == 0
        assert said in unfolded(printed)
    assert (tmp_path / "drawn.svg").exists() == (name != "table")
