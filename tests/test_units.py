"""Quantities: every usual spelling, rounded once, and one clear line for what is none."""

from __future__ import annotations

import math
import subprocess
import sys
from fractions import Fraction

import mpmath
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from pendula._unit_names import NAMES, PI
from pendula.units import quantities, quantity

finite = st.floats(allow_nan=False, allow_infinity=False)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("0.3", "m", 0.3),
        ("70cm", "m", 0.7),
        ("50 cm", "m", 0.5),
        (" 50 cm ", "m", 0.5),
        ("1.5E1mm", "m", 0.015),
        (".5m", "m", 0.5),
        ("3 inch", "m", 0.0762),
        ("3ft", "m", 0.9144),
        ("1ms", "s", 0.001),
        ("1e-3 s", "s", 0.001),
        ("5 µs", "s", 5e-6),
        ("5 μs", "s", 5e-6),
        ("2 min", "s", 120.0),
        ("500 g", "kg", 0.5),
        ("9.81 m/s^2", "m/s^2", 9.81),
        ("9.81 m/s²", "m/s^2", 9.81),
        ("9.81m/s2", "m/s^2", 9.81),
        ("9.81 m·s⁻²", "m/s^2", 9.81),
        ("9.81 m s**-2", "m/s^2", 9.81),
        ("981 cm/s/s", "m/s^2", 9.81),
        ("1 standard_gravity", "m/s^2", 9.80665),
        ("0.1 kg m^2", "kg m^2", 0.1),
        ("1 g*cm²", "kg m^2", 1e-7),
        ("1 N m s^2", "kg m^2", 1.0),
        ("2 rad", "rad", 2.0),
        ("180deg", "rad", math.pi),
        ("120°", "rad", float(PI * 2 / 3)),
        ("120º", "rad", float(PI * 2 / 3)),
        ("90 degrees", "rad", math.pi / 2),
        ("1 turn", "rad", math.tau),
        ("0.5 pi", "rad", math.pi / 2),
        ("0.5π rad", "rad", math.pi / 2),
        ("-10deg", "rad", -float(PI / 18)),
        ("−10°", "rad", -float(PI / 18)),
        ("+1 rad/s", "rad/s", 1.0),
        ("-0", "rad", 0.0),
        ("0e5", "rad/s", 0.0),
        ("30 grados", "rad", float(PI / 6)),
        ("30 Grados", "rad", float(PI / 6)),
        ("2 rads", "rad", 2.0),
        ("2 radianes", "rad", 2.0),
        ("1 radián", "rad", 1.0),
        ("1 radia\u0301n", "rad", 1.0),
        ("0.5 vueltas", "rad", math.pi),
        ("1 rev", "rad", math.tau),
        ("200 gon", "rad", math.pi),
        ("100 gradianes", "rad", math.pi / 2),
        ("10800 arcmin", "rad", math.pi),
        ("648000arcsec", "rad", math.pi),
        ("5 mrad", "rad", 0.005),
        ("5 µrad", "rad", 5e-6),
        ("90 grados/s", "rad/s", math.pi / 2),
        ("1 vuelta/min", "rad/s", float(PI / 30)),
        ("2 segundos", "s", 2.0),
        ("3 minutes", "s", 180.0),
        ("5 metros", "m", 5.0),
        ("3 1/s", "1/s", 3.0),
        ("3/s", "1/s", 3.0),
        ("3 s^-1", "1/s", 3.0),
        ("3 1/min", "1/s", 0.05),
        ("180 °/s", "rad/s", math.pi),
        ("30 rpm", "rad/s", math.pi),
        ("3", "", 3.0),
        ("0e9999 m", "m", 0.0),
        ("1e-320 mm", "m", 1e-323),
    ],
)
def test_usual_spellings_have_their_value_to_the_last_bit(
    text: str, unit: str, value: float
) -> None:
    assert quantity(text, unit, "--x") == value


@pytest.mark.parametrize(
    ("text", "unit", "told"),
    [
        ("150", "rad", "--x needs a unit, got '150'; write 150deg or 150rad"),
        ("-1e-3", "rad", "--x needs a unit, got '-1e-3'; write -1e-3deg or -1e-3rad"),
        ("90", "rad/s", "--x needs a unit, got '90'; write 90deg/s or 90rad/s"),
        ("0,5", "rad", "--x: write 0.5deg; a comma"),
        ("30 Grad", "rad", "--x must be in deg or gon: Grad can mean either, got '30 Grad'"),
        ("30grad", "rad", "--x must be in deg or gon: grad can mean either"),
        ("30 Grad/s", "rad/s", "--x must be in deg or gon: Grad can mean either"),
        ("30 Mrad", "rad", "--x has the unknown unit 'Mrad'"),
        ("30 krad/s", "rad/s", "--x has the unknown unit 'krad'"),
        ("30 kdeg", "rad", "--x has the unknown unit 'kdeg'"),
        ("30 gigaradian", "rad", "--x has the unknown unit 'gigaradian'"),
        ("1 kiloturn", "rad", "--x has the unknown unit 'kiloturn'"),
        ("30 grado centigrado", "rad", "--x has the unknown unit 'centigrado'"),
        ("3 1/s", "rad/s", "--x must be in rad/s or a unit of the same kind, got '3 1/s'"),
        ("3 m", "1/s", "--x must be in 1/s or a unit of the same kind, got '3 m'; write 0.5/s"),
        ("0,5m", "m", "--x: write 0.5m; a comma separates entries of a list"),
        ("-0,5", "m", "--x: write -0.5; a comma"),
        ("1s,2s", "s", "--x takes one value, got '1s,2s'"),
        ("1,000.5m", "m", "--x takes one value"),
        ("", "m", "--x must be one quantity, got ''; write 50cm, say"),
        ("  ", "s", "--x must be one quantity"),
        ("1" * 101, "m", "--x must be one quantity"),
        ("nan", "m", "--x must be a finite number [m], got 'nan'"),
        ("-inf s", "s", "--x must be a finite number [s], got '-inf s'"),
        ("Infinity", "", "--x must be a finite number, got"),
        ("abc", "m", "--x must begin with a number, got 'abc'"),
        ("30deg", "m", "--x must be in m or a unit of the same kind, got '30deg'; write 50cm"),
        ("5 Hz", "rad/s", "--x must be in rad/s"),
        ("1 g", "m/s^2", "--x must be in m/s^2"),
        ("5 degC", "m", "--x has the unknown unit 'degC'"),
        ("5m", "", "--x must be a number without a unit, got '5m'; write 0.5"),
        ("5cmm", "m", "--x has the unknown unit 'cmm' in '5cmm'; did you mean mm or cm?"),
        ("5 DEG", "rad", "did you mean deg or degree?"),
        ("5 quux", "m", "--x has the unknown unit 'quux' in '5 quux'; write 50cm, say"),
        ("5 percent", "rad", "--x has the unknown unit 'percent'"),
        ("1e400m", "m", "--x must not be beyond the largest number"),
        ("1e308km", "m", "--x must not be beyond the largest number"),
        ("1e-400", "m", "--x must not be nearer to zero than the smallest number"),
        ("1e-323 mm", "m", "--x must not be nearer to zero"),
        ("1e999999999999", "m", "--x must not be beyond the largest number"),
        ("1 000 m", "m", "--x must be one number and one unit, got '1 000 m'"),
        ("5ft3in", "m", "--x must be one number and one unit"),
        ("2**9", "m", "--x must be one number and one unit"),
        ("1 m**9**9**9", "m", "--x must be one number and one unit"),
        ("1 cm^99999999", "m", "--x must be one number and one unit"),
        ("1 __import__('os')", "m", "--x has the unknown unit '__import__'"),
    ],
)
def test_what_is_no_quantity_is_told_in_one_line(text: str, unit: str, told: str) -> None:
    with pytest.raises(ValueError, match="--x") as error:
        quantity(text, unit, "--x")
    assert told in str(error.value)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("text", "values"),
    [
        ("30deg,60deg", [float(PI / 6), float(PI / 3)]),
        ("1rad, 180°", [1.0, math.pi]),
        ("0.5rad", [0.5]),
        ("0", [0.0]),
    ],
)
def test_entries_of_a_list_carry_their_units(text: str, values: list[float]) -> None:
    assert quantities(text, "rad", "--x") == values


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("30,60deg", "'30' in the list '30,60deg' has no unit, each entry carries its own"),
        ("30,60deg", "write 30deg,60deg, or 30.60deg for one value with a decimal point"),
        ("0,5rad", "or 0.5rad for one value with a decimal point"),
        ("0,5", "write 0deg,5deg, or 0.5deg for one value with a decimal point"),
        ("0,30deg", "'0' in the list '0,30deg' has no unit"),
        ("30", "needs a unit, got '30'; write 30deg or 30rad"),
        ("30deg,60", "write 30deg,60deg"),
        ("1,2,3deg", "write 1deg,2deg,3deg"),
        ("1rad,,2rad", "has an empty entry between commas"),
        ("1rad,", "has an empty entry between commas"),
        ("1rad,2m", "must be in rad or a unit of the same kind, got '2m'"),
    ],
)
def test_a_list_with_a_bare_entry_is_refused(text: str, told: str) -> None:
    with pytest.raises(ValueError, match="--x") as error:
        quantities(text, "rad", "--x")
    assert told in str(error.value)


def test_plain_numbers_need_no_unit_in_a_list() -> None:
    assert quantities("1,2.5", "", "--x") == [1.0, 2.5]


def test_pi_has_fifty_decimals() -> None:
    with mpmath.workdps(60):
        assert abs(mpmath.mpf(PI.numerator) / PI.denominator - mpmath.pi) < mpmath.mpf("1e-50")


@given(finite, st.sampled_from(["m", "s", "rad", "rad/s", "kg", "m/s^2", "kg m^2", ""]))
def test_a_printed_number_comes_back(value: float, unit: str) -> None:
    assert quantity(f"{value!r} {unit}", unit, "--x") == value
    if "rad" not in unit:
        assert quantity(repr(value), unit, "--x") == value


LINEAR = [n for n in NAMES if NAMES[n][1] in ({"m": 1}, {"s": 1}, {"kg": 1})]


@given(finite, st.sampled_from(LINEAR))
def test_the_value_is_rounded_once(value: float, name: str) -> None:
    factor, powers = NAMES[name]
    (unit,) = powers
    exact = Fraction(repr(value)) * factor
    assume(value == 0.0 or 1e-300 < abs(exact) < 1e300)
    assert quantity(f"{value!r}{name}", unit, "--x") == float(exact)


@given(st.text(alphabet="0123456789.,eE+-*/^ mscradegkπ°²()_n", max_size=15))
def test_any_text_gives_a_finite_number_or_one_line(text: str) -> None:
    told = ""
    values = [0.0]
    try:
        values = quantities(text, "m", "--x")
        values.append(quantity(text, "m", "--x"))
    except ValueError as error:
        told = str(error)
    assert all(map(math.isfinite, values))
    assert not told or (told.startswith("--x") and "\n" not in told)


def test_text_is_read_without_pint() -> None:
    code = (
        "import sys; from pendula.units import quantity; "
        "quantity('50 cm', 'm', 'x'); quantity('3 inch', 'm', 'x'); "
        "assert 'pint' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", code], check=True)


def test_a_decimal_point_is_offered_only_after_a_bare_number() -> None:
    with pytest.raises(ValueError, match="write 30deg,60deg") as error:
        quantities("30deg,60", "rad", "--x")
    assert "decimal" not in str(error.value)


@given(finite, st.sampled_from(["deg", "grados", "turn", "gon", "arcmin"]))
def test_an_angle_of_a_number_is_that_of_its_double(value: float, name: str) -> None:
    """So "119.7deg" is `pendula.degrees(119.7)`, though 119.7 has no double of its own."""
    exact = Fraction(value) * NAMES[name][0]
    assume(value == 0.0 or 1e-300 < abs(exact) < 1e300)
    assert quantity(f"{value!r}{name}", "rad", "--x") == float(exact)
