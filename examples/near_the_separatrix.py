"""Why an elliptic function of its own? Draws the picture of docs/en/exact.md.

A pendulum with ωn = 1 rad/s is released from 179.999° and from 150°: by scipy's ellipj, by
`pendula.exact`, and by mpmath with 60 digits, which is taken for the truth. Needs the extra
"report", scipy and mpmath. Run it as

    python near_the_separatrix.py [FILE.svg]
"""

import sys
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from pendula import SimplePendulum, degrees, exact

try:
    from mpmath import mp, mpf
    from scipy.special import ellipj
except ImportError as lacking:
    sys.exit(f"near_the_separatrix.py compares with {lacking.name}: pip install mpmath scipy")

PENDULUM = SimplePendulum(length=9.80665)  # its ωn is exactly 1 rad/s, so that no error is its own
HIGH, LOW = degrees(179.999), degrees(150)
SCIPY, PENDULA, GREY = "#d55e00", "#009e73", "#6b737c"


def by_scipy(start: float, t: Any) -> Any:
    """The textbook's θ = 2 arcsin(k cd(t, k)), by ellipj."""
    k = np.sin(start / 2)
    _, cn, dn, _ = ellipj(t, k * k)
    with np.errstate(invalid="ignore"):  # it ends as NaN
        return 2 * np.arcsin(np.clip(k * cn / dn, -1, 1))


def by_pendula(start: float, t: Any) -> Any:
    """The same angle by the closed form."""
    return exact(PENDULUM, (start, 0.0), t).theta


def errors(start: float, t: Any, theta: Any) -> Any:
    """How far the angles are from those with 60 digits [rad]."""
    with mp.workdps(60):
        k = mp.sin(mpf(start) / 2)
        K = mp.ellipk(k * k)

        def truth(u: Any) -> Any:
            u -= 4 * K * mp.nint(u / (4 * K))
            return 2 * mp.asin(k * mp.ellipfun("cd", u, k=k))

        pairs = zip(t, theta, strict=True)
        return np.array([float(abs(truth(mpf(float(u))) - mpf(float(x)))) for u, x in pairs])


def draw_motion(ax: Axes) -> None:
    """Two periods from 179.999° by both."""
    period = PENDULUM.period(HIGH)
    t = np.linspace(0, 2 * period, 1201)
    ax.plot(t, np.degrees(by_pendula(HIGH, t)), color=PENDULA, linewidth=4)
    ax.plot(t, np.degrees(by_scipy(HIGH, t)), color=SCIPY, linewidth=1.6)
    bottom = np.array([0.75 * period])
    for name, method, colour in (("scipy", by_scipy, SCIPY), ("pendula", by_pendula, PENDULA)):
        there = np.degrees(method(HIGH, bottom))
        ax.plot(bottom, there, "o", color=colour, markeredgecolor="white", markersize=9, zorder=3)
        print(f"{name:7} after 3/4 of a period, {bottom[0]:.2f} s: {there[0]:.3f}°")
    ax.text(bottom[0] + 3, -8, "pendula", color=PENDULA, va="top")
    ax.text(bottom[0] + 3, -170, "scipy's\nellipj", color=SCIPY, va="bottom")
    ax.set_title("released from 179.999°, two periods", fontsize=11)
    ax.set_xlabel("time [s]")
    ax.set_ylabel("angle [°]")
    ax.set_xlim(0, 2 * period)
    ax.set_yticks(range(-180, 181, 90))


def draw_errors(ax: Axes) -> None:
    """Errors of both releases, up to times of which a double has no more digits to tell."""
    t = np.geomspace(1, 1e15, 121)
    for start, marker in ((LOW, "o"), (HIGH, "^")):
        for name, method, colour in (("scipy", by_scipy, SCIPY), ("pendula", by_pendula, PENDULA)):
            wrong = errors(start, t, method(start, t))
            known = ~np.isnan(wrong)
            ax.loglog(t, wrong, marker, color=colour, markersize=4, markeredgewidth=0)
            end = "" if known.all() else f"; NaN from {t[~known][0]:.0f} s on"
            angle = f"{np.degrees(start):.6g}°"
            print(f"{name:7} from {angle:8} is off by up to {wrong[known].max():.0e} rad{end}")
    ax.text(1e3, 6, "scipy, 179.999° (triangles), then NaN", color=SCIPY, va="center")
    ax.text(2e8, 2e-11, "scipy, 150° (dots)", color=SCIPY)
    ax.text(3e7, 2e-20, "pendula, from both", color=PENDULA, ha="center")
    ax.axhline(4 * 2.0**-52 * np.pi, color=GREY, linewidth=0.8)
    ax.text(1e15, 6e-15, "pendula's bound, at |θ| = π", color=GREY, ha="right", fontsize=9)
    ax.set_title("and its error, beside 150°", fontsize=11)
    ax.set_xlabel("time [s]")
    ax.set_ylabel("error of the angle [rad]")
    ax.set_xlim(0.6, 2e15)
    ax.set_ylim(1e-21, 1e3)


def main(path: str) -> None:
    """Draw both panels."""
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    left, right = figure.subplots(1, 2)
    draw_motion(left)
    draw_errors(right)
    for ax in (left, right):
        ax.spines[["top", "right"]].set_visible(False)
    with mpl.rc_context({"svg.hashsalt": "pendula"}):  # the same picture is the same file
        figure.savefig(path, metadata={"Date": None})


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "near_the_separatrix.svg")
