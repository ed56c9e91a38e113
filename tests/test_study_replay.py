"""The motions that the report replays: smooth between the stored points, with their energies."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from pendula import DoublePendulum, LinearPendulum, SimplePendulum, exact, plot, solve
from pendula._types import MethodName
from pendula.plot.labels import labels
from pendula.study import report
from pendula.study.motions import _motion

TEMPLATES = Path(report.__file__).parent / "templates"
RODS = DoublePendulum.rods()
START = (np.radians(120), np.radians(-10), 0.0, 0.0)
T = np.linspace(0.0, 10.0, 501)
NODE = shutil.which("node")


def stored(runs: dict[str, Any], lengths: list[float]) -> dict[str, Any]:
    """A motion as the page reads it."""
    return json.loads(json.dumps(_motion(lengths, runs, labels("en"))))  # type: ignore[no-any-return]


def values(steps: list[int], parts: float) -> np.ndarray:
    return np.cumsum(steps) / parts


@pytest.mark.parametrize("method", ["taylor", "rk4", "euler"])
def test_rates_and_energies_are_those_of_the_run(method: MethodName) -> None:
    run = solve(RODS, START, T, method, step=None if method == "taylor" else 0.01)
    (kept,) = stored({method: run}, [1.0, 1.0])["runs"]
    for i in (0, 1):
        np.testing.assert_allclose(values(kept["angles"][i], 1e4), run.theta[:, i], atol=6e-5)
        np.testing.assert_allclose(values(kept["rates"][i], 1e3), run.omega[:, i], atol=6e-4)
    start = RODS.energy(START)
    for steps, energy in zip(
        kept["energies"], (run.kinetic_energy, run.potential_energy), strict=True
    ):
        np.testing.assert_allclose(values(steps, 1e3), energy / start, atol=6e-4)


def test_energies_of_a_start_at_rest_at_the_bottom_and_of_what_blows_up() -> None:
    still = exact(SimplePendulum(), (0.0, 0.0), T)
    wild = solve(LinearPendulum(length=1e-3), (1.0, 0.0), T, "euler", step=0.02)
    for run in (still, wild):
        (kept,) = stored({"exact": run}, [1.0])["runs"]
        found = values(kept["energies"][0], 1e3)
        assert np.isfinite(found).all()
        assert abs(found).max() <= 1e6


PAGE = """
const fs = require("fs"), vm = require("vm");
const text = fs.readFileSync(0, "utf8"), asked = JSON.parse(text);
const document = { getElementById: () => ({ textContent: JSON.stringify({ decimal: "," }) }) };
const sandbox = vm.createContext({ document, window: {}, asked });
vm.runInContext(fs.readFileSync(process.argv[1], "utf8"), sandbox);
const found = vm.runInContext(
  "unpack(asked.motion); asked.times.map((t) => joints(asked.motion, asked.motion.runs[0], t))",
  sandbox,
);
console.log(JSON.stringify(found));
"""


def replayed(motion: dict[str, Any], times: np.ndarray) -> list[Any]:
    """The pivot and the ends of the rods at these times, by the page's own script."""
    given = json.dumps({"motion": motion, "times": times.tolist()})
    command = [str(NODE), "-e", PAGE, str(TEMPLATES / "pendulums.js")]
    done = subprocess.run(command, input=given, text=True, capture_output=True, check=True)
    return json.loads(done.stdout)  # type: ignore[no-any-return]


@pytest.mark.skipif(NODE is None, reason="needs node")
@pytest.mark.parametrize("system", [RODS, SimplePendulum(0.5)], ids=["double", "simple"])
def test_between_the_stored_points_the_page_follows_the_motion(system: Any) -> None:
    """Straight on from one point to the next it was off by 4 mm for these rods."""
    state = START if system is RODS else (3.0, 0.0)
    lengths = [1.0, 1.0] if system is RODS else [0.5]
    run = solve(system, state, T) if system is RODS else exact(system, state, T)
    times = np.linspace(0.0, 10.0, 1237)
    joints = np.array(replayed(stored({"taylor": run}, lengths), times))
    truth = system.positions(run.at(times)) * [1.0, -1.0]  # y points down on the page
    np.testing.assert_allclose(joints[:, 1:], truth, atol=2e-4)
    assert (joints[:, 0] == 0.0).all()


@pytest.mark.skipif(NODE is None, reason="needs node")
def test_after_its_end_a_run_is_not_drawn() -> None:
    run = solve(RODS, START, T[:101])
    assert replayed(stored({"rk4": run}, [1.0, 1.0]), np.array([2.0, 2.01]))[1] is None


def test_the_scripts_need_no_network_and_name_every_word() -> None:
    both = "".join((TEMPLATES / name).read_text("utf-8") for name in ("pendulums.js", "replay.js"))
    assert "http" not in both
    used = set(re.findall(r"data\.words\.(\w+)", both))
    assert used | {"missing"} == set(report.catalogue("en")["replay"])
    assert {"ArrowLeft", "ArrowRight", "Home", "End"} <= set(re.findall(r"\w+", both))
    assert "requestFullscreen" in both


def test_letters_of_figures_are_text() -> None:
    figure = plot.trajectory(solve(RODS, START, 3.0), language="es")
    drawn = plot.svg(figure).decode()
    assert re.search(
        r"<text [^>]*'DejaVu Sans', Verdana, sans-serif[^>]*>tiempo t \[s\]</text>", drawn
    )
    assert b"/Subtype /CIDFontType2" in plot.picture(figure, "pdf")
