"""How does chaos begin? Draws a picture of docs/en/real.md.

The driven pendulum θ̈ + θ̇/2 + sin θ = a cos(2t/3) repeats itself with each turn of the drive, and
from a = 1.0663728624552 on with every second one only. Needs the extra "report". Run it as

    python period_doubling.py [FILE.svg]
"""

import sys
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula import DrivenPendulum, solve

Q, FREQUENCY, DOUBLING = 2.0, 2 / 3, 1.0663728624552
BESIDE = 0.002  # how far below and above it is drawn
TURN = 2 * np.pi / FREQUENCY
BELOW, ABOVE = "#0072b2", "#d55e00"
SETTLING = 2000  # turns of the drive


def settled(a: float, start: Any) -> Any:
    """The state when the start is forgotten, at a whole number of turns of the drive."""
    return solve(DrivenPendulum.scaled(Q, a, FREQUENCY), start, [SETTLING * TURN]).states[-1]


def draw_orbit(ax: Axes, a: float, colour: str) -> None:
    """Two turns of the drive, with a dot at the start of each."""
    pendulum = DrivenPendulum.scaled(Q, a, FREQUENCY)
    run = solve(pendulum, settled(a, (0.0, 0.0)), np.linspace(0, 2 * TURN, 801))
    theta = run.theta - 2 * np.pi * np.round(run.theta.mean() / (2 * np.pi))
    ax.plot(theta, run.omega, color=colour, linewidth=1.2)
    ax.plot(theta[:-1:400], run.omega[:-1:400], "o", color="#1b1f24", markersize=5)
    apart = abs(theta[400] - theta[0])
    print(f"a = {a:.7f}: after one turn of the drive {apart:.1e} rad beside itself")
    ax.set_title(f"a = {a:.4f}", fontsize=11)
    ax.set_xlabel("θ [rad]")
    ax.set_ylabel("ω")


def draw_fork(ax: Axes) -> None:
    """The angular velocity at the turns of the drive, against a."""
    start = settled(DOUBLING - BESIDE, (0.0, 0.0))
    for a in np.linspace(DOUBLING - BESIDE, DOUBLING + BESIDE, 81):
        start = settled(a, start)
        pendulum = DrivenPendulum.scaled(Q, a, FREQUENCY)
        ends = solve(pendulum, start, [0.0, TURN]).omega
        colour = BELOW if a < DOUBLING else ABOVE
        ax.plot([a, a], ends, ".", color=colour, markersize=3, markeredgewidth=0)
    ax.axvline(DOUBLING, color="#6b737c", linewidth=0.8)
    ax.set_title("ω at the dots", fontsize=11)
    ax.set_xlabel("a")
    ax.set_xticks([DOUBLING - BESIDE, DOUBLING, DOUBLING + BESIDE])
    ax.xaxis.set_major_formatter("{x:.4f}")


def main(path: str) -> None:
    """Draw the three panels."""
    figure = Figure(figsize=(9, 3.2), layout="constrained")
    below, above, fork = figure.subplots(1, 3)
    draw_orbit(below, DOUBLING - BESIDE, BELOW)
    draw_orbit(above, DOUBLING + BESIDE, ABOVE)
    draw_fork(fork)
    for ax in (below, above, fork):
        ax.spines[["top", "right"]].set_visible(False)
    with mpl.rc_context({"svg.hashsalt": "pendula"}):  # the same picture is the same file
        figure.savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "period_doubling.svg")
