"""`pendula map`: one number for each release, or for each point of an energy's Poincaré section."""

from __future__ import annotations

import re
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pendula.cli.groups import ChoiceGroup, one_each
from pendula.cli.map_output import check_targets, summary, write
from pendula.cli.map_picture import look_options
from pendula.cli.options import (
    range_of,
    run_options,
    run_options_of,
    system_of,
    system_options,
    value,
)
from pendula.cli.pictures import file_and_picture
from pendula.cli.progress import work_bar
from pendula.cli.run import seconds
from pendula.cli.stores import check_store_options, cluster, store_options, telling_how_to_resume
from pendula.cli.tables import paragraph
from pendula.systems import systems_that

if TYPE_CHECKING:
    from collections.abc import Iterator

    from pendula._engine import SystemEntry

_TURN, _SIZE = "-180deg:180deg", "500x500"
_ANGLES = ("theta1", "theta2")
_SECTION = {"theta2": ("rad", _TURN), "p2": ("J s", "-1:1")}  # unit and example of each axis
INDICATORS = {
    "megno": "MEGNO, the mean exponential growth of nearby orbits",
    "lyapunov": "the finite-time Lyapunov exponent",
    "sali": "SALI, the smaller alignment index",
}
_WITHOUT = (
    "a map is made over the angles of two rods, which the {system} pendulum does not have; "
    "use pendula map flip double, or pendula sweep for many starts of the {system} pendulum"
)


def _options(entry: SystemEntry) -> list[click.Parameter]:
    ranges = [
        click.Option(
            [f"--{name}"],
            metavar="LO:HI",
            default=_TURN,
            show_default=True,
            help=f"range of the initial angle of rod {i}",
        )
        for i, name in enumerate(_ANGLES, 1)
    ]
    return [*system_options(entry), *ranges, _size_option("along each angle")]


def _size_option(along: str) -> click.Option:
    return click.Option(
        ["--size"],
        metavar="N1xN2",
        default=_SIZE,
        show_default=True,
        help=f"cells {along}; one number for a square grid",
    )


def _flip_options(entry: SystemEntry) -> list[click.Parameter]:
    return [
        *_options(entry),
        value("t_max", "time limit for a flip, e.g. 30s", required=True),
        click.Option(
            ["--which"], type=int, metavar="ROD", help="rod 1 or 2 [default: whichever flips first]"
        ),
        *run_options("tolerance", otherwise="default: 1e-8"),
        click.Option(
            ["--no-resolve"],
            is_flag=True,
            help="skip the second run that verifies the time of each cell: half the work",
        ),
        *_output_options(),
    ]


def _divergence_options(entry: SystemEntry) -> list[click.Parameter]:
    return [
        *_options(entry),
        value("t_max", "time at which neighbours are compared", required=True),
        value("separation", "initial separation of the neighbours [default: 1e-8 rad]"),
        *run_options("tolerance"),
        *_output_options(),
    ]


def _indicator_options(entry: SystemEntry) -> list[click.Parameter]:
    return [
        *_options(entry),
        value("t_max", "length of the runs", required=True),
        *run_options("tolerance"),
        *_output_options(),
    ]


def _section_options(entry: SystemEntry) -> list[click.Parameter]:
    whole = "[default: all that the energy allows]"
    return [
        *system_options(entry),
        value("energy", "energy of all starts, e.g. 10J", required=True),
        click.Option(
            ["--indicator"],
            type=click.Choice(list(INDICATORS)),
            default="megno",
            show_default=True,
            help="what is mapped",
        ),
        click.Option(["--theta2"], metavar="LO:HI", help=f"range of the angle of rod 2 {whole}"),
        click.Option(["--p2"], metavar="LO:HI", help=f"range of its momentum, J s {whole}"),
        _size_option("along the angle and the momentum"),
        value("t_max", "length of the runs", required=True),
        *run_options("tolerance"),
        *_output_options(),
    ]


def _output_options() -> list[click.Parameter]:
    file = "a resumable .zarr store or a .nc file"
    return [*file_and_picture(file, "the map"), *look_options(), *store_options()]


def _map(kind: str, entry: SystemEntry, **given: Any) -> None:
    check_store_options(given)
    with telling_how_to_resume(given):
        _compute(kind, entry, given)


def _compute(kind: str, entry: SystemEntry, given: dict[str, Any]) -> None:
    from pendula.many import maps

    out, picture = check_targets(given)
    asked = _section_asked(entry, given) if kind == "section" else _asked(kind, entry, given)
    name = "indicator" if kind in INDICATORS else kind
    kinds: dict[str, Any] = {
        "flip": maps.FlipMap,
        "divergence": maps.DivergenceMap,
        "indicator": maps.IndicatorMap,
        "section": maps.SectionMap,
    }
    kinds[name].checked(**asked)  # refused before a cluster is waited for
    cells = asked["shape"][0] * asked["shape"][1]
    store = out if out is not None and Path(out).suffix == ".zarr" else None
    with (
        cluster(given["scheduler"]) as client,
        _enough_memory(),
        work_bar(f"{kind} map", cells, "cells") as progress,
    ):
        found = getattr(maps, f"{name}_map")(
            **asked,
            store=store,
            client=client,
            threads=given["threads"],
            progress=progress,
            resume=given["resume"],
            overwrite=given["force"],
        )
        write(found, None if store else out, picture, given)
        cells_found = summary(found)
    click.echo(paragraph(f"{out}: {cells_found}" if out else cells_found))
    if picture:
        click.echo(picture)


def _asked(kind: str, entry: SystemEntry, given: dict[str, Any]) -> dict[str, Any]:
    """The arguments of a map over two angles."""
    return {
        **_shared(entry, given),
        **{name: range_of(given[name], name, "rad", _TURN) for name in _ANGLES},
        **({"indicator": kind} if kind in INDICATORS else _OWN[kind](given)),
    }


def _section_asked(entry: SystemEntry, given: dict[str, Any]) -> dict[str, Any]:
    """The arguments of a map over a section."""
    from pendula.units import quantity

    ranges = {
        name: range_of(given[name], name, unit, example)
        for name, (unit, example) in _SECTION.items()
        if given[name] is not None
    }
    energy = quantity(given["energy"], "J", "energy")
    return {**_shared(entry, given), **ranges, "energy": energy, "indicator": given["indicator"]}


def _shared(entry: SystemEntry, given: dict[str, Any]) -> dict[str, Any]:
    """The arguments that all maps take."""
    return {
        "system": system_of(entry, given),
        "shape": _size(given["size"]),
        "t_max": seconds(given, "t_max"),
        **run_options_of(given),
    }


def _of_flips(given: dict[str, Any]) -> dict[str, Any]:
    return {"which": given["which"], "resolve": not given["no_resolve"]}


def _of_divergence(given: dict[str, Any]) -> dict[str, Any]:
    from pendula.units import quantity

    if given["separation"] is None:
        return {}
    return {"separation": quantity(given["separation"], "rad", "separation")}


_OWN = {"flip": _of_flips, "divergence": _of_divergence}


def _size(text: str) -> tuple[int, int]:
    """Cells along each angle.

    Raises:
        ValueError: for anything but one or two whole numbers.
    """
    found = re.fullmatch(r"(\d{1,9})(?:[x×](\d{1,9}))?", text.strip())
    if found is None:
        raise ValueError(f"--size must be cells such as {_SIZE}, or 500 for a square, got {text!r}")
    return int(found[1]), int(found[2] or found[1])


@contextmanager
def _enough_memory() -> Iterator[None]:
    try:
        yield
    except MemoryError:
        raise click.ClickException(
            "not enough memory for so many cells; write them to a store: -o map.zarr"
        ) from None


def _command() -> ChoiceGroup:
    """A group with a subcommand for each kind of map, and in it one for the double pendulum."""
    group = ChoiceGroup(
        "map",
        kind="map",
        help="Map releases from rest over the two initial angles, or the section of an energy.",
    )
    helps = {
        "flip": "Map the time until a rod first flips.",
        "divergence": "Map how far neighbouring motions have separated after a given time.",
        **{name: f"Map {meaning}." for name, meaning in INDICATORS.items()},
        "section": "Map an indicator of chaos over an energy's Poincaré section.",
    }
    options: dict[str, Any] = {
        "flip": _flip_options,
        "divergence": _divergence_options,
        **dict.fromkeys(INDICATORS, _indicator_options),
        "section": _section_options,
    }
    for kind, help in helps.items():
        systems = systems_that(lambda can: can.mapped)
        call = partial(_map, kind)
        group.add_command(one_each(kind, help, systems, options[kind], call, without=_WITHOUT))
    return group


command = _command()
