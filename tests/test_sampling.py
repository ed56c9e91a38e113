"""Sets of rows: each by itself, the same everywhere, spread as they should be."""

from __future__ import annotations

import json
import math
import pickle
from itertools import pairwise
from statistics import NormalDist
from typing import Any

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from pendula.many.sampling.bits import exp2
from pendula.many.sampling.normal import FARTHEST, normals
from pendula.sampling import (
    Choice,
    Fixed,
    Grid,
    Listed,
    LogUniform,
    Normal,
    SameAs,
    Sampler,
    Uniform,
    sampler_from,
)

MIXED = Sampler(
    (
        ("m1", Fixed(2.0)),
        ("l1", LogUniform(0.1, 10.0)),
        ("l2", SameAs("l1")),
        ("theta1", Grid(-math.pi, math.pi, 5)),
        ("theta2", Uniform(-1.0, 1.0)),
        ("omega1", Listed((0.0, 3.0))),
        ("omega2", Choice((1.0, 2.0, 4.0))),
    ),
    draws=100,
    seed=7,
)


@given(st.lists(st.integers(0, MIXED.count), min_size=1, max_size=6))
def test_a_row_is_the_same_however_rows_are_cut(cuts: list[int]) -> None:
    whole = MIXED.rows(0, MIXED.count)
    places = [0, *sorted(cuts), MIXED.count]
    parts = [MIXED.rows(a, b) for a, b in pairwise(places)]
    for name, values in whole.items():
        joined = np.concatenate([part[name] for part in parts])
        assert joined.tobytes() == values.tobytes(), name


@given(st.integers(0, 2**53 - 8), st.integers(0, 7))
def test_rows_far_out_are_the_same_alone(start: int, n: int) -> None:
    many = Sampler((("x", Uniform(0.0, 1.0)),), draws=2**53, seed=2**64 - 1)
    several = many.rows(start, start + 8)["x"]
    assert many.rows(start + n, start + n + 1)["x"][0] == several[n]


# Philox4x64-10 with key (seed, first 8 bytes of BLAKE2b-64 of the name) and counter 1 + i // 4.
FROZEN: dict[str, list[str]] = {
    "l1": [
        "0x1.f806dbcbf8e5dp-3",
        "0x1.ed1ed340d04b5p+2",
        "0x1.3d2ac6a6669f2p+2",
        "0x1.15d15a6110bbcp+3",
    ],
    "theta2": [
        "0x1.82a0a25d8c77ep-1",
        "-0x1.1d74ac532af00p-1",
        "-0x1.42e0e5e7579c0p-3",
        "0x1.c8e17834a4ab2p-1",
    ],
    "omega2": [
        "0x1.0000000000000p+2",
        "0x1.0000000000000p+0",
        "0x1.0000000000000p+2",
        "0x1.0000000000000p+0",
    ],
}


def test_rows_are_those_of_every_machine() -> None:
    rows = MIXED.rows(98, 102)
    assert {n: [x.hex() for x in v.tolist()] for n, v in rows.items() if n in FROZEN} == FROZEN
    assert set(FROZEN) == {"l1", "theta2", "omega2"}


def philox(counter: int, key: tuple[int, int]) -> list[int]:
    """Philox4x64-10 as Salmon et al. (SC 2011) write it."""
    word = 2**64 - 1
    c, (k0, k1) = [counter >> 64 * i & word for i in range(4)], key
    for _ in range(10):
        a, b = 0xD2E7470EE14C6C93 * c[0], 0xCA5A826395121157 * c[2]
        c = [b >> 64 ^ c[1] ^ k0, b & word, a >> 64 ^ c[3] ^ k1, a & word]
        k0, k1 = k0 + 0x9E3779B97F4A7C15 & word, k1 + 0xBB67AE8584CAA73B & word
    return c


def test_random_bits_are_those_of_the_paper() -> None:
    import hashlib

    assert philox(0, (0, 0))[0] == 0x16554D9ECA36314C  # Random123's known answers
    stream = int.from_bytes(hashlib.blake2b(b"x", digest_size=8).digest(), "little")
    sampler = Sampler((("x", Uniform(0.0, 1.0)),), draws=10**6, seed=5)
    for i in (0, 3, 4, 999_999):
        expected = (philox(1 + i // 4, (5, stream))[i % 4] >> 11) * 2.0**-53
        assert sampler.rows(i, i + 1)["x"][0] == expected


def test_columns_do_not_depend_on_one_another() -> None:
    alone = Sampler((("theta2", Uniform(-1.0, 1.0)),), draws=50, seed=7).rows(0, 50)["theta2"]
    both = (("theta1", Uniform(-1.0, 1.0)), ("theta2", Uniform(-1.0, 1.0)))
    rows = Sampler(both, draws=50, seed=7).rows(0, 50)
    np.testing.assert_array_equal(rows["theta2"], alone)
    assert not (rows["theta1"] == alone).any()
    other = Sampler(both, draws=50, seed=8).rows(0, 50)
    assert not (rows["theta1"] == other["theta1"]).any()


@pytest.mark.parametrize("seed", [0, 1, 2**64 - 1])
def test_uniform_values_fill_the_range_evenly(seed: int) -> None:
    n, boxes = 200_000, 64
    columns = (("a", Uniform(-2.0, 6.0)), ("b", Uniform(-2.0, 6.0)))
    rows = Sampler(columns, draws=n, seed=seed).rows(0, n)
    counts = np.histogram2d(rows["a"], rows["b"], bins=boxes, range=[(-2, 6), (-2, 6)])[0]
    chi_square = float(((counts - n / boxes**2) ** 2).sum() / (n / boxes**2))
    freedom = boxes**2 - 1
    assert abs(chi_square - freedom) < 4 * math.sqrt(2 * freedom)
    assert abs(np.corrcoef(rows["a"][1:], rows["a"][:-1])[0, 1]) < 4 / math.sqrt(n)


def test_logarithms_of_log_uniform_values_fill_the_range_evenly() -> None:
    n, boxes = 100_000, 50
    x = Sampler((("x", LogUniform(1e-3, 1e2)),), draws=n).rows(0, n)["x"]
    counts = np.histogram(np.log10(x), bins=boxes, range=(-3, 2))[0]
    assert counts.sum() == n
    chi_square = float(((counts - n / boxes) ** 2).sum() / (n / boxes))
    assert abs(chi_square - (boxes - 1)) < 4 * math.sqrt(2 * (boxes - 1))


def test_choices_are_drawn_alike() -> None:
    n = 90_000
    x = Sampler((("x", Choice((3.0, 1.0, 2.0))),), draws=n, seed=1).rows(0, n)["x"]
    values, counts = np.unique(x, return_counts=True)
    assert values.tolist() == [1.0, 2.0, 3.0]
    assert np.abs(counts - n / 3).max() < 4 * math.sqrt(n * 2 / 9)


@given(st.floats(-40.0, 40.0))
def test_powers_of_two_are_right_to_the_last_bits(x: float) -> None:
    with mpmath.workdps(40):
        truth = mpmath.mpf(2) ** mpmath.mpf(x)
        error = abs(mpmath.mpf(float(exp2(np.array([x]))[0])) - truth) / truth
    assert float(error) < 2.0**-52


def test_powers_of_two_have_the_same_bits_everywhere() -> None:
    expected = ["0x1.0000000000000p+0", "0x1.6a09e667f3bccp+0", "0x1.6a09e667f3bccp-1"]
    assert [x.hex() for x in exp2(np.array([0.0, 0.5, -0.5])).tolist()] == expected


@given(
    st.floats(-1e6, 1e6), st.floats(1e-3, 1e6), st.integers(2, 3000), st.sampled_from([True, False])
)
def test_a_grid_has_its_ends_and_opposites(
    low: float, width: float, count: int, opposite: bool
) -> None:
    low, high = (-width, width) if opposite else (low, low + width)
    values = Grid(low, high, count).at(np.arange(count))
    assert (values[0], values[-1]) == (low, high)
    np.testing.assert_allclose(values, np.linspace(low, high, count), rtol=1e-15, atol=1e-9)
    assert (np.diff(values) > 0).all()
    if opposite:
        np.testing.assert_array_equal(values, -values[::-1])


def test_a_grid_of_whole_numbers_is_whole() -> None:
    assert Grid(0.0, 10.0, 11).at(np.arange(11)).tolist() == list(range(11))


def test_a_pass_through_the_grids_follows_another_for_each_draw() -> None:
    columns = (("a", Listed((1.0, 2.0))), ("b", Grid(0.0, 2.0, 3)), ("x", Uniform(0.0, 1.0)))
    sampler = Sampler(columns, draws=2)
    assert (sampler.count, sampler.shape) == (12, (2, 3))
    rows = sampler.rows(0, 12)
    assert rows["a"].tolist() == ([1.0] * 3 + [2.0] * 3) * 2
    assert rows["b"].tolist() == [0.0, 1.0, 2.0] * 4
    assert len(set(rows["x"].tolist())) == 12


def test_more_draws_leave_the_rows_that_there_are() -> None:
    columns = (("n", Normal(1.0, 2.0)), *MIXED.columns)
    few, many = Sampler(columns, draws=2, seed=7), Sampler(columns, draws=9, seed=7)
    rows = many.rows(0, few.count)
    for name, values in few.rows(0, few.count).items():
        assert values.tobytes() == rows[name].tobytes(), name


def test_normal_values_are_the_quantiles_of_their_bits() -> None:
    """From mpmath with 40 digits, to the rounding of the last operations."""
    places = [0, 1, 17, 2**20, 2**40, 2**51 + 3, 2**52 - 1, int(0.075 * 2**53), int(0.0749 * 2**53)]
    places += [int(math.exp(-25.0) * 2**53) + i for i in (0, 1)]  # where the far tail begins
    with mpmath.workdps(40):
        expected = [
            mpmath.sqrt(2) * mpmath.erfinv(1 - 2 * (mpmath.mpf(k) + 0.5) / 2**53) for k in places
        ]
        for sign, bit in ((1, 1), (-1, 0)):
            found = normals(np.array([k << 12 | bit for k in places], np.uint64))
            for value, exact in zip(found.tolist(), expected, strict=True):
                assert abs(sign * value / exact - 1) < 5e-16
    assert float(expected[0]) < FARTHEST < float(expected[0]) + 1e-4


def test_normal_values_are_distributed_normally() -> None:
    n, boxes = 200_000, 60
    x = Sampler((("x", Normal(3.0, 0.5)),), draws=n, seed=4).rows(0, n)["x"]
    ends = [NormalDist(3.0, 0.5).inv_cdf(i / boxes) for i in range(1, boxes)]
    counts = np.histogram(x, bins=[-math.inf, *ends, math.inf])[0]
    chi_square = float(((counts - n / boxes) ** 2).sum() / (n / boxes))
    assert abs(chi_square - (boxes - 1)) < 4 * math.sqrt(2 * (boxes - 1))
    low, high = Normal(3.0, 0.5).ends
    assert low < x.min() < x.max() < high


def test_a_count_may_be_written_as_a_float() -> None:
    made = Sampler((("x", Normal(0.0, 1.0)), ("y", Grid(0.0, 1.0, 3.0))), draws=1e5)  # type: ignore[arg-type]
    assert made == Sampler((("x", Normal(0.0, 1.0)), ("y", Grid(0.0, 1.0, 3))), draws=10**5)
    assert json.dumps(made.description()["draws"]) == "100000"


def test_a_column_may_be_that_of_another() -> None:
    rows = MIXED.rows(5, 50)
    assert rows["l1"].tobytes() == rows["l2"].tobytes()
    assert list(rows) == [name for name, _ in MIXED.columns]


def test_a_sampler_goes_through_pickle_and_json() -> None:
    assert pickle.loads(pickle.dumps(MIXED)) == MIXED
    assert sampler_from(json.loads(json.dumps(MIXED.description()))) == MIXED
    assert hash(MIXED) == hash(sampler_from(MIXED.description()))


def test_rows_are_counted_from_0() -> None:
    assert MIXED.rows(3, 3)["theta1"].shape == (0,)
    for start, stop in ((-1, 2), (3, 2), (0, MIXED.count + 1)):
        with pytest.raises(IndexError, match="there are rows 0 to 1000"):
            MIXED.rows(start, stop)


@pytest.mark.parametrize(
    ("make", "says"),
    [
        (lambda: Fixed(math.nan), "value must be a finite number, got nan"),
        (lambda: Uniform(1.0, 1.0), "a range must rise, got 1.0 to 1.0"),
        (lambda: Uniform(-1.5e308, 1.5e308), "a range must not be wider than numbers go"),
        (lambda: Uniform(0.0, math.inf), "high must be a finite number"),
        (lambda: LogUniform(0.0, 1.0), "log_uniform must begin above zero, got 0.0"),
        (lambda: LogUniform(1e-300, 1e300), "log_uniform must not be wider"),
        (lambda: Choice(()), "a choice must have at least one value"),
        (lambda: Listed((1.0, math.inf)), "each value of a list must be a finite number"),
        (lambda: Grid(0.0, 1.0, 1), "a grid must have at least 2 values, got 1"),
        (lambda: Normal(0.0, 0.0), "the standard deviation must be positive, got 0.0"),
        (lambda: Normal(math.nan, 1.0), "mean must be a finite number"),
        (lambda: Normal(1e308, 1e308), "a normal must not be wider than numbers go"),
        (lambda: Sampler((("a", Normal(0, 1)),), draws=1.5), "draws must be a whole number"),  # type: ignore[arg-type]
        (lambda: Grid(0.0, 1.0, 2.5), "the count of a grid must be a whole number"),  # type: ignore[arg-type]
        (lambda: Grid(0.0, 1e308, 10), "a grid must end before"),
        (lambda: Sampler((("a", Fixed(1.0)),), draws=2), "draws must be 1 where nothing is random"),
        (lambda: Sampler((("a", Uniform(0, 1)),), draws=0), "draws must be a whole number"),
        (lambda: Sampler((("a", Uniform(0, 1)),), seed=-1), "seed must be a whole number from 0"),
        (lambda: Sampler((("a", Fixed(1)), ("a", Fixed(1)))), "different names, got a, a"),
        (lambda: Sampler((("a", SameAs("b")),)), "a: same_as must be one of"),
        (
            lambda: Sampler((("a", Grid(0, 1, 2**30)), ("b", Grid(0, 1, 2**30)))),
            "at most 2\\^53 rows",
        ),
    ],
)
def test_what_cannot_be_sampled_is_told(make: Any, says: str) -> None:
    with pytest.raises(ValueError, match=says):
        make()
