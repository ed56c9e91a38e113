"""`pendula methods`: the catalogue's methods."""

from __future__ import annotations

import click

from pendula import _engine
from pendula.cli.tables import paragraph, table


@click.command("methods")
def command() -> None:
    """List the integration methods of `solve`."""
    header = (
        "name",
        "order",
        "kind",
        "symplectic",
        "dense\noutput",
        "evals\nper step",
        "systems",
    )
    rows = [
        (
            each.name,
            str(each.order),
            "adaptive" if each.adaptive else "fixed",
            "yes" if each.symplectic else "no",
            "yes" if each.adaptive else "no",
            str(each.evaluations_per_step or "iterated"),
            _systems(each),
        )
        for each in _engine.methods()
    ]
    click.echo(table(header, rows))
    click.echo("\nSources:")
    for each in _engine.methods():
        click.echo(paragraph(f"{each.name}: {each.source}"))


def _systems(method: _engine.Method) -> str:
    """The systems in a few words; "ideal" are those without friction and drive."""
    entries = _engine.system_entries()
    ideal = [name for name in entries if entries[name].can.conservative]
    taken = list(method.systems)
    return "all" if taken == list(entries) else "ideal" if taken == ideal else ", ".join(taken)
