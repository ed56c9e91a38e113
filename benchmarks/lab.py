"""The laboratory's page: what is loaded, how soon it moves, what it computes in Chromium."""

import gzip
import json
import sys
import tempfile
from pathlib import Path
from typing import Any

from benchmarks.lanes import START, STEP, TRAJECTORIES, on_machine
from pendula.lab import page

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent / "tests"))
import browsers  # noqa: E402
from lab_pages import serving  # noqa: E402

RODS = "#system=double&form=rods&state=2.0943951023931953,-0.17453292519943295,0,0&lang=en&t_max="
STEPS = 500  # of RK4 in the browser, for each trajectory
SIDE = 64  # cells along each angle of the flip map
WORK = {"start": START, "many": TRAJECTORIES, "end": STEPS * STEP, "step": STEP, "side": SIDE}
CALLS = {  # of lab_page.js, each on a page of its own
    "firstMotion()": f"{RODS}30",
    "ghostFrame()": f"{RODS}30&view=compare&compare=rk4,dop853,gauss4",
    "leaving()": f"{RODS}100",
    f"workerTimes(lanesAndMap({json.dumps(WORK)}))": f"{RODS}10",
}


def packed(*names: str) -> float:
    """Size of files of the page as servers send them, in kB of 1000 bytes."""
    files = page.page_files()
    return sum(len(gzip.compress(files[name].read_bytes(), 9)) for name in names) / 1000


def in_chromium() -> list[Any]:
    """What each of the calls gives."""
    functions = (HERE / "lab_page.js").read_text(encoding="utf-8")
    found = []
    with serving() as server:
        for call, link in CALLS.items():
            with tempfile.TemporaryDirectory() as folder, browsers.browser(Path(folder)) as one:
                one.open(f"{server.url}{link}")
                found.append(one.value(f"(() => {{ {functions}\nreturn {call}; }})()"))
    return found


def line(what: str, value: float, asked: str) -> None:
    """One figure, beside what was asked."""
    print(f"{what + ':':50}{value:10.4g}   (asked: {asked})")


def report() -> None:
    """Print the figures, or why there are none."""
    print("The laboratory's page\n")
    try:
        names = list(page.page_files())
    except ImportError as error:
        print(f"skipped: {error}")
        return
    module = next(name for name in names if name.endswith(".wasm"))
    line("module, gz [kB]", packed(module), "≤ 350")
    line("first page, gz [kB]", packed(*names), "≤ 450")
    if not browsers.PROGRAM:
        print("the rest is skipped: there is no Chromium here")
        return
    moved, frame, left, (lanes, cells) = in_chromium()
    native, wasm = on_machine("avx2") * 1e9, lanes * 1e6 / (STEPS * TRAJECTORIES)
    line("first motion in Chromium [s]", moved / 1000, "≤ 1")
    line("a frame of the main thread, three ghosts [ms]", frame, "≤ 8")
    line("a computation that is left has ended after [ms]", left, "≤ 100")
    line("flip map to 20 s [cells a second and core]", SIDE**2 / (cells / 1000), "≥ 15000")
    print(f"{'RK4 lanes [ns a step and trajectory]:':50}{wasm:10.4g}")
    line("RK4 lanes ÷ pendula.ensemble, avx2", wasm / native, "≤ 3")


if __name__ == "__main__":
    report()
