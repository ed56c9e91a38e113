"""Which model describes a recording: real swings, and simulated ones in air and in liquids."""

from __future__ import annotations

import numpy as np
import pytest

from pendula.measured import Measurement, compare_models
from pendula.measured.compare import preferred_of
from simulated import clean, correlated, of_angle
from test_fit import long_swing, small_swing, video_runs

NESTED = [
    ("undamped", "viscous"),
    ("undamped", "coulomb"),
    ("viscous", "viscous + coulomb"),
    ("viscous", "viscous + quadratic"),
    ("coulomb", "viscous + coulomb"),
    ("coulomb", "coulomb + quadratic"),
    ("quadratic", "coulomb + quadratic"),
    ("viscous + coulomb", "viscous + coulomb + quadratic"),
    ("viscous + quadratic", "viscous + coulomb + quadratic"),
    ("coulomb + quadratic", "viscous + coulomb + quadratic"),
    ("viscous + coulomb", "viscous + coulomb + cubic"),
    ("linear", "linear + viscous"),
]


def noisy(made: Measurement, size: float, seed: int = 5) -> Measurement:
    """The swing with noise whose neighbours are alike."""
    noise = correlated(np.random.default_rng(seed), len(made.t), 0.8)
    return of_angle(made.t, made.values[:, 0] + size * noise)


def test_real_swings_in_air_are_viscous() -> None:
    for run in video_runs():
        found = compare_models(run)
        assert found.preferred == "viscous"
        assert found["undamped"].bic > 50.0
        assert "damped" in found["undamped"].fit.flags


def test_the_small_swing_is_dry_friction() -> None:
    found = compare_models(small_swing())
    assert found.preferred == found.dominant == "coulomb"
    assert found["viscous"].bic > 100.0
    assert found.linear_enough
    assert "dry friction" in found.verdict()
    assert "rozamiento seco" in found.verdict("es")


def test_a_larger_model_never_fits_worse_among_those_compared() -> None:
    for made in (long_swing(), small_swing(), video_runs()[2]):
        found = compare_models(made)
        for small, large in NESTED:
            assert found[large].rms <= found[small].rms * (1 + 1e-6), (small, large)


def test_the_long_swing_loses_most_to_dry_friction() -> None:
    found = compare_models(long_swing(20))
    assert found.dominant == "coulomb"
    assert not found.linear_enough
    assert not found["viscous + quadratic"].admitted  # its drag ended at zero
    assert found["viscous + quadratic"].fit.at_bounds == ("quadratic",)
    assert 150 < found.n_effective < 300


@pytest.mark.parametrize("seed", range(4))
def test_liquids_are_viscous_and_quadratic(seed: int) -> None:
    made = clean(seconds=12.0, start=(0.9, 0.0), viscous=0.15, quadratic=0.2, noise=0.0)
    found = compare_models(noisy(made, 2e-3, seed))
    assert found.preferred == "viscous + quadratic"


@pytest.mark.parametrize("seed", range(4))
def test_air_is_viscous_and_still_water_of_dry_friction_is_not_taken_for_it(seed: int) -> None:
    air = clean(seconds=30.0, viscous=0.05, noise=0.0)
    assert compare_models(noisy(air, 2e-3, seed)).preferred == "viscous"
    dry = clean(seconds=30.0, coulomb=0.03, noise=0.0)
    assert compare_models(noisy(dry, 2e-3, seed)).preferred == "coulomb"
    none = clean(seconds=30.0, noise=0.0)
    assert compare_models(noisy(none, 2e-3, seed)).preferred == "undamped"


def test_shares_of_energy_are_those_lost() -> None:
    made = clean(seconds=20.0, viscous=0.05, coulomb=0.05, noise=1e-4)
    found = compare_models(made)
    run = found.best.trajectory
    speed = np.abs(run.omega)
    lost = run.energy[0] - run.energy[-1]
    viscous = found.best["viscous"].value * np.trapezoid(speed**2, made.t) / lost
    assert found.preferred == "viscous + coulomb"
    assert found.shares["viscous"] == pytest.approx(viscous, rel=2e-3)


def test_the_table_has_a_row_a_model() -> None:
    models = ("viscous", "viscous + coulomb", "linear + viscous", "viscous")
    found = compare_models(clean(viscous=0.05), models, length=0.8)
    table = found.to_pandas()
    assert list(table.index) == ["viscous", "viscous + coulomb", "linear + viscous"]
    assert table["bic"].min() == 0.0
    assert "gravity" in found.best.derived
    with pytest.raises(ValueError, match="models must be one of undamped"):
        compare_models(clean(), ["glue"])


def test_drag_is_not_preferred_without_its_viscous_part_where_both_are_better() -> None:
    made = compare_models(clean(viscous=0.05), ["viscous", "quadratic", "viscous + quadratic"])
    rows = [
        row._replace(bic=bic, rms=rms, admitted=True)
        for row, bic, rms in zip(made.rows, (90.0, 5.0, 0.0), (2.0, 1.0, 1.0), strict=True)
    ]
    assert preferred_of(rows).model == "viscous + quadratic"
    rows[0] = rows[0]._replace(bic=5.0)
    assert preferred_of(rows).model == "viscous"
