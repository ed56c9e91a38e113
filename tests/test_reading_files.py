"""Files of programs: spreadsheets, archives, Tracker, phyphox, MATLAB, Parquet, NetCDF."""

from __future__ import annotations

import io
import struct
import zipfile
from typing import TYPE_CHECKING, Any

import h5py
import numpy as np
import pandas as pd
import pytest
import scipy.io
import xarray as xr

from recordings import DEGREES, OTHER_SWING, RATE, SWING, TIMES, rows, text
from sheets import ods, xlsx
from test_reading_text import measured

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

T = TIMES
CELLS = [[float(a), float(b)] for a, b in zip(T, DEGREES, strict=True)]
COMMAS = [[f"{a:.6f}".replace(".", ",") for a in row] for row in CELLS]


def archive(**files: str | bytes) -> bytes:
    held = io.BytesIO()
    with zipfile.ZipFile(held, "w") as into:
        for name, content in files.items():
            into.writestr(name.replace("__", "/").replace("_dot_", "."), content)
    return held.getvalue()


@pytest.mark.parametrize(
    "sheets",
    [
        {"Raw Data": [["Time (s)", "Angle (°)"], *CELLS]},
        {"Notes": [["by hand"]], "Data": [["Title"], [], ["Tiempo", "θ"], ["s", "grados"], *CELLS]},
        {"Data": [[None, "t", "theta"], *[[None, *row] for row in CELLS]]},
        {"as text": [["t", "theta"], *COMMAS]},
        {"one cell a line": [["t;theta"], *[[";".join(row)] for row in COMMAS]]},
    ],
)
def test_spreadsheets(sheets: dict[str, Any], tmp_path: Path) -> None:
    for content in (xlsx(sheets), ods(sheets)):
        found = measured(tmp_path / "a.bin", content)
        np.testing.assert_allclose(found.values[:, 0], SWING, rtol=0, atol=1e-6)
        np.testing.assert_allclose(found.t, T, rtol=0, atol=1e-6)


def test_two_sheets_are_asked_for(tmp_path: Path) -> None:
    content = xlsx({"A": [["t", "theta"], *CELLS[::2]], "B": [["t", "theta"], *CELLS]})
    with pytest.raises(ValueError, match=r"holds 2 tables: 'A', 'B'; name one with sheet=A$"):
        measured(tmp_path / "a.xlsx", content)
    assert measured(tmp_path / "a.xlsx", content, sheet="B").t.size == T.size
    with pytest.raises(ValueError, match="^sheet must be one of A, B, got 'C'"):
        measured(tmp_path / "a.xlsx", content, sheet="C")


def test_an_archive_of_phyphox(tmp_path: Path) -> None:
    raw = text('"Time (s)","Gyroscope x (rad/s)"', rows(T, RATE, form="%.9E"))
    other = text('"Time shift (s)","Autocorrelation of sum"', rows(T, RATE))
    device = text('"property","value"', '"version","1.1"')
    stamps = text('"event","experiment time"', '"START",0.0E0', '"PAUSE",8.0E0')
    content = archive(**{"Raw Data_dot_csv": raw, "Autocorrelation_dot_csv": other,
                         "meta__device_dot_csv": device, "meta__time_dot_csv": stamps})  # fmt: skip
    found = measured(tmp_path / "a.zip", content)
    assert found.reading["sheet"] == "Raw Data"
    np.testing.assert_allclose(found.values[:, 0], RATE, rtol=0, atol=1e-8)


def test_a_saved_state_of_phyphox(tmp_path: Path) -> None:
    def container(name: str, values: Any) -> str:
        return (
            f'<container size="0" init="{",".join(map(repr, values.tolist()))}">{name}</container>'
        )

    content = (
        f'<phyphox version="1.7"><data-containers>{container("time", T)}{container("gyrX", RATE)}'
        '</data-containers><export><set name="Raw"><data name="Time (s)">time</data>'
        '<data name="Gyroscope x (rad/s)">gyrX</data></set></export></phyphox>'
    )
    found = measured(tmp_path / "a.phyphox", content)
    np.testing.assert_array_equal(found.values[:, 0], RATE)


@pytest.mark.parametrize("separator", [",", "\t", ";"])
@pytest.mark.parametrize("word", ["mass_A", "masa A", "masse A", "Masse A", "massa A"])
def test_text_exports_of_tracker(separator: str, word: str, tmp_path: Path) -> None:
    x, y = 0.6 * np.sin(SWING), -0.6 * np.cos(SWING)
    lines = [line + separator for line in rows(T, x, y, separator=separator, form="%.6E")]
    head = [separator.join(["", word, "", ""]), separator.join(["t", "x", "y", ""])]
    for start in ([], ["#multi:"]):
        found = measured(tmp_path / "a.txt", text(start, head, lines), unit="m")
        assert (found.quantity, found.names) == ("position", ("x", "y"))
        np.testing.assert_allclose(found.as_angle().values[:, 0], SWING, rtol=0, atol=1e-5)


def test_two_tracks_of_tracker_with_gaps(tmp_path: Path) -> None:
    x, y = 0.6 * np.sin(SWING), -0.6 * np.cos(SWING)
    x[20:23] = y[20:23] = np.nan
    lines = [f"{line}," for line in rows(T, x, y, x + np.sin(OTHER_SWING), y - np.cos(OTHER_SWING))]
    content = text("#multi:", ",mass A,,mass B,,", "t,x,y,x,y,", lines)
    found = measured(tmp_path / "a.txt", content, unit="m")
    assert found.reading["x"] == (2, 4)
    np.testing.assert_array_equal(np.isnan(found.values[:, 0]), np.isnan(x))
    found = measured(tmp_path / "a.txt", content, x="mass B x", y="mass B y", unit="m")
    np.testing.assert_allclose(found.values[:, 0], x + np.sin(OTHER_SWING), rtol=0, atol=1e-6)


@pytest.mark.parametrize("label", ["θr", "θ_r", "θ"])
def test_angles_of_tracker_that_do_not_state_their_unit(label: str, tmp_path: Path) -> None:
    content = text(",mass A,,", f"t,{label},θ_v,", [f"{line}," for line in rows(T, DEGREES, RATE)])
    found = measured(tmp_path / "a.txt", content)
    np.testing.assert_allclose(found.values[:, 0], SWING, rtol=0, atol=1e-6)


def test_positions_of_two_bobs_go_before_the_angle_of_one(tmp_path: Path) -> None:
    x, y = 0.6 * np.sin(SWING), -0.6 * np.cos(SWING)
    columns = (T, x, y, DEGREES, x + np.sin(OTHER_SWING), y - np.cos(OTHER_SWING))
    content = text(",mass A,,,mass B,,", "t,x,y,θ,x,y,", [f"{line}," for line in rows(*columns)])
    found = measured(tmp_path / "a.txt", content, unit="m")
    assert found.names == ("x1", "y1", "x2", "y2")


TRACK = """<object class="org.opensourcephysics.cabrillo.tracker.{kind}">
<property name="name" type="string">{name}</property>
<property name="framedata" type="array">{frames}</property></object>"""
POINT = """<property name="[{i}]" type="object"><object>
<property name="x" type="double">{x}</property><property name="y" type="double">{y}</property>
</object></property>"""
FILE = """<?xml version="1.0" encoding="UTF-8"?>
<object class="org.opensourcephysics.cabrillo.tracker.TrackerPanel">
<object class="org.opensourcephysics.media.core.VideoClip">
<property name="startframe" type="int">5</property></object>
<object class="org.opensourcephysics.media.core.StepperClipControl">
<property name="delta_t" type="double">20.0</property></object>
<object class="org.opensourcephysics.media.core.ImageCoordSystem">
<property name="framedata" type="array"><property name="[0]" type="object"><object>
<property name="xorigin" type="double">640.0</property>
<property name="yorigin" type="double">100.0</property>
<property name="angle" type="double">30.0</property>
<property name="xscale" type="double">500.0</property>
<property name="yscale" type="double">500.0</property>
</object></property></property></object>{tracks}</object>"""


def tracked(name: str, x: Any, y: Any) -> str:
    points = [POINT.format(i=i + 5, x=a, y=b) for i, (a, b) in enumerate(zip(x, y, strict=True))]
    return TRACK.format(kind="PointMass", name=name, frames="".join(points))


def test_a_trk_file(tmp_path: Path) -> None:
    """In axes turned by 30° counter-clockwise, with their origin at the pivot."""
    x, y = 0.6 * np.sin(SWING), -0.6 * np.cos(SWING)
    pivot = TRACK.format(kind="PointMass", name="pivot", frames=POINT.format(i=5, x=640, y=100))
    bob = tracked("bob", 640 + 500 * x, 100 - 500 * y)
    content = FILE.format(tracks=bob + pivot)
    for made in (content, archive(**{"video_dot_trk": content})):
        found = measured(tmp_path / "a.trk", made)
        assert (found.unit, found.names) == ("m", ("x", "y"))
        np.testing.assert_allclose(found.t, T, rtol=0, atol=1e-9)
        turned = np.radians(30)
        np.testing.assert_allclose(
            found.values[:, 0], x * np.cos(turned) + y * np.sin(turned), rtol=0, atol=1e-9
        )
        angle = found.as_angle()
        np.testing.assert_allclose(angle.values[:, 0], SWING - turned, rtol=0, atol=1e-9)
        assert any("'pivot' is marked in one frame only" in note for note in found.notes)


def test_matlab(tmp_path: Path) -> None:
    variables: list[dict[str, Any]] = [
        {"t": T, "theta": SWING, "g": 9.81},
        {"data": np.column_stack([T, SWING, RATE])},
        {"data": np.vstack([T, SWING, RATE])},
        {"s": {"time": T, "angle": SWING, "fs": 50.0}},
        {"theta": SWING, "dt": 0.02},
    ]
    for held in variables:
        file = io.BytesIO()
        scipy.io.savemat(file, held)
        found = measured(tmp_path / "a.mat", file.getvalue())
        np.testing.assert_array_equal(found.values[:, 0], SWING)
        np.testing.assert_allclose(found.t, T, rtol=0, atol=1e-12)


def test_a_matrix_of_two_angles_in_matlab(tmp_path: Path) -> None:
    file = io.BytesIO()
    both = np.column_stack([SWING, OTHER_SWING])
    scipy.io.savemat(file, {"theta": both, "dt": 0.02})
    found = measured(tmp_path / "a.mat", file.getvalue())
    assert found.names == ("theta1", "theta2")
    np.testing.assert_array_equal(found.values, both)


def test_runs_in_matlab(tmp_path: Path) -> None:
    """As the double encoder's windows: times, and states by rows."""
    file = io.BytesIO()
    rate = np.gradient(OTHER_SWING, T)
    state = np.vstack([SWING, OTHER_SWING, RATE, rate])
    scipy.io.savemat(file, {"t_1": T, "y_1": -state, "t_2": T[:300] + 9, "y_2": state[:, :300]})
    with pytest.raises(ValueError, match="holds 2 runs: 1, 2; name one with run=1$"):
        measured(tmp_path / "a.mat", file.getvalue())
    found = measured(tmp_path / "a.mat", file.getvalue(), run=2)
    np.testing.assert_array_equal(found.t, T[:300] + 9)
    np.testing.assert_array_equal(found.values, state[:2, :300].T)
    named = measured(tmp_path / "a.mat", file.getvalue(), run=2, angle="y_2[2]")
    np.testing.assert_array_equal(named.values[:, 0], OTHER_SWING[:300])


def hdf5(path: Path, marked: str, **held: Any) -> bytes:
    """A file as MATLAB 7.3 writes it."""
    with h5py.File(path, "w", userblock_size=512) as file:
        for name, values in held.items():
            data = file.create_dataset(name, data=values)
            data.attrs["MATLAB_class"] = np.bytes_(marked)
            if marked != "double":
                data.attrs["MATLAB_object_decode"] = 3
    return b"MATLAB 7.3 MAT-file".ljust(512) + path.read_bytes()[512:]


def test_matlab_of_version_7_3(tmp_path: Path) -> None:
    content = hdf5(tmp_path / "a", "double", t=T[:, np.newaxis], theta=SWING[:, np.newaxis])
    found = measured(tmp_path / "a.mat", content)
    np.testing.assert_array_equal(found.values[:, 0], SWING)


def test_objects_of_matlab_get_one_line(tmp_path: Path) -> None:
    def element(kind: int, data: bytes) -> bytes:
        return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)

    numbers = element(6, struct.pack("<II", 13, 0)) + element(5, struct.pack("<ii", 6, 1))
    inner = element(14, numbers + element(1, b"") + element(6, struct.pack("<6I", *[1] * 6)))
    names = element(1, b"tbl") + element(1, b"MCOS") + element(1, b"timetable")
    held = element(14, element(6, struct.pack("<II", 17, 0)) + names + inner)
    old = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM" + held
    new = hdf5(tmp_path / "b", "timetable", data=np.ones((1, 6), dtype="uint32"))
    for content in (old, new):
        with pytest.raises(ValueError, match=r"holds MATLAB objects \(timetable\), which only MAT"):
            measured(tmp_path / "a.mat", content)


def test_parquet_and_netcdf(tmp_path: Path) -> None:
    frame = pd.DataFrame({"t (s)": T, "theta (deg)": DEGREES, "remark": "ok"})
    attributes = {"units": "degree"}
    dataset = xr.Dataset(
        {"theta": ("time", DEGREES, attributes)}, coords={"time": ("time", T, {"units": "s"})}
    )
    writers: dict[str, Callable[[Path], Any]] = {
        "a.parquet": frame.to_parquet,
        "b.parquet": frame.set_index("t (s)").to_parquet,
        "c.nc": lambda path: dataset.to_netcdf(path, engine="h5netcdf"),
        "d.nc": lambda path: dataset.to_netcdf(path, engine="scipy"),
    }
    for name, write in writers.items():
        write(tmp_path / name)
        found = measured(tmp_path / "again", (tmp_path / name).read_bytes())
        np.testing.assert_array_equal(found.t, T)
        np.testing.assert_allclose(found.values[:, 0], SWING, rtol=1e-15)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "holds no table of numbers; export the data as CSV, say$"),
        (b"only words\nand more\n", "holds no table of numbers"),
        (bytes(range(256)) * 9, "holds no table of numbers"),
        (b"PK\x03\x04" + bytes(60), "is no whole archive"),
        (b"\xd0\xcf\x11\xe0" + bytes(60), "is no spreadsheet that can be read"),
        (b"PAR1" + bytes(60), "is no Parquet file that can be read"),
        (b"\x89HDF\r\n\x1a\n" + bytes(60), "is no NetCDF file that can be read"),
        (b"MATLAB 5.0 MAT-file" + bytes(30), "is no MATLAB file that can be read"),
        (b'<?xml version="1.0"?><object class="org.opensourcephysics.x">', "is no whole .trk file"),
        (FILE.format(tracks="").encode(), "marks no point in more than one frame"),
        (b'<?xml version="1.0"?><phyphox></phyphox>', "holds no recorded data"),
    ],
)
def test_files_that_are_damaged_get_one_line(content: bytes, said: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=said) as error:
        measured(tmp_path / "a.dat", content)
    assert "\n" not in str(error.value)
    assert "a.dat" in str(error.value)


def test_a_missing_package_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "python_calamine", None)
    with pytest.raises(ImportError, match=r"^python_calamine is not installed; .*\[fit\]"):
        measured(tmp_path / "a.xlsx", xlsx({"A": [["t", "theta"], *CELLS]}))
