"""Values are printed with the digits that their uncertainty leaves, by the rule of the PDG."""

import math

import pytest

from pendula.measured.rounding import rounded, with_uncertainty


@pytest.mark.parametrize(
    ("value", "uncertainty", "text"),
    [
        (0.827, 0.119, "0.83 ± 0.12"),  # the three examples of the Particle Data Group
        (0.827, 0.367, "0.8 ± 0.4"),
        (9.8067, 0.0354, "9.807 ± 0.035"),  # 354 keeps two digits, 355 one
        (9.8067, 0.0355, "9.81 ± 0.04"),
        (9.8067, 0.0949, "9.81 ± 0.09"),
        (9.8067, 0.0950, "9.81 ± 0.10"),  # 950 is rounded up to 1000, with two digits
        (9.8067, 0.9996, "9.8 ± 1.0"),
        (64.0763, 0.006, "64.076 ± 0.006"),
        (-0.0276, 0.004, "−0.028 ± 0.004"),
        (-0.001, 0.4, "0.0 ± 0.4"),  # no minus in front of zero
        (123456.0, 1234.0, "(1.235 ± 0.012) × 10⁵"),  # zeros would look like digits
        (1.23456e-5, 4.2e-8, "(1.235 ± 0.004) × 10⁻⁵"),
        (0.0, 3e-7, "(0.0 ± 3.0) × 10⁻⁷"),
        (2.5, 0.0, "2.5"),
        (0.75, 1e-60, "0.75000000000000000 ± 0.00000000000000017"),  # a double's own resolution
    ],
)
def test_digits_are_those_that_the_uncertainty_leaves(
    value: float, uncertainty: float, text: str
) -> None:
    assert with_uncertainty(value, uncertainty) == text


def test_halves_of_exact_decimals_go_to_the_even_digit() -> None:
    # both are exact in binary
    assert rounded(0.125, 0.1).value == "0.12"
    assert rounded(0.375, 0.1).value == "0.38"


def test_a_coverage_factor_widens_and_is_told() -> None:
    assert with_uncertainty(9.8067, 0.02, "m/s²", coverage=2) == "9.81 ± 0.04 m/s² (k = 2)"


def test_spanish_has_a_decimal_comma() -> None:
    shown = with_uncertainty(9.8067, 0.0123, "m/s²", coverage=2.5, language="es")
    assert shown == "9,807 ± 0,031 m/s² (k = 2,5)"


@pytest.mark.parametrize("unknown", [math.inf, math.nan])
def test_an_unknown_uncertainty_leaves_no_doubt(unknown: float) -> None:
    assert with_uncertainty(9.8067, unknown) == "9.81 ± ∞"


@pytest.mark.parametrize(
    ("arguments", "coverage", "error"),
    [
        ((math.nan, 1.0), 1.0, "value must be"),
        ((1.0, -0.1), 1.0, "uncertainty must be 0 or more, got -0.1"),
        ((1.0, 0.1), 0.0, "coverage must be positive"),
    ],
)
def test_what_is_no_uncertainty_is_refused(
    arguments: tuple[float, float], coverage: float, error: str
) -> None:
    with pytest.raises(ValueError, match=error):
        rounded(*arguments, coverage=coverage)


def test_an_unknown_language_is_refused() -> None:
    with pytest.raises(ValueError, match="language"):
        with_uncertainty(1.0, 0.1, language="fr")
