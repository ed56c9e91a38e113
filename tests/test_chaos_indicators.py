"""Growth, MEGNO, SALI and GALI against stored values; verdicts, spectra, and what a batch gives."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from indicated import CALM, CASES, RODS, STORED, WILD, double_of, each_case, of
from pendula import (
    DampedDoublePendulum,
    DoublePendulum,
    DrivenPendulum,
    LinearPendulum,
    SimplePendulum,
    solve,
)
from pendula.chaos import gali, lyapunov, megno, sali, tangent_map
from refusals import told

STARTS = np.array([WILD, CALM, (1.2, 1.5, 0.0, 0.0), (0.1, 0.2, 5.0, 3.0), (-1.0, 2.0, 0.0, 1.0)])


# ---- stored values ----


@each_case
def test_megno_and_growth(case: dict[str, Any]) -> None:
    system = double_of(case["system"])
    t, want = of(case, "megno")
    found = megno(system, case["state"], t)
    assert np.abs(found.megno - want).max() <= 1e-5
    assert np.abs(found.mean - of(case, "megno_mean")[1]).max() <= 1e-5
    assert np.abs(found.growth - of(case, "log_growth")[1]).max() <= 1e-9


@each_case
def test_sali_and_gali(case: dict[str, Any]) -> None:
    system = double_of(case["system"])
    for name, call in (("sali", sali), ("gali2", gali)):
        t, want = of(case, name)
        found = call(system, case["state"], t).value
        seen = want > 1e-8
        assert seen.any()
        assert np.abs(found[seen] / want[seen] - 1.0).max() <= 1e-6


@each_case
def test_the_largest_singular_value(case: dict[str, Any]) -> None:
    t, want = of(case, "ftle_largest_singular")
    found = tangent_map(double_of(case["system"]), case["state"], t).rate
    assert np.abs(found - want).max() <= 1e-9


# ---- orders that hold for any motion ----


def test_megno_of_a_regular_motion_is_two() -> None:
    starts = np.array([CALM, (1.0, 0.8, 0.0, 0.0), (0.6, -0.9, 0.0, 0.0)])
    found = megno(RODS, starts, [2000.0])
    assert np.abs(found.mean[:, -1] - 2.0).max() < 0.1
    assert list(found.verdict) == ["regular"] * 3


@pytest.mark.parametrize("name", ["rods-regular", "rods-fast"])
def test_megno_of_the_stored_regular_motions_is_two(name: str) -> None:
    (case,) = (each for each in CASES if each["name"] == name)
    found = megno(double_of(case["system"]), case["state"], [2000.0])
    assert abs(found.mean[0] - 2.0) < 0.03
    assert found.verdict == "regular"


def test_sali_tells_chaos_from_order() -> None:
    t = np.arange(1.0, 101.0)
    wild, calm = sali(RODS, WILD, t), sali(RODS, CALM, t)
    assert wild.aligned < 30.0
    assert wild.value[t == wild.aligned].item() < 1e-8
    assert np.isinf(calm.aligned)
    assert calm.value.min() > 0.01


def test_gali_of_all_directions_is_their_volume_and_falls_in_chaos() -> None:
    t = [1.0, 2.0, 3.0, 10.0]
    assert (np.diff(np.log(gali(RODS, WILD, t, 4).value)) < 0.0).all()
    one = gali(RODS, CALM, [1e-9], 4).value
    assert one == pytest.approx(1.0, abs=1e-7)  # orthogonal ones to begin with


# ---- exponents ----


def test_the_exponent_of_a_short_run_is_its_growth() -> None:
    for case in CASES:
        t, want = of(case, "finite_time_lyapunov")
        for end, value in zip(t, want, strict=True):
            found = lyapunov(double_of(case["system"]), case["state"], end)
            assert found.exponents[0] == pytest.approx(value, abs=1e-9)


@pytest.mark.parametrize("motion", ["rest", "linear", "swing"])
def test_where_nothing_is_chaotic_the_exponent_tends_to_zero(motion: str) -> None:
    systems: dict[str, tuple[Any, Any]] = {
        "rest": (RODS, (0.0, 0.0, 0.0, 0.0)),
        "linear": (LinearPendulum(), (0.3, 0.1)),
        "swing": (SimplePendulum(), (1.0, 0.0)),
    }
    system, start = systems[motion]
    found = lyapunov(system, start, 1000.0, exponents=len(start))
    assert np.isfinite(found.running).all()
    assert np.abs(found.exponents).max() < 0.02
    one = lyapunov(system, start, 1000.0)
    assert np.isfinite(one.running).all()
    assert one.verdict == "regular"


@pytest.mark.parametrize(
    ("form", "energy"),
    [("rods", 15.0), ("rods", 20.0), ("rods", 30), ("rods", 60.0), ("bobs", 30)],
)
def test_long_exponents_are_those_of_another_program(form: str, energy: float) -> None:
    """Within three combined errors, of a start in the same chaotic sea."""
    (stored,) = (
        each for each in STORED["long_runs"] if (each["form"], each["energy"]) == (form, energy)
    )
    system = getattr(DoublePendulum, form)(gravity=9.81)
    start = np.array([0.0, 0.5, 0.0, 0.0])
    left = energy - system.energy(start)
    start[2] = np.sqrt(2.0 * left / system.constants["A"])
    found = lyapunov(system, start, 4000.0)
    assert system.energy(start) == pytest.approx(energy)
    combined = np.hypot(found.standard_error[0], stored["standard_error"])
    assert abs(found.exponents[0] - stored["mean_of_chaotic"]) < 3.0 * combined
    assert found.verdict == "chaotic"
    assert found.standard_error[0] < 0.15 * found.exponents[0]


@pytest.mark.parametrize("form", ["rods", "bobs"])
def test_the_spectrum_without_friction_is_in_pairs(form: str) -> None:
    system = getattr(DoublePendulum, form)(gravity=9.81)
    found = lyapunov(system, WILD, 1000.0, exponents=4)
    assert abs(found.sum) <= 20.0 / 1000.0
    assert (found.pairing_error <= 20.0 / 1000.0).all()
    assert found.exponents[0] > 0.5
    assert np.abs(found.exponents[1:3]).max() < 0.02


@pytest.mark.parametrize(
    "row", [r for r in STORED["driven"] if r["a"] in (0.9, 1.07, 1.15, 1.48, 1.5)]
)
def test_a_driven_pendulum(row: dict[str, float]) -> None:
    system = DrivenPendulum.scaled(row["q"], row["a"], 2.0 / 3.0)
    found = lyapunov(system, (0.2, 0.0), 6000.0, exponents=2, transient=1000.0)
    assert found.sum == pytest.approx(-1.0 / row["q"], abs=1e-9)
    combined = np.hypot(np.nan_to_num(found.standard_error[0], nan=2e-3), row["standard_error"])
    assert abs(found.exponents[0] - row["exponent"]) < 3.0 * max(combined, 1e-3)


def test_a_variation_that_friction_makes_shorter_does_not_vanish() -> None:
    """Alone it falls below all numbers, e^(−1500), where nothing makes it longer again."""
    (row,) = (each for each in STORED["driven"] if each["a"] == 0.9)
    system = DrivenPendulum.scaled(row["q"], row["a"], 2.0 / 3.0)
    found = lyapunov(system, (0.2, 0.0), 6000.0, transient=1000.0)
    assert abs(found.exponents[0] - row["exponent"]) < 3e-3
    assert np.isfinite(megno(system, (0.2, 0.0), [3000.0, 6000.0]).megno).all()


def test_friction_makes_volumes_shrink() -> None:
    system = DampedDoublePendulum.rods(viscous=(0.1, 0.1))
    assert lyapunov(system, WILD, 20.0, exponents=4).sum < -0.1


def test_a_transient_is_left_out() -> None:
    whole = megno(RODS, WILD, [50.0, 150.0])
    found = lyapunov(RODS, WILD, 100.0, transient=50.0)
    between = (whole.growth[1] - whole.growth[0]) / 100.0
    assert found.exponents[0] == pytest.approx(between, abs=1e-9)
    assert (found.t[0], found.t[-1]) == (50.0 + 0.25, 150.0)


# ---- the same bits ----


def test_states_are_those_of_solve() -> None:
    t = [1.0, 10.0, 40.0]
    for start in STARTS:
        plain = solve(RODS, start, t)
        assert np.array_equal(megno(RODS, start, t).states, plain.states)
        assert np.array_equal(tangent_map(RODS, start, t).states, plain.states)


@pytest.mark.parametrize("threads", [1, 2, 3])
def test_a_batch_has_the_bits_of_each_of_its_motions(threads: int) -> None:
    many = np.tile(STARTS, (5, 1))
    t = [5.0, 20.0]
    batch = megno(RODS, many, t, threads=threads)
    exponents = lyapunov(RODS, many, 20.0, exponents=4, threads=threads)
    angles = sali(RODS, many, t, threads=threads)
    for i, start in enumerate(many[:5]):
        one = megno(RODS, start, t)
        assert np.array_equal(batch.mean[i], one.mean)
        assert np.array_equal(batch.growth[i], one.growth)
        assert np.array_equal(batch.states[i + 15], one.states)
        assert np.array_equal(angles.value[i + 5], sali(RODS, start, t).value)
        alone = lyapunov(RODS, start, 20.0, exponents=4)
        assert np.array_equal(exponents.running[i + 10], alone.running)


# ---- wrong use ----


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: lyapunov(RODS, WILD, -1.0), "t_max must be positive [s], got -1.0"),
        (lambda: lyapunov(RODS, WILD, 1.0, exponents=5), "exponents must be a whole number"),
        (lambda: lyapunov(RODS, WILD, 1.0, transient=-1.0), "transient must be 0 or more [s]"),
        (lambda: lyapunov(RODS, WILD, 1.0, tangent=(1, 0)), "tangent must be of shape (1, 4)"),
        (lambda: lyapunov(RODS, WILD, 1.0).sum, "exponents must be 4 for their sum and pairs"),
        (lambda: lyapunov(RODS, (1.0, 2.0), 1.0), "state must be"),
        (lambda: gali(RODS, WILD, 1.0, 1), "k must be 2 directions or more, got 1"),
        (lambda: gali(RODS, WILD, 1.0, 5), "k must be a whole number from 1 to 4, got 5"),
        (lambda: sali(RODS, WILD, 1.0, tangents=[(1, 0, 0, 0)] * 2), "tangents must be indep"),
        (lambda: megno(RODS, [], 1.0), "state must be"),
        (lambda: megno(RODS, WILD, float("nan")), "t "),
        (lambda: megno(RODS, WILD, 1.0, threads=0), "threads must be a whole number from 1"),
        (lambda: megno(RODS, WILD, 1.0, tolerance=2.0), "tolerance must"),
    ],
)
def test_a_wrong_call_is_one_line(call: Any, message: str) -> None:
    assert message in told(call)
