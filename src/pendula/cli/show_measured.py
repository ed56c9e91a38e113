"""`pendula show` of a saved recording, table of periods, or fit of either."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from pendula.cli.fit import told
from pendula.cli.tables import paragraph

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.figure import Figure

    from pendula.cli.shown import Held


def show_measured(found: Held, given: dict[str, Any]) -> Callable[[str], Figure]:
    """Say what the file holds; what draws it is given back, in a language."""
    from pendula.io import load
    from pendula.measured import Comparison, Fit, Measurement, PeriodFit

    kept = load(found.path)
    if isinstance(kept, Comparison | Fit | PeriodFit):
        for line in told(kept, given["lang"]):
            click.echo(line)
    else:
        for name, value in kept.facts():
            click.echo(paragraph(f"{name}: {value}" if name else value))

    def draw(language: str) -> Figure:
        from pendula.plot.measured import measured_fit
        from pendula.plot.measured_periods import period_table

        if isinstance(kept, Comparison):
            return measured_fit(kept.best.recordings[0], language=language)
        if isinstance(kept, Fit):
            return measured_fit(kept.recordings[0], language=language)
        if isinstance(kept, PeriodFit):
            return period_table(kept, language=language)
        if isinstance(kept, Measurement):
            return kept.plot(language=language)
        rule = "--picture draws recordings and fits, not a table of periods; fit it"
        raise click.UsageError(rule)

    return draw
