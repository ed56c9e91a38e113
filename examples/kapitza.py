"""Can a pendulum stand on its head? Draws a picture of docs/en/real.md.

Kapitza's pendulum: a bob of 100 g on a rod of 20 cm, whose pivot is shaken up and down by 2 cm to
either side. Mathieu's equation puts the limit for small swings about the top at 15.80 Hz. Needs
the extra "report". Run it as

    python kapitza.py [FILE.svg]
"""

import sys

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula import DrivenPendulum, Trajectory, degrees, solve

LENGTH, SHAKEN = 0.2, 0.02  # m
COLOURS = {25.0: "#009e73", 15.0: "#d55e00"}  # of the frequencies [Hz]
SHOWN = np.arange(0.0, 0.241, 0.03)  # s, the moments on the right


def shaken(frequency: float) -> Trajectory:
    """Three seconds from 10° beside the top."""
    pendulum = DrivenPendulum.bob(
        length=LENGTH,
        mass=0.1,
        viscous=1e-3,
        pivot_amplitude=SHAKEN,
        pivot_frequency=2 * np.pi * frequency,
    )
    return solve(pendulum, (degrees(170), 0.0), np.linspace(0, 3, 1501))


def draw_angles(ax: Axes, runs: dict[float, Trajectory]) -> None:
    """The angles of all runs."""
    for frequency, run in runs.items():
        end = np.degrees(run.theta[-1])
        print(
            f"{frequency:g} Hz: {end:.2f}° after 3 s, the shaking did {run.work[-1]:.4f} J of work"
        )
        ax.plot(run.t, np.degrees(run.theta), color=COLOURS[frequency], linewidth=1.2)
    ax.axhline(180, color="#6b737c", linewidth=0.8)
    ax.text(1.2, 200, "shaken at 25 Hz", color=COLOURS[25.0])
    ax.text(1.2, 105, "at 15 Hz", color=COLOURS[15.0])
    ax.set_title("released 10° beside the top", fontsize=11)
    ax.set_xlabel("time [s]")
    ax.set_ylabel("angle [°]")
    ax.set_xlim(0, 3)
    ax.set_yticks(range(-90, 271, 90))


def draw_rods(ax: Axes, run: Trajectory) -> None:
    """The rod at some moments, its pivot where it then is; the later, the darker."""
    for moment, depth in zip(SHOWN, np.linspace(0.2, 1, SHOWN.size), strict=True):
        now = int(np.searchsorted(run.t, moment - 1e-9))
        pivot = np.array(
            [0.0, SHAKEN * np.cos(run.system.parameters["pivot_frequency"] * run.t[now])]
        )
        rod = np.vstack([pivot, pivot + run.positions[now, 0]])
        ax.plot(*rod.T, color="#c9ced4", linewidth=1.5)
        ax.plot(*rod[1], "o", color=COLOURS[25.0], alpha=depth, markersize=9, markeredgewidth=0)
        ax.plot(*rod[0], "o", color="#1b1f24", alpha=depth, markersize=4, markeredgewidth=0)
    ax.plot([0, 0], [-SHAKEN, SHAKEN], color="#1b1f24", linewidth=0.8)
    ax.set_title("at 25 Hz, every 30 ms", fontsize=11)
    ax.set_aspect("equal")
    ax.set_xlim(-0.09, 0.09)
    ax.axis("off")


def main(path: str) -> None:
    """Run both and draw both panels."""
    runs = {frequency: shaken(frequency) for frequency in COLOURS}
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(2, 1))
    draw_angles(left, runs)
    draw_rods(right, runs[25.0])
    left.spines[["top", "right"]].set_visible(False)
    with mpl.rc_context({"svg.hashsalt": "pendula"}):  # the same picture is the same file
        figure.savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "kapitza.svg")
