"""The pendulums: descriptions, equations of motion, energies and periods."""

from __future__ import annotations

import dataclasses
import inspect
import json
import math
import pickle
import re
from typing import Any

import numpy as np
import pytest
import sympy as sp

import pendula
from catalogue import ENTRIES, SYSTEMS, at_rest, label
from pendula import DoublePendulum, LinearPendulum, SimplePendulum
from pendula.systems import System, system_from
from pendula.systems.driven import Real

BODIES = DoublePendulum.bodies(1.2, 0.7, 0.9, 0.4, 0.3, 0.05, 0.02, 9.81, l2=0.8)
every_system = pytest.mark.parametrize("system", [*SYSTEMS, BODIES], ids=label)


@every_system
def test_a_description_survives_everything(system: System) -> None:
    assert pickle.loads(pickle.dumps(system)) == system
    assert system_from(json.loads(json.dumps(system.description()))) == system
    assert len({system, system_from(system.description())}) == 1
    assert eval(repr(system), {**vars(pendula.systems)}) == system


@every_system
def test_a_description_is_frozen(system: System) -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        system.mass = 3.0  # type: ignore[attr-defined]


def test_parameters_are_attributes() -> None:
    rods = DoublePendulum.rods(m1=3.0)
    assert (rods.m1, rods.l2) == (3.0, 1.0)
    assert BODIES.I1 == 0.05
    with pytest.raises(AttributeError, match="no attribute 'c1'"):
        rods.c1  # noqa: B018


def test_different_systems_differ() -> None:
    assert len({*SYSTEMS, BODIES}) == len(SYSTEMS) + 1
    assert len({LinearPendulum(), SimplePendulum()}) == 2
    assert SimplePendulum(1.0) != SimplePendulum(1.0 + 2**-52)


def test_every_system_of_the_catalogue_is_a_class_of_the_package() -> None:
    assert sorted(System.classes) == sorted(each.name for each in ENTRIES)
    for cls in System.classes.values():
        assert getattr(pendula, cls.__name__) is cls
        assert cls.__name__ in pendula.__all__
        assert cls.__name__ in pendula.systems.__all__


def arguments_of(maker: Any) -> dict[str, Any]:
    """Names and defaults of what makes a system; of pairs, one for each joint."""
    found = dict[str, Any]()
    for name, each in inspect.signature(maker).parameters.items():
        if each.kind is each.VAR_KEYWORD:
            found |= dict.fromkeys(Real.__annotations__)
        elif isinstance(each.default, tuple):
            found |= {f"{name}{i}": value for i, value in enumerate(each.default, 1)}
        else:
            found[name] = each.default
    return found


def test_python_and_the_catalogue_agree_on_parameters() -> None:
    for entry in ENTRIES:
        for form in entry.forms:
            cls: Any = System.classes[entry.name]
            if entry.name == cls.name and cls.other_names:
                continue  # the parameters are those of its most general description
            maker = getattr(cls, form.name) if form.name else cls
            given = arguments_of(maker)
            assert list(given) == [row.name for row in form.parameters]
            for row in form.parameters:
                if row.standard is not None and row.name not in Real.__annotations__:
                    assert given[row.name] == row.standard


@pytest.mark.parametrize("bad", [0.0, -1.0, math.inf, math.nan, "1 m", None])
@pytest.mark.parametrize("name", ["length", "gravity", "mass"])
def test_a_parameter_out_of_range_is_named(name: str, bad: Any) -> None:
    with pytest.raises(ValueError, match=rf"^{name} must .*got {bad!r}"):
        SimplePendulum(**{name: bad})


@pytest.mark.parametrize(
    ("parameters", "message"),
    [
        ({"m1": -1.0}, "m1 must be positive"),
        ({"l2": 0.0}, "l2 must be positive"),
        ({"m1": 1e-300, "l1": 1e-300}, r"constant A is 0\.0"),
        ({"l1": 1e200}, "constant A is inf"),
    ],
)
def test_a_double_pendulum_out_of_range_is_refused(
    parameters: dict[str, float], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        DoublePendulum.rods(**parameters)


def test_bodies_may_have_no_inertia_but_not_no_mass() -> None:
    bob = DoublePendulum.bodies(1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0)
    same = DoublePendulum.bobs()
    assert bob.constants == same.constants
    assert (bob.rhs([1.0, 2.0, 3.0, 4.0]) == same.rhs([1.0, 2.0, 3.0, 4.0])).all()
    with pytest.raises(ValueError, match="m2 must be positive"):
        DoublePendulum.bodies(1.0, 0.0, 1.0, 1.0, 1.0, 0.0, 0.0)


@every_system
def test_the_rhs_and_energies_are_those_of_the_lagrangian(system: System) -> None:
    """Euler-Lagrange by computer algebra, from the ends' positions and the bodies' inertia."""
    random = np.random.default_rng(1)
    states = random.uniform(-3, 3, (5, len(system.components)))
    rhs, kinetic, potential = _lagrangian(system)
    for state, slope, T, V in zip(
        states,
        system.rhs(states),
        system.kinetic_energy(states),
        system.potential_energy(states),
        strict=True,
    ):
        np.testing.assert_allclose(slope, rhs(state), rtol=1e-11, atol=1e-11)
        assert T == pytest.approx(kinetic(state), rel=1e-13)
        assert V == pytest.approx(potential(state), rel=1e-13)
    assert system.energy(states) == pytest.approx(
        system.kinetic_energy(states) + system.potential_energy(states)
    )


def _lagrangian(system: System) -> Any:
    """Functions of a state: its time derivative, kinetic and potential energy, from sympy."""
    d = system.can.degrees_of_freedom
    q = sp.symbols(f"q1:{d + 1}", real=True)
    w = sp.symbols(f"w1:{d + 1}", real=True)
    p = {name: sp.Rational(value) for name, value in system.parameters.items()}
    T, V = ENERGIES[system.name](system, p, q, w)
    others = FORCES.get(system.name, lambda *_: [0] * d)(p, q, w)
    mass_matrix = sp.Matrix(d, d, lambda i, j: sp.diff(T, w[i], w[j]))
    force = sp.Matrix(
        [
            others[i] + sp.diff(T - V, q[i]) - sum(sp.diff(T, w[i], q[j]) * w[j] for j in range(d))
            for i in range(d)
        ]
    )
    slope = [*w, *mass_matrix.LUsolve(force)]
    rhs, kinetic, potential = (sp.lambdify([*q, *w], each) for each in (slope, T, V))
    return (lambda s: rhs(*s)), (lambda s: kinetic(*s)), (lambda s: potential(*s))


def _one_bob_energies(p: Any, w: Any, height: Any) -> Any:
    """Of a point mass at that height, over the length."""
    return p["mass"] * (p["length"] * w[0]) ** 2 / 2, p["mass"] * p["gravity"] * p[
        "length"
    ] * height


def _double_energies(system: System, p: Any, q: Any, w: Any) -> Any:
    c1, c2, I1, I2 = {  # type: ignore[no-untyped-call]
        "rods": lambda: (
            p["l1"] / 2,
            p["l2"] / 2,
            p["m1"] * p["l1"] ** 2 / 12,
            p["m2"] * p["l2"] ** 2 / 12,
        ),
        "bobs": lambda: (p["l1"], p["l2"], 0, 0),
        "bodies": lambda: (p["c1"], p["c2"], p["I1"], p["I2"]),
    }[system.form]()
    along = [sp.Matrix([sp.sin(a), -sp.cos(a)]) for a in q]
    centres = [c1 * along[0], p["l1"] * along[0] + c2 * along[1]]
    T = V = sp.Integer(0)
    for centre, m, inertia, turning in zip(centres, (p["m1"], p["m2"]), (I1, I2), w, strict=True):
        velocity = sum((centre.diff(a) * b for a, b in zip(q, w, strict=True)), sp.zeros(2, 1))
        T += m * velocity.dot(velocity) / 2 + inertia * turning**2 / 2
        V += m * p["gravity"] * (centre[1] - centre[1].subs(dict.fromkeys(q, 0)))
    return T, V


# Kinetic and potential energy by computer algebra, of each system: what a new one has to add here.
ENERGIES: dict[str, Any] = {
    "linear": lambda _, p, q, w: _one_bob_energies(p, w, q[0] ** 2 / 2),
    "simple": lambda _, p, q, w: _one_bob_energies(p, w, 1 - sp.cos(q[0])),
    "double": _double_energies,
    "driven-linear": lambda _, p, q, w: _one_bob_energies(p, w, q[0] ** 2 / 2),
    "driven": lambda _, p, q, w: _body_energies(p, w, 1 - sp.cos(q[0])),
    "damped-double": _double_energies,
}


def _body_energies(p: Any, w: Any, height: Any) -> Any:
    if "q" in p:  # the scaled form
        return w[0] ** 2 / 2, height
    if "length" in p:
        return _one_bob_energies(p, w, height)
    return p["inertia"] * w[0] ** 2 / 2, p["mass"] * p["gravity"] * p["centre"] * height


def _force_on_a_body(p: Any, q: Any, w: Any) -> Any:
    if "q" in p:
        return [-w[0] / p["q"] + p["a"] * sp.cos(p["drive_phase"])]
    moment = p["mass"] * p.get("length", p.get("centre"))
    push = moment * p["pivot_amplitude"] * p["pivot_frequency"] ** 2 * sp.cos(p["pivot_phase"])
    return [
        p["torque"] * sp.cos(p["drive_phase"])
        + push * sp.cos(q[0] - p["pivot_direction"])
        - p["viscous"] * w[0]
        - p["cubic"] * w[0] ** 3
    ]


def _friction_in_joints(p: Any, q: Any, w: Any) -> Any:
    second = p["viscous2"] * (w[1] - w[0])
    return [-p["viscous1"] * w[0] + second, -second]


# Generalised forces at t = 0, beside those of the potential, of systems that have any.
FORCES: dict[str, Any] = {
    "driven-linear": lambda p, q, w: [p["torque"] * sp.cos(p["drive_phase"]) - p["viscous"] * w[0]],
    "driven": _force_on_a_body,
    "damped-double": _friction_in_joints,
}


def test_every_system_is_held_to_its_lagrangian() -> None:
    assert sorted(ENERGIES) == sorted(each.name for each in ENTRIES)


@every_system
def test_positions_hang_down_from_the_origin(system: System) -> None:
    d = system.can.degrees_of_freedom
    named = system.parameters.items()
    lengths = [value for name, value in named if re.fullmatch(r"length|centre|l\d", name)] or [1.0]
    rest = system.positions(at_rest(system))
    np.testing.assert_allclose(rest, [[0, -sum(lengths[: i + 1])] for i in range(d)])
    right = system.positions([*[math.pi / 2] * d, *[0.0] * d])
    np.testing.assert_allclose(right, [[sum(lengths[: i + 1]), 0] for i in range(d)], atol=1e-15)
    assert system.positions(np.zeros((3, 4, 2 * d))).shape == (3, 4, d, 2)


@every_system
@pytest.mark.parametrize("bad", [1.0, [1.0], [1.0, 2.0, 3.0], [math.nan] * 4, "abc"])
def test_states_of_another_shape_are_refused(system: System, bad: Any) -> None:
    with pytest.raises(ValueError, match="^state must"):
        system.rhs(bad)


def test_an_unknown_system_is_refused() -> None:
    with pytest.raises(
        ValueError, match=rf"^system must be one of {', '.join(System.classes)}; got 'triple'"
    ):
        system_from({"name": "triple", "form": "", "parameters": {}})
