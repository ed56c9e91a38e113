"""Pictures of maps: what each cell looks like, the scale, the words, and how much is read."""

from __future__ import annotations

import json
import re
from typing import Any

import numpy as np
import pytest
import xarray as xr
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.text import Text
from xarray.backends import BackendArray
from xarray.core import indexing

from pendula import plot
from pendula.plot.grid import MOST
from pendula.plot.labels import LANGUAGES

NEVER, FORBIDDEN = to_rgb("#8fb8d8"), to_rgb("#f7f8f9")
DIMS = ("theta1", "theta2")


def centres(low: float, high: float, n: int) -> np.ndarray:
    half = np.arange(n) + 0.5
    return (low * half[::-1] + high * half) / n


def flips(n1: int = 60, n2: int = 40, turn: float = np.pi, **recipe: Any) -> xr.Dataset:
    """Like equal rods: forbidden about the rest, slower and slower toward it."""
    theta1, theta2 = centres(-turn, turn, n1), centres(-turn, turn, n2)
    height = 3 * np.cos(theta1)[:, None] + np.cos(theta2)
    time = 0.2 * np.exp(1.2 * (height + 4) / 2)
    time[(height > 1.2) | (theta1 < -3)[:, None]] = np.nan
    forbidden = height > 2
    resolved = forbidden | ~(height > 0.5)
    system = {
        "name": "double",
        "form": "rods",
        "parameters": {"l1": 4.0, "l2": 4.0, "gravity": 1.0},
    }
    return xr.Dataset(
        {
            "flip_time": (DIMS, time, {"units": "s"}),
            "flipped_rod": (DIMS, np.where(np.isnan(time), 0, 1).astype(np.int8)),
            "forbidden": (DIMS, forbidden),
            "resolved": (DIMS, resolved),
        },
        coords={
            "theta1": ("theta1", theta1, {"units": "rad"}),
            "theta2": ("theta2", theta2, {"units": "rad"}),
        },
        attrs={"t_max": 10.0, "pendula": json.dumps({"system": system, "which": None, **recipe})},
    )


def pixels(figure: Figure) -> np.ndarray:
    """The colours (n1, n2, 3) of the cells."""
    shown = figure.axes[0].get_images()[0].get_array()
    assert shown is not None
    return np.asarray(shown).transpose(1, 0, 2) / 255


def texts(figure: Figure) -> list[str]:
    figure.draw_without_rendering()
    return [t.get_text() for t in figure.findobj(Text) if isinstance(t, Text) and t.get_text()]


def test_each_cell_has_the_colour_of_what_is_known_of_it() -> None:
    data = flips()
    colours = pixels(plot.flip_map(data, unresolved="shown"))
    time, forbidden = data["flip_time"].values, data["forbidden"].values
    never = np.isnan(time) & ~forbidden
    assert never.any()
    assert colours[never] == pytest.approx(np.broadcast_to(NEVER, (never.sum(), 3)), abs=2e-3)
    assert colours[forbidden] == pytest.approx(
        np.broadcast_to(FORBIDDEN, (forbidden.sum(), 3)), abs=2e-3
    )
    flipped = ~np.isnan(time)
    brightness = colours.sum(axis=-1)[flipped]
    order = np.argsort(time[flipped])
    assert (np.diff(brightness[order][::20]) >= 0).all()  # late is light
    assert not (np.abs(colours[flipped] - NEVER).max(axis=-1) < 0.1).any()


def test_colours_are_logarithmic_in_time() -> None:
    """1 is the middle of 0.1 to 10 as of 0.01 to 100; 10 and 0.1 lie as far from it."""
    data = flips().assign(forbidden=flips()["forbidden"] & False)

    def colour(time: float, limits: tuple[float, float]) -> np.ndarray:
        same = data.assign(flip_time=xr.full_like(data["flip_time"], time))
        shown: np.ndarray = pixels(plot.flip_map(same, unresolved="shown", limits=limits))[0, 0]
        return shown

    np.testing.assert_allclose(colour(1.0, (0.1, 10.0)), colour(1.0, (0.01, 100.0)), atol=0.01)
    np.testing.assert_allclose(colour(10.0, (0.1, 1e3)), colour(1.0, (0.01, 100.0)), atol=0.01)
    assert colour(0.5, (0.1, 10.0)).sum() < colour(1.0, (0.1, 10.0)).sum() - 0.1


def test_cells_that_are_not_certain_are_paler() -> None:
    data = flips()
    plain, pale = (pixels(plot.flip_map(data, unresolved=u)) for u in ("shown", "pale"))
    certain = data["resolved"].values
    np.testing.assert_array_equal(plain[certain], pale[certain])
    unclear = ~certain
    assert unclear.any()
    np.testing.assert_allclose(pale[unclear], plain[unclear] * 0.45 + 0.55, atol=4e-3)
    assert "pale: time not verified" in texts(plot.flip_map(data))
    assert "pale: time not verified" not in texts(plot.flip_map(data, unresolved="shown"))


def test_a_map_that_does_not_tell_what_is_certain_has_no_paler_cells() -> None:
    data = flips().drop_vars("resolved")
    shown = plot.flip_map(flips(), unresolved="shown")
    np.testing.assert_array_equal(pixels(plot.flip_map(data)), pixels(shown))
    assert "pale: time not verified" not in texts(plot.flip_map(data))


def test_the_forbidden_region_is_hatched_up_to_the_edges() -> None:
    ax = plot.flip_map(flips()).axes[0]
    hatched = [each for each in ax.collections if any(getattr(each, "hatches", ()) or ())]
    assert len(hatched) == 1
    whole = flips(turn=0.3)
    ax = plot.flip_map(whole).axes[0]
    (region,) = (each for each in ax.collections if any(getattr(each, "hatches", ()) or ()))
    box = region.get_paths()[0].get_extents()
    assert (box.x0, box.x1) == pytest.approx(ax.get_xlim())
    assert (box.y0, box.y1) == pytest.approx(ax.get_ylim())


def test_the_axes_are_the_cells_outer_edges_with_equal_units() -> None:
    ax = plot.flip_map(flips()).axes[0]
    assert ax.get_xlim() == pytest.approx((-180, 180))
    assert ax.get_ylim() == pytest.approx((-180, 180))
    assert ax.get_aspect() == 1.0
    strip = flips().isel(theta1=slice(0, 3))
    assert plot.flip_map(strip).axes[0].get_aspect() == "auto"


def test_ticks_are_degrees_or_parts_of_pi() -> None:
    seen = texts(plot.flip_map(flips()))
    assert {"−180", "−90", "0", "90", "180", "angle θ₁ [°]", "angle θ₂ [°]"} <= set(seen)
    seen = texts(plot.flip_map(flips(), ticks="pi"))
    assert {"−π", "−π/2", "0", "π/2", "π", "angle θ₁ [rad]", "angle θ₂ [rad]"} <= set(seen)
    small = flips().assign_coords(theta1=centres(1.0, 1.01, 60))
    shown = [t for t in texts(plot.flip_map(small, ticks="pi")) if re.fullmatch(r"0\.3\d+π", t)]
    assert len(shown) >= 2


def test_times_in_natural_units() -> None:
    data = flips()
    bars = [plot.flip_map(data, time_unit=unit).axes[0].child_axes[0] for unit in ("s", "natural")]
    assert bars[0].get_ylabel() == "time until a rod flips [s]"
    assert bars[1].get_ylabel() == "time until a rod flips [√(l/g)]"
    seconds, natural = (np.array(bar.get_ylim()) for bar in bars)
    np.testing.assert_allclose(seconds, 2.0 * natural)
    assert "no flip until 10 s" in texts(plot.flip_map(data))
    assert "no flip until 5 √(l/g)" in texts(plot.flip_map(data, time_unit="natural"))
    del data.attrs["pendula"]
    with pytest.raises(ValueError, match='"natural" needs a dataset whose attribute "pendula"'):
        plot.flip_map(data, time_unit="natural")


def test_the_scale_names_the_rod() -> None:
    bar = plot.flip_map(flips(which=2)).axes[0].child_axes[0]
    assert bar.get_ylabel() == "time until rod 2 flips [s]"


@pytest.mark.parametrize("language", LANGUAGES)
def test_words_and_numbers_are_those_of_the_language(language: str) -> None:
    data = flips()
    data.attrs["t_max"] = 12.5
    seen = texts(plot.flip_map(data, language=language))
    wrong = {"en": r"\d,\d", "es": r"\d\.\d"}[language]
    assert not [text for text in seen if re.search(wrong, text)]
    words = {"en": "no flip until 12.5 s", "es": "sin vuelco hasta 12,5 s"}[language]
    assert words in seen
    figure = plot.flip_map(data, language=language)
    figure.draw_without_rendering()
    for text in figure.legends[0].get_texts():
        box = text.get_window_extent()
        assert figure.bbox.x0 <= box.x0
        assert box.x1 <= figure.bbox.x1 + 1


@pytest.mark.parametrize("kind", ["svg", "png", "pdf"])
def test_the_picture_is_the_same_each_time(kind: str) -> None:
    one, two = (plot.picture(plot.flip_map(flips()), kind) for _ in range(2))
    assert one == two


def test_a_map_in_a_vector_picture_is_one_image() -> None:
    picture = plot.svg(plot.flip_map(flips(300, 300)))
    assert picture.count(b"<image") == 2  # the map and its scale
    assert len(picture) < 400_000


class Counted(BackendArray):
    """A large array on a disk, say, that notes what is read of it."""

    def __init__(self, shape: tuple[int, ...], dtype: str) -> None:
        self.shape, self.dtype, self.most, self.all = shape, np.dtype(dtype), 0, 0

    def __getitem__(self, key: indexing.ExplicitIndexer) -> Any:
        return indexing.explicit_indexing_adapter(
            key, self.shape, indexing.IndexingSupport.BASIC, self._values
        )

    def _values(self, key: tuple[slice, ...]) -> np.ndarray:
        rows, columns = (np.arange(n)[k] for n, k in zip(self.shape, key, strict=True))
        self.most = max(self.most, rows.size * columns.size)
        self.all += rows.size * columns.size
        values = 1.0 + (rows[:, None] + columns) % 7
        return values.astype(self.dtype) if self.dtype.kind == "f" else values > 7


def test_of_a_large_map_only_a_band_is_read_at_once() -> None:
    shape = (10_000, 4_000)
    arrays = {
        name: Counted(shape, kind)
        for name, kind in (("flip_time", "f8"), ("forbidden", "?"), ("resolved", "?"))
    }
    data = xr.Dataset(
        {name: (DIMS, indexing.LazilyIndexedArray(a)) for name, a in arrays.items()},
        coords={d: (d, centres(-np.pi, np.pi, n)) for d, n in zip(DIMS, shape, strict=True)},
    )
    figure = plot.flip_map(data)
    for array in arrays.values():
        assert 0 < array.most <= 2**23
        assert array.all <= shape[0] * shape[1]
    shown = pixels(figure)
    assert shown.shape[:2] == (3333, 4000)
    assert max(shown.shape[:2]) <= MOST
    assert figure.axes[0].get_xlim() == pytest.approx((-180, 180))


@pytest.mark.parametrize(
    "spoil",
    [
        lambda d: d.assign(flip_time=d["flip_time"] * np.nan),
        lambda d: d.assign(forbidden=d["forbidden"] | True),
        lambda d: d.assign(flip_time=d["flip_time"] * 0 + 1.0),
        lambda d: d.isel(theta1=slice(5, 6), theta2=slice(5, 6)),
        lambda d: d.transpose("theta2", "theta1"),
        lambda d: d.assign_coords(theta1=2.3 + 1e-12 * np.arange(60)),
    ],
)
def test_any_map_can_be_drawn(spoil: Any) -> None:
    assert plot.picture(plot.flip_map(spoil(flips())), "png").startswith(b"\x89PNG")


def test_rows_and_columns_are_not_mixed_up() -> None:
    data = flips()
    again = pixels(plot.flip_map(data.transpose("theta2", "theta1")))
    np.testing.assert_array_equal(again, pixels(plot.flip_map(data)))
    figure = plot.flip_map(data)
    assert figure.axes[0].get_images()[0].origin == "lower"


def test_what_is_no_map_is_refused() -> None:
    with pytest.raises(ValueError, match="must hold flip_time over theta1 and theta2"):
        plot.flip_map(flips().drop_vars("flip_time"))
    with pytest.raises(ValueError, match="must hold forbidden over theta1 and theta2"):
        plot.flip_map(flips().assign(forbidden=("theta1", np.zeros(60, bool))))
    with pytest.raises(ValueError, match="rising cell centres"):
        plot.flip_map(flips().isel(theta1=slice(None, None, -1)))
    options: list[dict[str, Any]] = [{"ticks": "turns"}, {"unresolved": "grey"}, {"time_unit": "h"}]
    for wrong in options:
        with pytest.raises(ValueError, match=f"{next(iter(wrong))} must be one of"):
            plot.flip_map(flips(), **wrong)
    with pytest.raises(ValueError, match="limits must be two times"):
        plot.flip_map(flips(), limits=(2.0, 1.0))
