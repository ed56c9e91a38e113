"""`pendula fit`: from a file to values with their uncertainty, in one line where it cannot."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest

from commands import unfolded
from recordings import recording as real
from report_page import page
from swung import OMEGA2, recording

if TYPE_CHECKING:
    from commands import Call


def written(name: str = "swing.csv") -> str:
    """A recording in the current folder."""
    made = recording()
    rows = np.column_stack([made.t, np.degrees(made.values[:, 0])]).tolist()
    lines = [f"{t:.4f},{theta:.6f}" for t, theta in rows]
    Path(name).write_text("\n".join(["time (s),angle (deg)", *lines]) + "\n", encoding="utf-8")
    return name


def quiet(call: Call, line: str) -> str:
    code, printed, error = call(line)
    assert (code, error) == (0, "")
    return unfolded(printed)


def value(printed: str, name: str, decimal: str = ".") -> tuple[float, float]:
    """A value and its error, as the table has them."""
    number = rf"[−\d{decimal}]+"
    found = re.search(rf"^{re.escape(name)} +({number}) ± ({number})", printed, re.MULTILINE)
    assert found, printed
    first, second = (each.replace("−", "-").replace(decimal, ".") for each in found.groups())
    return float(first), float(second)


def test_values_have_their_uncertainty_and_unit(call: Call) -> None:
    printed = quiet(call, f"fit {written()} --length 49cm --model viscous")
    found, error = value(printed, "gravity g")
    assert abs(found - OMEGA2 * 0.49) <= 3.0 * error
    assert "gravity g                      9." in printed
    assert "m/s²\n" in printed
    assert printed.startswith("viscous friction\n")


def test_error_of_the_length_widens_that_of_g(call: Call) -> None:
    printed = quiet(call, f"fit {written()} --length 49cm --length-error 1cm --model viscous")
    assert value(printed, "gravity g")[1] == pytest.approx(OMEGA2 * 0.01, rel=0.06)


def test_spanish_is_spanish(call: Call) -> None:
    printed = quiet(call, f"fit {written()} --lang es --model viscous")
    found, error = value(printed, "frecuencia propia ω₀", ",")
    assert abs(found - math.sqrt(OMEGA2)) <= 3.0 * error
    assert "rozamiento viscoso\n" in printed


def test_report_is_written_and_named(call: Call) -> None:
    printed = quiet(
        call, f"fit {written()} --model viscous --report out --author 'Ana Gil' --title 'A swing'"
    )
    assert printed.splitlines()[-1] == str(Path("out") / "report.html")
    shown = page(Path("out")).words
    assert "Ana Gil" in shown
    assert "A swing" in shown


def test_existing_report_is_refused_before_the_fit(call: Call) -> None:
    Path("out").mkdir()
    code, printed, error = call(f"fit {written()} --report out")
    assert (code, printed) == (2, "")
    assert error == "pendula: out exists; choose another name, or pass --force\n"


def test_models_are_compared_unless_one_is_named(call: Call) -> None:
    printed = quiet(call, f"fit {written()}")
    rows = printed.splitlines()
    assert rows[0].split() == ["model", "residuals", "BIC", "above", "the", "best"]
    bic = {row.rsplit(None, 2)[0]: int(row.split()[-1].replace("\u202f", "")) for row in rows[1:12]}
    assert bic["viscous friction"] < 3
    assert bic["undamped"] > 100
    assert "described by this model: viscous friction." in printed
    assert value(printed, "natural frequency ω₀")[0] == pytest.approx(math.sqrt(OMEGA2), rel=1e-3)


def test_model_is_named(call: Call) -> None:
    printed = quiet(call, f"fit {written()} --model viscous+quadratic")
    assert printed.startswith("viscous friction + quadratic drag\n")
    code, _, error = call(f"fit {written()} --model viscus")
    assert code == 2
    assert error.count("\n") == 1
    assert "--model" in error
    assert "viscous" in error


def test_wrong_column_is_one_line(call: Call) -> None:
    code, _, error = call(f"fit {written()} --angle phi")
    assert code == 2
    assert error.count("\n") == 1
    assert "--angle" in error


def test_recordings_are_fitted_together(call: Call) -> None:
    first, second = written("first.csv"), written("second.csv")
    alone = value(quiet(call, f"fit {first} --model viscous"), "natural frequency ω₀")
    line = f"fit {first} {second} --model viscous --report out --lang en"
    printed = quiet(call, line)
    together = value(printed, "natural frequency ω₀")
    assert together[0] == pytest.approx(alone[0], abs=1e-4)
    assert together[1] == pytest.approx(alone[1] / math.sqrt(2.0), rel=0.15)
    assert "angle at the start[2]" in printed
    assert "fitted together with second.csv" in page(Path("out")).words


def test_a_table_of_periods_is_fitted_alone(call: Call) -> None:
    Path("periods.csv").write_text("length (m),period (s)\n0.5,1.42\n1.0,2.01\n", encoding="utf-8")
    code, _, error = call(f"fit {written()} periods.csv")
    assert code == 2
    assert error == "pendula: periods.csv is a table of periods; give it alone\n"


def test_real_periods_need_the_number_of_swings(call: Call) -> None:
    file = real("periods_stopwatch.csv")
    code, _, error = call(f"fit {file}")
    assert code == 2
    assert "--swings 10" in error


def test_real_periods_give_g_with_corrections(call: Call) -> None:
    file = real("periods_stopwatch.csv")
    printed = quiet(call, f"fit {file} --swings 10 --amplitude 10deg --bob-radius 2cm")
    found, error = value(printed, "gravity g")
    assert abs(found - 9.81) < 2.0 * error < 0.7
    assert re.search(r"^finite amplitude +0\.38.%$", printed, re.MULTILINE)
    assert re.search(r"^size of the bob +0\.25.%$", printed, re.MULTILINE)


def test_corrections_are_chosen_by_name(call: Call) -> None:
    file = real("periods_stopwatch.csv")
    printed = quiet(call, f"fit {file} --swings 10 --corrections offset")
    found, error = value(printed, "offset of the lengths")
    assert abs(found) < 2.0 * error
    code, _, error_line = call(f"fit {file} --swings 10 --corrections bob")
    assert code == 2
    assert "give --bob-radius" in error_line


def test_real_swing_is_fitted(call: Call) -> None:
    file = real("single_three_runs_semicolon_degrees.csv")
    printed = quiet(call, f"fit {file} --run 1 --t 0.7s,100s --model viscous")
    found, error = value(printed, "ω₀² = g/L, or m g c/I")
    assert abs(found - 17.3418) < 3.0 * error < 0.01  # an independent least squares


def test_study_takes_a_recording(call: Call) -> None:
    file = written()
    Path("r.toml").write_text('[report]\nsections = ["errata"]\n', encoding="utf-8")
    code, printed, _ = call(f"study r.toml --out s --measured {file} --model viscous")
    assert code == 0
    assert printed.strip() == str(Path("s") / "report.html")
    assert "swing.csv" in page(Path("s")).words


def test_options_of_a_recording_need_one(call: Call) -> None:
    code, _, error = call("study --out s --run 2")
    assert code == 2
    assert error.startswith("pendula: --run goes with --measured; name the recording")
