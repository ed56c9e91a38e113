"""`pendula methods`: the catalogue's methods."""

from __future__ import annotations

import click

from pendula import _engine
from pendula.cli.tables import table


@click.command("methods")
def command() -> None:
    """List the integration methods of `solve`."""
    header = (
        "name",
        "order",
        "kind",
        "symplectic",
        "dense output",
        "systems",
        "evaluations/step",
        "source",
    )
    rows = [
        (
            each.name,
            str(each.order),
            "adaptive" if each.adaptive else "fixed",
            "yes" if each.symplectic else "no",
            "yes" if each.adaptive else "no",
            ",".join(each.systems),
            str(each.evaluations_per_step or "iterated"),
            each.source,
        )
        for each in _engine.methods()
    ]
    click.echo(table(header, rows))
