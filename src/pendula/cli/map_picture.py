"""The picture of a map: its options, and the map that a store or file holds."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pendula.cli.pictures import checked_picture, write_picture

if TYPE_CHECKING:
    import xarray as xr

_LOOK = ("colormap", "title", "ticks")  # as the functions of `pendula.plot` call them
_NARROW = 60  # characters of a map
_DARK = {"flip_time": "early", "growth": "slow", "sali": "chaos"}  # what is dark in one
_DARK |= dict.fromkeys(("megno", "lyapunov"), "order")


def look_options() -> list[click.Parameter]:
    """The options --colormap, --title and --ticks."""
    return [
        click.Option(
            ["--colormap"],
            metavar="NAME",
            help="colors of a map, as matplotlib names them [default: inferno]",
        ),
        click.Option(
            ["--title"],
            metavar="TEXT",
            help="title of the picture of a map [default: none; of an indicator the case]",
        ),
        click.Option(
            ["--ticks"],
            type=click.Choice(["degrees", "pi"]),
            help="angles of a map in degrees or parts of pi [default: degrees]",
        ),
    ]


def checked_map_picture(given: dict[str, Any]) -> Path | None:
    """The picture to draw; refuses before long work what cannot be drawn or written.

    Raises:
        ValueError: for an unknown ending or colormap, or a look without a picture.
        OSError: where it cannot be written, or exists without --force.
    """
    picture, look = checked_picture(given), look_of(given)
    if picture is None and look:
        raise ValueError(f"--{next(iter(look))} goes with --picture; name the picture")
    if "colormap" in look:
        from pendula.plot.map_drawing import palette

        palette(look["colormap"])
    return picture


def draw_map(found: xr.Dataset, picture: Path, given: dict[str, Any]) -> None:
    """Draw a map of either kind and write its picture."""
    from pendula import plot

    write_picture(plot.stored_map(found, language=given["lang"], **look_of(given)), picture, given)


def look_of(given: dict[str, Any]) -> dict[str, Any]:
    """The options of these that were given, as `pendula.plot` takes them."""
    return {name: given[name] for name in _LOOK if given[name] is not None}


def shaded(data: xr.Dataset) -> None:
    """The map in the terminal, where it can show it."""
    import numpy as np

    from pendula.cli.plots import shades
    from pendula.cli.tables import can_print

    if not can_print("█▓▒░"):
        return
    name = next(each for each in _DARK if each in data)
    first, second = axes_of(data)
    counts = [data.sizes[first], data.sizes[second]]
    few = [np.unique(np.linspace(0, n - 1, min(n, _NARROW)).round().astype(int)) for n in counts]
    picked = data[name].isel({first: few[0]}).isel({second: few[1]}).transpose(first, second)
    click.echo(f"\n{shades(picked.values.astype(float), width=_NARROW)}")
    click.echo(f"{first} to the right, {second} upward; dark: {_DARK[name]}, blank: none\n")


def axes_of(data: xr.Dataset) -> tuple[str, str]:
    """The axes of a map."""
    return ("theta2", "p2") if "p2" in data.dims else ("theta1", "theta2")
