"""Work and heat: where the energy of a motion comes from, and where it goes."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

from pendula import (
    DampedDoublePendulum,
    DoublePendulum,
    DrivenPendulum,
    LinearPendulum,
    exact,
    load,
    solve,
)


def test_a_chaotic_drive_balances_over_ten_thousand_periods() -> None:
    driven = DrivenPendulum.scaled(2.0, 1.5, 2.0 / 3.0)
    run = solve(driven, (0.2, 0.0), np.linspace(0.0, 1e4 * 3.0 * np.pi, 101))
    assert np.abs(run.energy_error).max() < 1e-11
    assert run.work[-1] > 5e4  # of which the heat is nearly all


ALL = DrivenPendulum.body(
    2.0,
    0.3,
    0.5,
    9.81,
    viscous=0.1,
    quadratic=0.05,
    cubic=0.01,
    torque=0.8,
    drive_frequency=3.0,
    pivot_amplitude=0.02,
    pivot_frequency=9.0,
    pivot_direction=0.3,
)


@pytest.mark.parametrize("method", ["taylor", "dop853", "rk4"])
def test_work_and_heat_are_the_integrals_of_the_powers(method: Any) -> None:
    options: dict[str, Any] = {"step": 1e-3} if method == "rk4" else {}
    run = solve(ALL, (1.0, 0.0), [0.0, 1.0, 2.0], method, **options)
    dense = solve(ALL, (1.0, 0.0), 2.0)

    def integral(power: Any) -> float:
        return float(
            quad(
                lambda t: power(t, *dense.at([t])[0]),
                0.0,
                2.0,
                epsabs=1e-13,
                epsrel=1e-13,
                limit=500,
            )[0]
        )

    lever = 2.0 * 0.3 * 0.02 * 9.0**2
    want = {
        "drive": integral(lambda t, theta, omega: 0.8 * np.cos(3.0 * t) * omega),
        "pivot": integral(
            lambda t, theta, omega: lever * np.cos(9.0 * t) * np.cos(theta - 0.3) * omega
        ),
        "viscous": integral(lambda t, theta, omega: 0.1 * omega**2),
        "quadratic": integral(lambda t, theta, omega: 0.05 * abs(omega) ** 3),
        "cubic": integral(lambda t, theta, omega: 0.01 * omega**4),
        "coulomb": 0.0,
    }
    balance = run.energy_balance
    for name, value in {**balance.work_by, **balance.heat_by}.items():
        assert value[0] == 0.0
        assert abs(value[-1] - want[name]) < (1e-7 if method == "rk4" else 1e-11)
    np.testing.assert_allclose(run.work - run.heat, balance.net, rtol=0, atol=1e-14)
    assert np.abs(run.energy_error).max() < (1e-7 if method == "rk4" else 1e-13)


def test_the_fixed_methods_pay_for_jumps_of_friction() -> None:
    dry = DrivenPendulum.bob(coulomb=0.5)
    truth = solve(dry, (1.0, 0.0), [5.0]).states
    errors = [
        np.abs(solve(dry, (1.0, 0.0), [5.0], "rk4", step=h).states - truth).max()
        for h in (4e-3, 1e-3, 2.5e-4)
    ]
    orders = np.log(errors[0] / errors[2]) / np.log(16.0)
    assert 0.5 < orders < 1.6  # of a method of order four
    assert errors[2] > 1e-7


def test_the_exact_motion_balances_too() -> None:
    system = LinearPendulum(0.5, 9.81, 2.0, viscous=0.3, torque=1.0, drive_frequency=3.0)
    run = exact(system, [[0.3, 0.0], [0.0, 1.0]], np.linspace(-1.0, 5.0, 25), t0=0.5)
    assert run.work.shape == (2, 25)
    assert np.abs(run.energy_error).max() < 1e-13


def test_ideal_motions_do_no_work() -> None:
    run = solve(DoublePendulum.rods(), (1.0, 1.0, 0.0, 0.0), 2.0)
    assert not run.work.any()
    assert not run.heat.any()
    assert run.pieces.times.size == 0


def test_files_keep_what_the_balance_is_made_of(tmp_path: Path) -> None:
    system = DampedDoublePendulum.rods(coulomb=(0.3, 0.2), viscous=(0.1, 0.0))
    run = solve(system, (1.0, 2.0, 0.0, 0.0), 20.0)
    for name in ("run.nc", "run.csv", "run.zarr", "run.parquet"):
        run.save(tmp_path / name)
        again = load(tmp_path / name)
        assert again.system == system
        assert np.array_equal(again.heat, run.heat)
        assert np.array_equal(again.pieces.times, run.pieces.times)
        assert np.array_equal(again.pieces.states, run.pieces.states)
