"""How far runs of the adaptive methods come, and times they refuse."""

import numpy as np
import pytest

from pendula import DoublePendulum, solve
from pendula.events import flip


@pytest.mark.parametrize("t0", [1e14, -1e17])
def test_times_that_cannot_be_told_apart_are_refused(t0: float) -> None:
    with pytest.raises(ValueError, match="^t must be small enough to tell times apart.* t0"):
        solve(DoublePendulum.rods(), (2.0, 1.0, 0.0, 0.0), t0 + 1024.0, t0=t0)
    fine = solve(DoublePendulum.rods(), (2.0, 1.0, 0.0, 0.0), 1e9 + 1.0, t0=1e9)
    assert fine.outcome == "reached_end"


def test_how_far_a_run_came_counts_not_its_outputs() -> None:
    rods, state = DoublePendulum.rods(gravity=9.81), (2.0, 2.5, 0.0, 0.0)
    own = solve(rods, state, 30.0, certify=1e-9)
    ended = solve(rods, state, [0.0, 100.0], events=[flip(2, terminal=40)], certify=1e-9)
    assert (ended.outcome, ended.t.tolist()) == ("event", [0.0])
    assert ended.trust_horizon == own.trust_horizon
    crossings = ended.events[0]
    np.testing.assert_allclose(ended.at(crossings.times), crossings.states, rtol=0, atol=1e-12)
    stopped = solve(rods, state, [100.0], max_steps=1500, certify=1e-9)
    assert (stopped.outcome, stopped.t.size) == ("step_limit", 0)
    assert stopped.trust_horizon == own.trust_horizon
    fixed = solve(rods, state, [100.0], "rk4", step=1e-3, max_steps=20_000, certify=1e-6)
    whole = solve(rods, state, 20.0, "rk4", step=1e-3, certify=1e-6)
    assert whole.trust_horizon is not None
    assert whole.trust_horizon < 20.0
    assert fixed.trust_horizon == whole.trust_horizon
