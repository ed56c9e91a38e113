"""Plain tables, and a run as a short one with its curves."""

from __future__ import annotations

import shutil
import sys
from typing import TYPE_CHECKING

import click

from pendula import _engine

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula.trajectory import Trajectory

ROWS = 11  # of a run: ten intervals
_ENOUGH_FOR_A_CURVE = 20
_NARROWEST, _WIDEST = 30, 79  # characters of a curve with its margin


def table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Aligned columns, two spaces apart; numbers are set to the right."""
    widths = [max(map(len, column)) for column in zip(header, *rows, strict=True)]
    right = [all(_is_number(cell) for cell in column) for column in zip(*rows, strict=True)]
    lines = (
        "  ".join(
            cell.rjust(width) if to_right else cell.ljust(width)
            for cell, width, to_right in zip(row, widths, right, strict=True)
        ).rstrip()
        for row in (header, *rows)
    )
    return "\n".join(lines)


def show(run: Trajectory, *, every_row: bool = False) -> None:
    """Print a run: some of its rows (or all), its angles as curves, and one line of summary."""
    click.echo(_rows_of(run, every_row=every_row))
    if len(run.t) >= _ENOUGH_FOR_A_CURVE and _can_print("⣿"):
        _curves(run)
    click.echo(summary(run))


def summary(run: Trajectory) -> str:
    """How a run was made and how it ended."""
    error = f"largest relative energy error at these times {largest_energy_error(run):.2g}"
    if run.method == "exact":
        return f"exact: {len(run.t)} times, {error}"
    return (
        f"{run.method}, step {run.request.step:g} s: {run.n_steps} steps, "
        f"{run.n_evaluations} evaluations, {run.outcome}, {error}"
    )


def largest_energy_error(run: Trajectory) -> float:
    """The largest |E(t) − E(t0)| / E(t0) of a run's outputs."""
    import numpy as np

    return float(np.abs(run.energy_error).max())


def _rows_of(run: Trajectory, *, every_row: bool) -> str:
    import numpy as np

    components = _engine.system_entries()[run.system.name].components
    header = ["t [s]", *(f"{row.name} [{row.unit}]" for row in components), "(E-E0)/E0"]
    digits = 24 // len(components) + 1  # four columns fit into 80 characters, too
    count = len(run.t)
    chosen = np.arange(count)
    if not every_row and count > ROWS:
        chosen = np.linspace(0, count - 1, ROWS).round().astype(int)
    energy_error = run.energy_error
    rows = [
        [
            f"{run.t[i]:.6g}",
            *(f"{component:.{digits}g}" for component in run.states[i]),
            f"{energy_error[i]:.1e}",
        ]
        for i in chosen
    ]
    return table(header, rows)


def _curves(run: Trajectory) -> None:
    from pendula.cli.plots import MARGIN, curve

    components = _engine.system_entries()[run.system.name].components
    angles = components[: len(components) // 2]
    width = max(_NARROWEST, min(shutil.get_terminal_size().columns, _WIDEST)) - MARGIN
    for i, row in enumerate(angles):
        click.secho(f"\n{row.name} [{row.unit}]", dim=True)
        click.echo(curve(run.t, run.states[:, i], width=width, height=10 // len(angles)))
    click.echo()


def _can_print(text: str) -> bool:
    try:
        text.encode(sys.stdout.encoding or "ascii")
    except (LookupError, UnicodeEncodeError):
        return False
    return True


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
