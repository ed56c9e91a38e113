"""What errors cost: the ladder of steps, the reference, the counts, and how they are drawn."""

from __future__ import annotations

import csv
import json
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from matplotlib.colors import to_hex

from catalogue import METHODS, taking
from pendula import DoublePendulum, LinearPendulum, SimplePendulum, exact, plot, solve
from pendula._engine import series_order
from pendula.analysis import (
    MethodWork,
    WorkPrecision,
    convergence_order,
    time_scale,
    work_precision,
)
from pendula.io.rows import write_rows
from pendula.plot.style import MARKERS, line

if TYPE_CHECKING:
    from pendula._types import MethodName

SIMPLE, LARGE = SimplePendulum(0.5), (2.6, 0.0)
RODS, START = DoublePendulum.rods(), (2.0943951023931953, -0.17453292519943295, 0.0, 0.0)


def of(found: WorkPrecision, method: str) -> MethodWork:
    return next(each for each in found.methods if each.method == method)


@pytest.fixture(scope="module")
def simple() -> WorkPrecision:
    return work_precision(SIMPLE, LARGE, 5.0, timed=False)


@pytest.fixture(scope="module")
def double() -> WorkPrecision:
    return work_precision(RODS, START, 3.0, ["midpoint", "rk4", "gauss8", "taylor"], points=8)


def made(errors: list[float], evaluations: list[float]) -> MethodWork:
    e, n = np.array(errors), np.array(evaluations)
    outcomes = tuple("reached_end" for _ in errors)
    return MethodWork("rk4", False, 1.0 / n, n, n * 1e-6, e, e, outcomes)


def test_all_methods_that_take_the_system_are_run(simple: WorkPrecision) -> None:
    assert [each.method for each in simple.methods] == [each.name for each in taking("simple")]
    assert [each.method for each in work_precision(RODS, START, 0.5, timed=False).methods] == [
        each.name for each in taking("double")
    ]


def test_errors_and_counts_are_those_of_runs(simple: WorkPrecision) -> None:
    truth = exact(SIMPLE, LARGE, simple.t)
    for name in ("rk4", "gauss6", "dop853"):
        work = of(simple, name)
        setting = {"tolerance" if work.adaptive else "step": float(work.settings[4])}
        run = solve(SIMPLE, LARGE, simple.t, name, **setting)  # type: ignore[arg-type]
        assert work.errors[4] == np.abs(run.theta - truth.theta).max() > 0
        assert work.evaluations[4] == run.n_evaluations
        assert work.energy_errors[4] == abs(run.energy_error[-1])


def test_no_step_is_shortened_for_an_output(simple: WorkPrecision) -> None:
    for each in METHODS:
        if each.evaluations_per_step is not None and not each.adaptive:
            work = of(simple, each.name)
            steps = np.round(5.0 / work.settings)
            assert work.evaluations.tolist() == (steps * each.evaluations_per_step).tolist()
            assert (np.diff(work.settings) < 0).all()


def test_the_ladder_shows_the_order(simple: WorkPrecision) -> None:
    for name, order in (("heun", 2), ("verlet", 2), ("yoshida4", 4), ("gauss4", 4)):
        work = of(simple, name)
        fit = convergence_order(work.settings, work.errors, floor=1e-10)
        assert fit.order == pytest.approx(order, abs=0.1)


def test_high_orders_come_down_to_rounding(simple: WorkPrecision) -> None:
    for name in ("yoshida6", "yoshida8", "gauss6", "gauss8", "dop853", "taylor"):
        assert of(simple, name).best < 1e-12


def test_a_coefficient_of_the_series_is_an_evaluation(simple: WorkPrecision) -> None:
    assert series_order(2.0**-52) == next(m.order for m in METHODS if m.name == "taylor")
    assert series_order(1e-3) == 6
    work = of(simple, "taylor")
    run = solve(SIMPLE, LARGE, simple.t, tolerance=float(work.settings[0]))
    assert work.evaluations[0] == 6 * run.n_evaluations


def test_the_double_pendulum_is_judged_by_a_certified_run(double: WorkPrecision) -> None:
    assert (double.reference, double.digits) == ("taylor", 15)
    assert double.precision is not None
    assert double.precision > 15
    truth = solve(RODS, START, double.t, digits=15)
    work = of(double, "rk4")
    run = solve(RODS, START, double.t, "rk4", step=float(work.settings[3]))
    assert work.errors[3] == np.abs(run.theta - truth.theta).max()
    assert double.resolution < double.reference_error < 1e-13
    assert of(double, "gauss8").best < 1e-12


def test_a_run_that_breaks_down_is_infinitely_wrong(double: WorkPrecision) -> None:
    work = of(double, "midpoint")
    assert work.outcomes[0] == "not_finite"
    assert (work.errors[0], work.energy_errors[0]) == (math.inf, math.inf)
    assert np.isfinite(work.errors[-1])
    assert work.outcomes[-1] == "reached_end"


def test_times_are_measured(double: WorkPrecision) -> None:
    seconds = of(double, "rk4").seconds
    assert (seconds > 0).all()
    assert seconds[-1] > 20 * seconds[0]  # 400 times the steps


def test_without_times_the_same_comes_again(simple: WorkPrecision) -> None:
    again = work_precision(SIMPLE, LARGE, 5.0, timed=False)
    assert str(again.to_dict()) == str(simple.to_dict())
    assert all(np.isnan(each.seconds).all() for each in again.methods)


def test_a_motion_may_go_backward() -> None:
    found = work_precision(LinearPendulum(), (0.1, 0.2), -3.0, ["verlet", "taylor"], t0=1.0)
    assert (found.t[0], found.t[-1]) == (pytest.approx(1.0 - 4.0 / len(found.t)), -3.0)
    assert of(found, "taylor").best < 1e-15 * 50
    assert of(found, "verlet").errors[-1] < of(found, "verlet").errors[0] < 0.1


@pytest.mark.parametrize(
    ("system", "state", "scale"),
    [
        (SimplePendulum(0.5), (1.0, 0.0), math.tau / math.sqrt(9.80665 / 0.5)),
        (SimplePendulum(0.5), (0.0, -50.0), math.tau / 50),
        (RODS, START, math.tau / RODS.normal_modes().frequencies[1]),
    ],
)
def test_the_time_scale(system: Any, state: tuple[float, ...], scale: float) -> None:
    assert time_scale(system, state) == pytest.approx(scale, rel=1e-15)


def test_what_an_error_costs_is_read_off_straight_lines() -> None:
    work = made([1e-2, 1e-4, 1e-6], [100.0, 1000.0, 10000.0])
    assert work.to_reach(1e-5) == pytest.approx((1000 * math.sqrt(10), math.sqrt(10) * 1e-3))
    assert work.to_reach(1e-6) == pytest.approx((10000, 1e-2))
    assert work.to_reach(1.0)[0] == 100
    assert all(map(math.isnan, work.to_reach(1e-7)))
    assert work.error_at(1000 * math.sqrt(10)) == pytest.approx(1e-5)
    assert work.error_at(1e6) == work.best == 1e-6
    assert math.isnan(work.error_at(99))


def test_a_broken_or_perfect_run_is_no_end_of_a_line() -> None:
    work = made([math.inf, 1e-4, 0.0], [100.0, 1000.0, 10000.0])
    assert work.to_reach(1e-3)[0] == 1000
    assert work.to_reach(1e-9)[0] == 10000
    assert work.error_at(500) == math.inf
    assert work.error_at(5000) == 1e-4


def test_equal_work_is_a_round_number_within_all_ranges(simple: WorkPrecision) -> None:
    work = simple.equal_work()
    assert str(work).rstrip("0") in {"1", "2", "5"}
    assert all(not math.isnan(each.error_at(work)) for each in simple.methods)


def test_a_table_has_a_row_for_each_run(double: WorkPrecision) -> None:
    frame = double.to_pandas()
    assert len(frame) == sum(len(each.settings) for each in double.methods)
    assert frame["step [s]"].isna().tolist() == (frame["method"] == "taylor").tolist()
    assert math.isinf(frame["largest angle error at the outputs [rad]"][0])


def test_files_hold_every_run_and_what_was_compared(double: WorkPrecision, tmp_path: Path) -> None:
    for name in ("work.csv", "work.json"):
        write_rows(double.to_dict(), double.attributes(), tmp_path / name)
    with (tmp_path / "work.csv").open(encoding="utf-8") as file:
        attributes = json.loads(file.readline().removeprefix("# pendula: "))
        rows = list(csv.DictReader(file))
    data = json.loads((tmp_path / "work.json").read_text(encoding="utf-8"))
    assert attributes == {key: value for key, value in data.items() if key != "rows"}
    assert attributes["system"] == RODS.description()
    assert (attributes["reference"], attributes["digits"], attributes["t_max"]) == (
        "taylor",
        15,
        3.0,
    )
    column = "largest angle error at the outputs [rad]"
    errors = np.concatenate([each.errors for each in double.methods]).tolist()
    assert [float(row[column]) for row in rows] == errors
    assert [float(row[column]) for row in data["rows"]] == errors
    assert rows[0]["tolerance [1]"] == ""
    assert data["rows"][0]["tolerance [1]"] is None


def test_progress_goes_from_nothing_to_all() -> None:
    seen: list[tuple[str, float]] = []
    chosen: list[MethodName] = ["rk4", "taylor", "rk4"]
    work_precision(
        RODS, START, 1.0, chosen, points=2, timed=False, progress=lambda *each: seen.append(each)
    )
    shares = [share for _, share in seen]
    assert shares == sorted(shares)
    assert (shares[0], shares[-1]) == (0.0, 1.0)
    assert list(dict.fromkeys(label for label, _ in seen)) == ["reference", "rk4", "taylor", "done"]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"methods": ["rk5"]}, "methods must be one of"),
        ({"methods": []}, "methods must name at least one method, got none"),
        (
            {"methods": ["verlet"], "system": RODS, "state": START},
            "methods 'verlet' needs a system",
        ),
        ({"t_max": 0.0}, "t_max must differ from t0"),
        ({"t_max": 1e9}, "t_max must differ from t0, by at most 100000 of"),
        ({"t_max": math.inf}, "t_max must be a finite number"),
        ({"points": 1}, "points must be at least 2, got 1"),
        ({"points": 101}, "points must be a whole number from 1 to 100, got 101"),
        ({"state": (1.0,)}, "state must be"),
        ({"system": "simple"}, "system must be a pendulum"),
    ],
)
def test_wrong_use_is_refused(given: dict[str, Any], message: str) -> None:
    usual: dict[str, Any] = {"system": SIMPLE, "state": LARGE, "t_max": 1.0}
    with pytest.raises(ValueError, match=message):
        work_precision(**(usual | given))


# ---- the figure ----


def test_every_method_looks_different() -> None:
    looks = {(line(each.name)["color"], MARKERS[each.name]) for each in METHODS}
    assert len(looks) == len(METHODS)
    marks = {each.name: MARKERS[each.name] for each in METHODS}
    for one in METHODS:
        for other in METHODS:
            same = marks[one.name] == marks[other.name]
            assert same == (one.order == other.order), (one.name, other.name)


def test_curves_are_the_errors_and_broken_runs_hollow(double: WorkPrecision) -> None:
    figure = plot.work_precision([double])
    left, right = figure.axes
    work = of(double, "rk4")
    for ax, cost in ((left, work.evaluations), (right, work.seconds)):
        curve = next(c for c in ax.lines if to_hex(str(c.get_color())) == line("rk4")["color"])
        assert np.array_equal(np.asarray(curve.get_xdata()), cost)
        assert np.array_equal(np.asarray(curve.get_ydata()), work.errors)
        hollow = [c for c in ax.lines if c.get_markerfacecolor() == "white" and len(c.get_xdata())]  # type: ignore[arg-type]
        assert [to_hex(str(c.get_color())) for c in hollow] == [line("midpoint")["color"]]
        assert np.asarray(hollow[0].get_ydata()).tolist() == [ax.get_ylim()[1]]


def test_cases_stand_side_by_side_or_in_rows(simple: WorkPrecision, double: WorkPrecision) -> None:
    beside = plot.work_precision([simple, double], ["a", "b"], against=("evaluations",))
    assert [ax.get_title(loc="left") for ax in beside.axes] == ["a", "b"]
    assert beside.axes[0].get_ylim() == beside.axes[1].get_ylim()
    assert len(plot.work_precision([double, double], ["a", "b"]).axes) == 4


@pytest.mark.parametrize(
    ("kind", "start"), [("png", b"\x89PNG"), ("pdf", b"%PDF-"), ("svg", b"<?xml")]
)
def test_a_picture_is_the_same_each_time(double: WorkPrecision, kind: str, start: bytes) -> None:
    one, two = (plot.picture(plot.work_precision([double]), kind) for _ in range(2))
    assert one == two
    assert one.startswith(start)
