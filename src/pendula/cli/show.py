"""`pendula show`: the picture of a stored map, without computing it again."""

from __future__ import annotations

from typing import Any

import click

from pendula.cli.map_picture import checked_map_picture, draw_map, look_options
from pendula.cli.pictures import picture_options


def _show(store: str, **given: Any) -> None:
    from pendula.many.maps import open_map

    picture = checked_map_picture(given)
    if picture is None:
        raise click.UsageError("name the picture: --picture map.png")
    with open_map(store) as found:
        draw_map(found, picture, given)
    click.echo(picture)


command = click.Command(
    "show",
    params=[
        click.Argument(["store"], metavar="STORE"),
        *picture_options("the map"),
        *look_options(),
        click.Option(["--force"], is_flag=True, help="overwrite existing files"),
    ],
    callback=_show,
    help="Draw the map in a .zarr STORE or a .nc file that `pendula map` wrote.",
    short_help="Draw a stored map.",
)
