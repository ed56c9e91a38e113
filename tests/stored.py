"""The stored solutions of tests/reference, the promised bounds, and errors in their units."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any, NamedTuple

from mpmath import mp, mpf

ROOT = Path(__file__).parents[1]
EPS = 2.0**-52


def cases(name: str) -> list[dict[str, Any]]:
    """The cases of one file, whether each names its values or a table does for all of a kind."""
    loaded = document(name)
    if isinstance(loaded, list):
        return loaded
    return [
        {"kind": table["kind"], **dict(zip(table["columns"], row, strict=True))}
        for table in loaded["tables"]
        for row in table["rows"]
    ]


def document(name: str) -> Any:
    """One file as it stands."""
    return json.loads((ROOT / "tests/reference" / name).read_text(encoding="utf-8"))


def constant(name: str, header: str) -> float:
    """A number of a header of the core."""
    text = (ROOT / "core/include/pendula" / header).read_text(encoding="utf-8")
    found = re.findall(rf"\b{name} = ([\w.+-]+)[,;]", text)
    assert len(found) == 1, f"{name} has to stand once in {header}"
    return float(found[0])


class Bounds(NamedTuple):
    """What the closed form and the elliptic functions promise."""

    motion: float = constant("exact_epsilons", "exact/simple.hpp")
    complete: float = constant("complete_ulps", "exact/elliptic.hpp")
    incomplete: float = constant("incomplete_ulps", "exact/incomplete_F.hpp")
    jacobi_ulps: float = constant("jacobi_ulps", "exact/elliptic.hpp")
    jacobi_epsilons: float = constant("jacobi_epsilons", "exact/elliptic.hpp")
    jacobi_floor: float = constant("jacobi_floor", "exact/elliptic.hpp")


BOUNDS = Bounds()


def in_units(got: float, want: Any, unit: Any) -> float:
    """|got − want| / unit; equal counts 0, and anything else without a unit is infinite."""
    with mp.workdps(60):
        want = mpf(want)
        if mp.isinf(want) or not mp.isfinite(got):
            return 0.0 if got == want else mp.inf
        difference = abs(mpf(got) - want)
        return 0.0 if difference == 0 else mp.inf if unit == 0 else float(difference / unit)


def in_ulps(got: float, want: Any) -> float:
    """In units in the last place of the right value, of subnormal ones too."""
    with mp.workdps(60):
        size = abs(mpf(want))
        exponent = int(mp.frexp(size)[1]) if 0 < size < mp.inf else -1074
        return in_units(got, want, mp.ldexp(1, max(exponent - 53, -1074)))


def in_epsilons(got: float, want: Any, floor: float = BOUNDS.jacobi_floor) -> float:
    """In 2^-52 max(|want|, floor)."""
    with mp.workdps(60):
        return in_units(got, want, EPS * max(abs(mpf(want)), mpf(floor)))


def of_motion(state: Any, want: Any) -> float:
    """The larger error of a state, in what the closed form's bound is a multiple of."""
    theta, omega = map(float, state)
    with mp.workdps(60):
        largest, amplitude, angle = (mpf(want[i]) for i in (2, 3, 0))
        unit = max(abs(angle), min(mpf(1), amplitude))
        return max(in_units(theta, angle, EPS * unit), in_units(omega, want[1], EPS * largest))
