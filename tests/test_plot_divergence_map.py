"""Pictures of divergence maps, and of maps as they are computed."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_rgb
from matplotlib.text import Text

from pendula import DoublePendulum, divergence_map, flip_map, plot


def test_a_map_of_divergence() -> None:
    rates = np.random.default_rng(2).uniform(-0.1, 2.0, (30, 20))
    rates[3:5, 7] = np.nan
    centres = {name: np.linspace(-3, 3, n) for name, n in (("theta1", 30), ("theta2", 20))}
    growth = xr.DataArray(np.exp(rates * 10.0), centres, ("theta1", "theta2"))
    figure = plot.divergence_map(xr.Dataset({"growth": growth}, attrs={"t_max": 10.0}))
    bar = figure.axes[0].child_axes[0]
    assert bar.get_ylabel() == "mean rate of divergence [1/s]"
    low, high = bar.get_ylim()
    assert (rates[~np.isnan(rates)] < low).mean() == pytest.approx(0.01, abs=0.002)
    assert high == pytest.approx(np.nanmax(rates))
    assert bar.get_yscale() == "linear"
    shown = figure.axes[0].get_images()[0].get_array()
    assert shown is not None
    colours = np.asarray(shown).transpose(1, 0, 2) / 255
    unknown = np.isnan(rates)
    assert colours[unknown] == pytest.approx(np.broadcast_to(to_rgb("#f7f8f9"), (2, 3)), abs=2e-3)
    brightness = colours[~unknown].sum(axis=-1)[np.argsort(rates[~unknown])]
    assert (np.diff(brightness[6::20]) > 0).all()  # fast is light
    with pytest.raises(ValueError, match="must hold growth"):
        plot.divergence_map(growth.to_dataset(name="divergence"))
    with pytest.raises(ValueError, match='must have the attribute "t_max"'):
        plot.divergence_map(xr.Dataset({"growth": growth}))


def test_real_maps_can_be_drawn() -> None:
    rods, whole = DoublePendulum.rods(), (-np.pi, np.pi)
    data = flip_map(rods, whole, whole, (30, 30), 10.0, which=2)
    figure = plot.flip_map(data, time_unit="natural")
    assert figure.axes[0].child_axes[0].get_ylabel() == "time until rod 2 flips [√(l/g)]"
    unit = np.sqrt(1.0 / rods.gravity)
    figure.draw_without_rendering()
    seen = [each.get_text() for each in figure.findobj(Text) if isinstance(each, Text)]
    assert f"no flip until {10.0 / unit:.4g} √(l/g)" in seen
    apart = divergence_map(rods, whole, whole, (30, 30), 10.0)
    bar = plot.divergence_map(apart).axes[0].child_axes[0]
    rates = np.log(apart.growth.values) / 10.0
    assert bar.get_ylim() == pytest.approx((np.sort(rates, axis=None)[9], rates.max()))
    assert {len(plot.picture(plot.flip_map(data), kind)) > 9000 for kind in ("png", "svg")} == {
        True
    }
