"""What `pendula chaos` writes and prints: a table, a summary, a file of rows, a picture."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from pendula.cli.pictures import checked_picture, file_and_picture, write_picture
from pendula.cli.tables import paragraph

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    Targets = tuple[Path | None, Path | None]


def output_options(file: str, picture: str) -> list[click.Parameter]:
    """The options -o, --picture, --dpi, --lang and --force."""
    return [
        *file_and_picture(f"{file} to a .csv or .json file", picture),
        click.Option(["--force"], is_flag=True, help="replace the files if they exist"),
    ]


def check_targets(given: dict[str, Any]) -> Targets:
    """The files to write; refuses before long work what cannot be written.

    Raises:
        ValueError: for an unknown ending.
        OSError: where one cannot be written, or exists without --force.
    """
    from pendula.io.rows import check_rows_target

    out = None if given["out"] is None else Path(given["out"])
    if out is not None:
        check_rows_target(out, overwrite=given["force"])
    return out, checked_picture(given)


def deliver(
    given: dict[str, Any],
    targets: Targets,
    found: Any,
    columns: Mapping[str, Sequence[Any]],
    printed: str,
    told: str,
    **drawing: Any,
) -> None:
    """Draw first, so that a picture that fails leaves no data behind; then write, then print.

    Args:
        given: the options of the command.
        targets: the files to write, as `check_targets` gave them.
        found: what is drawn, and described in the file.
        columns: of the file.
        printed: the table on the terminal.
        told: the summary below it.
        **drawing: further arguments of the picture.
    """
    from pendula._attributes import KEY
    from pendula._version import __version__
    from pendula.io.rows import write_rows

    out, picture = targets
    if picture is not None:
        write_picture(_drawn(found, given["lang"], drawing), picture, given)
    if out is not None:
        measure = type(found).__name__
        system = (found.orbits[0] if hasattr(found, "orbits") else found).system
        attributes = {KEY: __version__, "chaos": measure, "system": system.description()}
        for name in ("start", "state"):
            if hasattr(found, name):
                attributes["state"] = getattr(found, name).tolist()
        write_rows(columns, attributes, out, overwrite=given["force"])
    click.echo(printed)
    click.echo(paragraph(told))
    for path in filter(None, targets):
        click.echo(path)


def _drawn(found: Any, language: str, drawing: dict[str, Any]) -> Any:
    """The picture of a result, by its class."""
    from pendula import plot

    drawers: dict[str, Any] = {
        "Bifurcation": plot.bifurcation,
        "Family": plot.family,
        "PeriodicOrbit": plot.periodic_orbit,
        "Section": plot.section,
    }
    return drawers.get(type(found).__name__, plot.running)(found, language=language, **drawing)
