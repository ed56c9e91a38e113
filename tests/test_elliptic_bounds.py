"""The elliptic functions against values with many digits: within their bounds, all over."""

from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

import truth
from motions import powers, signed
from pendula import elliptic
from stored import BOUNDS, cases, in_epsilons, in_ulps

STORED = cases("elliptic.json")
KINDS = sorted({case["kind"] for case in STORED})
Modulus = dict[str, float]


def jacobi_error(u: float, modulus: Modulus, wanted: Any) -> float:
    """The largest error of am, sn, cn and dn, each over its bound."""
    got = (elliptic.am(u, **modulus), *elliptic.sncndn(u, **modulus))
    ulps = modulus.get("k", 0.0) <= 1.0  # above, am and dn have zeros as sn and cn have
    return max(
        in_ulps(value, want) / BOUNDS.jacobi_ulps
        if ulps and name in {"am", "dn"}
        else in_epsilons(value, want) / BOUNDS.jacobi_epsilons
        for name, value, want in zip(("am", "sn", "cn", "dn"), got, wanted, strict=True)
    )


@pytest.mark.parametrize("kind", KINDS)
def test_the_stored_values_of_every_kind(kind: str) -> None:
    function = kind.partition(":")[0]
    for case in STORED:
        if case["kind"] != kind:
            continue
        modulus: Modulus = {name: float.fromhex(case[name]) for name in ("k", "kc") if name in case}
        if function == "jacobi":
            wanted = [case[name] for name in ("am", "sn", "cn", "dn")]
            error = jacobi_error(float.fromhex(case["u"]), modulus, wanted)
        elif function == "F":
            value = elliptic.F(float.fromhex(case["phi"]), **modulus)
            error = in_ulps(value, case["value"]) / BOUNDS.incomplete
        else:
            value = getattr(elliptic, function)(**modulus)
            error = in_ulps(value, case["value"]) / BOUNDS.complete
        assert error <= 1, case


to_one = st.one_of(
    st.floats(0, 1).map(lambda k: {"k": k}),
    powers(-300, 0).map(lambda k: {"k": k}),
    powers(-16, 0).map(lambda x: {"k": 1 - x}),
    st.floats(0, 1).map(lambda kc: {"kc": kc}),
    powers(-300, 0).map(lambda kc: {"kc": kc}),
    powers(-20, 0).map(lambda kc: {"kc": kc}),
)
above_one = st.one_of(powers(-15, 6).map(lambda x: {"k": 1 + x}))
amplitudes = st.one_of(st.floats(-1.5, 1.5), signed(powers(-300, 0)), signed(powers(0, 9)))
arguments = st.one_of(st.floats(-20, 20), signed(powers(-300, 0)), signed(powers(0, 15)))


@settings(max_examples=200)
@given(to_one)
def test_complete_integrals_agree_with_mpmath(modulus: Modulus) -> None:
    """By mpmath's own functions of m = k²."""
    kc = modulus.get("kc", 1.0)
    with mp.workdps(40 if kc > 1e-9 else 700):
        m = mpf(modulus["k"]) ** 2 if "k" in modulus else 1 - mpf(kc) ** 2
        K, E = mp.ellipk(m), mp.ellipe(m)
    assert in_ulps(elliptic.K(**modulus), K) <= BOUNDS.complete
    assert in_ulps(elliptic.E(**modulus), E) <= BOUNDS.complete
    assert elliptic.K_series(**modulus, terms=50) <= elliptic.K(**modulus) * (1 + 1e-15)


def working_digits(modulus: Modulus) -> int:
    return truth.digits(**modulus) - 60


@settings(max_examples=150)
@given(amplitudes, to_one)
def test_the_incomplete_integral_of_any_amplitude(phi: float, modulus: Modulus) -> None:
    want = truth.settled(lambda: [truth.F_of(phi, **modulus)], working_digits(modulus), 26)[0]
    assert in_ulps(elliptic.F(phi, **modulus), want) <= BOUNDS.incomplete


@settings(max_examples=100)
@given(st.floats(-1, 1), above_one)
def test_the_incomplete_integral_beyond_one(part: float, modulus: Modulus) -> None:
    with mp.workdps(60):
        phi = float(part * mp.asin(1 / mpf(modulus["k"])))
        assume(abs(modulus["k"] * mp.sin(mpf(phi))) < 1)
    want = truth.settled(lambda: [truth.F_of(phi, **modulus)], 80, 26)[0]
    assert in_ulps(elliptic.F(phi, **modulus), want) <= BOUNDS.incomplete


@settings(max_examples=300)
@given(arguments, st.one_of(to_one, to_one, above_one))
def test_the_jacobi_functions_of_any_argument(u: float, modulus: Modulus) -> None:
    dps = working_digits(modulus)
    want = truth.settled(lambda: truth.jacobi_of(u, **modulus), dps, 26)
    assert jacobi_error(u, modulus, want) <= 1


@settings(max_examples=50)
@given(st.floats(-9, 9), st.floats(0, 0.999999))
def test_the_jacobi_functions_agree_with_mpmath(u: float, k: float) -> None:
    """By mpmath's own theta functions."""
    with mp.workdps(50):
        want = [mp.ellipfun(name, mpf(u), k=mpf(k)) for name in ("sn", "cn", "dn")]
    sn, cn, dn = elliptic.sncndn(u, k)
    assert in_epsilons(sn, want[0]) <= BOUNDS.jacobi_epsilons
    assert in_epsilons(cn, want[1]) <= BOUNDS.jacobi_epsilons
    assert in_ulps(dn, want[2]) <= BOUNDS.jacobi_ulps
