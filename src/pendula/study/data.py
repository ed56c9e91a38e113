"""The study's numbers as CSV: units in the header, floats that read back exactly."""

from __future__ import annotations

import math
from itertools import zip_longest
from typing import TYPE_CHECKING

from pendula.study.chaos import chaos_tables

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping
    from pathlib import Path

    from pendula.analysis import WorkPrecision
    from pendula.run.trajectory import Trajectory
    from pendula.study.runs import Comparison, Results

    Columns = dict[str, Iterable[float | int | str]]


def write_data(results: Results, folder: Path) -> None:
    """Write every table of the study into a folder that exists, as NAME.csv."""
    for name, columns in _tables(results).items():
        write_table(folder / f"{name}.csv", columns)


def _tables(results: Results) -> dict[str, Columns]:
    double = results.double
    motion = _motion({"reference": double.reference, **double.runs})
    motion["reference and its repetitions [rad]"] = double.own_difference.tolist()
    return {
        "gentle": _motion(dict(zip(("exact", "linear"), results.models["gentle"], strict=True))),
        "large": _motion(dict(zip(("exact", "linear"), results.models["large"], strict=True))),
        "linear_methods": _compared(results.linear),
        "simple_methods": _compared(results.simple),
        "double_methods": motion | _differences(double) | _energies(double),
        "linear_error": _linear_error(results),
        "small_angle_limits": _limits(results),
        "periods": _periods(results),
        "elliptic": {
            "amplitude [rad]": results.elliptic.amplitudes.tolist(),
            "terms of the series [1]": [
                int(n) if n < math.inf else n for n in results.elliptic.terms
            ],
            "iterations of the AGM [1]": results.elliptic.iterations.tolist(),
        },
        "convergence": _convergence(results),
        "orders": _orders(results),
        **{f"{name}_work": _work(each) for name, each in results.work.items()},
        "parting": {
            "method": [*double.parting, "reference and its repetitions"],
            "time [s]": [*double.parting.values(), double.horizon],
        },
        **chaos_tables(results.chaos),
    }


def _motion(runs: Mapping[str, Trajectory]) -> Columns:
    """Times, and each run's state and energy; a run that ended early has empty cells."""
    first = next(iter(runs.values()))
    columns: Columns = {"t [s]": first.t.tolist()}
    units = {"theta": "rad", "omega": "rad/s"}
    for name, run in runs.items():
        for i, component in enumerate(run.system.components):
            unit = units[component.rstrip("12")]
            columns[f"{name} {component} [{unit}]"] = run.states[:, i].tolist()
        columns[f"{name} energy [J]"] = run.energy.tolist()
    return columns


def _differences(compared: Comparison) -> Columns:
    return {
        f"{name} difference [rad]": values.tolist() for name, values in compared.differences.items()
    }


def _energies(compared: Comparison) -> Columns:
    return {
        f"{name} largest energy error of the steps since the row before [1]": values.tolist()
        for name, values in compared.energy_errors.items()
    }


def _compared(compared: Comparison) -> Columns:
    motion = _motion({"exact": compared.reference, **compared.runs})
    return motion | _differences(compared) | _energies(compared)


def _linear_error(results: Results) -> Columns:
    part = results.linear_errors
    columns: Columns = {"amplitude [rad]": part.amplitudes.tolist()}
    for n, errors in part.errors.items():
        columns[f"largest error / amplitude within {_count(n, 'period')} [1]"] = errors.tolist()
    return columns


def _limits(results: Results) -> Columns:
    part = results.linear_errors
    columns: Columns = {
        "error [1]": list(part.period_limits),
        "amplitude for the period [rad]": list(part.period_limits.values()),
    }
    for n, limits in part.limits.items():
        columns[f"amplitude for the angle within {_count(n, 'period')} [rad]"] = list(
            limits.values()
        )
    return columns


def _periods(results: Results) -> Columns:
    part = results.periods
    columns: Columns = {
        "amplitude [rad]": part.amplitudes.tolist(),
        "exact period [s]": part.exact.tolist(),
    }
    for n, values in part.series.items():
        columns[f"period by {_count(n, 'term')} [s]"] = values.tolist()
    return columns


def _convergence(results: Results) -> Columns:
    columns: Columns = {"step [s]": results.orders.steps.tolist()}
    for system, methods in results.orders.cases.items():
        for method, (errors, _) in methods.items():
            columns[f"{system} {method} largest error at the outputs [rad]"] = errors.tolist()
    return columns


def _orders(results: Results) -> Columns:
    cases = results.orders.cases
    rows = [(s, m, fit.order) for s, methods in cases.items() for m, (_, fit) in methods.items()]
    system, method, order = zip(*rows, strict=True)
    return {"system": system, "method": method, "order [1]": order}


def _work(part: WorkPrecision) -> Columns:
    """Every run; no times, which would not be the same again."""
    columns: Columns = {}
    for name, values in part.to_dict().items():
        if name != "processor time [s]":
            columns[name] = ["" if str(value) == "nan" else value for value in values]
    return columns


def _count(n: int, thing: str) -> str:
    return f"{n} {thing}" if n == 1 else f"{n} {thing}s"


def write_table(path: Path, columns: Columns) -> None:
    """Write columns by their header; those that end before the longest have empty cells."""
    rows = zip_longest(*columns.values(), fillvalue="")
    lines = [",".join(map(_quoted, columns))]
    lines += [",".join(str(value) for value in row) for row in rows]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")


def _quoted(name: str) -> str:
    return f'"{name}"' if "," in name else name
