"""Groups of subcommands: of the command itself, and one for each system of the catalogue."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from pendula import _engine

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from pendula._engine import Capabilities, SystemEntry


class ChoiceGroup(click.Group):
    """A group that lists its subcommands where another, or none, is named."""

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


class _SystemCommand(click.Command):
    """A command whose values are quantities: a word too many likely follows a space in one."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Refuse words that belong to no option."""
        ctx.allow_extra_args = True
        rest = super().parse_args(ctx, args)
        if rest:
            words = f"unexpected extra argument{'s' if len(rest) > 1 else ''} ({' '.join(rest)})"
            ctx.fail(f"{words}; a value with spaces needs quotes: '50 cm'")
        return rest


def one_each(
    name: str,
    help: str,
    entries: Iterable[SystemEntry],
    options: Callable[[SystemEntry], list[click.Parameter]],
    callback: Callable[..., None],
    kind: type[ChoiceGroup] = ChoiceGroup,
) -> ChoiceGroup:
    """A group with a subcommand for each system; `callback` is given the system's entry first."""
    group = kind(name, kind="system", help=help)
    for entry in entries:

        def call(entry: SystemEntry = entry, **given: Any) -> None:
            callback(entry, **given)

        forms = ", ".join(form.meaning for form in entry.forms)
        command = _SystemCommand(
            entry.name,
            params=options(entry),
            callback=call,
            help=f"{help} The {entry.name} pendulum: {forms}.",
            short_help=f"the {entry.name} pendulum: {forms}",
        )
        group.add_command(command)
    return group


def systems_that(can: Callable[[Capabilities], bool] = lambda _: True) -> list[SystemEntry]:
    """The catalogue's systems with a capability; all, if none is named."""
    return [entry for entry in _engine.system_entries().values() if can(entry.can)]
