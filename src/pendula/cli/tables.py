"""Plain tables; a run as a short table with its curves."""

from __future__ import annotations

import math
import shutil
import sys
import textwrap
from typing import TYPE_CHECKING

import click

from pendula import _engine

if TYPE_CHECKING:
    from collections.abc import Sequence

    from pendula.run.trajectory import Trajectory

_ROWS = 11  # of a run: ten intervals
_ENOUGH_FOR_A_CURVE = 20
_NARROWEST, _WIDEST = 30, 79  # characters of a curve with its margin, or of a line


def table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Aligned columns, two spaces apart; numbers are right-aligned.

    Names in the header may have two lines.
    """
    high = max(name.count("\n") for name in header)
    names = [("\n" * (high - name.count("\n")) + name).split("\n") for name in header]
    headers = list(zip(*names, strict=True))
    widths = [max(map(len, column)) for column in zip(*headers, *rows, strict=True)]
    right = [all(_is_number(cell) for cell in column) for column in zip(*rows, strict=True)]
    lines = (
        "  ".join(
            cell.rjust(width) if to_right else cell.ljust(width)
            for cell, width, to_right in zip(row, widths, right, strict=True)
        ).rstrip()
        for row in (*headers, *rows)
    )
    return "\n".join(lines)


def paragraph(text: str) -> str:
    """Each line of a text in lines that 80 columns have room for, the further ones indented."""
    return "\n".join(
        textwrap.fill(
            line, _WIDEST, subsequent_indent="  ", break_long_words=False, break_on_hyphens=False
        )
        for line in text.splitlines()
    )


def show(run: Trajectory, *, every_row: bool = False, more: str = "-o FILE writes all") -> None:
    """Print a run: some of its rows (or all), and its angles as curves.

    `more` says what gives the rows that are left out.
    """
    rows = _chosen_rows(len(run.t), every_row=every_row)
    click.echo(_rows_of(run, rows))
    if len(rows) < len(run.t):
        click.echo(f"{len(rows)} of {times_of(run)} shown; {more}")
    if len(run.t) >= _ENOUGH_FOR_A_CURVE and can_print("⣿"):
        _curves(run)


def summary(run: Trajectory) -> str:
    """How a run was made, how it ended, and until when it is accurate."""
    asked, error = run.request, "no outputs"
    if run.t.size:
        # between outputs of their own choice a run's steps may be worse
        place = "" if isinstance(asked.t, float) else " at the outputs"
        kind = run.energy_error_name.replace("energy e", "relative energy e")
        error = f"largest {kind}{place} {largest_energy_error(run):.2g}"
    if run.method == "exact":
        return f"exact: {times_of(run)}; {error}"
    if asked.digits is not None:
        return (
            f"{run.method}, {asked.digits} guaranteed digits: "
            f"computed with {run.precision} digits, {run.outcome}, {error}"
        )
    chosen = f"step {asked.step:g} s" if asked.step else f"tolerance {asked.tolerance:.3g}"
    lines = [
        f"{run.method}, {chosen}: {run.n_steps} steps, {run.n_evaluations} evaluations, "
        f"{run.outcome}, {error}"
    ]
    if run.trust_horizon is not None:
        until = "throughout" if math.isinf(run.trust_horizon) else f"until {run.trust_horizon:g} s"
        lines.append(f"accurate to {asked.certify:g} rad {until}")
    return "\n".join(lines)


def times_of(run: Trajectory) -> str:
    """How many outputs a run has."""
    return f"{len(run.t)} time{'' if len(run.t) == 1 else 's'}"


def largest_energy_error(run: Trajectory) -> float:
    """The largest |E(t) − E(t0)| / E(t0) of a run's outputs."""
    import numpy as np

    return float(np.abs(run.energy_error).max())


def _rows_of(run: Trajectory, chosen: Sequence[int]) -> str:
    components = _engine.system_entries()[run.system.name].components
    header = [
        "t [s]",
        *(f"{row.name} [{row.unit}]" for row in components),
        "(E-E0)/E0" if run.system.can.conservative else "defect",
    ]
    digits = digits_of(len(components))
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


def digits_of(columns: int) -> int:
    """Significant digits of printed numbers: with signs and exponents 80 characters hold them."""
    return 26 // columns


def _chosen_rows(count: int, *, every_row: bool) -> list[int]:
    """Which of so many rows are printed."""
    if every_row or count <= _ROWS:
        return list(range(count))
    return [round(i * (count - 1) / (_ROWS - 1)) for i in range(_ROWS)]


def _curves(run: Trajectory) -> None:
    from pendula.cli.plots import MARGIN, curve

    components = _engine.system_entries()[run.system.name].components
    angles = components[: run.system.can.degrees_of_freedom]
    width = max(_NARROWEST, min(shutil.get_terminal_size().columns, _WIDEST)) - MARGIN
    for i, row in enumerate(angles):
        click.secho(f"\n{row.name} [{row.unit}]", dim=True)
        click.echo(curve(run.t, run.states[:, i], width=width, height=10 // len(angles)))
    click.echo()


def can_print(text: str) -> bool:
    """Whether stdout's encoding has these characters."""
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
