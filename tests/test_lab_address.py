"""Links of the laboratory: read, refused, written; a run that comes of one has the same bits."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import pendula
from pendula.lab import Recipe, read_link
from pendula.lab.address import is_link, number_of, rows, written
from pendula.lab.recipe import losses
from refusals import told
from test_readme import ROOT

CASES = json.loads((Path(__file__).parent / "data/addresses.json").read_text(encoding="utf-8"))
RODS = pendula.DoublePendulum.rods(m1=0.1, m2=1.0 / 3.0)
SIMPLE = pendula.SimplePendulum(length=0.5)
DRIVEN = pendula.DrivenPendulum.bob(viscous=0.1, torque=-0.0, drive_frequency=2.0 / 3.0)
SIDEWAYS = pendula.DrivenPendulum.bob(
    pivot_amplitude=0.1,
    pivot_frequency=9.0,
    pivot_direction=0.0,  # a zero that is not standard
)
BODIES = pendula.DampedDoublePendulum.bodies(1, 1, 1, 0.5, 0.5, 0.1, 0.1, viscous=(0.1, 0.0))
FRICTION = pendula.LinearPendulum(viscous=0.2, torque=0.1, drive_frequency=3.0)


# ---- the cases that the page reads, too ----


@pytest.mark.parametrize("case", CASES["good"], ids=lambda case: case["link"])
def test_a_good_link_is_read(case: dict[str, Any]) -> None:
    recipe = read_link(case["link"])
    description = recipe.system.description()
    found = {
        "system": description["name"],
        "form": description["form"],
        "state": list(recipe.state),
        "t0": recipe.t0,
        "t_max": recipe.t_max,
        "every": recipe.every,
        "method": recipe.method,
        **recipe.options,
    }
    assert {key: found[key] for key in case["recipe"]} == case["recipe"]


@pytest.mark.parametrize("case", CASES["bad"], ids=lambda case: case["link"])
def test_a_bad_link_is_refused_in_a_line_that_names_the_key(case: dict[str, Any]) -> None:
    message = told(lambda: read_link(case["link"]))
    assert message.startswith("the link: ")
    assert case["names"] in message.removeprefix("the link: ").partition(" must")[0].split("; ")[0]


@pytest.mark.parametrize("case", CASES["of Python alone"], ids=lambda case: case["link"])
def test_a_link_that_the_page_refuses_is_read(case: dict[str, Any]) -> None:
    assert case["names"] in read_link(case["link"]).options


def test_the_way_out_of_a_link_names_its_keys() -> None:
    said = told(lambda: read_link("#system=simple&t_max=1&method=rk4"))
    assert said == "the link: step is needed by the fixed-step method 'rk4'; give step=0.001, say"
    said = told(lambda: read_link("#system=simple&t_max=1&lenght=2"))
    assert said.endswith("did you mean 'length'?")
    many = told(lambda: read_link("#system=simple&t_max=1e9&method=rk4&step=1e-6"))
    assert "give output times, such as every" in many


def test_every_page_that_a_link_is_on_gives_the_same_recipe() -> None:
    fragment = "#system=simple&t_max=10&method=rk4&step=0.01"
    bare = read_link(fragment)
    for page in ("http://127.0.0.1:8642/", "https://example.org/a/lab.html", "file:///x/lab.html"):
        assert read_link(page + fragment) == bare
    assert read_link(f" {fragment}\n") == bare


@pytest.mark.parametrize("link", [None, 1, Path("run.csv"), b"#system=simple&t_max=1"])
def test_a_link_is_text(link: Any) -> None:
    assert told(lambda: read_link(link)).startswith(f"the link: must be text, got {link!r}; write")


def test_a_path_is_no_link(tmp_path: Path) -> None:
    numbered = tmp_path / "run#1.csv"
    numbered.touch()
    assert not is_link(str(numbered))
    assert not is_link("run.csv")
    assert not is_link("run#2.csv")
    assert not is_link("#")
    assert is_link("#system=simple&t_max=1")
    assert is_link("http://127.0.0.1:8642/")


# ---- numbers ----


@given(st.floats(allow_nan=False, allow_infinity=False))
def test_a_number_keeps_its_bits(value: float) -> None:
    text = written(value)
    assert np.float64(number_of("x", text)).tobytes() == np.float64(value).tobytes()
    assert "+" not in text


@given(st.text(alphabet="0123456789.eE+-_ ,xaninf", max_size=8))
def test_a_text_is_a_number_or_is_refused(text: str) -> None:
    """What Python's float takes beyond that (1_0, inf, nan, spaces) is none."""
    if re.fullmatch(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", text) and float(text) < math.inf:
        assert number_of("x", text) == float(text)
    else:
        assert told(lambda: number_of("x", text)).startswith("x must ")


# ---- a run, its link, and the run again ----

RUNS = [
    (RODS, (2.0, -0.1, 0.5, -0.0), 3.0, "rk4", {"step": 0.001}),
    (RODS, (2.0, -0.1, 0.5, 0.0), 3.0, "taylor", {}),
    (RODS, (2.0, -0.1, 0.5, 0.0), 3.0, "dop853", {"tolerance": 1e-7, "certify": 1e-5}),
    (RODS, (2.0, -0.1, 0.5, 0.0), 1.0, "taylor", {"digits": 12}),
    (SIMPLE, (3.0, 0.1), -3.0, "yoshida6", {"step": 0.01, "t0": 1.5}),
    (SIMPLE, (3.0, 0.1), 10.0, "taylor", {"max_steps": 20}),
    (DRIVEN, (1.0 / 3.0, 0.0), 5.0, "taylor", {}),
    (SIDEWAYS, (1.0, 0.0), 5.0, "taylor", {}),
    (BODIES, (1.0, 0.0, 0.0, 0.0), 2.0, "rk4", {"step": 0.01}),
    (FRICTION, (1.0, 0.0), 2.0, "heun", {"step": 0.01}),
]


@pytest.mark.parametrize(("system", "state", "t", "method", "options"), RUNS)
def test_the_link_of_a_run_gives_its_bits(
    system: Any, state: tuple[float, ...], t: float, method: Any, options: dict[str, Any]
) -> None:
    run = pendula.solve(system, state, t, method, **options)
    recipe = Recipe.of(run)
    assert losses(run) == []
    again = read_link(recipe.link()).run()
    assert again.system == run.system
    assert (again.t.tobytes(), again.states.tobytes()) == (run.t.tobytes(), run.states.tobytes())
    assert (again.outcome, again.trust_horizon) == (run.outcome, run.trust_horizon)


@pytest.mark.parametrize("t0", [0.0, 0.5])
@pytest.mark.parametrize("every", [0.01, 0.3, 1.0 / 3.0, 0.0625])
@pytest.mark.parametrize("t_max", [7.0, -7.0])
def test_output_times_at_equal_distances_are_kept(t0: float, every: float, t_max: float) -> None:
    from pendula.run._times import spaced

    times = spaced(t0, t_max, every)
    run = pendula.solve(RODS, (1.0, 0.0, 0.0, 0.0), times, t0=t0)
    assert losses(run) == []
    again = read_link(Recipe.of(run).link()).run()
    assert (again.t.tobytes(), again.states.tobytes()) == (run.t.tobytes(), run.states.tobytes())


def test_the_closed_form_has_a_link() -> None:
    from pendula.run._times import spaced

    run = pendula.exact(SIMPLE, (3.0, 0.1), spaced(0.0, 2.0, 0.1))
    again = read_link(Recipe.of(run).link()).run()
    assert again.method == "exact"
    assert again.states.tobytes() == run.states.tobytes()
    assert read_link("#system=simple&t_max=1&method=exact").run().t.size == 501


def test_what_a_link_does_not_hold_is_told() -> None:
    events = [pendula.events.flip(1)]
    run = pendula.solve(RODS, (1.0, 0.0, 0.0, 0.0), [0.1, 0.15, 0.3], events=events)
    assert losses(run) == ["events", "output times"]
    back = pendula.exact(SIMPLE, (1.0, 0.0), [1.0, -2.0, 0.5])
    assert losses(back) == ["output times"]
    assert Recipe.of(back).t_max == -2.0


def test_several_motions_have_no_link() -> None:
    run = pendula.exact(SIMPLE, [(1.0, 0.0), (2.0, 0.0)], [1.0])
    assert told(lambda: Recipe.of(run)) == "run must be one motion, got 2 of them"


def test_every_parameter_of_every_form_is_a_key() -> None:
    """A new system of the catalogue has its links by itself."""
    from pendula._engine import system_entries

    for entry in system_entries().values():
        for form in entry.forms:
            values = {row.name: 0.5 for row in form.parameters}
            keys = "&".join(f"{key}={value}" for key, value in values.items())
            own = f"&form={form.name}" if form.name else ""
            recipe = read_link(f"#system={entry.name}{own}&{keys}&t_max=1")
            assert recipe.system.description()["parameters"] == values


def test_what_a_run_alone_can_tell_is_told_of_the_link() -> None:
    recipe = read_link("#system=simple&t_max=1e80&method=exact")
    assert told(recipe.run).startswith("the link: t_max must lie within 2^200 half periods of t0")


# ---- the documentation ----


@pytest.mark.parametrize("language", ["en", "es"])
def test_the_pages_list_the_keys(language: str) -> None:
    text = (ROOT / "docs" / language / "lab.md").read_text(encoding="utf-8")
    told = re.findall(r"^\| `(\w+)` \|", text, re.MULTILINE)
    assert told == [*rows("recipe"), *rows("page")]
    for row in rows("page").values():
        for choice in row.get("choices", ()):
            assert f"`{choice}`" in text
