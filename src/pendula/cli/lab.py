"""`pendula lab`: the laboratory in the browser, with a run that a file or a link describes."""

from __future__ import annotations

import os
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pendula._messages import ArgumentError

if TYPE_CHECKING:
    from pendula.cli.shown import Held
    from pendula.lab.recipe import Recipe
    from pendula.lab.server import LabServer


_MEASURED = "#system=simple&t_max=10&view=data"


def _lab(**given: Any) -> None:
    from pendula.lab.server import LabServer

    fragment = "" if given["start"] is None else _fragment_of(given["start"])
    if given["export"] is not None:
        _export(fragment, given)
        return
    with LabServer(given["port"]) as server:
        click.echo(f"{server.url}{fragment}")
        click.echo("Ctrl-C ends the laboratory", err=True)
        _serve(server, f"{server.url}{fragment}", open_it=not given["no_browser"])


def _fragment_of(start: str) -> str:
    """The recipe of a file or a link, from the # on."""
    from pendula.lab.address import is_link
    from pendula.lab.map_link import losses_of_map, map_link
    from pendula.lab.recipe import read_link

    if is_link(start):
        _check_shown(read_link(start), start)
        return f"#{start.strip().partition('#')[2]}"
    found = _held(start)
    if found.kind == "map":
        link, lost = map_link(start, found.known), losses_of_map(found.known)
    elif found.kind == "trajectory":
        link, lost = _link_of_run(start)
    else:
        rule = f"{start} must hold a trajectory or a map to be shown in the laboratory"
        raise ValueError(f"{rule}, got a file of the kind {found.kind!r}; use pendula show")
    read_link(link)
    if lost:
        click.echo(f"{start}: shown without its {' and '.join(lost)}", err=True)
    return link


def _held(start: str) -> Held:
    """What a file holds; a table of measured motion has another way onto the page."""
    from pendula.cli.shown import held

    try:
        return held(start)
    except ValueError as error:
        if not Path(start).is_file() or Path(start).suffix == ".json":
            raise
        way_out = (
            f"open pendula lab '{_MEASURED}' and drop a text table of measured motion there, "
            f"or use pendula fit {shlex.quote(start)}"
        )
        raise ValueError(f"{start} was not written by pendula; {way_out}") from error


def _link_of_run(start: str) -> tuple[str, list[str]]:
    """The link of a saved run, and what it does not hold."""
    from pendula.io import load
    from pendula.lab.recipe import Recipe, losses

    run = load(start)
    recipe = Recipe.of(run)
    _check_shown(recipe, start)
    return recipe.link(), losses(run)


def _check_shown(recipe: Recipe, start: str) -> None:
    """Refuse what the page, which computes in doubles, would show otherwise than the run is."""
    if "digits" in recipe.options:
        rule = "digits = {value} is not kept by the page, which computes in doubles"
        way_out = "use pendula rerun {start}"
        raise ArgumentError("", rule, way_out, value=recipe.options["digits"], start=start)


def _export(fragment: str, given: dict[str, Any]) -> None:
    from pendula.lab.export import export

    if given["port"] is not None:
        raise click.UsageError("--port goes with a server, not with --export")
    start = export(given["export"], overwrite=given["force"])
    click.echo(f"{start}{fragment}")


def _serve(server: LabServer, url: str, *, open_it: bool) -> None:
    """Answer until Ctrl-C."""
    import webbrowser

    if open_it and _has_windows():
        webbrowser.open(url)  # the socket listens: what is asked for at once waits
    server.serve_forever()


def _has_windows() -> bool:
    """Whether a browser has a window to open; elsewhere one in text would take the terminal."""
    if sys.platform in ("darwin", "win32"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


command = click.Command(
    "lab",
    params=[
        click.Argument(["start"], required=False, metavar="[FILE|LINK]"),
        click.Option(
            ["--port"], type=int, metavar="N", help="port to listen on [default: 8642, or any]"
        ),
        click.Option(["--no-browser"], is_flag=True, help="print the address, open no browser"),
        click.Option(
            ["--export"],
            type=click.Path(),
            metavar="PATH",
            help="write the page instead: one file (.html), or a folder for any server",
        ),
        click.Option(["--force"], is_flag=True, help="replace what --export wrote before"),
    ],
    callback=_lab,
    help="Open the laboratory in the browser, with the run of a FILE or a LINK where one is named.",
)
