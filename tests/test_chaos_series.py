"""The 0–1 test and the frequencies of series, against values from outside."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest

import refusals
from pendula import DoublePendulum, SimplePendulum, exact, solve
from pendula.chaos import frequencies, zero_one

# K, K_c of the first c and of c 50, summed as Gottwald & Melbourne (2009) write it, in numpy
LOGISTIC = [
    (3.55, -0.0002725958048126063, 0.0031764703746882668, 0.9834514328421611),
    (3.97, 0.9977739592955803, 0.9974617054662598, 0.998347441634209),
    (3.9, 0.9976047931111051, 0.9952890920457117, 0.9961975843336468),
    (3.5699, 0.005492913372296612, 0.014322835293451767, 0.9834514950503132),
]

# ω and the amplitudes of ω, 3ω, 5ω, 7ω: nome series of am(u, k), mpmath, 40 digits
LIBRATION = [
    (
        (1.0, 9.81, 1.0),
        2.9372515847220753548,
        (1.00550444192923136, 0.00555823286526640836, 5.44172347969748285e-5, 6.34242045506228e-7),
    ),
    (
        (2.5, 9.81, 1.0),
        1.9063454091998012706,
        (2.62928852418486795, 0.140055991252571187, 0.0118392106990659854, 0.00118825224728560987),
    ),
    (
        (3.0, 9.80665, 0.5),
        1.7223989098196781606,
        (3.35294537237109391, 0.415048468592396142, 0.0749758869029937685, 0.0157895892020774112),
    ),
]

RODS = DoublePendulum.rods(gravity=9.81)
WAVES = np.cos(0.9 * np.arange(60.0)) + 0.1 * np.cos(2.1 * np.arange(60.0))


def logistic(r: float, count: int) -> Any:
    x, values = 0.1, []
    for _ in range(1000 + count):
        x = r * x * (1.0 - x)
        values.append(x)
    return np.array(values[1000:])


@pytest.mark.parametrize(("r", "value", "first", "at_50"), LOGISTIC)
def test_the_logistic_map(r: float, value: float, first: float, at_50: float) -> None:
    found = zero_one(logistic(r, 2000))
    assert abs(found.value - value) < 1e-13
    assert abs(found.values[0] - first) < 1e-12
    assert abs(found.values[50] - at_50) < 1e-12
    assert found.verdict == ("chaotic" if value > 0.9 else "regular")
    assert not found.oversampled


def test_the_displacement_is_the_mean_that_the_paper_writes() -> None:
    """The convolution against the sum itself, of a series with a large mean."""
    series = 5.0 + logistic(3.9, 300)
    c, count, most = 1.234, 300, 30
    places = np.arange(1, count + 1)
    path = np.cumsum(series * np.exp(1j * c * places))
    lags = np.arange(1, most + 1)
    moved = [np.mean(abs(path[n : count - most + n] - path[: count - most]) ** 2) for n in lags]
    moved -= series.mean() ** 2 * (1.0 - np.cos(lags * c)) / (1.0 - np.cos(c))
    assert zero_one(series, [c]).values[0] == pytest.approx(
        np.corrcoef(lags, moved)[0, 1], abs=1e-12
    )


def test_oversampling_is_told() -> None:
    """The same chaotic motion, sampled every 10 ms and every 0.5 s."""
    start = (2.0, 2.5, 0.0, 0.0)
    often, rarely = (
        zero_one(np.sin(solve(RODS, start, np.arange(2000) * step).states[:, 1]))
        for step in (0.01, 0.5)
    )
    assert often.oversampled
    assert often.value < 0.5
    assert often.verdict == "undecided"
    assert often.first_zero > 10
    assert not rarely.oversampled
    assert rarely.verdict == "chaotic"
    assert "oversampled" in repr(often)


def test_frequencies_drawn_by_a_seed() -> None:
    series = logistic(3.9, 500)
    one, same, other = (zero_one(series, 7, seed) for seed in (1, 1, 2))
    assert np.array_equal(one.c, same.c)
    assert not np.array_equal(one.c, other.c)
    assert one.c.size == 7
    assert ((one.c > math.pi / 5) & (one.c < 4 * math.pi / 5)).all()


@pytest.mark.parametrize(
    ("series", "c", "says"),
    [
        ([1.0] * 200, None, "series must vary, got 1.0 in every sample"),
        ([1.0, 2.0], None, "series must hold from 100"),
        (logistic(3.9, 200), [0.0], "c must not be a multiple of 2 pi"),
        (logistic(3.9, 200), 0, "c must be a whole number from 1"),
        ([math.nan] * 200, None, "series must hold finite numbers, got nan at series[0]"),
        ([logistic(3.9, 200), [2.0] * 200], None, "series[1] must vary, got 2.0 in every sample"),
        ([[0.0] * 200, [math.nan] * 200], None, "got nan at series[1, 0]"),
        (np.zeros((200, 4)), None, "got shape (200, 4); give several quantities as rows"),
        (np.zeros((2, 2, 200)), None, "series must hold from 100"),
        (np.zeros((0, 200)), None, "series must hold from 100"),
    ],
)
def test_a_series_that_cannot_be_tested(series: Any, c: Any, says: str) -> None:
    assert says in refusals.told(lambda: zero_one(series, c))


@pytest.mark.parametrize("threads", [1, 2, 3])
@pytest.mark.parametrize(("count", "c"), [(301, None), (70001, [1.0, 1.7])])
def test_several_series_are_tested_to_the_bits_of_each(
    threads: int, count: int, c: list[float] | None
) -> None:
    """Blocks of several series, and long series, one a block; one series is told as ever."""
    rates = (3.9, 3.55, 3.97, 3.5699, 3.8)
    series = [logistic(rate, count) + i for i, rate in enumerate(rates)]
    many = zero_one(series, c, threads=threads)
    assert many.values.shape == (5, many.c.size)
    for i, each in enumerate(series):
        one = zero_one(each, c)
        assert (many.value[i], many.first_zero[i]) == (one.value, one.first_zero)
        assert (many.verdict[i], many.oversampled[i]) == (one.verdict, one.oversampled)
        assert np.array_equal(many.values[i], one.values)
        assert np.array_equal(many.c, one.c)
        assert many.recipe == one.recipe
    told = one.value, one.first_zero, one.oversampled, one.verdict
    assert [type(each) for each in told] == [float, int, bool, str]
    assert one.values.shape == one.c.shape
    assert zero_one(series[:1], c).value.shape == (1,)


def test_tests_of_several_series_as_text_and_as_a_dataset() -> None:
    slow = np.sin(np.arange(500) * 0.05) + 0.1 * logistic(3.9, 500)
    found = zero_one([logistic(3.9, 500), logistic(3.55, 500), slow])
    assert repr(found) == (
        "<ZeroOne of 3 series: 1 chaotic, 1 regular, 1 undecided; 1 oversampled>"
    )
    made = found.to_xarray()
    assert made["K_c"].dims == ("series", "c")
    assert np.array_equal(made["K"].values, found.value)
    assert made["verdict"].values.tolist() == ["chaotic", "regular", "undecided"]
    assert made["first_zero"].dims == ("series",)
    assert list(made.attrs) == ["pendula"]


def test_threads_of_the_test_are_counted() -> None:
    says = refusals.told(lambda: zero_one(logistic(3.9, 200), threads=0))
    assert "threads must be a whole number from 1" in says


@pytest.mark.parametrize(("case", "omega", "amplitudes"), LIBRATION)
@pytest.mark.parametrize(("span", "count"), [(20.0, 512), (100.0, 10000)])
def test_the_harmonics_of_a_libration(
    case: tuple[float, float, float],
    omega: float,
    amplitudes: tuple[float, ...],
    span: float,
    count: int,
) -> None:
    theta0, gravity, length = case
    t = np.linspace(0.0, span, count)
    theta = exact(SimplePendulum(length, gravity), (theta0, 0.0), t).theta
    found = frequencies(t, theta, 4)
    orders = np.array([1, 3, 5, 7])
    assert abs(found.frequencies / (omega * orders) - 1.0).max() < 2e-12
    assert abs(found.frequencies[0] / omega - 1.0) < 1e-15
    signs = np.array([1.0, -1.0, 1.0, -1.0])  # θ = Σ (−1)^n a_n cos (2n + 1)ωt
    assert abs(found.amplitudes - signs * amplitudes).max() < 1e-13
    assert found.limit == "rounding of the samples"
    assert found.residual < 1e-12


@pytest.mark.parametrize(("span", "within"), [(200.0, 2e-12), (500.0, 5e-14)])
def test_a_quasi_periodic_double_pendulum(span: float, within: float) -> None:
    """The two frequencies of a regular motion, from 40 digits over 4000 s."""
    wanted = np.array([6.0030251576208, 2.6980046543883])
    t = np.linspace(0.0, span, round(20 * span))
    states = solve(RODS, (0.4, -0.3, 0.2, 0.1), t).states
    for series in (states[:, 0], states[:, 1], states[:, 3]):
        found = frequencies(t, series, 2)
        assert abs(found.frequencies / wanted - 1.0).max() < within
        assert (abs(found.frequencies - wanted) < found.uncertainties + 1e-13).all()
        assert (found.uncertainties < 1e-7).all()
    both = frequencies(t, states[:, 0] + 1j * states[:, 2], 4).frequencies
    assert np.sort(both)[[0, -1]] == pytest.approx([-wanted[0], wanted[0]], rel=within)


def test_lines_far_from_the_first_time() -> None:
    """A mean, two close lines and noise, at times that do not begin at 0."""
    t = np.linspace(1000.0, 1300.0, 6001)
    noise = np.random.Generator(np.random.PCG64(5)).normal(0.0, 1e-6, t.size)
    x = 0.7 + 2.0 * np.cos(3.0 * t + 0.5) + 0.1 * np.sin(3.1 * t) + noise
    found = frequencies(t, x, 3)
    errors = abs(found.frequencies - [3.0, 0.0, 3.1])
    assert (errors < found.uncertainties).all()
    assert (found.uncertainties < 1e-7).all()
    wanted = np.array([2.0 * np.exp(0.5j), 0.7, -0.1j])
    assert abs(found.amplitudes - wanted).max() < 1e-5
    assert "left beside" in found.limit
    assert found.residual == pytest.approx(1e-6 / np.sqrt(np.mean(x**2)), rel=0.05)


@pytest.mark.parametrize(
    ("t", "x", "n", "says"),
    [
        ([0.0, 1.0, 3.0, *range(4, 60)], [1.0] * 59, 1, "t must rise in even steps"),
        (np.arange(60.0), [1.0] * 59, 1, "x must hold one number for each of the 60 times"),
        (np.arange(60.0), np.zeros(60), 1, "x must not be zero throughout"),
        (np.arange(60.0), np.cos(np.arange(60.0)), 9, "n must not exceed the lines"),
        (np.arange(6.0), np.cos(np.arange(6.0)), 1, "t must hold from 32"),
        (np.arange(60.0), [math.nan] * 60, 1, "x must hold finite numbers, got nan at x[0]"),
        (np.arange(60.0), [np.ones(60), np.zeros(60)], 1, "x[1] must not be zero throughout"),
        (np.arange(60.0), np.ones((60, 2)), 1, "got shape (60, 2); give several series as rows"),
        (np.arange(60.0), np.ones((0, 60)), 1, "x must hold one number for each of the 60 times"),
        (np.arange(60.0), np.ones((1, 2, 60)), 1, "x must hold one number for each of the 60"),
        (np.arange(60.0), [WAVES, np.ones(60)], 2, "rounding, 1 in x[1]; got 2"),
    ],
)
def test_a_series_without_frequencies(t: Any, x: Any, n: int, says: str) -> None:
    assert says in refusals.told(lambda: frequencies(t, x, n))


def test_frequencies_as_a_dataset() -> None:
    t = np.linspace(0.0, 20.0, 400)
    found = frequencies(t, np.cos(3.0 * t + 1.0), 1)
    made = found.to_xarray()
    assert made["frequency"].values == pytest.approx([3.0], abs=1e-13)
    assert made["phase"].values == pytest.approx([1.0], abs=1e-12)
    told = json.loads(made.attrs["pendula"])
    assert told["chaos"] == "Frequencies"
    assert told["recipe"] == {"n": 1, "samples": 400, "step": t[1]}


@pytest.mark.parametrize("kind", [float, complex])
def test_several_series_have_the_lines_of_each(kind: type) -> None:
    t = np.linspace(3.0, 100.0, 801)
    states = np.moveaxis(solve(RODS, (0.4, -0.3, 0.2, 0.1), t).states, -1, 0)
    series = states if kind is float else states[:2] + 1j * states[2:]
    many = frequencies(t, series, 2)
    assert many.frequencies.shape == (len(series), 2)
    for i, each in enumerate(series):
        one = frequencies(t, each, 2)
        for name in ("frequencies", "amplitudes", "uncertainties"):
            assert np.array_equal(getattr(many, name)[i], getattr(one, name))
            assert getattr(one, name).shape == (2,)
        told = many.residual[i], many.fitted[i], many.limit[i]
        assert told == (one.residual, one.fitted, one.limit)
        assert many.recipe == one.recipe
    assert [type(each) for each in (one.residual, one.fitted, one.limit)] == [float, int, str]
    assert frequencies(t, series[:1], 2).residual.shape == (1,)


def test_frequencies_of_several_series_as_text_and_as_a_dataset() -> None:
    t = np.linspace(0.0, 20.0, 400)
    found = frequencies(t, [np.cos(3.0 * t + 1.0), 2.0 * np.cos(2.0 * t)], 1)
    left = found.residual.max()
    assert repr(found) == f"<Frequencies of 2 series, 1 of each, residual up to {left:.1e}>"
    made = found.to_xarray()
    assert made["frequency"].dims == made["phase"].dims == ("series", "line")
    assert made["frequency"].values == pytest.approx(np.array([[3.0], [2.0]]), abs=1e-12)
    assert np.array_equal(made["residual"].values, found.residual)
    assert made["limit"].values.tolist() == found.limit.tolist()
