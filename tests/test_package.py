"""The package as a whole: what it exports, what it imports, its stubs."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import pendula

SOURCE = Path(pendula.__file__).parent


def imported_by(statement: str) -> set[str]:
    """Top-level modules that a statement brings in."""
    code = f"import sys; {statement}; print(*sorted({{m.partition('.')[0] for m in sys.modules}}))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    return set(done.stdout.split())


@pytest.mark.parametrize(
    "statement", ["import pendula", "from pendula.systems import SimplePendulum; SimplePendulum(1)"]
)
def test_describing_a_pendulum_imports_nothing_heavy(statement: str) -> None:
    assert not imported_by(statement) & {"numpy", "matplotlib", "xarray", "pandas", "pint", "rich"}


@pytest.mark.parametrize(
    ("prepared", "call"),
    [
        ("import pendula; rods = pendula.DoublePendulum.rods()", "pendula.solve"),
        ("from pendula import DoublePendulum, solve; rods = DoublePendulum.rods()", "solve"),
    ],
)
@pytest.mark.parametrize("options", ["", ", 'rk4', step=0.001", ", certify=1e-9", ", digits=9"])
def test_no_run_waits_for_an_import(prepared: str, call: str, options: str) -> None:
    """The first solution in a new process is there at once: the names brought what it needs."""
    code = (
        f"import sys; {prepared}; before = set(sys.modules)\n"
        f"run = {call}(rods, (2, 2.5, 0, 0), 0.01{options})\n"
        "run.at(0.005) if not run.request.step and not run.request.digits else None\n"
        "new = set(sys.modules) - before\n"
        "assert not new, new"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_solving_imports_numpy_alone() -> None:
    heavy = imported_by(
        "import pendula; pendula.solve(pendula.SimplePendulum(), (1, 0), 1, events=[])"
    )
    assert "numpy" in heavy
    assert not heavy & {"matplotlib", "xarray", "pandas", "pint", "rich", "scipy"}


def test_the_stub_is_what_the_extension_says(tmp_path: Path) -> None:
    made = tmp_path / "_core.pyi"
    subprocess.run(
        [sys.executable, "-m", "nanobind.stubgen", "-q", "-m", "pendula._core", "-o", str(made)],
        check=True,
    )
    committed = (SOURCE / "_core.pyi").read_text(encoding="utf-8")
    assert made.read_text(encoding="utf-8") == committed, "run: make stubs"


def test_only_the_engine_sees_the_compiled_core() -> None:
    seeing = {
        path.name
        for path in SOURCE.rglob("*.py")
        if re.search(r"\b_core\b(?!\.pyi)", path.read_text(encoding="utf-8"))
    }
    assert seeing == {"_engine.py"}


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="no attribute 'penduli'"):
        pendula.penduli  # noqa: B018


def test_the_version_is_the_projects() -> None:
    from importlib.metadata import version

    assert version("pendula") == pendula.__version__
