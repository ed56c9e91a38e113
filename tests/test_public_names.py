"""What users may name is there, whatever a process named before and wherever a run comes from."""

import ast
import inspect
import pickle
import random
import subprocess
import sys
from pathlib import Path
from typing import Any

import grimp
import pytest

import pendula
from pendula.run import trajectory

MODULES = {
    "analysis": ["angle_difference", "parting_time", "period_limit", "work_precision"],
    "chunks": ["Axis", "Chunk", "Variable", "Work", "computed", "connect", "opened", "run"],
    "elliptic": ["E", "F", "K", "K_series", "am", "sncndn"],
    "events": ["Crossings", "Event", "angle", "flip", "tip_height", "velocity_zero"],
    "io": ["load", "rerun", "save", "to_pandas", "to_xarray"],
    "lab": ["Recipe", "read_link"],
    "maps": ["divergence_map", "flip_map"],
    "plot": ["divergence_map", "flip_map", "trajectory", "work_precision"],
    "sampling": ["Choice", "Fixed", "Grid", "Listed", "LogUniform", "SameAs", "Sampler", "Uniform"],
    "study": ["run_study"],
    "sweeping": ["SweepRecipe", "read_sweep", "sweep", "sweep_from"],
    "systems": ["DoublePendulum", "LinearPendulum", "SimplePendulum", "System"],
    "units": ["quantities", "quantity"],
}
NAMES = sorted({*pendula.__all__, *MODULES})
ATTACHED = ("plot", "save", "to_pandas", "to_xarray")


def in_a_new_process(code: str, *arguments: str, given: bytes = b"") -> None:
    done = subprocess.run(
        [sys.executable, "-c", code, *arguments], input=given, capture_output=True, check=False
    )
    assert done.returncode == 0, done.stderr.decode()


def test_the_face_lists_all_of_them() -> None:
    assert set(NAMES) <= set(dir(pendula))


@pytest.mark.parametrize("first", NAMES)
def test_a_public_name_needs_no_other_before_it(first: str) -> None:
    """The others follow in some order, and leave it what it was."""
    code = (
        "import sys, pendula\n"
        "first, *others = sys.argv[1:]\n"
        "found = getattr(pendula, first)\n"
        "for name in others: getattr(pendula, name)\n"
        "assert getattr(pendula, first) is found\n"
    )
    in_a_new_process(code, first, *random.Random(first).sample(NAMES, len(NAMES)))


def test_the_modules_imported_by_themselves_hold_their_names() -> None:
    code = "".join(f"from pendula.{m} import {', '.join(names)}\n" for m, names in MODULES.items())
    in_a_new_process(code + "import pendula; assert callable(pendula.sweep)")


# ---- methods of a trajectory that rooms above it define ----


@pytest.mark.parametrize("method", ATTACHED)
@pytest.mark.parametrize(
    "made",
    [
        "import pickle, sys; run = pickle.loads(sys.stdin.buffer.read())",
        "from pendula.run.solve import solve; from pendula.systems import SimplePendulum\n"
        "run = solve(SimplePendulum(), (1, 0), 1)",
        "import pendula; run = pendula.exact(pendula.SimplePendulum(), (1, 0), [1])",
        "from pendula.plot import angles; from pendula.run.trajectory import Trajectory as run",
    ],
)
def test_a_run_has_all_its_methods_wherever_it_comes_from(made: str, method: str) -> None:
    run = pendula.solve(pendula.SimplePendulum(), (1.0, 0.0), 1.0)
    names = f"assert {set(ATTACHED)} <= set(dir(run))"
    code = f"{made}\n{names}\nassert run.{method}.__doc__ and callable(run.{method})"
    in_a_new_process(code, given=pickle.dumps(run))


def test_an_unpickled_run_is_saved_and_drawn(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    run = pendula.solve(pendula.SimplePendulum(), (1.0, 0.0), 1.0)
    code = (
        "import pickle, sys; run = pickle.loads(sys.stdin.buffer.read())\n"
        "run.save(sys.argv[1]); run.plot().savefig(sys.argv[2])"
    )
    table, picture = tmp_path / "run.csv", tmp_path / "run.svg"
    in_a_new_process(code, str(table), str(picture), given=pickle.dumps(run))
    assert pendula.load(table).states.tobytes() == run.states.tobytes()
    assert picture.stat().st_size > 0


@pytest.mark.parametrize("name", ATTACHED)
def test_a_method_takes_what_its_declaration_says(name: str) -> None:
    """Type checkers read the declaration; `help` shows the function."""
    tree = ast.parse(Path(trajectory.__file__).read_text(encoding="utf-8"))
    nodes = [each for each in ast.walk(tree) if isinstance(each, ast.FunctionDef)]
    *_, declared = (each for each in nodes if each.name == name)  # after its overloads
    method: Any = getattr(trajectory.Trajectory, name)
    _, *taken = inspect.signature(method).parameters.values()
    arguments = declared.args
    assert [each.arg for each in (*arguments.args[1:], *arguments.kwonlyargs)] == [
        each.name for each in taken
    ]
    assert ast.unparse(declared.returns or ast.Constant(None)) == method.__annotations__["return"]
    assert method.__doc__


# ---- who imports whom ----


def test_nothing_imports_the_face_of_the_package() -> None:
    """Only the compiled core looks so, a module that is no source: `from pendula import _core`."""
    graph = grimp.build_graph("pendula", exclude_type_checking_imports=True)
    assert graph.find_modules_that_directly_import("pendula") <= {"pendula._engine"}
