import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from pendula import elliptic

MODULI = [0.0, 1e-9, 0.1, 0.5, 0.8, 0.99, 0.999999, 1 - 2**-40]
moduli = st.floats(0.0, 0.999999)


@pytest.mark.parametrize("k", MODULI)
def test_complete_integrals_agree_with_mpmath(k: float) -> None:
    with mp.workdps(40):
        K, E = float(mp.ellipk(mpf(k) ** 2)), float(mp.ellipe(mpf(k) ** 2))
    assert abs(elliptic.K(k) - K) <= 4 * math.ulp(K)
    assert abs(elliptic.E(k) - E) <= 4 * math.ulp(E)
    assert elliptic.K_series(k, 100) <= K * (1 + 1e-15)


@pytest.mark.parametrize("kc", [1.0, 0.3, 1e-5, 1.1e-9, 1e-20, 5.3e-159, 1e-300])
def test_complete_integrals_of_the_complement(kc: float) -> None:
    with mp.workdps(700):
        m = 1 - mpf(kc) ** 2
        K, E = float(mp.ellipk(m)), float(mp.ellipe(m))
    assert abs(elliptic.K(kc=kc) - K) <= 4 * math.ulp(K)
    assert abs(elliptic.E(kc=kc) - E) <= 4 * math.ulp(E)


def test_the_ends_of_the_domain() -> None:
    assert elliptic.K(1.0) == elliptic.K(kc=0.0) == math.inf
    assert elliptic.E(1.0) == 1.0
    assert elliptic.K(0.0) == math.pi / 2
    assert elliptic.sncndn(0.5, 1.0).sn == pytest.approx(math.tanh(0.5), rel=1e-15)
    assert elliptic.am(0.5, 0.0) == 0.5
    assert math.isnan(elliptic.K(math.nan))
    assert math.isnan(elliptic.F(math.nan, 0.5))
    assert np.isnan(elliptic.sncndn([math.nan, 1.0], 0.5).cn).tolist() == [True, False]


@pytest.mark.parametrize("k", MODULI)
@pytest.mark.parametrize("phi", [-4.0, 0.3, 1.5, 7.0])
def test_the_incomplete_integral_agrees_with_mpmath(k: float, phi: float) -> None:
    with mp.workdps(40):
        want = float(mp.ellipf(mpf(phi), mpf(k) ** 2))
    assert elliptic.F(phi, k) == pytest.approx(want, rel=2e-14)


@pytest.mark.parametrize("k", MODULI)
@pytest.mark.parametrize("u", [-11.0, -0.7, 1e-8, 1.2, 5.0])
def test_the_jacobi_functions_agree_with_mpmath(k: float, u: float) -> None:
    with mp.workdps(40):
        want = [float(mp.ellipfun(name, mpf(u), k=mpf(k))) for name in ("sn", "cn", "dn")]
    np.testing.assert_allclose(elliptic.sncndn(u, k), want, rtol=0, atol=2e-14)


@pytest.mark.parametrize("kc", [0.75, 0.7, 0.1, 1e-4, 1e-8, 1e-12, 1e-20, 1e-40])
def test_small_values_keep_their_digits_next_to_modulus_one(kc: float) -> None:
    """In units of the error of u, which grows with the multiples of K taken off."""
    with mp.workdps(110):
        m = 1 - mpf(kc) ** 2
        K = mp.ellipk(m)
        for part in (0.1, 0.5, 0.9, 1.0, 1.3, 2.2, 3.7):
            u = float(part * K)
            want = [mp.ellipfun(name, mpf(u), m=m) for name in ("sn", "cn", "dn")]
            sn, cn, dn = elliptic.sncndn(u, kc=kc)
            assert abs(sn - want[0]) < 4e-16 * (2 + u)
            assert abs(cn - want[1]) < 4e-16 * (2 + u)
            assert abs(dn / want[2] - 1) < 8e-16 * (2 + u)


@given(st.floats(-20, 20), moduli)
def test_the_amplitude_inverts_the_incomplete_integral(phi: float, k: float) -> None:
    assert elliptic.am(elliptic.F(phi, k), k) == pytest.approx(phi, abs=1e-12, rel=1e-12)


@given(st.floats(-20, 20), moduli)
def test_the_squares_add_up(u: float, k: float) -> None:
    sn, cn, dn = elliptic.sncndn(u, k)
    assert sn * sn + cn * cn == pytest.approx(1, abs=1e-15 * 4)
    assert dn * dn + k * k * sn * sn == pytest.approx(1, abs=1e-14)


@given(st.floats(-3, 3), st.floats(-3, 3), moduli)
def test_the_addition_law(u: float, v: float, k: float) -> None:
    """DLMF 22.8.1."""
    (a, ca, da), (b, cb, db) = elliptic.sncndn(u, k), elliptic.sncndn(v, k)
    below = 1 - (k * a * b) ** 2
    assert elliptic.sncndn(u + v, k).sn * below == pytest.approx(
        a * cb * db + b * ca * da, abs=1e-12
    )


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


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: elliptic.K(1.5), r"k must lie within \[0, 1\], got 1\.5"),
        (lambda: elliptic.F(1.0, [0.1, -0.2]), r"k must lie within \[0, 1\], got -0\.2"),
        (lambda: elliptic.K(kc=2.0), r"kc must lie within"),
        (elliptic.K, "one of the two"),
        (lambda: elliptic.am(1.0, 0.5, kc=0.5), "one of the two"),
        (lambda: elliptic.K_series(0.5, 0), "terms must be a whole number from 1 to"),
        (lambda: elliptic.K_series(0.5, 10**30), "terms must be a whole number from 1 to"),
        (lambda: elliptic.K_series(0.5), "terms must be a whole number from 1 to"),
        (lambda: elliptic.K_series(0.5, 2.5), "terms must be a whole number"),  # type: ignore[arg-type]
    ],
)
def test_what_is_outside_the_domain_is_refused(call: Any, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call()
