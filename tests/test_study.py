"""The study from end to end, with a recipe that is quickly cooked."""

from __future__ import annotations

import csv
import json
import math
import re
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from pendula.study import run_study
from pendula.study.errata import errata
from report_page import page, signs

if TYPE_CHECKING:
    from pendula.study.errata import Language

    Studies = tuple[Path, list[tuple[str, float]]]

RECIPE = """
[simple]
until = "6 s"
output = "20 ms"
[linear_model]
amplitudes = ["5 deg", "90 deg"]
[elliptic]
largest_terms = 20000
[convergence]
steps = ["8 ms", "4 ms", "2 ms", "1 ms", "0.5 ms", "0.25 ms"]
[work]
swings = 2
points = 6
[double]
l2 = "80 cm"
theta2 = "2.5 rad"
until = "12 s"
output = "20 ms"
reference_step = "0.5 ms"
"""
LANGUAGES = ("en", "es")


@pytest.fixture(scope="module")
def studies(tmp_path_factory: pytest.TempPathFactory) -> Studies:
    folder = tmp_path_factory.mktemp("studies")
    (folder / "quick.toml").write_text(RECIPE)
    seen: list[tuple[str, float]] = []
    for language in LANGUAGES:
        run_study(
            folder / "quick.toml",
            folder / language,
            language,
            progress=lambda *each: seen.append(each),
        )
    return folder, seen


@pytest.fixture(params=LANGUAGES)
def study(request: pytest.FixtureRequest, studies: Studies) -> tuple[Path, str]:
    return studies[0] / request.param, request.param


def _table(folder: Path, name: str) -> dict[str, list[str]]:
    with (folder / "data" / f"{name}.csv").open(encoding="utf-8") as file:
        header, *rows = csv.reader(file)
    return {column: [row[i] for row in rows] for i, column in enumerate(header)}


def _files(folder: Path, pattern: str) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in sorted(folder.glob(pattern))}


def test_everything_is_written_and_nothing_else(study: tuple[Path, str]) -> None:
    folder, _ = study
    assert {p.name for p in folder.iterdir()} == {
        "report.html", "report.pdf", "figures", "data", "recipe.toml",
    }  # fmt: skip
    assert len(_files(folder, "figures/*.svg")) == len(list((folder / "figures").iterdir())) == 15
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF-")
    assert {p.name for p in folder.parent.iterdir()} == {"quick.toml", "en", "es"}  # no scratch


def test_the_page_needs_nothing_else(study: tuple[Path, str]) -> None:
    found = page(study[0])
    inside = re.compile(r"#|data:image/svg\+xml;base64,")
    assert [r for r in found.references if not inside.match(r)] == ["https://dlmf.nist.gov"]
    assert "link" not in found.tags
    source = (study[0] / "report.html").read_text(encoding="utf-8")
    assert "@import" not in source
    assert "url(" not in source
    assert found.tags.count("img") == 15


def test_formulas_and_figures_are_numbered_in_the_language(study: tuple[Path, str]) -> None:
    folder, language = study
    text = page(folder).words
    for number in range(1, 20):
        assert f"({number})" in text
    figure, table = {"en": ("Figure", "Table"), "es": ("Figura", "Tabla")}[language]
    for number in range(1, 16):
        assert f"{figure} {number}" in text or f"{figure}\N{NO-BREAK SPACE}{number}" in text
    for number in range(1, 11):
        assert f"{table} {number}" in text or f"{table}\N{NO-BREAK SPACE}{number}" in text


def test_dots_stand_above_their_letters(study: tuple[Path, str]) -> None:
    source = (study[0] / "report.html").read_text(encoding="utf-8")
    assert not re.search("<mo>[\u0307\u0308]</mo>", source)
    assert len(re.findall("<mo>[\u02d9\u00a8]</mo>", source)) > 10


def test_the_decimal_sign_is_that_of_the_language(study: tuple[Path, str]) -> None:
    folder, language = study
    text = "\n".join(page(folder).text)
    # What is no number: the version, the sections of the DLMF, and the report's own.
    text = re.sub(r"0\.1\.0|19\.5, 19\.8 (and|y) 22\.19|^\d\.\d (?=[^\W\d])", "", text, flags=re.M)
    other = {"en": r"\d,\d", "es": r"\d\.\d"}[language]
    assert re.findall(rf".*{other}.*", text) == []


def test_spanish_is_spanish(studies: Studies) -> None:
    text = " ".join(page(studies[0] / "es").text).lower()
    words = set(re.findall(r"[a-z]+", text))
    assert not words & {"the", "and", "with", "angle", "time", "step", "error of", "until", "exact"}
    assert {"período", "péndulo"} <= set(re.findall(r"\w+", text))


def test_all_errata_stand_in_the_report(study: tuple[Path, str]) -> None:
    """Each formula as mathematics, sign for sign that of the page of plain text."""
    folder, language = study
    code: Language = "en" if language == "en" else "es"
    found = page(folder).cells[-3 * len(errata()) :]
    assert len(errata()) == 24
    for row, cells in zip(errata(), zip(*[iter(found)] * 3, strict=True), strict=True):
        equation, formulas, why = cells
        assert signs(equation["all"]) == signs(row.equation[code])
        assert signs(formulas["formulas"]) == signs(row.printed[code] + row.correct[code]), row.id
        assert not formulas["words"].strip(), row.id
        assert signs(why["all"]) == signs(row.why[code]), row.id
        said = re.sub(r"\$[^$]*\$", "", row.why.marked[code])
        assert signs(why["words"]) == signs(said), row.id


def test_data_have_units_and_read_back_exactly(study: tuple[Path, str]) -> None:
    table = _table(study[0], "simple_methods")
    assert list(table)[:4] == [
        "t [s]", "exact theta [rad]", "exact omega [rad/s]", "exact energy [J]",
    ]  # fmt: skip
    assert len(table["t [s]"]) == 301
    for column in table.values():
        assert all(repr(float(cell)) == cell for cell in column)


def test_every_column_says_its_unit_and_counts_well(study: tuple[Path, str]) -> None:
    words = {"system", "method", "outcome"}
    for path in sorted((study[0] / "data").glob("*.csv")):
        for column in _table(study[0], path.stem):
            assert column in words or re.search(r" \[(1|s|1/s|rad|rad/s|J|J s)\]$", column), (
                path.name
            )
            assert not re.search(r"\b1 \w+s\b", column)
    for name, count in (("convergence", 9), ("simple_work", 1), ("double_work", 1)):
        assert sum("error at the outputs" in each for each in _table(study[0], name)) == count


def test_periods_against_the_known_ones(study: tuple[Path, str]) -> None:
    table = _table(study[0], "periods")
    period = float(
        table["exact period [s]"][table["amplitude [rad]"].index(repr(math.radians(150)))]
    )
    # T/T0 for 150°, from mpmath with 40 digits.
    known = 1.76220372950375603 * math.tau * math.sqrt(0.5 / 9.80665)
    assert period == pytest.approx(known, rel=1e-15)


def test_double_reference_against_an_independent_integration(study: tuple[Path, str]) -> None:
    table = _table(study[0], "double_methods")
    g, l1, l2 = 9.80665, 1.0, 0.8

    def rods(_: float, state: Any) -> tuple[float, ...]:
        # The paper's (49) and, with l2 in its denominator, (50), for m1 = m2 = 1.
        a, b, u, v = state
        d = a - b
        p = g * math.sin(b) - l1 * u * u * math.sin(d)
        q = l2 * v * v * math.sin(d) + 3 * g * math.sin(a)
        below = 23 - 9 * math.cos(2 * d)
        return (
            u,
            v,
            (18 * math.cos(d) * p - 12 * q) / (l1 * below),
            (18 * math.cos(d) * q - 48 * p) / (l2 * below),
        )

    start = (math.radians(120), 2.5, 0.0, 0.0)
    truth = solve_ivp(rods, (0, 5), start, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    row = table["t [s]"].index("5.0")
    names = ("theta1 [rad]", "theta2 [rad]", "omega1 [rad/s]", "omega2 [rad/s]")
    got = [float(table[f"reference {name}"][row]) for name in names]
    np.testing.assert_allclose(got, truth, atol=1e-6)


def test_orders_are_measured(study: tuple[Path, str]) -> None:
    table = _table(study[0], "orders")
    theory = {"euler": 1, "heun": 2, "rk4": 4}
    assert len(table["order [1]"]) == 9
    for method, order in zip(table["method"], table["order [1]"], strict=True):
        assert float(order) == pytest.approx(theory[method], abs=0.1)


def test_the_report_says_what_precision_costs(study: tuple[Path, str]) -> None:
    text = page(study[0]).words
    told = {
        "en": "For the double pendulum Taylor reaches it with the fewest evaluations, about ",
        "es": "En el péndulo doble lo alcanza con menos evaluaciones Taylor, con unas ",
    }[study[1]]
    assert told in text
    assert "pendula compare" in text


def test_parting_times_are_where_the_differences_pass_the_tolerance(
    study: tuple[Path, str],
) -> None:
    motion, parting = _table(study[0], "double_methods"), _table(study[0], "parting")
    t = np.array(motion["t [s]"], dtype=float)
    for method, time in zip(parting["method"][:3], parting["time [s]"], strict=False):
        apart = np.array(motion[f"{method} difference [rad]"], dtype=float)
        tolerance, moment = math.radians(1), float(time)
        assert np.all(apart[t < moment] <= tolerance)
        if math.isfinite(moment):
            assert apart[t >= moment][0] > tolerance
    assert float(parting["time [s]"][0]) < float(parting["time [s]"][2])


def test_motions_are_those_of_the_runs(study: tuple[Path, str]) -> None:
    source = (study[0] / "report.html").read_text(encoding="utf-8")
    stored = re.search(r'<script type="application/json" id="motions">(.*?)</script>', source, re.S)
    assert stored
    data = json.loads(stored[1])
    double = data["motions"]["double"]
    table = _table(study[0], "double_methods")
    every = round(double["interval"] / float(table["t [s]"][1]))
    for run, name in zip(double["runs"], ("reference", "euler", "heun", "rk4"), strict=True):
        for i in (0, 1):
            column = np.array(table[f"{name} theta{i + 1} [rad]"], dtype=float)[::every]
            np.testing.assert_allclose(np.cumsum(run["angles"][i]) / 1e4, column, atol=6e-5)
    assert set(data["motions"]) == {"gentle", "large", "double"}
    assert data["decimal"] == {"en": ".", "es": ","}[study[1]]
    assert page(study[0]).classes.count("player") == 3


def test_the_written_recipe_gives_the_same_again(studies: Studies, tmp_path: Path) -> None:
    folder = studies[0] / "es"
    again = run_study(folder / "recipe.toml", tmp_path / "again", "es")
    for pattern in ("data/*.csv", "figures/*.svg", "recipe.toml", "report.*"):
        assert _files(again, pattern) == _files(folder, pattern)


def test_the_language_changes_no_number(studies: Studies) -> None:
    english, spanish = (_files(studies[0] / language, "data/*.csv") for language in LANGUAGES)
    assert len(english) == 16
    assert english == spanish


def test_progress_goes_from_nothing_to_all(studies: Studies) -> None:
    shares = [share for _, share in studies[1]]
    half = len(shares) // 2
    for each in (shares[:half], shares[half:]):
        assert each == sorted(each)
        assert (each[0], each[-1]) == (0.0, 1.0)
    assert len({label for label, _ in studies[1]}) == 8
