"""Shared by the commands that write a picture beside a file of numbers."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ENDINGS = (".png", ".svg", ".pdf")
_FEWEST, _MOST = 20, 4800  # dots an inch: a picture of 128 pixels, and one of 30 000


def file_and_picture(file: str, picture: str) -> list[click.Parameter]:
    """The options -o, --picture and --lang; their help ends with what is written."""
    return [
        click.Option(
            ["out", "-o", "--output"], type=click.Path(), metavar="FILE", help=f"write {file}"
        ),
        *picture_options(picture),
    ]


def picture_options(picture: str) -> list[click.Parameter]:
    """The options --picture, --dpi and --lang."""
    return [
        click.Option(
            ["--picture"],
            type=click.Path(),
            metavar="FILE",
            help=f"draw {picture}: .png, .svg or .pdf",
        ),
        click.Option(
            ["--dpi"],
            type=int,
            metavar="N",
            help="dots per inch of a .png [default: 200; of a map at least a pixel per cell]",
        ),
        language_option("the picture"),
    ]


def language_option(of: str) -> click.Option:
    """The option --lang."""
    return click.Option(
        ["--lang"],
        type=click.Choice(["en", "es"]),
        default="en",
        show_default=True,
        help=f"language of {of}",
    )


def checked_picture(given: dict[str, Any]) -> Path | None:
    """The picture to draw; refuses before long work what cannot be written.

    Raises:
        ValueError: for an unknown ending.
        OSError: where it cannot be written, or exists without --force.
    """
    from pendula._checks import installed
    from pendula._writing import refuse_existing

    if given["picture"] is None:
        if given["dpi"] is not None:
            raise ValueError("--dpi goes with --picture; name the picture")
        return None
    picture = Path(given["picture"])
    if picture.suffix.lower() not in ENDINGS:
        raise ValueError(f"--picture must end in one of {', '.join(ENDINGS)}, got {str(picture)!r}")
    _check_dpi(given["dpi"], picture)
    installed("matplotlib", "report")
    if given.get("resume") and picture.exists():  # --force would overwrite the store
        raise FileExistsError(f"{picture} exists; remove it, or name another")
    refuse_existing(picture, overwrite=given["force"])
    return picture


def _check_dpi(dpi: int | None, picture: Path) -> None:
    """Refuse dots that no picture, or not this one, can have."""
    if dpi is None:
        return
    if picture.suffix.lower() != ".png":
        raise ValueError(
            f"--dpi is for a .png, which has dots; {picture.name} has none: leave out --dpi"
        )
    if not _FEWEST <= dpi <= _MOST:
        raise ValueError(f"--dpi must be a whole number from {_FEWEST} to {_MOST}, got {dpi}")


def write_picture(figure: Figure, picture: Path, given: dict[str, Any]) -> None:
    """Write a complete picture, or nothing."""
    from pendula import plot
    from pendula._writing import replacing

    drawn = plot.picture(figure, picture.suffix[1:].lower(), given["dpi"])
    with replacing(picture, overwrite=given["force"]) as unfinished:
        unfinished.write_bytes(drawn)
