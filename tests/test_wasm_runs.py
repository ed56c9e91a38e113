"""The laboratory's module computes the bits of the package: runs, grids, events, energies."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import pytest

from catalogue import ADAPTIVE, SYSTEMS, TAKEN, any_states, label, made, some_state
from pendula import ensemble, solve
from pendula._engine import Method
from pendula.chaos import megno
from pendula.events import angle, flip, tip_height, velocity_zero
from pendula.systems import System
from wasm_lab import RefusedError, described, listed, requested, same_bits, the_lab

if TYPE_CHECKING:
    from pendula._types import MethodName

OUTCOMES = "reached_end", "event", "step_limit", "not_finite", "interrupted"
TIMES = [0.25, 0.7, 1.9]
SPACING = 1.0 / 128.0
DRY = made("damped-double", "rods", coulomb1=0.3, coulomb2=0.2)


def options_of(method: Method, step: float = 1.0 / 256.0) -> dict[str, Any]:
    return {"tolerance": 1e-10} if method.adaptive else {"step": step}


@pytest.mark.parametrize(("method", "system"), TAKEN, ids=label)
def test_runs_have_the_bits_of_solve(method: Method, system: System) -> None:
    for start in (some_state(system), any_states(system, 1, seed=5)[0]):
        how = options_of(method)
        expected = solve(system, start, TIMES, method.name, t0=0.1, **how)
        told, times, states, *_ = the_lab().ask(
            "solve", requested(system, method.name, start, TIMES, t0=0.1, **how)
        )
        assert OUTCOMES[int(told[0])] == expected.outcome
        counted = expected.n_steps, expected.n_evaluations, expected.reached
        assert tuple(told[1:4]) == counted
        assert same_bits(times, expected.t)
        assert same_bits(states, expected.states)


@pytest.mark.parametrize(("method", "system"), TAKEN, ids=label)
def test_a_grid_has_the_bits_of_outputs_whatever_its_pieces(method: Method, system: System) -> None:
    start, how = some_state(system), options_of(method)
    places = np.arange(400)
    expected = solve(system, start, 0.5 + places * SPACING, method.name, t0=0.5, **how)
    asked = [*requested(system, method.name, start, t0=0.5, **how), SPACING]
    for first, count, stride in ((0, 7, 1), (7, 50, 1), (300, 100, 1), (3, 20, 5), (0, 400, 1)):
        told, states = the_lab().ask("block", [*asked, first, count, stride])
        assert told[2] == count
        assert same_bits(states, expected.states[first : first + count * stride : stride])


def test_a_grid_that_is_gone_far_along_is_gone_back_on() -> None:
    system = made("double", "rods")
    start = some_state(system)
    asked = [*requested(system, "rk4", start, step=1e-3), 1e-3]
    places = [700_000, 699_998, 5, 650_001, 4096, 0, 700_001]
    order = np.unique(places)
    expected = solve(system, start, order * 1e-3, "rk4", step=1e-3)
    for place in places:
        _, states = the_lab().ask("block", [*asked, place, 1, 1])
        assert same_bits(states, expected.states[np.searchsorted(order, place)])


def test_a_grid_ends_where_the_motion_breaks_down() -> None:
    system = made("double", "rods")
    start = [1.0, 2.0, 40.0, -60.0]
    asked = [*requested(system, "euler", start, step=0.125), 0.125]
    expected = solve(system, start, np.arange(400) * 0.125, "euler", step=0.125)
    assert expected.outcome == "not_finite"
    told, states = the_lab().ask("block", [*asked, 0, 400, 1])
    assert OUTCOMES[int(told[0])] == "not_finite"
    assert same_bits(states, expected.states)


@pytest.mark.parametrize("method", ADAPTIVE, ids=label)
@pytest.mark.parametrize("system", [s for s in SYSTEMS if s.can.periodic], ids=label)
def test_events_and_trust_have_the_bits_of_solve(method: Method, system: System) -> None:
    rods = system.can.degrees_of_freedom
    start = np.concatenate([np.full(rods, 2.5), np.linspace(1.0, 4.0, rods)])
    events = [angle(1, 0.3, 1, every_turn=True), flip(rods), velocity_zero(1), tip_height(0.1)]
    expected = solve(system, start, 6.0, method.name, events=events, certify=1e-9)
    told, times, states, _, _, *found = the_lab().ask(
        "solve", requested(system, method.name, start, 6.0, events=events, certify=1e-9)
    )
    assert same_bits(times, expected.t)
    assert same_bits(states, expected.states)
    assert told[4] == 1.0
    assert told[5] == expected.trust_horizon
    assert sum(len(each.times) for each in expected.events) > 0
    for i, each in enumerate(expected.events):
        assert same_bits(found[2 * i], each.times)
        assert same_bits(found[2 * i + 1], each.states)


@pytest.mark.parametrize("method", ["rk4", "verlet", "gauss4", "taylor"])
def test_trust_horizons_of_methods_of_fixed_step_too(method: MethodName) -> None:
    system = made("simple") if method == "verlet" else made("double", "rods")
    start = some_state(system) * 2.0
    how: dict[str, Any] = {} if method == "taylor" else {"step": 0.01}
    expected = solve(system, start, [9.999], method, certify=1e-6, **how)
    told, *_ = the_lab().ask(
        "solve", requested(system, method, start, [9.999], certify=1e-6, **how)
    )
    assert told[5] == expected.trust_horizon


def test_dry_friction_has_the_same_pieces_and_balance() -> None:
    start = [1.0, -0.5, 0.0, 3.0]
    times = np.linspace(0.1, 8.0, 80)
    expected = solve(DRY, start, times)
    asked = requested(DRY, "taylor", start, times)
    _, _, _, changes, senses, *_ = the_lab().ask("solve", asked)
    assert len(expected.pieces.times) > 2
    assert same_bits(changes[1:], expected.pieces.times)
    assert same_bits(senses[2:], expected.pieces.states)
    parts, net, tails = the_lab().ask("balance", asked)
    balance = expected.energy_balance
    assert same_bits(parts, np.stack([*balance.work_by.values(), *balance.heat_by.values()], -1))
    assert same_bits(net, balance.net)
    assert same_bits(tails, balance.net_tail)


@pytest.mark.parametrize("method", ["rk4", "symplectic-euler", "gauss6", "dop853", "taylor"])
def test_ensembles_have_the_bits_of_the_package(method: MethodName) -> None:
    ideal = method in ("symplectic-euler", "gauss6")
    system = made("simple") if ideal else made("driven", "bob")
    states = any_states(system, 11)
    how: dict[str, Any] = {} if method in ("dop853", "taylor") else {"step": 0.01}
    expected = ensemble(system, states, TIMES, method, **how)
    ended, steps, reached, found, horizons = the_lab().ask(
        "ensemble",
        [*requested(system, method, states[0], TIMES, **how), *listed(states), *listed([])],
    )
    assert [OUTCOMES[int(each)] for each in ended] == list(expected.outcomes)
    assert same_bits(steps, expected.n_steps)
    assert same_bits(reached, expected.reached)
    assert same_bits(found, expected.states)
    assert horizons.size == 0


def test_a_cloud_that_is_gone_on_with_has_the_bits_of_one_run() -> None:
    system = made("double", "rods")
    states = any_states(system, 9)
    whole = ensemble(system, states, [2.0], "rk4", step=2.0**-9).states
    half = np.asarray(states)
    for t0 in (0.0, 1.0):
        asked = requested(system, "rk4", half[0], [t0 + 1.0], t0=t0, step=2.0**-9)
        half = the_lab().ask("ensemble", [*asked, *listed(half), *listed([])])[3].reshape(9, 4)
    assert same_bits(half.ravel(), whole)


def test_variations_have_the_bits_of_the_package() -> None:
    system, t = made("double", "rods"), 20.0
    start, tangent = some_state(system), [0.5, -0.5, 0.5, 0.5]
    expected = megno(system, start, [t], tangent=tangent)
    asked = requested(system, "taylor", start, [t])
    rows = [*listed(start), *listed([])]
    told = the_lab().ask("varied", [*asked, *rows, 1.0, *listed(tangent)])[3]
    assert same_bits(told[:4], expected.states)
    assert told[-1] / t == expected.mean[0]


@pytest.mark.parametrize("system", SYSTEMS, ids=label)
def test_energies_positions_and_slopes_are_the_same(system: System) -> None:
    states = any_states(system, 5)
    asked = [*described(system), *listed(states)]
    kinetic, potential = the_lab().ask("energies", asked)
    assert same_bits(kinetic, system.kinetic_energy(states))
    assert same_bits(potential, system.potential_energy(states))
    (positions,) = the_lab().ask("positions", asked)
    assert same_bits(positions, system.positions(states))
    (slopes,) = the_lab().ask("rhs", [0.3, *asked])
    assert same_bits(slopes, system.rhs(states, 0.3))
    scales, constants = the_lab().ask("numbers", described(system))
    assert tuple(scales[:2]) == (system.energy_scale, system.largest_frequency)
    assert same_bits(constants, list(system.constants.values()))


def test_what_is_wrong_comes_as_data() -> None:
    system = made("simple")
    cases: tuple[tuple[dict[str, Any], str, str], ...] = (
        ({"step": -0.1}, "positive", "step"),
        ({}, "step_needed", "step"),
        ({"step": 0.1, "certify": 2.0}, "angle_to_certify", "certify"),
    )
    for given, rule, argument in cases:
        with pytest.raises(RefusedError) as refused:
            the_lab().ask("solve", requested(system, "rk4", [1.0, 0.0], [1.0], **given))
        assert refused.value.fault["rule"] == rule
        assert refused.value.fault["argument"] == argument
    with pytest.raises(RefusedError) as refused:
        the_lab().ask("check", requested(system, "rk4", [1.0, np.inf], [1.0], step=0.1))
    assert refused.value.fault["value"] == "inf"
    assert refused.value.fault["details"] == {"place": "state[1]"}
