"""Up to which time a run was made that stopped before its end."""

from __future__ import annotations

import numpy as np
import pytest

from pendula import LinearPendulum, ensemble, solve


@pytest.mark.parametrize("end", [1000.0, -1000.0])
@pytest.mark.parametrize("every", [0.05, 0.3, 1.0, 7.0])
@pytest.mark.parametrize("limit", [None, 100])
def test_a_run_that_stops_has_reached_what_its_whole_steps_came_to(
    limit: int | None, every: float, end: float
) -> None:
    """Steps shortened to an output beside the grid lead nowhere; alone and through the lanes."""
    system, start = LinearPendulum(0.5), (0.1, 0.0)
    times = np.arange(every, abs(end), every) * np.sign(end)
    run = solve(system, start, times, "rk4", step=1.0, max_steps=limit)
    assert run.outcome == ("step_limit" if limit else "not_finite")
    assert 0 <= (run.reached - run.t[-1]) * np.sign(end) <= 1.0 + every
    if not limit:  # it breaks down in a whole step or in a shortened one
        assert abs(run.reached - solve(system, start, end, "rk4", step=1.0).reached) <= 1.0
    lanes = ensemble(system, [start, (0.2, 0.0)], times, "rk4", step=1.0, max_steps=limit)
    assert lanes.reached[0] == run.reached
