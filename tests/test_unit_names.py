"""The names that units are read with: none means another unit to someone else."""

from __future__ import annotations

import math
from contextlib import suppress
from fractions import Fraction
from typing import Any

import pint
import pytest
import xarray as xr

import pendula
from pendula import SimplePendulum
from pendula._unit_names import NAMES, PI, UnknownUnitError, looked_up
from pendula.events import angle
from pendula.units import quantity

SIMPLE = SimplePendulum()
REGISTRY: Any = pint.UnitRegistry()
Q: Any = REGISTRY.Quantity


def labelled(values: Any, unit: str) -> Any:
    return xr.DataArray(values, attrs={"units": unit})


FIRST = {str(each): name for name, each in reversed(NAMES.items())}  # of the names of one unit
NOT_OF_PINT = ("dps", "pound_force", "Nms")
OF_YARN = ("Nm", "mNm", "Nms")  # of which pint's are the counts; here of a torque


@pytest.mark.parametrize("name", NAMES)
def test_pint_knows_no_other_unit_of_that_name(name: str) -> None:
    """But for the rad of doses, in the plural, and kilo-seconds without the second."""
    try:
        known = looked_up(name)
    except UnknownUnitError:
        return
    assert known == NAMES[name] or name in ("rads", "kilos", *OF_YARN)


@pytest.mark.parametrize("name", FIRST.values())
def test_one_name_of_each_unit_is_known_to_pint(name: str) -> None:
    others = [each for each, unit in NAMES.items() if unit == NAMES[name]]
    known = []
    for each in others:
        with suppress(UnknownUnitError):
            known.append(looked_up(each))
    assert NAMES[name] in known or name in NOT_OF_PINT


WORDS = [
    ("1 giro", "rad", math.tau),
    ("1 revolucion", "rad", math.tau),
    ("2 REVOLUCIONES", "rad", 2 * math.tau),
    ("1 kilómetro", "m", 1000.0),
    ("2 decímetros", "m", 0.2),
    ("3 micrómetros", "m", 3e-6),
    ("1 micra", "m", 1e-6),
    ("1 miligramo", "kg", 1e-6),
    ("1 hectogramo", "kg", 0.1),
    ("2 kilos", "kg", 2.0),
    ("1 tonelada", "kg", 1000.0),
    ("1 día", "s", 86400.0),
    ("5 seg", "s", 5.0),
    ("2 hrs", "s", 7200.0),
    ("6 pies", "m", 1.8288),
    ("2 pulgadas", "m", 0.0508),
    ("1 nanosegundo", "s", 1e-9),
    ("30 minutos de arco", "rad", float(PI / 360)),
    ("30 minutes of arc", "rad", float(PI / 360)),
    ("30 arc minutes", "rad", float(PI / 360)),
    ("1 segundo de arco", "rad", float(PI / 648000)),
    ("30 grados sexagesimales", "rad", float(PI / 6)),
    ("100 grados centesimales", "rad", math.pi / 2),
    ("90 grados por segundo", "rad/s", math.pi / 2),
    ("90 degrees per second", "rad/s", math.pi / 2),
    ("90 dps", "rad/s", math.pi / 2),
    ("1 vuelta  por minuto", "rad/s", float(PI / 30)),
    ("1 rev per min", "rad/s", float(PI / 30)),
    ("9.81 metros por segundo al cuadrado", "m/s^2", 9.81),
    ("9.81 metros por segundo por segundo", "m/s^2", 9.81),
    ("9.81 meters per second squared", "m/s^2", 9.81),
    ("981 Gal", "m/s^2", 9.81),
    ("980665 mGal", "m/s^2", 9.80665),
    ("0.1 kg metro cuadrado", "kg m^2", 0.1),
    ("0.1 kilogram square metres", "kg m^2", 0.1),
    ("2 lb ft^2", "kg m^2", float(2 * Fraction("0.45359237") * Fraction("0.3048") ** 2)),
    ("3 por segundo", "1/s", 3.0),
    ("3 Hz", "1/s", 3.0),
]


@pytest.mark.parametrize(("text", "unit", "value"), WORDS)
def test_words_of_both_languages_are_read(text: str, unit: str, value: float) -> None:
    assert quantity(text, unit, "--x") == value


MISREAD = [
    (
        "500 gr",
        "kg",
        "--x must be in g or grain: gr can mean either, got '500 gr'; write 500g, say",
    ),
    ("500 GRS", "kg", "--x must be in g or grain: GRS can mean either"),
    ("500 gr cm^2", "kg m^2", "--x must be in g or grain: gr can mean either"),
    (
        "1 mil",
        "rad",
        "--x must not be in mil, which has several meanings, got '1 mil'; write 30deg",
    ),
    ("1 mils/s", "rad/s", "--x must not be in mils, which has several meanings"),
    ("1 milésima", "rad", "--x must not be in milésima, which has several meanings"),
    ("5 mil", "m", "--x must not be in mil, which has several meanings"),
    ("30 grade", "rad", "--x must be in deg or gon: grade can mean either"),
    ("30 GRA", "rad", "--x must be in deg or gon: GRA can mean either"),
    ("1 ton", "kg", "--x must not be in ton, which has several meanings"),
    ("1 libra", "kg", "--x must not be in libra, which has several meanings"),
    ("1 onza", "kg", "--x must not be in onza, which has several meanings"),
    ("1 mes", "s", "--x must not be in mes, which has several meanings"),
    ("1 año", "s", "--x must not be in año, which has several meanings"),
    ("2 hs", "s", "--x has the unknown unit 'hs'"),
    ("2 Ms", "s", "--x has the unknown unit 'Ms' in '2 Ms'; did you mean ms"),
    ("2 Mm", "m", "--x has the unknown unit 'Mm' in '2 Mm'; did you mean mm"),
    ("2 a", "s", "--x has the unknown unit 'a'"),
    ("2 u", "kg", "--x has the unknown unit 'u'"),
    ("2 ct", "kg", "--x has the unknown unit 'ct'"),
    ("2 point", "m", "--x has the unknown unit 'point'"),
    ("2 pt", "m", "--x has the unknown unit 'pt'"),
    ("2 gal", "m/s^2", "--x has the unknown unit 'gal' in '2 gal'; did you mean Gal"),
    ("2 mas", "rad", "--x has the unknown unit 'mas'"),
    ("30 circle", "rad", "--x has the unknown unit 'circle'"),
    ("30 Mrad", "rad", "did you mean mrad"),
    ("1 Kg", "kg", "did you mean kg"),
]


@pytest.mark.parametrize(("text", "unit", "told"), MISREAD)
def test_a_name_that_can_be_misread_is_refused(text: str, unit: str, told: str) -> None:
    with pytest.raises(ValueError, match="--x") as error:
        quantity(text, unit, "--x")
    assert told in str(error.value)


@pytest.mark.parametrize("prefix", ["deci", "yocto", "centi", "Mega"])
@pytest.mark.parametrize(
    ("word", "unit"), [("grado", "rad"), ("segundo", "s"), ("minuto", "s"), ("vuelta", "rad")]
)
def test_no_unit_with_another_prefix_is_offered(prefix: str, word: str, unit: str) -> None:
    with pytest.raises(ValueError, match="unknown unit") as error:
        quantity(f"1 {prefix}{word}", unit, "--x")
    assert "did you mean" not in str(error.value)


@pytest.mark.parametrize(
    ("typed", "unit", "meant"),
    [("kilgramo", "kg", "kilogramo"), ("centimetr", "m", "centimetro"), ("grdo", "rad", "grado")],
)
def test_a_misprint_is_told_what_it_is_nearest(typed: str, unit: str, meant: str) -> None:
    with pytest.raises(ValueError, match=f"did you mean .*{meant}"):
        quantity(f"1 {typed}", unit, "--x")


@pytest.mark.parametrize("unit", ["grade", "mil", "angular_minute", "arcminute", "cycle"])
def test_the_units_of_pint_are_those_of_pint(unit: str) -> None:
    """Whatever the same word can mean in text."""
    assert angle(1, Q(1, unit)).value == pytest.approx(Q(1, unit).m_as("rad"), rel=1e-15)


def test_a_unit_in_text_that_can_be_misread_is_refused() -> None:
    with pytest.raises(ValueError, match="mass must be in g or grain: gr can mean either, got"):
        SimplePendulum(mass=labelled(500.0, "gr"))
    with pytest.raises(ValueError, match="state must have theta in deg or gon: grad can mean"):
        pendula.solve(SIMPLE, labelled([1.0, 2.0], "grad"), 1)
    with pytest.raises(
        ValueError, match="amplitude must not be in mil, which has several meanings"
    ):
        SIMPLE.period(labelled(1.0, "mil"))
