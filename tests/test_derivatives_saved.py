"""Derivatives in files and tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

pytest.importorskip("xarray")

from pendula import DrivenPendulum, SimplePendulum, ensemble, events, exact, io, solve

if TYPE_CHECKING:
    from pathlib import Path


@pytest.mark.parametrize("ending", [".csv", ".nc", ".parquet", ".zarr"])
def test_files_hold_them_with_those_of_events(tmp_path: Path, ending: str) -> None:
    system, wanted = DrivenPendulum.bob(coulomb=0.3), ("theta", "coulomb")
    turns = events.velocity_zero(1)
    run = solve(system, (1.2, 0.0), 5.0, events=turns, derivatives=wanted)
    path = tmp_path / f"run{ending}"
    run.save(path)
    assert run.derivatives is not None
    for found in (io.load(path), io.rerun(path)):
        assert found.derivative_names == wanted
        assert np.array_equal(found.derivatives, run.derivatives)
        for there, here in zip(found.event_derivatives, run.event_derivatives, strict=True):
            assert np.array_equal(there.times, here.times)
            assert np.array_equal(there.states, here.states)
    assert "domega_dcoulomb [rad/s/(N m)]" in run.to_pandas()
    assert "domega_dcoulomb" not in run.to_xarray()  # but in one variable with the others


def test_files_hold_those_of_closed_forms_and_tables_those_of_ensembles(tmp_path: Path) -> None:
    starts = np.array([[1.0, 0.0], [2.0, 0.5]])
    solutions = exact(SimplePendulum(0.5), starts, [0.5, 1.0], derivatives="all")
    assert solutions.derivatives is not None
    solutions.save(tmp_path / "exact.nc")
    for found in (io.load(tmp_path / "exact.nc"), io.rerun(tmp_path / "exact.nc")):
        assert np.array_equal(found.derivatives, solutions.derivatives)
    many = ensemble(SimplePendulum(0.5), starts, [0.5, 1.0], derivatives=("omega", "length"))
    assert many.derivatives is not None
    found = many.to_xarray()["domega_dlength"]
    assert np.array_equal(found, many.derivatives[:, :, 1, 1])
    assert found.units == "rad/s/m"
    assert many.to_pandas()["dtheta_domega [rad/(rad/s)]"].tolist() == (
        many.derivatives[:, :, 0, 0].ravel().tolist()
    )


def test_a_file_that_lost_derivatives_is_damaged(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    solve(SimplePendulum(), (1.0, 0.0), [0.5, 1.0], derivatives="theta").save(path)
    recipe, header, *rows = path.read_text().splitlines()
    header = header.replace("domega_dtheta [", "domega_dthetas [")
    path.write_text("\n".join([recipe, header, *rows]))
    with pytest.raises(ValueError, match="the column domega_dtheta .* is missing"):
        io.load(path)
