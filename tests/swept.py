"""A small sweep."""

from __future__ import annotations

from pathlib import Path

import xarray as xr

from pendula.sweeping import SweepRecipe, read_sweep

RODS = """
[system]
kind = "double"
l1 = { log_uniform = ["10 cm", "1 m"] }
[state]
theta1 = { uniform = ["-180 deg", "180 deg"] }
omega2 = { choice = ["0 rad/s", "1 rad/s"] }
[run]
t_max = "2 s"
every = "0.3 s"
tolerance = 1e-10
draws = 20
chunk = 7
"""


def recipe(folder: Path, text: str) -> SweepRecipe:
    path = folder / "recipe.toml"
    path.write_text(text, encoding="utf-8")
    return read_sweep(path)


def bits(dataset: xr.Dataset, *but: str) -> dict[str, bytes]:
    return {str(name): each.values.tobytes() for name, each in dataset.drop_vars(but).items()}
