"""Degrees: correctly rounded, the same in Python and on the command line, and radians like them."""

from __future__ import annotations

import math
import sys
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pint
import pytest

import pendula
from commands import Call
from pendula import DegreesWarning, DoublePendulum, SimplePendulum, degrees, elliptic
from pendula.cli.events import event_of
from pendula.events import angle
from pendula.study.recipe import read_recipe
from pendula.sweeping import read_sweep
from pendula.units import quantity

SIMPLE, RODS = SimplePendulum(), DoublePendulum.rods()
Q: Any = pint.UnitRegistry().Quantity
RANDOM = np.random.default_rng(7)


def rounded(x: float, factor: Callable[[], Any]) -> float:
    """The double nearest to x times a factor; `float` would round twice where digits are few."""
    with mpmath.workdps(400):
        exact = mpmath.mpf(x) * factor()
        if abs(exact) < sys.float_info.min:
            return math.ldexp(float(mpmath.nint(mpmath.ldexp(exact, 1074))), -1074)
        return float(exact)


def some_doubles(count: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    anywhere = RANDOM.integers(0, 2**64, count, dtype=np.uint64).view(np.float64)
    usual = RANDOM.uniform(-720, 720, count)
    tiny = RANDOM.integers(1, 2**53, count // 4).astype(np.uint64).view(np.float64)
    typed = np.round(usual, 1)
    ends = [5e-324, 2.0**-1022, sys.float_info.max, -sys.float_info.max, 0.0, -0.0, 1e-290, 1e300]
    values = np.concatenate([anywhere, usual, typed, tiny, np.arange(-720.0, 721.0), ends])
    return np.compress(np.isfinite(values), values)


def test_degrees_are_correctly_rounded() -> None:
    x = some_doubles(4000)
    want = [rounded(each, lambda: mpmath.pi / 180) for each in x.tolist()]
    assert degrees(x).tolist() == want
    assert [degrees(each) for each in x.tolist()[::50]] == want[::50]


def test_degrees_keep_shapes_and_what_is_no_number() -> None:
    assert type(degrees(120)) is float
    assert degrees(120) == 2.0943951023931957 != math.radians(120)
    assert degrees(np.full((2, 3), 180)).tolist() == [[math.pi] * 3] * 2
    assert degrees([]).shape == (0,)
    assert math.isnan(degrees(math.nan))
    assert degrees([-math.inf, 1e400]).tolist() == [-math.inf, math.inf]
    assert math.copysign(1.0, degrees(-0.0)) == -1.0


@pytest.mark.parametrize("bad", ["120", True, 1j, None, [True], Q(120, "deg"), np.ma.masked])
def test_what_is_no_number_of_degrees_is_refused(bad: Any) -> None:
    with pytest.raises(ValueError, match="^x must ") as error:
        degrees(bad)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("text", ["120", "-10", "119.7", "0.1", "1e-5", "179.999", "33.3"])
def test_the_command_reads_the_same_angle(text: str) -> None:
    assert quantity(f"{text}deg", "rad", "x") == degrees(float(text))
    assert quantity(f"{text} °/s", "rad/s", "x") == degrees(float(text))
    state = pendula.solve(SIMPLE, (Q(float(text), "deg"), 0.0), 0.1).states[0]
    assert state.tolist() == [degrees(float(text)), 0.0]


@pytest.mark.parametrize(
    ("name", "parts"),
    [("deg", 180), ("arcmin", 10800), ("arcsec", 648000), ("gon", 200), ("turn", 0.5)],
)
def test_every_angle_is_correctly_rounded(name: str, parts: float) -> None:
    for each in (*RANDOM.uniform(-1000, 1000, 200).tolist(), 1e-300, 1e306, 0.1, 120.0):
        want = rounded(each, lambda: mpmath.pi / parts)
        assert quantity(f"{each!r}{name}", "rad", "x") == want


# ---- the upright start ----


@pytest.mark.parametrize("text", ["180deg", "-180°", "0.5turn", "200gon", "1pi", "10800arcmin"])
def test_the_period_of_the_upright_start_is_infinite(text: str, call: Call) -> None:
    code, printed, _ = call(f"period simple --amplitude {text}")
    assert code == 0
    assert printed.splitlines()[1].split()[-2:] == ["inf", "inf"]
    code, printed, _ = call(f"period simple --theta {text}")
    assert printed.splitlines()[1].split()[-2:] == ["inf", "inf"]


def test_the_period_next_to_it_is_finite(call: Call) -> None:
    """The double is as given; the linear pendulum has one period; three half turns are upright."""
    _, printed, _ = call("period simple --amplitude 3.141592653589793rad,179.999999deg,180deg")
    rows = [line.split()[2] for line in printed.splitlines()[1:]]
    assert [math.isinf(float(each)) for each in rows] == [False, False, True]
    assert float(rows[0]) == SIMPLE.period(math.pi)
    assert "inf" not in call("period linear --amplitude 180deg")[1]
    assert "inf" in call("period simple --theta 540deg")[1]
    assert "inf" not in call("period simple --theta 360deg --omega 1rad/s")[1]
    assert "inf" not in call("period simple --theta 180deg --omega 1rad/s")[1]


# ---- degrees taken for radians ----

DEGREES: list[Callable[[], Any]] = [
    lambda: pendula.solve(RODS, (120, -10, 0, 0), 0.1),
    lambda: pendula.solve(RODS, (1.0, 57.3, 0, 0), -0.1),
    lambda: pendula.solve(SIMPLE, np.array([10.0, 0.0]), 0.1, "rk4", step=0.01),
    lambda: pendula.exact(SIMPLE, [(0.5, 0.0), (-30.0, 0.0)], 1.0),
    lambda: pendula.ensemble(RODS, [(120, -10, 0, 0), (121, -10, 0, 0)], 0.1),
    lambda: pendula.poincare_section(RODS, (120, -10, 0, 0), angle(1, 0.0, every_turn=True), 1),
    lambda: pendula.time_at(SIMPLE, (30.0, 0.0), 0.0),
    lambda: pendula.action(SIMPLE, (30.0, 0.0)),
    lambda: SIMPLE.period(state=(30.0, 0.0)),
    lambda: angle(1, 30),
    lambda: pendula.flip_map(RODS, (-180, 180), (-1, 1), (1, 1), 0.1),
    lambda: pendula.divergence_map(RODS, (-1, 1), (-180, 180), (1, 1), 0.1),
    lambda: pendula.analysis.work_precision(SIMPLE, (30, 0), 1.0, ["rk4"], points=2, timed=False),
]


@pytest.mark.parametrize("made", DEGREES)
def test_angles_like_degrees_are_warned_of_once(made: Callable[[], Any]) -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        made()
    (one,) = caught
    assert one.category is DegreesWarning
    assert one.filename == __file__
    assert "give pendula.degrees(" in str(one.message)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warnings.filterwarnings("ignore", category=DegreesWarning)
        made()


def test_other_angles_are_not_warned_of(call: Call) -> None:
    """Small ones, those that a motion left, those with a unit, and those of the command line."""
    turned = pendula.solve(SIMPLE, (0.0, 20.0), 5.0).states[-1]
    assert abs(turned[0]) > math.tau
    pendula.solve(SIMPLE, turned, 1.0)
    pendula.solve(SIMPLE, (6.28, 100.0), 0.1)
    pendula.solve(SIMPLE, (Q(30, "rad"), 0), 0.1)
    pendula.solve(SIMPLE, (degrees(720.0), 0.0), 0.1)
    angle(1, 4 * math.tau)
    assert call("solve simple --theta 30rad --t-max 1s")[2] == ""
    event_of("angle 1 20rad")


# ---- the command's angles without a unit ----


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("solve simple --t-max 1s --theta 150", "--theta needs a unit, got '150'; write 150deg or"),
        (
            "solve simple --t-max 1s --omega 3",
            "--omega needs a unit, got '3'; write 3deg/s or 3rad",
        ),
        ("solve double --t-max 1s --theta2 -10", "--theta2 needs a unit, got '-10'"),
        ("solve simple --t-max 1s --certify 1e-9", "--certify needs a unit, got '1e-9'"),
        ("exact simple --at 1s --theta 1", "--theta needs a unit"),
        ("period simple --amplitude 30", "--amplitude needs a unit, got '30'"),
        ("period simple --theta 1 --omega 2rad/s", "--theta needs a unit"),
        ("compare simple --t-max 1s --theta 1", "--theta needs a unit"),
        ("map flip double --t-max 1s --theta1 1:2rad", "--theta1 needs a unit, got '1'"),
        ("map flip double --t-max 1s --theta1 0:2", "--theta1 needs a unit, got '2'"),
        ("map divergence double --t-max 1s --separation 1e-8", "--separation needs a unit"),
    ],
)
def test_an_angle_needs_its_unit(line: str, told: str, call: Call) -> None:
    code, printed, error = call(line)
    assert (code, printed) == (2, "")
    assert error.startswith(f"pendula: {told}")
    assert error.count("\n") == 1


def test_zero_is_zero_in_any_unit(call: Call) -> None:
    assert call("solve simple --t-max 1s --theta 0 --omega 0")[0] == 0
    assert event_of("angle 1 0 rising") == angle(1, 0.0, 1)


def test_an_event_needs_the_unit_of_its_angle() -> None:
    with pytest.raises(ValueError, match="^--event needs a unit, got '30'; write 30deg or 30rad"):
        event_of("angle 1 30 rising")


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('[state]\ntheta1 = "30"', "state.theta1 needs a unit, got '30'; write 30deg or 30rad"),
        ('[state]\nomega1 = "3"', "state.omega1 needs a unit, got '3'; write 3deg/s or 3rad/s"),
        ('[state]\ntheta1 = { grid = ["0", "30", 3] }', "state.theta1 needs a unit, got '30'"),
        ('[state]\ntheta1 = { uniform = ["1 deg", "2"] }', "state.theta1 needs a unit, got '2'"),
        ('[state]\ntheta1 = { list = ["1 Grad"] }', "state.theta1 must be in deg or gon"),
    ],
)
def test_an_angle_of_a_sweep_needs_its_unit(text: str, told: str, tmp_path: Path) -> None:
    path = tmp_path / "recipe.toml"
    path.write_text(f'[system]\nkind = "double"\n{text}\n[run]\nt_max = "1 s"\n')
    with pytest.raises(ValueError, match=r"recipe.toml, line 4: ") as error:
        read_sweep(path)
    assert told in str(error.value)


@pytest.mark.parametrize("certify", ["1e-9", '"1e-9"'])
def test_the_certified_angle_of_a_sweep_needs_its_unit(certify: str, tmp_path: Path) -> None:
    path = tmp_path / "recipe.toml"
    path.write_text(f'[system]\nkind = "double"\n[run]\nt_max = "1 s"\ncertify = {certify}\n')
    with pytest.raises(ValueError, match=r"line 5: run.certify needs a (quantity with its )?unit"):
        read_sweep(path)


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('[double]\ntheta1 = "30"', "double.theta1 needs a unit, got '30'; write 30deg or 30rad"),
        ('[double]\nomega1 = "3"', "double.omega1 needs a unit, got '3'"),
        ('[simple]\nlarge = "150"', "simple.large needs a unit, got '150'"),
        ('[period]\namplitudes = ["30 deg", "60"]', "period.amplitudes needs a unit, got '60'"),
        ('[double]\ntolerance = "1"', "double.tolerance needs a unit, got '1'"),
    ],
)
def test_an_angle_of_the_study_needs_its_unit(text: str, told: str, tmp_path: Path) -> None:
    path = tmp_path / "recipe.toml"
    path.write_text(text)
    with pytest.raises(ValueError, match=r"recipe.toml, line 2: ") as error:
        read_recipe(path)
    assert told in str(error.value)


# ---- the largest amplitude of F for k > 1 ----


def test_F_takes_the_arcsine_of_doubles_for_its_limit() -> None:
    random = np.random.default_rng(5)
    k = 1.0 + np.concatenate([random.uniform(0, 5, 2000), 10.0 ** -random.uniform(0, 15, 2000)])
    phi = np.arcsin(1 / k)
    for sign in (1.0, -1.0):
        found = elliptic.F(sign * phi, k)
        assert np.isfinite(found).all()
        with mpmath.workdps(40):  # an amplitude less by δ has about √(2δ/√(k² − 1)) less
            for i in range(0, k.size, 20):
                modulus, ulp = mpmath.mpf(k[i]), mpmath.mpf(2) ** -52
                top, slope = mpmath.ellipk(1 / modulus**2) / modulus, mpmath.sqrt(modulus**2 - 1)
                rounding = ulp / slope + ulp  # of 1/k, and of the arcsine
                assert abs(sign * found[i] - top) <= 2 * mpmath.sqrt(2 * rounding / slope)


@pytest.mark.parametrize(("phi", "k"), [(math.pi / 2, 1 + 2**-52), (0.34, 3.0), (-1.0, 2.0)])
def test_F_beyond_rounding_is_refused(phi: float, k: float) -> None:
    with pytest.raises(ValueError, match=r"^phi must, for k > 1, lie within"):
        elliptic.F(phi, k)


def test_the_limit_of_F_is_a_complete_integral() -> None:
    k = 9 / 7
    limit = math.nextafter(math.asin(1 / k), 9)
    with mpmath.workdps(40):
        want = float(mpmath.ellipk(1 / mpmath.mpf(k) ** 2) / k)
    assert elliptic.F([limit, -limit], k) == pytest.approx([want, -want], rel=4e-16)
    assert type(elliptic.F(limit, k)) is float
    assert elliptic.F(math.nextafter(limit, 9), k) == pytest.approx(want, rel=4e-16)
