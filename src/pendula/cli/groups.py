"""Groups of subcommands: of the command itself, and one for each system of the catalogue."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from pendula import _engine

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from pendula._engine import SystemEntry


class ChoiceGroup(click.Group):
    """A group that lists its subcommands to whoever names another, or none."""

    def __init__(self, name: str, *, kind: str, **options: Any) -> None:
        super().__init__(name, subcommand_metavar=f"{kind.upper()} [OPTIONS]", **options)
        self.kind = kind

    def list_commands(self, ctx: click.Context) -> list[str]:
        """The names in the order in which they were added."""
        return list(self.commands)

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Refuse an empty line."""
        if not args:
            ctx.fail(f"name a {self.kind}: {', '.join(self.commands)}")
        return super().parse_args(ctx, args)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Refuse an unknown name."""
        if args[0] not in self.commands:
            ctx.fail(f"no {self.kind} {args[0]!r}; take one of {', '.join(self.commands)}")
        return super().resolve_command(ctx, args)


def one_each(
    name: str,
    help: str,
    entries: Iterable[SystemEntry],
    options: Callable[[SystemEntry], list[click.Parameter]],
    callback: Callable[..., None],
) -> ChoiceGroup:
    """A group with a subcommand for each system; `callback` is given the system's entry first."""
    group = ChoiceGroup(name, kind="system", help=help)
    for entry in entries:

        def call(entry: SystemEntry = entry, **given: Any) -> None:
            callback(entry, **given)

        forms = ", ".join(form.meaning for form in entry.forms)
        told = f"{help} The {entry.name} pendulum: {forms}."
        command = click.Command(entry.name, params=options(entry), callback=call, help=told)
        command.short_help = f"the {entry.name} pendulum: {forms}"
        group.add_command(command)
    return group


def all_systems() -> list[SystemEntry]:
    """The catalogue's systems."""
    return list(_engine.system_entries().values())


def one_angle() -> list[SystemEntry]:
    """The systems with one angle: those with a closed form and a period."""
    return [entry for entry in all_systems() if len(entry.components) == 2]
