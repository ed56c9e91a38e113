"""How long does each method stay accurate? Draws the picture of the README.

Two rods of 1 m and 1 kg, released from 120° and −10°, go by Euler, Heun and RK4 with steps of
1 ms; the reference is RK4 with steps of 0.1 ms. Needs the extra "report". Run it as

    python parting.py [FILE.svg]
"""

import sys

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula import DoublePendulum, Trajectory, degrees, solve
from pendula.analysis import angle_difference, parting_time

COLOURS = {"reference": "#c9ced4", "rk4": "#009e73", "heun": "#0072b2", "euler": "#d55e00"}
NAMES = {"euler": "Euler", "heun": "Heun", "rk4": "RK4"}
SHOWN = 12.0  # s, the moment on the left
TOLERANCE = degrees(1.0)


def draw_moment(ax: Axes, runs: dict[str, Trajectory]) -> None:
    """The rods of every run at one moment, and the way their lower end took there."""
    for name, run in runs.items():
        now = int(np.searchsorted(run.t, SHOWN))
        width = 7.0 if name == "reference" else 2.5
        tip = run.positions[now - 80 : now + 1, 1]
        rods = np.vstack([(0.0, 0.0), run.positions[now]])
        ax.plot(*tip.T, color=COLOURS[name], linewidth=0.4 * width, alpha=0.6)
        ax.plot(*rods.T, "o-", color=COLOURS[name], linewidth=width, markersize=7)
    ax.plot(0, 0, "o", color="#1b1f24", markersize=7)
    ax.set_title(f"the same rods after {SHOWN:g} s (grey: reference)", fontsize=11)
    ax.set_aspect("equal")
    ax.axis("off")


def draw_differences(ax: Axes, runs: dict[str, Trajectory]) -> None:
    """How far each run is from the reference, and since when by more than 1°."""
    for name, title in NAMES.items():
        t, apart = runs["reference"].t, angle_difference(runs[name], runs["reference"])
        moment = parting_time(t, apart, TOLERANCE)
        label = f"{title}: accurate to 1° for {moment:.1f} s"
        print(label)
        ax.semilogy(t[1:], np.degrees(apart[1:]), color=COLOURS[name], linewidth=1.2, label=label)
        ax.plot(moment, 1.0, "o", color=COLOURS[name])
    ax.axhline(1.0, color="#6b737c", linewidth=0.8)
    ax.set_title("largest difference of an angle from the reference [°]", fontsize=11)
    ax.set_xlabel("time [s]")
    ax.set_xlim(0, 20)
    ax.set_xticks(range(0, 21, 5))
    ax.set_ylim(1e-9, 1e5)
    ax.legend(loc="lower right", frameon=False)
    ax.spines[["top", "right"]].set_visible(False)


def main(path: str) -> None:
    """Run the pendulums and draw both panels."""
    rods, start = DoublePendulum.rods(), (degrees(120), degrees(-10), 0.0, 0.0)
    t = np.arange(2001) / 100
    runs = {"reference": solve(rods, start, t, "rk4", step=1e-4)}
    runs |= {method: solve(rods, start, t, method, step=1e-3) for method in NAMES}
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2, width_ratios=(1, 1.4))
    draw_moment(left, runs)
    draw_differences(right, runs)
    with mpl.rc_context({"svg.hashsalt": "pendula"}):  # the same picture is the same file
        figure.savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "parting.svg")
