"""What a motion cannot reach, or only in very many steps, is said before the run."""

from __future__ import annotations

import warnings
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

import pendula
from pendula import (
    DoublePendulum,
    LinearPendulum,
    SimplePendulum,
    StiffWarning,
    ensemble,
    poincare_section,
    solve,
)
from pendula.events import Event, angle, flip, tip_height, velocity_zero
from pendula.sweeping import read_sweep
from refusals import told

if TYPE_CHECKING:
    from collections.abc import Callable

    from commands import Call

SIMPLE, RODS = SimplePendulum(), DoublePendulum.rods()
START = (2.0, 2.5, 0.0, 0.0)
RECIPE: dict[str, Any] = {"system": {"kind": "simple"}, "run": {"t_max": "1 s"}}


# ---- stiff systems ----


@pytest.mark.parametrize(
    "call",
    [
        lambda system: solve(system, START, 1.0, max_steps=10),
        lambda system: solve(system, START, -1.0, max_steps=10),
        lambda system: solve(system, START, [0.5, 1.0], "rk4", step=0.1),
        lambda system: ensemble(system, [START, START], 1.0, max_steps=10),
        lambda system: ensemble([DoublePendulum.bobs(), system], START, 1.0, max_steps=10),
    ],
)
def test_a_stiff_system_is_said_to_be(call: Callable[[Any], object]) -> None:
    with pytest.warns(
        StiffWarning, match="is stiff: its fast mode swings .* times in the 1 s of"
    ) as told:
        call(DoublePendulum.bobs(m1=1e-12))
    assert [each.filename for each in told] == [__file__]


def test_a_sweep_looks_at_the_ends_of_its_ranges() -> None:
    masses = {"log_uniform": ["1e-12 kg", "1 kg"]}
    run = {"t_max": "1 s", "draws": 3, "max_steps": 10}
    with pytest.warns(StiffWarning, match=r"bobs\(m1=1e-12"):
        read_sweep({"system": {"kind": "double", "form": "bobs", "m1": masses}, "run": run})


def test_the_command_says_it_in_one_line(
    call: Call, monkeypatch: pytest.MonkeyPatch, recwarn: pytest.WarningsRecorder
) -> None:
    warnings.simplefilter("default")
    code, _, printed = call("solve double --bobs --m1 1e-12kg --t-max 1s --max-steps 10")
    first, last = printed.splitlines()
    assert code == 1
    assert first.startswith("pendula: warning: DoublePendulum.bobs(m1=1e-12, ")
    assert "it took the 10 steps that were allowed" in last


def test_usual_systems_are_not_stiff() -> None:
    solve(DoublePendulum.bobs(m1=1e-5), START, 10.0)
    solve(DoublePendulum.bobs(m1=1e-12), START, 1e-3)
    solve(DoublePendulum.rods(m2=1e-6, l2=0.01), START, 10.0)
    solve(SIMPLE, (1.0, 0.0), 1e5, max_steps=10)


# ---- sections ----

FORBIDDEN = [
    (RODS, (0.1, 0.1, 0.0, 0.0), flip(1), "needs an energy of 29.4"),
    (RODS, (0.1, 0.1, 0.0, 0.0), flip(2), "needs an energy of 9.8"),
    (RODS, (0.1, 0.1, 0.0, 0.0), angle(2, 1.5), "needs an energy of"),
    (RODS, (0.1, 0.1, 0.0, 0.0), tip_height(0.0), "needs an energy of"),
    (RODS, START, tip_height(2.1), "never is so far from the pivot"),
    (RODS, START, tip_height(-2.1), "never is so far from the pivot"),
    (
        RODS,
        (0.3, 0.1, 0.0, 0.0),
        angle(1, 6.41234),
        "rod 1 does not get over the top, to 6.41234 rad",
    ),
    (RODS, (0.0, 0.0, 0.0, 0.0), angle(1, 0.0), "state is an equilibrium"),
    (SIMPLE, (1.0, 0.0), flip(1), "needs an energy of 19.6133 J, and the motion has 4.50"),
    (SIMPLE, (1.0, 0.0), angle(1, -1.1, every_turn=True), "needs an energy of"),
    (SIMPLE, (1.0, 0.0), angle(1, 100.123), "needs an energy of|does not get over the top"),
    (SIMPLE, (1.0, 0.0), tip_height(-0.5), "needs an energy of"),
    (SIMPLE, (0.0, 9.0), velocity_zero(1), "turns over the top and never stands still"),
    (SIMPLE, (0.0, 9.0), angle(1, 0.5, -1, every_turn=True), "over the top, the other way"),
    (SIMPLE, (0.0, 9.0), angle(1, 0.5), "so often: the pendulum turns over the top and does not"),
    (SIMPLE, (0.0, -9.0), angle(1, 0.5), "does not come back; give every_turn=True"),
    (LinearPendulum(), (1.0, 0.0), angle(1, 1.1), "needs an energy of"),
    (LinearPendulum(), (1.0, 0.0), tip_height(1.5), "never is so far from the pivot"),
    (LinearPendulum(), (0.0, 0.0), velocity_zero(1), "state is an equilibrium"),
]


@pytest.mark.parametrize(("system", "state", "event", "message"), FORBIDDEN)
def test_a_section_that_the_energy_forbids_is_refused_before_the_run(
    system: Any, state: Any, event: Event, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("pendula._engine.solve", lambda *_: pytest.fail("it ran"))
    with pytest.raises(ValueError, match=message):
        poincare_section(system, state, event, 3)


@pytest.mark.parametrize("seed", range(20))
def test_what_a_motion_crosses_is_not_forbidden(seed: int) -> None:
    """Each place that a long run passes can be made a section of it."""
    draw = np.random.default_rng(seed)
    system = [SIMPLE, RODS, DoublePendulum.bobs(2.0, 0.3, 0.5, 1.7)][seed % 3]
    rods = system.can.degrees_of_freedom
    state = np.r_[draw.uniform(-9, 9, rods), draw.normal(scale=3, size=rods)]
    run = solve(system, state, np.linspace(0.0, 20.0, 400))
    i = int(draw.integers(rods))
    heights = run.positions[:, -1, 1]
    inside = float(draw.uniform(heights.min(), heights.max()))
    events = [
        *(
            angle(i + 1, float(each))
            for each in draw.uniform(run.states[:, i].min(), run.states[:, i].max(), 3)
        ),
        tip_height(inside),
    ]
    for each in events:
        assert len(poincare_section(system, state, each, 1, max_steps=100_000).times) == 1


def test_a_rotation_passes_an_angle_ahead_once() -> None:
    for omega, value in ((9.0, 7.123), (-9.0, -7.123)):
        found = poincare_section(SIMPLE, (0.0, omega), angle(1, value), 1)
        assert found.states[0, 0] == pytest.approx(value)
        with pytest.raises(ValueError, match="does not come back"):
            poincare_section(SIMPLE, (0.0, omega), angle(1, -value), 1)
        every = angle(1, value, every_turn=True)
        assert len(poincare_section(SIMPLE, (0.0, omega), every, 5).times) == 5
    assert len(poincare_section(SIMPLE, (0.0, 9.0), tip_height(0.0), 4).times) == 4


def test_a_section_shows_how_far_it_is() -> None:
    seen: list[float] = []
    plane = angle(1, 0.0, 1, every_turn=True)
    found = poincare_section(RODS, START, plane, 2000, progress=seen.append)
    assert len(seen) > 5
    assert seen == sorted(seen)
    assert 0.0 <= seen[0] < 0.5 < seen[-1] <= 1.0
    np.testing.assert_array_equal(found.times, poincare_section(RODS, START, plane, 2000).times)
    assert "progress must be a function" in told(
        lambda: poincare_section(RODS, START, plane, 2, progress=3)  # type: ignore[arg-type]
    )


def test_the_names_are_there() -> None:
    assert issubclass(pendula.StiffWarning, UserWarning)
