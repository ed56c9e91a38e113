"""Maps of indicators and chaotic shares: cells against single runs, stores, workers, kills."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray as xr

from chunked import files
from pendula import DoublePendulum, SimplePendulum, chunks
from pendula.chaos import (
    chaotic_share,
    energy_surface,
    indicator_map,
    lyapunov,
    megno,
    sali,
    section_map,
    section_starts,
)
from pendula.many.maps import cells as cells_of_map
from pendula.many.shares import seed_of
from refusals import told
from stored import document

RODS = DoublePendulum.rods(gravity=9.81)
OTHER: Any = SimplePendulum()
BOBS = DoublePendulum.bobs(1.3, 0.7, 0.8, 1.1, gravity=9.81)
RANGES = (-2.0, 2.5), (-1.0, 3.0)


def of_one(system: DoublePendulum, start: Any, end: float, indicator: str) -> float:
    """What the measure itself gives for one start."""
    if indicator == "megno":
        return float(megno(system, start, [end]).mean[-1])
    if indicator == "sali":
        return float(sali(system, start, [end]).value[-1])
    return float(lyapunov(system, start, end).exponents[0])


@pytest.mark.parametrize("indicator", ["megno", "lyapunov", "sali"])
@pytest.mark.parametrize("system", [RODS, BOBS], ids=["rods", "bobs"])
def test_a_cell_is_what_a_single_run_gives(system: DoublePendulum, indicator: str) -> None:
    data = indicator_map(system, *RANGES, (4, 3), 6.0, indicator)
    for i, j in product(range(4), range(3)):
        cell = data.isel(theta1=i, theta2=j)
        start = (float(cell.theta1), float(cell.theta2), 0.0, 0.0)
        assert float(cell[indicator]) == of_one(system, start, 6.0, indicator)


def test_a_cell_of_a_section_is_a_start_of_its_energy() -> None:
    data = section_map(BOBS, 12.0, (7, 6), 5.0)
    allowed = 0
    for i, j in product(range(7), range(6)):
        cell = data.isel(theta2=i, p2=j)
        if bool(cell.forbidden):
            assert np.isnan(float(cell.megno))
            assert "12 J reach" in told(
                lambda cell=cell: section_starts(BOBS, 12.0, float(cell.theta2), float(cell.p2))
            )
            continue
        allowed += 1
        start = section_starts(BOBS, 12.0, float(cell.theta2), float(cell.p2))
        assert BOBS.energy(start) == pytest.approx(12.0, rel=1e-13)
        assert start[0] == 0.0
        assert start[2] > 0.0
        assert float(cell.megno) == pytest.approx(of_one(BOBS, start, 5.0, "megno"), abs=1e-9)
    assert 10 < allowed < 42


def test_the_section_is_told_apart_where_it_should_be() -> None:
    """Most of 4 J is regular within 100 s, nearly all of 20 J chaotic."""
    calm, wild = (section_map(RODS, energy, (8, 8), 100.0).megno for energy in (4.0, 20.0))
    assert float((calm > 5.5).sum()) == 0.0
    assert float((wild > 5.5).sum() / wild.notnull().sum()) > 0.9


@pytest.mark.parametrize("largest", [3, 256])
def test_chunks_threads_and_stores_change_no_bit(
    largest: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    one = section_map(RODS, 8.0, (7, 6), 5.0), indicator_map(RODS, *RANGES, (7, 6), 5.0)
    monkeypatch.setattr(cells_of_map, "LARGEST_CHUNK", largest)
    cut = (
        section_map(RODS, 8.0, (7, 6), 5.0, threads=3, store=tmp_path / "section.zarr"),
        indicator_map(RODS, *RANGES, (7, 6), 5.0, threads=2, store=tmp_path / "map.zarr"),
    )
    for whole, parts in zip(one, cut, strict=True):
        xr.testing.assert_equal(parts.load(), whole)


def test_two_workers_write_the_same_bytes(
    tmp_path: Path, client: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cells_of_map, "LARGEST_CHUNK", 3)
    alone, shared = tmp_path / "alone.zarr", tmp_path / "shared.zarr"
    section_map(RODS, 8.0, (7, 6), 5.0, store=alone)
    section_map(RODS, 8.0, (7, 6), 5.0, store=shared, client=client)
    assert files(shared) == files(alone)


SLOW = """
import sys, time
from pendula.cli import main
from pendula.many.maps import cells, section
cells.LARGEST_CHUNK = 3
compute = section.SectionMap.__call__
def slow(*given):
    time.sleep(0.05)
    return compute(*given)
section.SectionMap.__call__ = slow
sys.exit(main(sys.argv[1:]))
"""


def test_a_run_that_is_killed_is_resumed_to_the_same_bytes(tmp_path: Path) -> None:
    line = "map section double --energy 8J --size 15x12 --t-max 3s --threads 1 -o m.zarr --resume"
    calm, killed = tmp_path / "calm", tmp_path / "killed"
    for folder in (calm, killed):
        folder.mkdir()
    run: Any = [sys.executable, "-c", SLOW, *line.split()]
    subprocess.run(run, cwd=calm, check=True, capture_output=True)
    first = killed / "m.zarr" / "megno"
    with subprocess.Popen(run, cwd=killed, stdout=subprocess.DEVNULL) as process:
        until = time.monotonic() + 120.0
        while len(list(first.glob("c.*"))) < 4 and time.monotonic() < until:
            time.sleep(0.02)
        os.kill(process.pid, signal.SIGKILL)
    assert process.returncode == -signal.SIGKILL
    assert 4 <= len(list(first.glob("c.*"))) < 20
    subprocess.run(run, cwd=killed, check=True, capture_output=True)
    assert files(killed / "m.zarr") == files(calm / "m.zarr")


def test_the_map_says_what_it_is() -> None:
    recipe = json.loads(section_map(RODS, 8.0, (2, 3), 2.0, "sali", p2=(-1.0, 1.0)).pendula)
    assert (recipe["map"], recipe["energy"], recipe["indicator"]) == ("section", 8.0, "sali")
    assert recipe["p2"] == [-1.0, 1.0]


# ---- shares ----


@pytest.mark.parametrize("energy", [4.0, 8.0, 10.0, 12.0, 60.0])
def test_shares_are_those_of_another_program(energy: float) -> None:
    (stored,) = (
        each for each in document("chaos.json")["chaotic_share"] if each["energy"] == energy
    )
    found = chaotic_share(RODS, energy, n=150, seed=3)
    share, error = float(found.share[0]), float(found.standard_error[0])
    assert abs(share - stored["share"]) <= 3.0 * np.hypot(error, stored["standard_error"])
    assert float(found.undecided[0]) < 0.08
    assert np.isnan(float(found.exponent[0])) == (share == 0.0)


def test_a_share_is_what_the_verdicts_of_its_starts_say() -> None:
    found = chaotic_share(RODS, [9.0, 12.0], n=40, t_max=100.0, seed=5)
    for i, energy in enumerate((9.0, 12.0)):
        starts = energy_surface(RODS, energy, 40, seed_of(5, i))
        runs = megno(RODS, starts, [100.0])
        chaotic = runs.verdict == "chaotic"
        assert float(found.share[i]) == chaotic.mean()
        assert float(found.undecided[i]) == (runs.verdict == "undecided").mean()
        assert float(found.exponent[i]) == pytest.approx(runs.growth[chaotic, 0].mean() / 100.0)
        share = chaotic.mean()
        assert float(found.standard_error[i]) == pytest.approx(np.sqrt(share * (1 - share) / 40))
    again = chaotic_share(RODS, [9.0, 12.0], n=40, t_max=100.0, seed=5, threads=1)
    xr.testing.assert_identical(again, found)
    other = chaotic_share(RODS, [9.0, 12.0], n=40, t_max=100.0, seed=6)
    assert not np.array_equal(other.exponent, found.exponent)


def test_shares_have_a_store_that_a_stopped_run_goes_on_with(tmp_path: Path, client: Any) -> None:
    how: dict[str, Any] = {"n": 20, "t_max": 20.0, "seed": 5}
    whole = chaotic_share(RODS, [9.0, 12.0], **how, store=tmp_path / "whole.zarr")
    xr.testing.assert_identical(whole, chaotic_share(RODS, [9.0, 12.0], **how))

    def stop(part: float) -> None:
        if part >= 0.5:
            raise KeyboardInterrupt

    stopped = tmp_path / "stopped.zarr"
    with pytest.raises(KeyboardInterrupt, match="of 2 chunks"):
        chaotic_share(RODS, [9.0, 12.0], **how, store=stopped, progress=stop)
    xr.testing.assert_identical(chaotic_share(RODS, [9.0, 12.0], **how, store=stopped), whole)
    assert files(stopped) == files(tmp_path / "whole.zarr")
    spread = tmp_path / "spread.zarr"
    chaotic_share(RODS, [9.0, 12.0], **how, store=spread, client=client)
    assert files(spread) == files(stopped)
    held = chunks.opened(stopped)
    assert held.megno.shape == (2, 20)
    with pytest.raises(ValueError, match="energies"):
        chaotic_share(RODS, [9.0, 13.0], **how, store=stopped)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: chaotic_share(OTHER, [1.0]), "system must be a DoublePendulum"),
        (lambda: chaotic_share(RODS, [-1.0]), "energies must be positive [J], got -1.0"),
        (lambda: chaotic_share(RODS, []), "energies must have shape (k,), got (0,)"),
        (lambda: chaotic_share(RODS, [1.0], n=0), "n must be a whole number from 1"),
        (lambda: chaotic_share(RODS, [1.0], seed=-1), "seed must be a whole number of at least 0"),
        (lambda: chaotic_share(RODS, [1.0], t_max=0.0), "t_max must be positive [s], got 0.0"),
        (lambda: indicator_map(RODS, *RANGES, (2, 2), 1.0, "heat"), "indicator must be one of"),
        (lambda: indicator_map(RODS, (1.0, 0.0), (0.0, 1.0), (2, 2), 1.0), "theta1 must be a ran"),
        (lambda: section_map(RODS, 0.0, (2, 2), 1.0), "energy must be positive [J], got 0.0"),
        (lambda: section_map(RODS, 1.0, (2, 2), 1.0, p2=(1.0, 1.0)), "p2 must be a range"),
        (lambda: section_map(OTHER, 1.0, (2, 2), 1.0), "system must be a DoublePen"),
    ],
)
def test_a_wrong_call_is_one_line(call: Any, message: str) -> None:
    assert message in told(call)
