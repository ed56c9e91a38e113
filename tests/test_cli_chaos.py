"""`pendula chaos` and the maps of indicators: the same as in Python, files, pictures, bad input."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
import xarray as xr

from commands import floats, table_of, unfolded
from pendula import DoublePendulum, DrivenPendulum, chunks
from pendula.chaos import (
    bifurcation,
    family,
    indicator_map,
    lyapunov,
    megno,
    normal_mode,
    section_map,
)

if TYPE_CHECKING:
    from commands import Call

RODS = DoublePendulum.rods()
WILD = (2.0, 2.5, 0.0, 0.0)
START = "--theta1 2rad --theta2 2.5rad"
SCALED = "driven --scaled --q 2 --a 1.07 --drive-frequency 0.6666666666666666"


# ---- the same as in Python ----


def test_exponents(call: Call) -> None:
    line = f"chaos lyapunov double {START} --t-max 50s --transient 10s --exponents 2 -o e.csv"
    code, printed, error = call(line)
    assert (code, error) == (0, "")
    found = lyapunov(RODS, WILD, 50.0, transient=10.0, exponents=2)
    told, columns = table_of("e.csv")
    assert told["chaos"] == "Lyapunov"
    assert told["system"] == RODS.description()
    assert told["state"] == list(WILD)
    assert floats(columns["t [s]"]) == found.t.tolist()
    assert floats(columns["exponent2 [1/s]"]) == found.running[:, 1].tolist()
    assert f"{found.exponents[0]:.6g}" in printed
    assert f"Lyapunov time {1.0 / found.exponents[0]:.4g} s" in unfolded(printed)
    assert printed.endswith("e.csv\n")


def test_a_single_exponent_has_a_verdict_and_a_certified_one_an_end(call: Call) -> None:
    code, printed, _ = call(f"chaos lyapunov double {START} --t-max 30s --certify 1e-6rad")
    assert code == 0
    found = lyapunov(RODS, WILD, 30.0, certify=1e-6)
    assert f"{found.verdict}: mean MEGNO {found.mean_megno:.4g}" in printed
    assert f"certified to {found.trust_horizon:g} s" in unfolded(printed)
    (value,), (error,), (n,) = found.finite_time, found.finite_time_error, found.digits
    assert f"exponents up to there are {value:.{n}f} (±{error:.1g}) 1/s" in unfolded(printed)


def test_a_spectrum_tells_its_checks(call: Call) -> None:
    _, printed, _ = call(f"chaos lyapunov double {START} --t-max 20s --exponents 4")
    found = lyapunov(RODS, WILD, 20.0, exponents=4)
    assert f"sum {float(found.sum):.2g} 1/s" in printed
    assert f"errors of the pairs {found.pairing_error[0]:.2g}" in unfolded(printed)


def test_megno(call: Call) -> None:
    code, printed, _ = call(f"chaos megno double {START} --t-max 10s --every 2s -o m.json")
    assert code == 0
    found = megno(RODS, WILD, [2.0, 4.0, 6.0, 8.0, 10.0])
    rows = json.loads(Path("m.json").read_text())["rows"]
    assert [row["mean MEGNO"] for row in rows] == found.mean.tolist()
    assert [row["ln growth"] for row in rows] == found.growth.tolist()
    assert f"{found.verdict}: mean MEGNO {found.mean[-1]:.4g}" in printed


def test_an_orbit_and_its_family(call: Call) -> None:
    code, printed, _ = call("chaos orbit double --mode 2 --energy 6J -o o.csv")
    assert code == 0
    orbit = normal_mode(RODS, 2, energy=6.0)
    _, columns = table_of("o.csv")
    assert floats(columns["period [s]"]) == [orbit.period]
    assert floats(columns["theta2 [rad]"]) == [orbit.state[1]]
    assert f"period [s]      {orbit.period!r}" in printed
    assert "elliptic" in printed
    line = "chaos orbit double --mode 2 --energy 6J --family 6:10 --orbits 5 -o f.csv"
    code, printed, _ = call(line)
    assert code == 0
    followed = family(orbit, 5, energy=(6.0, 10.0))
    _, columns = table_of("f.csv")
    assert floats(columns["energy [J]"]) == [each.energy for each in followed.orbits]
    assert f"{followed.changes[0].value:.12g}" in printed


def test_an_orbit_from_a_start(call: Call) -> None:
    line = f"chaos orbit {SCALED.replace('1.07', '1')} --theta=-1rad --omega 1.9rad/s"
    code, printed, _ = call(line)
    assert code == 0
    assert "stable node" in printed
    code, printed, _ = call(f"{line} --family a=0.99:1.01 --orbits 3")
    assert code == 0
    assert "1.0043194774" in printed  # the symmetry breaks


def test_a_bifurcation(call: Call) -> None:
    line = f"chaos bifurcation {SCALED} --along a=1.06:1.07 --values 3 --points 32"
    code, printed, _ = call(f"{line} --transient 40 --theta 0rad -o b.csv")
    assert code == 0
    system = DrivenPendulum.scaled(2.0, 1.07, 0.6666666666666666)
    found = bifurcation(system, "a", np.linspace(1.06, 1.07, 3), points=32, transient=40)
    _, columns = table_of("b.csv")
    assert floats(columns["omega"]) == found.points[..., 1].ravel().tolist()
    assert "1.06637286" in printed
    assert "3 values of a, 32 points each" in unfolded(printed)


# ---- pictures ----


@pytest.mark.parametrize(
    "line",
    [
        f"lyapunov double {START} --t-max 20s",
        f"megno double {START} --t-max 20s",
        "section double --energy 5J --starts 3 --crossings 5",
        "orbit double --mode 1 --amplitude 20deg",
        "orbit double --mode 1 --amplitude 20deg --family 1:2 --orbits 3",
        f"bifurcation {SCALED} --along a=1:1.01 --values 2 --points 32 --transient 5",
    ],
)
def test_every_measure_has_a_picture(call: Call, line: str) -> None:
    code, printed, error = call(f"chaos {line} --picture p.svg --lang es")
    assert (code, error) == (0, "")
    assert printed.endswith("p.svg\n")
    text = Path("p.svg").read_text(encoding="utf-8")
    assert "varillas" in text or "adimensional" in text
    code, _, error = call(f"chaos {line} --picture p.svg")
    assert (code, error) == (2, "pendula: p.svg exists; choose another name, or pass --force\n")


def test_show_prints_what_a_measure_wrote(call: Call) -> None:
    assert call(f"chaos megno double {START} --t-max 4s --every 1s -o m.csv")[0] == 0
    code, printed, _ = call("show m.csv")
    assert code == 0
    assert printed.startswith("measure of chaos\n")
    assert "chaos: Megno" in printed


# ---- maps ----


@pytest.mark.parametrize("indicator", ["megno", "lyapunov", "sali"])
def test_a_map_of_an_indicator(call: Call, indicator: str) -> None:
    line = f"map {indicator} double --theta1=1rad:2rad --size 4x3 --t-max 5s -o m.zarr"
    code, printed, error = call(f"{line} --picture m.png")
    assert (code, error) == (0, "")
    expected = indicator_map(RODS, (1.0, 2.0), (-math.pi, math.pi), (4, 3), 5.0, indicator)
    xr.testing.assert_identical(chunks.opened("m.zarr").load(), expected)
    values = expected[indicator]
    assert unfolded(printed).startswith(f"m.zarr: 4 x 3 cells; {indicator} {values.min():.3g} to ")
    if indicator == "megno":
        assert f"{float((values > 5.5).mean()):.1%} chaotic" in unfolded(printed)
    assert Path("m.png").read_bytes().startswith(b"\x89PNG")
    code, printed, _ = call("show m.zarr --picture again.png")
    assert code == 0
    assert f"{indicator} map" in printed or "indicator map" in printed
    assert Path("again.png").read_bytes() == Path("m.png").read_bytes()


@pytest.mark.parametrize("ending", ["zarr", "nc"])
def test_a_map_over_a_section(call: Call, ending: str) -> None:
    line = f"map section double --energy 6J --p2=-1:1.5 --size 5x4 --t-max 4s -o s.{ending}"
    code, printed, error = call(line)
    assert (code, error) == (0, "")
    expected = section_map(RODS, 6.0, (5, 4), 4.0, p2=(-1.0, 1.5))
    path = f"s.{ending}"
    found = chunks.opened(path) if ending == "zarr" else xr.open_dataset(path, engine="h5netcdf")
    with found:
        xr.testing.assert_identical(found.load(), expected)
    assert f"{float(expected.forbidden.mean()):.1%} of the cells beyond" in unfolded(printed)
    code, printed, _ = call(f"show {path}")
    assert code == 0
    assert "energy 6 J, t_max = 4 s" in printed
    assert "theta2 to the right, p2 upward; dark: order, blank: none" in printed


def test_a_store_that_lacks_a_chunk_is_gone_on_with_to_the_same_bytes(
    call: Call, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pendula.many.maps.cells.LARGEST_CHUNK", 3)
    line = "map section double --energy 6J --size 8x6 --t-max 4s --indicator sali -o s.zarr"
    assert call(line)[0] == 0
    whole = {path.name: path.read_bytes() for path in Path("s.zarr/sali").iterdir()}
    assert len(whole) > 3
    lost = sorted(Path("s.zarr/sali").glob("c.*"))[1]
    lost.unlink()
    code, _, error = call(line)
    assert code == 2
    assert "pass --resume to resume it" in error
    assert call(f"{line} --resume")[0] == 0
    assert {path.name: path.read_bytes() for path in Path("s.zarr/sali").iterdir()} == whole


# ---- wrong use ----


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("chaos", "name a measure: lyapunov, megno, section, orbit, bifurcation"),
        ("chaos heat", "no measure 'heat'; take one of lyapunov"),
        ("chaos lyapunov double", "Missing option '--t-max'"),
        ("chaos lyapunov double --t-max 1s --exponents 9", "--exponents must be a whole number"),
        ("chaos lyapunov double --t-max -1s", "--t-max must be positive [s], got -1.0"),
        ("chaos lyapunov double --t-max 9s --transient -1s", "--transient must be 0 or more"),
        ("chaos lyapunov double --t-max 9s -o e.nc", "must end in .csv or .json, got 'e.nc'"),
        ("chaos lyapunov double --t-max 9s --picture e.gif", "--picture must end in one of"),
        ("chaos megno double --t-max 1s --every 2s", "--every must"),
        ("chaos section simple --crossings 3", "has no section that is drawn; use pendula chaos"),
        ("chaos section double --energy -1J", "--energy must be positive [J], got -1.0"),
        (f"chaos section double {START} --energy 3J", "--energy and --theta1 exclude one another"),
        ("chaos section double --energy 3J --crossings 0", "--crossings must be a whole number"),
        ("chaos orbit double --mode 3 --energy 3J", "--mode must be 1 (the slow mode, in phase)"),
        ("chaos orbit double --mode 1", "--amplitude must be given, or --energy: one of them"),
        ("chaos orbit double --amplitude 3deg", "--amplitude goes with --mode"),
        ("chaos orbit double --mode 1 --energy 1J --family 1", "--family must be a range such as"),
        ("chaos orbit linear", "has no periodic orbits of its own kind"),
        (f"chaos orbit {SCALED} --family 1:2", "--family must be such as a=1:1.08"),
        (f"chaos bifurcation {SCALED}", "Missing option '--along'"),
        (f"chaos bifurcation {SCALED} --along b=1:2", "--along must be NAME=LO:HI with one of q"),
        (f"chaos bifurcation {SCALED} --along a=1", "--along must be a range such as 1:20"),
        (f"chaos bifurcation {SCALED} --along a=1:2 --points 3", "--points must be at least 32"),
        ("map section double --t-max 1s", "Missing option '--energy'"),
        ("map section double --energy 0J --t-max 1s", "--energy must be positive [J], got 0.0"),
        ("map section double --energy 1J --t-max 1s --p2 3", "--p2 must be a range such as -1:1"),
        ("map section double --energy 1J --t-max 1s --indicator heat", "'heat' is not one of"),
        ("map megno double --t-max 0s", "--t-max must be positive [s], got 0.0"),
        ("map megno double --t-max 1s --size 0", "--size must be a whole number from 1"),
        ("map lyapunov simple --t-max 1s", "which the simple pendulum does not have"),
    ],
)
def test_wrong_use_is_one_line(call: Call, line: str, message: str) -> None:
    code, printed, said = call(line)
    assert (code, printed) == (2, "")
    assert message in said
    assert said.count("\n") == 1
    assert list(Path().iterdir()) == []
