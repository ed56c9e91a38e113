"""Which friction is it? Three decays tell it apart. Draws a picture of docs/en/real.md.

A bob of 1 kg on a rod of 1 m is released from 20°: with viscous friction, with dry friction, and
with the drag of the air at speed; each beside the envelope of small swings. Needs the extra
"report". Run it as

    python decays.py [FILE.svg]
"""

import sys
from collections.abc import Callable
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure

from pendula import DrivenPendulum, degrees, solve

START, END = degrees(20), 40.0  # [rad], [s]
FREQUENCY = np.sqrt(9.80665)  # for small swings [rad/s]
VISCOUS, COULOMB, QUADRATIC = 0.12, 0.052, 0.4  # N m s, N m, N m s²; I is 1 kg m²
COLOURS = ("#0072b2", "#d55e00", "#009e73")


def exponential(t: Any) -> Any:
    """Envelope with viscous friction."""
    return START * np.exp(-VISCOUS / 2 * t)


def straight(t: Any) -> Any:
    """Envelope with dry friction: 2 τc/(m g L) less each half period."""
    return np.maximum(START - 2 * COULOMB / (np.pi * FREQUENCY) * t, 0)


def hyperbolic(t: Any) -> Any:
    """Envelope with drag that grows as the square of the velocity."""
    return START / (1 + 4 * QUADRATIC * FREQUENCY * START / (3 * np.pi) * t)


PANELS: tuple[tuple[str, DrivenPendulum, Callable[[Any], Any]], ...] = (
    ("viscous: exponential", DrivenPendulum.bob(viscous=VISCOUS), exponential),
    ("dry: a straight line, then rest", DrivenPendulum.bob(coulomb=COULOMB), straight),
    ("quadratic: a hyperbola", DrivenPendulum.bob(quadratic=QUADRATIC), hyperbolic),
)


def main(path: str) -> None:
    """Draw the three panels."""
    t = np.linspace(0, END, 1001)
    figure = Figure(figsize=(9, 3.2), layout="constrained")
    for ax, colour, panel in zip(figure.subplots(1, 3, sharey=True), COLOURS, PANELS, strict=True):
        title, pendulum, envelope = panel
        run = solve(pendulum, (START, 0.0), t)
        for side in (1, -1):
            ax.plot(t, side * np.degrees(envelope(t)), "--", color="#6b737c", linewidth=0.9)
        ax.plot(t, np.degrees(run.theta), color=colour, linewidth=1.2)
        ax.set_title(title, fontsize=11)
        ax.set_xlabel("time [s]")
        ax.set_xlim(0, END)
        ax.set_yticks(range(-20, 21, 10))
        ax.spines[["top", "right"]].set_visible(False)
        heat, defect = run.heat[-1], abs(run.energy_error).max()
        print(f"{title}: {heat:.4f} J of heat, defect of the energy balance {defect:.0e}")
        if (run.pieces.states == 0).any():
            rest = np.degrees(run.theta[-1])
            print(f"  at rest from {run.pieces.times[-1]:.2f} s on, at {rest:.3f}°")
            ax.plot(run.pieces.times[-1], rest, "o", color=colour)
    figure.axes[0].set_ylabel("angle [°]")
    with mpl.rc_context({"svg.hashsalt": "pendula"}):  # the same picture is the same file
        figure.savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "decays.svg")
