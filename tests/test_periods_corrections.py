"""Each correction of a period is what an exact computation of that effect has."""

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from pendula.measured.measurement import PeriodTable
from pendula.measured.period_corrections import CORRECTIONS, Apparatus
from pendula.measured.periods import fit_periods

G = 9.8
LENGTHS = np.array([0.4, 0.7, 1.0, 1.3])


def swing(frequency_squared: float, amplitude: float) -> float:
    """Period of θ̈ = −ω² sin θ by the energy integral, with sin(θ/2) = sin(θ0/2) sin φ."""
    k = math.sin(amplitude / 2.0)
    whole, _ = quad(lambda phi: 1.0 / math.sqrt(1.0 - (k * math.sin(phi)) ** 2), 0, math.pi / 2)
    return 4.0 * float(whole) / math.sqrt(frequency_squared)


def rigid(length: float, ball: float, radius: float, density: float) -> float:
    """Torque over inertia of a ball on a stiff uniform string that ends at its surface, over g."""
    string = length - radius
    inertia, _ = quad(lambda s: density * s**2, 0, string)
    torque, _ = quad(lambda s: density * s, 0, string)
    return float((torque + ball * length) / (inertia + ball * (length**2 + 0.4 * radius**2)))


def gravity(periods: list[float], **known: Any) -> float:
    table = PeriodTable(np.array(periods), length=LENGTHS)
    return fit_periods(table, apparatus=Apparatus(**known), timing_error=1e-6)["gravity"].value


def test_a_swing_of_any_amplitude_gives_g() -> None:
    periods = [swing(G / each, math.radians(100.0)) for each in LENGTHS]
    assert gravity(periods, amplitude=math.radians(100.0)) == pytest.approx(G, rel=1e-12)


def test_a_ball_on_a_heavy_string_gives_g() -> None:
    ball, radius, density = 0.1, 0.03, 0.02
    periods = [math.tau / math.sqrt(G * rigid(each, ball, radius, density)) for each in LENGTHS]
    corrections = ["bob", "string"]
    table = PeriodTable(np.array(periods), length=LENGTHS)
    apparatus = Apparatus(bob_mass=ball, bob_radius=radius, string_density=density)
    fit = fit_periods(table, apparatus=apparatus, corrections=corrections, timing_error=1e-6)
    assert fit["gravity"].value == pytest.approx(G, rel=1e-12)
    assert [each.name for each in fit.corrections] == corrections


def test_first_orders_are_those_of_nelson_and_olsson() -> None:
    length, radius, ball, decay, period = 1.0, 0.01, 1.0, 1e-3, 2.0
    known = {
        "length": length,
        "amplitude": 0.02,
        "period": period,
        "bob_radius": radius,
        "bob_mass": ball,
        "string_density": 1e-4,
        "decay_rate": decay,
        "air_density": 1.2,
    }
    displaced = 1.2 * 4.0 / 3.0 * math.pi * radius**3
    # ΔT/T of each
    first_orders = {
        "amplitude": 0.02**2 / 16.0,
        "bob": (radius / length) ** 2 / 5.0,
        "string": -(1e-4 * (length - radius) / ball) / 12.0,
        "buoyancy": displaced / ball / 2.0,
        "damping": (decay * period / math.tau) ** 2 / 2.0,
    }
    for name, expected in first_orders.items():
        factor = float(CORRECTIONS[name].factor(known))
        assert math.sqrt(factor) - 1.0 == pytest.approx(expected, rel=0.02), name


def test_damping_is_that_of_a_damped_oscillation() -> None:
    decay = 0.4

    def crossing(_: float, y: Any) -> float:
        return float(y[0])

    periods = []
    for each in LENGTHS:
        found = solve_ivp(
            lambda _, y, squared=G / each: [y[1], -squared * y[0] - 2.0 * decay * y[1]],
            (0.0, 6.0),
            [0.0, 1.0],
            events=crossing,
            rtol=1e-11,
            atol=1e-13,
        ).t_events[0]
        periods.append(float(found[3] - found[1]))
    assert gravity(periods, decay_rate=decay) == pytest.approx(G, rel=1e-7)


def test_air_carried_along_is_that_of_the_force_on_an_oscillating_sphere() -> None:
    radius, period, density, viscosity = 0.02, 2.0, 1.2, 1.8e-5
    frequency = math.tau / period
    depth = math.sqrt(2.0 * viscosity / (density * frequency))
    # the part of the force that goes with the acceleration: Landau & Lifshitz, § 24, problem 5
    carried = (
        3.0
        * math.pi
        * radius**2
        * math.sqrt(2.0 * viscosity * density / frequency)
        * (1.0 + 2.0 * radius / (9.0 * depth))
    )
    known = {
        "bob_radius": radius,
        "bob_mass": 0.1,
        "air_density": density,
        "air_viscosity": viscosity / density,
        "period": period,
    }
    factor = float(CORRECTIONS["added_mass"].factor(known))
    assert factor - 1.0 == pytest.approx(carried / 0.1, rel=1e-10)


def test_a_string_that_stretches_is_longer_than_measured() -> None:
    ball, stiffness = 0.2, 500.0
    longer = LENGTHS * (1.0 + ball * 9.80665 / stiffness)
    periods = list(math.tau * np.sqrt(longer / G))
    assert gravity(periods, bob_mass=ball, string_stiffness=stiffness) == pytest.approx(G)


def test_a_change_is_that_of_g_without_the_correction() -> None:
    periods = [1.3, 1.7, 2.0, 2.3]
    known = {"amplitude": 0.3, "bob_mass": 0.1, "bob_radius": 0.02}
    table = PeriodTable(np.array(periods), length=LENGTHS)
    fit = fit_periods(table, apparatus=Apparatus(**known))
    assert [each.name for each in fit.corrections] == [
        "amplitude",
        "bob",
        "buoyancy",
        "added_mass",
    ]
    changes = {each.name: each.change for each in fit.corrections}
    assert changes["amplitude"] == pytest.approx(
        fit["gravity"].value / gravity_without_amplitude(table, known) - 1.0
    )
    assert changes["amplitude"] == pytest.approx(0.3**2 / 8.0, rel=0.02)


def gravity_without_amplitude(table: PeriodTable, known: dict[str, float]) -> float:
    others = {name: value for name, value in known.items() if name != "amplitude"}
    return fit_periods(table, apparatus=Apparatus(**others))["gravity"].value


@pytest.mark.parametrize(
    ("known", "error"),
    [
        ({"bob_mass": -1.0}, "bob_mass must be positive"),
        ({"amplitude": 4.0}, "amplitude must be below pi"),
        ({"bob_mass": 1e-5, "bob_radius": 0.1}, "bob_mass must be that of a ball heavier than"),
    ],
)
def test_what_no_apparatus_has_is_refused(known: dict[str, float], error: str) -> None:
    with pytest.raises(ValueError, match=error):
        Apparatus(**known)
