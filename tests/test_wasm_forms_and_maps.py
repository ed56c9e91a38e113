"""The laboratory's module computes the bits of the package: closed forms and flip maps."""

from __future__ import annotations

import math
from typing import cast

import numpy as np
import pytest

from catalogue import SYSTEMS, any_states, label, made
from pendula import DoublePendulum, exact, flip_map
from pendula.systems import System
from wasm_lab import described, listed, same_bits, the_lab

SOLVABLE = [each for each in SYSTEMS if each.can.closed_form]
PERIODIC = [each for each in SOLVABLE if each.can.period]


@pytest.mark.parametrize("system", SOLVABLE, ids=label)
def test_closed_forms_have_the_bits_of_exact(system: System) -> None:
    states = np.concatenate(
        [any_states(system, 40), [[math.pi, 0.0], [1e-9, 0.0], [3.1415, 1e-6], [0.0, 7.0]]]
    )
    times = np.concatenate([np.linspace(-3.0, 20.0, 17), [1e9]])
    (found,) = the_lab().ask("exact", [*described(system), *listed(states), 0.25, *listed(times)])
    assert same_bits(found, exact(system, states, times, t0=0.25).states)
    one = states[:1]
    (found,) = the_lab().ask("exact", [*described(system), *listed(one), 0.0, *listed(times)])
    assert same_bits(found, exact(system, one, times).states)


@pytest.mark.parametrize("system", PERIODIC, ids=label)
def test_periods_have_the_bits_of_the_package(system: System) -> None:
    states = np.abs(any_states(system, 30))
    asked = [*described(system), *listed(states)]
    (found,) = the_lab().ask("periods", asked)
    assert same_bits(found, system.period(state=states))  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    ("form", "theta1", "theta2", "shape", "which", "resolve"),
    [
        ("rods", (-3.0, 3.0), (-3.0, 3.0), (24, 24), None, True),
        ("rods", (0.5, 3.1), (-3.0, 1.0), (13, 17), 1, False),
        ("bobs", (-2.9, 3.1), (1.0, 8.95432), (12, 11), 2, True),
        ("bodies", (1.0, 1.0001), (2.0, 2.0001), (9, 9), None, True),
    ],
)
def test_flip_maps_have_the_bits_of_flip_map(
    form: str,
    theta1: tuple[float, float],
    theta2: tuple[float, float],
    shape: tuple[int, int],
    which: int | None,
    resolve: bool,
) -> None:
    system, t_max, tolerance = made("double", form), 8.0, 1e-8
    expected = flip_map(
        cast(DoublePendulum, system),
        theta1,
        theta2,
        shape,
        t_max,
        which,
        tolerance=tolerance,
        resolve=resolve,
    )
    assert 0 < np.isfinite(expected.flip_time).sum() < expected.flip_time.size or form == "bodies"
    how = [t_max, tolerance, float(which or 0), float(resolve)]
    for rows, columns in ((slice(0, shape[0]), slice(0, shape[1])), (slice(3, 8), slice(5, 6))):
        spans = [
            *(*theta1, shape[0], rows.start, rows.stop),
            *(*theta2, shape[1], columns.start, columns.stop),
        ]
        first, second, time, rod, forbidden, resolved = the_lab().ask(
            "flip_cells", [*described(system), *how, *map(float, spans)]
        )
        part = expected.isel(theta1=rows, theta2=columns)
        assert same_bits(first, part.theta1)
        assert same_bits(second, part.theta2)
        assert same_bits(time, part.flip_time)
        assert same_bits(rod, part.flipped_rod)
        assert same_bits(forbidden, part.forbidden)
        assert same_bits(resolved, part.resolved if resolve else [])
