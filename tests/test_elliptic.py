import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pendula import elliptic
from stored import BOUNDS, EPS

moduli = st.floats(0.0, 0.999999)


def test_the_ends_of_the_domain() -> None:
    assert elliptic.K(1.0) == elliptic.K(kc=0.0) == math.inf
    assert elliptic.E(1.0) == 1.0
    assert elliptic.K(0.0) == math.pi / 2
    assert elliptic.sncndn(0.5, 1.0).sn == pytest.approx(math.tanh(0.5), rel=1e-15)
    assert elliptic.am(0.5, 0.0) == 0.5
    assert math.isnan(elliptic.K(math.nan))
    assert math.isnan(elliptic.F(math.nan, 0.5))
    assert np.isnan(elliptic.sncndn([math.nan, 1.0], 0.5).cn).tolist() == [True, False]


@given(st.floats(-20, 20), moduli)
def test_the_amplitude_inverts_the_incomplete_integral(phi: float, k: float) -> None:
    """The rounding of F and that of am, of which a unit of F is dn units: at most one."""
    u = elliptic.F(phi, k)
    error = BOUNDS.incomplete * math.ulp(u) + BOUNDS.jacobi_ulps * math.ulp(phi)
    assert abs(elliptic.am(u, k) - phi) <= error


@given(st.floats(-20, 20), moduli)
def test_the_functions_go_together(u: float, k: float) -> None:
    """Squares (DLMF 22.6.1), am, and dn² = kc² + k² cn², each to its rounding."""
    sn, cn, dn = elliptic.sncndn(u, k)
    assert sn * sn + cn * cn == pytest.approx(1, abs=6 * EPS)
    assert dn * dn + k * k * sn * sn == pytest.approx(1, abs=6 * EPS)
    angle = elliptic.am(u, k)
    rounding = EPS * (4 + abs(angle))
    assert (math.sin(angle), math.cos(angle)) == pytest.approx((sn, cn), abs=rounding)


@given(st.floats(-20, 20), moduli)
def test_odd_and_even(u: float, k: float) -> None:
    sn, cn, dn = elliptic.sncndn(u, k)
    assert elliptic.sncndn(-u, k) == (-sn, cn, dn)
    assert elliptic.am(-u, k) == -elliptic.am(u, k)
    assert elliptic.F(-u, k) == -elliptic.F(u, k)


@given(st.floats(-9, 9), st.floats(-9, 9), moduli)
def test_the_addition_laws(u: float, v: float, k: float) -> None:
    """DLMF 22.8.1-3, of exact sums: the arguments are multiples of 2^-20."""
    u, v = (math.ldexp(round(math.ldexp(each, 20)), -20) for each in (u, v))
    (a, ca, da), (b, cb, db) = elliptic.sncndn(u, k), elliptic.sncndn(v, k)
    sn, cn, dn = elliptic.sncndn(u + v, k)
    below = 1 - (k * a * b) ** 2
    wanted = (
        a * cb * db + b * ca * da,
        ca * cb - a * b * da * db,
        da * db - k * k * a * b * ca * cb,
    )
    assert (sn * below, cn * below, dn * below) == pytest.approx(wanted, abs=16 * EPS)


@given(moduli)
def test_half_a_period_on(k: float) -> None:
    """Legendre's relation (DLMF 19.7.1), and am K = π/2."""
    kc = math.sqrt((1 - k) * (1 + k))
    K, E, Kc, Ec = elliptic.K(k), elliptic.E(k), elliptic.K(kc), elliptic.E(kc)
    if kc < 1 and k > 0:
        rounding = 20 * EPS * K * Kc + 2 * EPS / kc  # and kc's, where k is near 1 or near 0
        assert E * Kc + Ec * K - K * Kc == pytest.approx(math.pi / 2, abs=rounding)
    assert elliptic.am(K, k) == pytest.approx(math.pi / 2, abs=4 * EPS * K)


def test_the_series_gains_with_each_term() -> None:
    errors = [elliptic.K(0.6) - elliptic.K_series(0.6, terms) for terms in (1, 2, 4, 8, 16)]
    assert all(late < early for early, late in pairwise(errors))
    assert errors[-1] == pytest.approx(0, abs=1e-7)
    assert elliptic.K_series(kc=0.8, terms=9) == pytest.approx(elliptic.K_series(0.6, 9))
    assert elliptic.K_series([0.0, 0.6], 2) == pytest.approx([math.pi / 2, math.pi / 2 * 1.09])


def test_arguments_broadcast() -> None:
    u, k = np.linspace(-2, 2, 5), np.array([[0.1], [0.9]])
    values = elliptic.sncndn(u, k)
    assert values.dn.shape == (2, 5)
    assert values.cn[1, 3] == elliptic.sncndn(u[3], 0.9).cn
    assert isinstance(elliptic.K(0.5), float)
    assert elliptic.am(u, kc=0.2).shape == (5,)
    assert elliptic.K(np.empty(0)).shape == (0,)


def test_a_batch_is_bit_for_bit_its_parts() -> None:
    rng = np.random.default_rng(3)
    u, k = rng.uniform(-30, 30, 40), rng.choice([0.0, 0.3, 0.999, 1.0, 1.2, 50.0], 40)
    phi = rng.uniform(-1, 1, 40) * np.arcsin(1 / np.maximum(k, 1)) * 0.9
    below = np.minimum(k, 1)
    for count in range(1, 41):
        part = slice(40 - count, None)
        for function, first, moduli_ in ((elliptic.am, u, k), (elliptic.F, phi, k)):
            one = [function(x, m) for x, m in zip(first[part], moduli_[part], strict=True)]
            assert function(first[part], moduli_[part]).tolist() == one
        ones = [elliptic.sncndn(x, m) for x, m in zip(u[part], k[part], strict=True)]
        assert np.stack(elliptic.sncndn(u[part], k[part]), -1).tolist() == [list(x) for x in ones]
        for complete in (elliptic.K, elliptic.E):
            assert complete(below[part]).tolist() == [complete(m) for m in below[part]]
            assert complete(kc=below[part]).tolist() == [complete(kc=m) for m in below[part]]


NAN = math.nan


@pytest.mark.parametrize("good", [0.0, 0.4, 1.0])
def test_nan_gives_nan(good: float) -> None:
    for function in (elliptic.K, elliptic.E):
        assert math.isnan(function(NAN))
        assert math.isnan(function(kc=NAN))
        assert np.isnan(function([NAN, good])).tolist() == [True, False]
    assert math.isnan(elliptic.K_series(NAN, 5))
    for two in (elliptic.F, elliptic.am, elliptic.sncndn):
        for u, k in ((NAN, good), (good, NAN), (NAN, NAN), (0.0, NAN), (NAN, 1.5)):
            assert np.isnan(two(u, k)).all(), (two, u, k)
            if k != 1.5:
                assert np.isnan(two(u, kc=k)).all(), (two, u, k)
    assert np.isnan(elliptic.sncndn([NAN, 1.0], good).cn).tolist() == [True, False]


@pytest.mark.parametrize("modulus", [{"k": k} for k in (0.0, 0.5, 1.0, 3.0)] + [{"kc": 1e-300}])
def test_subnormal_arguments(modulus: dict[str, float]) -> None:
    for x in (5e-324, -1e-310, 0.0, -0.0):
        for value in (elliptic.am(x, **modulus), elliptic.F(x, **modulus)):
            assert (value, math.copysign(1, value)) == (x, math.copysign(1, x))
        assert elliptic.sncndn(x, **modulus) == (x, 1.0, 1.0)
    assert elliptic.K(5e-324) == elliptic.K(0.0) == elliptic.E(5e-324)
    assert elliptic.E(kc=5e-324) == 1.0
    assert elliptic.K(kc=5e-324) == pytest.approx(math.log(4) + 1074 * math.log(2), rel=1e-15)
    assert elliptic.sncndn(0.7, 5e-324) == pytest.approx((math.sin(0.7), math.cos(0.7), 1.0))


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: elliptic.K(1.5), r"^k must lie within \[0, 1\], got 1\.5 \(modulus"),
        (lambda: elliptic.K(-0.1), r"^k must lie within \[0, 1\], got -0\.1"),
        (lambda: elliptic.E([0.5, 2.0]), r"^k must lie within \[0, 1\], got 2\.0"),
        (lambda: elliptic.K_series(1.1, 3), r"^k must lie within \[0, 1\], got 1\.1"),
        (lambda: elliptic.F(1.0, [0.1, -0.2]), r"^k must be finite and not negative, got -0\.2"),
        (lambda: elliptic.am(1.0, -1e-300), r"^k must be finite and not negative, got -1e-300"),
        (lambda: elliptic.sncndn(1.0, math.inf), r"^k must be finite and not negative, got inf"),
        (lambda: elliptic.K(kc=2.0), r"^kc must lie within \[0, 1\], got 2\.0"),
        (lambda: elliptic.E(kc=-1.0), r"^kc must lie within \[0, 1\], got -1\.0"),
        (lambda: elliptic.F(1.0, kc=1.1), r"^kc must lie within \[0, 1\], got 1\.1"),
        (lambda: elliptic.sncndn(1.0, kc=math.inf), r"^kc must lie within \[0, 1\], got inf"),
        (elliptic.K, "one of the two"),
        (elliptic.E, "one of the two"),
        (lambda: elliptic.F(1.0), "one of the two"),
        (lambda: elliptic.am(1.0, 0.5, kc=0.5), "one of the two"),
        (lambda: elliptic.sncndn(1.0), "one of the two"),
        (lambda: elliptic.F(1.0, 1.5), r"^phi must, for k > 1, lie within.*got 1\.0 for k = 1\.5"),
        (lambda: elliptic.F([0.1, 3.1], 1.5), r"^phi must.*got 3\.1 for k = 1\.5"),
        (lambda: elliptic.am(math.inf, 0.5), r"^u must be at most 2\^\d+ half periods.*got inf"),
        (lambda: elliptic.sncndn([1.0, -1e70], 0.5), r"^u must be at most.*got -1e\+70"),
        (lambda: elliptic.am(1e300, kc=1e-9), r"^u must be at most.*got 1e\+300"),
        (lambda: elliptic.K_series(0.5, 0), "terms must be a whole number from 1 to"),
        (lambda: elliptic.K_series(0.5, 10**30), "terms must be a whole number from 1 to"),
        (lambda: elliptic.K_series(0.5), "terms must be a whole number from 1 to"),
        (lambda: elliptic.K_series(0.5, 2.5), "terms must be a whole number"),  # type: ignore[arg-type]
    ],
)
def test_what_is_outside_the_domain_is_refused(call: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()
