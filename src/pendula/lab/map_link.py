"""The link of a saved map: the page computes the same rectangle of starts anew, ever finer."""

from __future__ import annotations

from typing import Any

from pendula._messages import ArgumentError
from pendula.lab.address import written
from pendula.lab.recipe import Recipe
from pendula.run.options import STANDARD_METHOD
from pendula.systems import system_from

TOLERANCE = 1e-8  # of all maps of the page


def map_link(path: str, known: dict[str, Any]) -> str:
    """The part of a link from the # on that shows what a map's description says.

    On the stage is the start in the middle of the rectangle.

    Args:
        path: of the map, for messages.
        known: its description.

    Raises:
        ArgumentError: for a map that the page has not.
    """
    quantity = "flip_time" if known["map"] == "flip" else known.get("indicator", known["map"])
    if quantity not in ("flip_time", "megno") or "theta1" not in known:
        rule = "{path} must hold a map of flips or of MEGNO to be shown in the laboratory"
        way_out = "use pendula show"
        raise ArgumentError("", f"{rule}, got one of {{value}}", way_out, path=path, value=quantity)
    ranges = {key: known[key] for key in ("theta1", "theta2")}
    recipe = Recipe(
        system=system_from(known["system"]),
        state=(*(0.5 * (low + high) for low, high in ranges.values()), 0.0, 0.0),
        t0=0.0,
        t_max=known["t_max"],
        every=None,
        method=STANDARD_METHOD,
        options={},
    )
    page = {f"map_{key}": ",".join(map(written, ends)) for key, ends in ranges.items()}
    page |= {"map_quantity": quantity, "map_t_max": written(known["t_max"])}
    return "&".join((recipe.link(), "view=map", *(f"{key}={text}" for key, text in page.items())))


def losses_of_map(known: dict[str, Any]) -> list[str]:
    """What of a map the page does not show: "rod", "tolerance"."""
    lost = ["rod"] if known.get("which") is not None else []
    return lost if known["tolerance"] == TOLERANCE else [*lost, "tolerance"]
