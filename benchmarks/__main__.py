"""RK4 of the two rods, the closed forms and the Taylor series, each beside its peers in one run."""

import datetime
import platform
import subprocess
import sys
from pathlib import Path

from benchmarks import ensembles, exact, fit, lab, peers, real, taylor

ROOT = Path(__file__).resolve().parent.parent
BUILD = ROOT / "build" / "benchmarks"


def processor() -> str:
    """Name of the processor."""
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        return platform.processor()
    return next((line.partition(":")[2].strip() for line in lines if "model name" in line), "")


def build() -> None:
    """Build the core's benchmark programs."""
    tools = Path(sys.executable).parent
    options = [f"-DCMAKE_MAKE_PROGRAM={tools / 'ninja'}", f"-DPython_EXECUTABLE={sys.executable}"]
    switches = ["-DPENDULA_PYTHON=OFF", "-DPENDULA_BENCHMARKS=ON"]
    cmake = str(tools / "cmake")
    configure = [cmake, "-S", str(ROOT), "-B", str(BUILD), "-G", "Ninja", *options, *switches]
    for command in (configure, [cmake, "--build", str(BUILD)]):
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)


def core_program(architecture: str) -> dict[str, float]:
    """What the core's program prints: nanoseconds a step and trajectory of each variant."""
    program = BUILD / "benchmarks" / "core" / f"rk4_{architecture}"
    lines = subprocess.run(
        [program], check=True, capture_output=True, text=True
    ).stdout.splitlines()
    return {name: float(value) for name, value in (line.split("\t") for line in lines)}


def table() -> list[tuple[str, float]]:
    """Every figure in nanoseconds a step and trajectory."""
    rows: list[tuple[str, float]] = []
    for architecture, label in (("x86_64", "SSE2"), ("x86_64_v3", "AVX2")):
        rows += [(f"C++ {name}, {label}", ns) for name, ns in core_program(architecture).items()]
    return rows + list(peers.all_figures().items())


def main() -> None:
    """Print the table and the ratios that are asked for."""
    build()
    rows = table()
    ns = dict(rows)
    libm = ns["C++ bare loop, libm, AVX2"]
    print(f"RK4, two uniform rods, ns a step and trajectory, {datetime.date.today()}")
    print(f"{processor()}, Python {platform.python_version()}, {platform.system()}\n")
    print(f"{'':44}{'ns':>10}{'÷ bare loop (AVX2)':>22}")
    for name, value in rows:
        print(f"{name:44}{value:10.1f}{value / libm:22.3f}")
    print()
    lanes = ns["C++ 4 lanes, AVX2"]
    print(f"pendula.solve ÷ bare loop:        {ns['pendula.solve'] / libm:6.2f}   (asked: ≤ 1.5)")
    print(
        f"1 lane ÷ 4 lanes, AVX2:           {ns['C++ 1 lane, AVX2'] / lanes:6.2f}   (asked: ≥ 3.3)"
    )
    print(f"bare loop ÷ 4 lanes, AVX2:        {libm / lanes:6.2f}   (asked: ≥ 5)")
    for mine, ours in rows:
        for peer, asked in (("numba", 7), ("numpy", 15), ("JAX", 15)) if "ensemble" in mine else ():
            for theirs in (value for name, value in rows if name.startswith(peer)):
                print(f"{peer + ' ÷ ' + mine + ':':34}{theirs / ours:6.2f}   (asked: ≥ {asked})")
    print()
    exact.report()
    print()
    taylor.report(BUILD)
    print()
    real.report()
    print()
    ensembles.report()
    print()
    fit.report()
    print()
    lab.report()


if __name__ == "__main__":
    main()
