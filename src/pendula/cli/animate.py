"""`pendula animate`: files of trajectories, or a new run, as a moving picture."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.shell_completion import CompletionItem

from pendula import _engine
from pendula.cli.groups import ChoiceGroup, MethodChoice, one_each
from pendula.cli.options import (
    run_options,
    run_options_of,
    start_of,
    start_options,
    system_of,
    system_options,
    value,
)
from pendula.cli.pictures import language_option
from pendula.cli.progress import late_bar, work_bar
from pendula.cli.run import seconds, start_time
from pendula.run._times import span_of
from pendula.run.options import STANDARD_METHOD
from pendula.systems import systems_that

if TYPE_CHECKING:
    from pendula._engine import SystemEntry
    from pendula.run.trajectory import Trajectory

_FILES = "files"
_SIZE = "720x600"


class _FilesOrSystem(ChoiceGroup):
    """A group that takes its arguments for files where they do not begin with a system."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Send files to the subcommand for them."""
        if ctx.resilient_parsing and not args:  # as a shell's completion parses
            return super().parse_args(ctx, args)
        systems = [name for name in self.commands if name != _FILES]
        if not args:
            ctx.fail(f"name a file of a trajectory, or a system: {', '.join(systems)}")
        first = args[0]
        if first in self.commands or first in ctx.help_option_names:
            return super().parse_args(ctx, args)
        if not first.startswith("-") and not Path(first).suffix and not Path(first).exists():
            ctx.fail(f"no file and no system {first!r}; the systems are {', '.join(systems)}")
        return super().parse_args(ctx, [_FILES, *args])

    def shell_complete(self, ctx: click.Context, incomplete: str) -> list[CompletionItem]:
        """The systems; files where none begins so."""
        found = super().shell_complete(ctx, incomplete)
        return found or [CompletionItem(incomplete, type="file")]


def _picture_options() -> list[click.Parameter]:
    return [
        click.Option(
            ["out", "-o", "--output"],
            type=click.Path(),
            metavar="FILE",
            required=True,
            help="write a .gif, .mp4, .webm or .html file",
        ),
        click.Option(
            ["--speed"], type=float, default=1.0, show_default=True, help="1: true time; 0.5: half"
        ),
        click.Option(
            ["--fps"], type=int, metavar="N", help="frames per second [default: 25 (.gif), 30]"
        ),
        value("trail", "duration of the path behind the bob [default: 1 s]"),
        click.Option(["--no-energy"], is_flag=True, help="leave out the energy bars"),
        click.Option(
            ["--size"],
            metavar="WxH",
            default=_SIZE,
            show_default=True,
            help="width and height in pixels",
        ),
        language_option("the words in it"),
        click.Option(["--force"], is_flag=True, help="replace the file if it exists"),
    ]


def _options(entry: SystemEntry) -> list[click.Parameter]:
    return [
        *system_options(entry),
        *start_options(entry),
        start_time(),
        value("t_max", "end time", required=True),
        click.Option(
            ["--method"],
            type=MethodChoice(),
            metavar="NAME",
            multiple=True,
            help="see `pendula methods`; may be repeated, to overlay them [default: taylor]",
        ),
        *run_options("step", "tolerance", "max_steps"),
        *_picture_options(),
    ]


def _of_system(entry: SystemEntry, **given: Any) -> None:
    from pendula.run.request import checked_name
    from pendula.run.solve import solve

    check = _checked(given)
    system, start = system_of(entry, given), start_of(entry, given)
    t0, t_max = seconds(given, "t0"), seconds(given, "t_max")
    span_of(t0, t_max)
    options, runs = run_options_of(given), []
    methods = given["method"] or (STANDARD_METHOD,)
    for method in map(checked_name, methods):
        own = _taken(options, method) if len(methods) > 1 else options
        with late_bar(method) as progress:
            runs.append(solve(system, start, t_max, method, t0=t0, progress=progress, **own))
    _animate(runs, None, given, **check)


def _of_files(**given: Any) -> None:
    from pendula.io import load

    check = _checked(given)
    files = given["files"]
    names = [Path(each).stem for each in files] if len(files) > 1 else None
    runs = [load(each) for each in files]
    if any(run.states.ndim != 2 for run in runs):
        names = None
    _animate(runs, names, given, **check)


def _checked(given: dict[str, Any]) -> dict[str, Any]:
    """The options of the picture; refuses before long work what cannot be written."""
    from pendula._writing import refuse_existing
    from pendula.plot.animation import ending_of

    ending_of(given["out"])
    refuse_existing(Path(given["out"]), overwrite=given["force"])
    options = {"trail": seconds(given, "trail", 1.0), "size": _size(given["size"])}
    return {**options, "energy": not given["no_energy"], "language": given["lang"]}


def _animate(
    runs: list[Trajectory], names: list[str] | None, given: dict[str, Any], **options: Any
) -> None:
    from pendula.plot.animation import animate, count_frames

    how = {"speed": given["speed"], "fps": given["fps"]}
    count = count_frames(runs, given["out"], **how)
    with work_bar("animation", count, "frames") as progress:
        animate(
            runs,
            given["out"],
            names=names,
            overwrite=given["force"],
            progress=progress,
            **how,
            **options,
        )
    click.echo(f"{given['out']}: {count} frames")


def _taken(options: dict[str, Any], method: str) -> dict[str, Any]:
    """Of the options of several methods those that one of them takes."""
    other = "step" if _engine.method_named(method).adaptive else "tolerance"
    return {name: each for name, each in options.items() if name != other}


def _size(text: str) -> tuple[int, int]:
    """Width and height.

    Raises:
        ValueError: for anything but two whole numbers.
    """
    width, _, height = text.partition("x")
    if not (width.isdigit() and height.isdigit()):
        raise ValueError(f"--size must be width x height such as {_SIZE}, got {text!r}")
    return int(width), int(height)


def _command() -> ChoiceGroup:
    about = "Animate trajectories: FILES that were saved, or a new run."
    group = one_each("animate", about, systems_that(), _options, _of_system, kind=_FilesOrSystem)
    group.subcommand_metavar = "FILE…|SYSTEM [OPTIONS]"
    files = click.Command(
        _FILES,
        params=[
            click.Argument(["files"], nargs=-1, required=True, type=click.Path(), metavar="FILE…"),
            *_picture_options(),
        ],
        callback=_of_files,
        help="Animate saved trajectories, over one another if there are several.",
        short_help="FILE…: saved trajectories (the word `files` may be left out)",
    )
    group.add_command(files)
    return group


command = _command()
