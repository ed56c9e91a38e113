"""Groups of subcommands: of the command itself, and one for each system of the catalogue."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from pendula import _engine
from pendula._messages import meant

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from pendula._engine import SystemEntry


class ChoiceGroup(click.Group):
    """A group that lists its subcommands where another, or none, is named.

    Args:
        name: of the command.
        kind: what its subcommands are: "system".
        lacking: names that could be expected to be subcommands, and why they are none.
        **options: of click's group.
    """

    def __init__(
        self, name: str, *, kind: str, lacking: Mapping[str, str] | None = None, **options: Any
    ) -> None:
        super().__init__(name, subcommand_metavar=f"{kind.upper()} [OPTIONS]", **options)
        self.kind, self._lacking = kind, lacking or {}

    def list_commands(self, ctx: click.Context) -> list[str]:
        """The names in the order in which they were added."""
        return list(self.commands)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """The subcommands with the whole of what they do, where click would cut the line."""
        with formatter.section(f"{self.kind.capitalize()}s"):
            formatter.write_dl(
                [(name, each.short_help or each.help or "") for name, each in self.commands.items()]
            )

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Refuse an empty line."""
        if not args and not ctx.resilient_parsing:  # as a shell's completion parses
            ctx.fail(f"name a {self.kind}: {', '.join(self.commands)}")
        return super().parse_args(ctx, args)

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Refuse an unknown name; upper and lower case are the same."""
        name = args[0].lower()
        if name not in self.commands and not ctx.resilient_parsing:
            reason = self._lacking.get(name)
            ctx.fail(
                reason or f"no {self.kind} {args[0]!r}; take one of {', '.join(self.commands)}"
            )
        return super().resolve_command(ctx, [name, *args[1:]])


class MethodChoice(click.Choice[str]):
    """The name of a method, in any case; the one most like it where it is none."""

    def __init__(self) -> None:
        super().__init__([each.name for each in _engine.methods()], case_sensitive=False)

    def get_invalid_choice_message(self, value: Any, ctx: click.Context | None) -> str:
        """What is said of another name."""
        said = super().get_invalid_choice_message(value, ctx).removesuffix(".")
        way_out = meant(value, self.choices)
        return f"{said}; {way_out}" if way_out else said


class _SystemCommand(click.Command):
    """A command whose values are quantities: a word too many likely follows a space in one."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Refuse words that belong to no option."""
        ctx.allow_extra_args = True
        rest = super().parse_args(ctx, args)
        if rest and not ctx.resilient_parsing:
            words = f"unexpected extra argument{'s' if len(rest) > 1 else ''} ({' '.join(rest)})"
            ctx.fail(f"{words}; a value with spaces needs quotes: '50 cm'")
        return rest


def one_each(
    name: str,
    help: str,
    entries: Iterable[SystemEntry],
    options: Callable[[SystemEntry], list[click.Parameter]],
    callback: Callable[..., None],
    *,
    kind: type[ChoiceGroup] | None = None,
    without: str = "",
) -> ChoiceGroup:
    """A group with a subcommand for each system; `callback` is given the system's entry first.

    `without` says why the catalogue's other systems are left out, and what there is for {system}.
    """
    chosen = tuple(entries)
    lacking = {
        name: without.format(system=name)
        for name in _engine.system_entries().keys() - {each.name for each in chosen}
        if without
    }
    group = (kind or ChoiceGroup)(name, kind="system", lacking=lacking, help=help)
    for entry in chosen:

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
