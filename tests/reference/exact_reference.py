"""States of the simple pendulum in every regime, with 30 digits: tests/reference/exact.json.

Usage: python exact_reference.py OUT.json SEED EACH (of every kind the first EACH cases are kept)
The solutions are those of tests/truth.py, with 150 digits and again with 300.
"""

import json
import math
import random
import sys
from pathlib import Path

from mpmath import mp, mpf

sys.path.insert(0, str(Path(__file__).parents[1]))
from truth import settled, simple

INPUTS = ("theta0", "omega0", "gravity", "length", "t")
OUTPUTS = ("theta", "omega", "omega_max", "amplitude")
COUNTS = {  # how many of each kind are drawn, and so where in the sequence the next kind begins
    "libration with omega0": 300, "libration from rest": 250,
    "long t, omega0": 250, "long t, from rest": 250,
    "rotation": 250, "rotation, long t": 200,
    "fast rotation": 200, "fast rotation, long t": 100,
    "top from rest": 250, "top from rest, long t": 200,
    "top with omega0": 250, "top with omega0, long t": 150,
    "near separatrix": 350, "near separatrix, long t": 250,
}


class Draw:
    """Starts and times at random; `turns` whole turns are added to the angle."""

    def __init__(self, seed):
        self.random = random.Random(seed)
        self.uniform = self.random.uniform

    def sign(self):
        return self.random.choice([-1.0, 1.0])

    def power(self, low, high):
        return 10 ** self.uniform(low, high)

    def pendulum(self):
        usual = self.random.random() < 0.7
        gravity = self.random.choice([9.81, 9.80665, 1.62, 24.79]) if usual else self.uniform(0.5, 30.0)
        length = self.uniform(0.05, 20)
        return gravity, length, float(mp.sqrt(mpf(gravity) / mpf(length)))

    def time(self, long):
        return self.sign() * self.power(3, 9) if long else self.uniform(0, 50)

    def libration(self, turns, long=False, rest=False):
        while True:
            gravity, length, wn = self.pendulum()
            theta = turned(self.uniform(-3.1, 3.1), turns)
            omega = 0.0 if rest else self.uniform(-1.95, 1.95) * wn
            if rest or abs(omega) < 1.999 * wn * half_cosine(theta):
                return theta, omega, gravity, length, self.time(long)

    def rotation(self, turns, long=False, low=2.1, high=50):
        gravity, length, wn = self.pendulum()
        theta = turned(self.uniform(-3.14, 3.14), turns)
        omega = self.sign() * math.exp(self.uniform(math.log(low), math.log(high))) * wn
        return theta, omega, gravity, length, self.time(long)

    def top(self, turns, long=False, moving=False):
        gravity, length, wn = self.pendulum()
        short, sign = self.power(-15.5, -1), self.sign()
        nearest = self.random.random() < 0.12  # the double nearest to π
        if turns == 0:
            theta = sign * (math.pi if nearest else math.pi - short)
        else:
            theta = float(2 * mp.pi * turns + sign * (mp.pi - (0 if nearest else mpf(short))))
        omega = self.sign() * self.power(-14, -1) * wn if moving else 0.0
        rest = math.pi - abs(math.remainder(theta, 2 * math.pi))
        away = max(abs(rest), abs(omega) / wn, 1e-16)
        if long:
            return theta, omega, gravity, length, self.sign() * self.power(6, 9)
        return theta, omega, gravity, length, self.uniform(0, 12) * math.log(16 / away) / wn

    def separatrix(self, turns, long=False):
        gravity, length, wn = self.pendulum()
        theta, away = turned(self.uniform(-3.1, 3.1), turns), self.sign() * self.power(-15.5, -1)
        fastest = 2 * mp.sqrt(mpf(gravity) / mpf(length)) * abs(mp.cos(mpf(theta) / 2))
        omega = self.sign() * float(fastest * (1 + mpf(away)))
        if long:
            return theta, omega, gravity, length, self.time(long)
        return theta, omega, gravity, length, self.uniform(0, 10) * math.log(16 / abs(away)) / wn

    def of_kind(self, kind, turns=0):
        long = "long t" in kind
        if kind.startswith("top"):
            return self.top(turns, long, "omega0" in kind)
        if kind.startswith("near separatrix"):
            return self.separatrix(turns, long)
        if kind.startswith("fast"):
            return self.rotation(turns, long, 50, 1e6)
        if kind.startswith("rotation"):
            return self.rotation(turns, long)
        return self.libration(turns, long, "rest" in kind)

    def of_any_kind(self, among_turns=None):
        kind = self.random.choice(list(COUNTS))
        return self.of_kind(kind, self.random.choice(among_turns) if among_turns else 0)

    def small(self, moving):
        """Amplitudes down to 1e-300."""
        gravity, length, wn = self.pendulum()
        size = self.power(-300, -1) if moving else self.sign() * self.power(-300, -1)
        theta = size * self.uniform(-1, 1) if moving else size
        omega = size * self.uniform(-1, 1) * wn if moving else 0.0
        return theta, omega, gravity, length, self.time(not self.random.random() < 0.6)

    def exact_separatrix(self):
        omega, length = self.random.randint(1, 4000) / 256, self.random.randint(4, 1000) / 64
        gravity = omega * omega * length / 4  # exactly
        assert mpf(omega) ** 2 * mpf(length) == 4 * mpf(gravity)
        omega_, sign = self.sign() * omega, self.sign()
        time = self.uniform(0, 100) if self.random.random() < 0.7 else self.power(-8, 1)
        return 0.0, omega_, gravity, length, sign * time * 2 / omega


def turned(angle, turns):
    return angle if turns == 0 else float(mpf(angle) + 2 * mp.pi * turns)


def half_cosine(theta):
    return float(abs(mp.cos(mpf(theta) / 2)))


def tiny_time(draw):
    start = draw.of_any_kind()[:4]
    return (*start, draw.sign() * draw.power(-14, -6) if draw.random.random() < 0.7 else draw.sign() * 1e-12)


def negative_time(draw):
    *start, time = draw.of_any_kind()
    return (*start, -abs(time))


def at_the_bottom(draw, kind):
    gravity, length, wn = draw.pendulum()
    sign = draw.sign()
    if kind == "libration":
        fast = draw.uniform(0, 1.99) if draw.random.random() < 0.5 else draw.power(-20, 0)
    elif kind == "rotation":
        fast = draw.uniform(2.001, 10)
    else:
        near = 1 + draw.sign() * draw.power(-15.5, -1)
        return 0.0, sign * 2 * wn * near, gravity, length, draw.uniform(-100, 100) / wn
    return 0.0, sign * fast * wn, gravity, length, draw.uniform(-50, 50)


def at_rest_below(draw, i):
    gravity, length, _ = draw.pendulum()
    time = 0.0 if i == 3 else draw.time(True) if i % 3 else draw.uniform(0, 50)
    return (0.0, -0.0)[i % 2], 0.0, gravity, length, time


def at_rest_turned(draw, i):
    gravity, length, _ = draw.pendulum()
    turns = i + 1 if i < 20 else round(draw.power(0, 3))
    theta = draw.sign() * float(2 * mp.pi * turns)
    time = draw.uniform(-50, 50) if draw.random.random() < 0.7 else draw.time(True)
    return theta, 0.0, gravity, length, time


def drawn(seed):
    """All cases, kind by kind."""
    draw = Draw(seed)
    for kind, count in COUNTS.items():
        for _ in range(count):
            yield kind, draw.of_kind(kind)
        for _ in range(35):
            turns = int(draw.sign()) * round(draw.power(0, 3))
            yield "turns: " + kind, draw.of_kind(kind, turns)
    for _ in range(220):
        yield "small, from rest", draw.small(False)
    for _ in range(220):
        yield "small, omega0", draw.small(True)
    for _ in range(150):
        yield "tiny t", tiny_time(draw)
    for _ in range(10):
        yield "t = 0", (*draw.of_any_kind([0, 0, 3, -40])[:4], 0.0)
    for _ in range(250):
        yield "negative t", negative_time(draw)
    for _ in range(160):
        yield "exact separatrix", draw.exact_separatrix()
    for kind, count in (("libration", 150), ("rotation", 80), ("near separatrix", 80)):
        for _ in range(count):
            yield "bottom, " + kind, at_the_bottom(draw, kind)
    for i in range(20):
        yield "rest", at_rest_below(draw, i)
    for i in range(200):
        yield "2 pi n at rest", at_rest_turned(draw, i)


def text(x):
    if mp.isinf(x):
        return "inf" if x > 0 else "-inf"
    if abs(x) < mpf(10) ** -400:  # far below every double
        return "0.0"
    with mp.workdps(60):
        return mp.nstr(+x, 30)


def write(path, about, tables):
    """One row a line."""
    parts = []
    for (kind, columns), rows in tables.items():
        lines = ",\n".join(json.dumps(row, separators=(",", ":")) for row in rows)
        head = json.dumps({"kind": kind, "columns": columns})[:-1]
        parts.append(f'{head}, "rows": [\n{lines}]}}')
    tables = ",\n".join(parts)
    Path(path).write_text(f'{{"made": {json.dumps(about)}, "tables": [\n{tables}]}}\n')


def main(path, seed, each):
    mp.dps = 60
    tables = {}
    for kind, given in drawn(int(seed)):
        rows = tables.setdefault((kind, (*INPUTS, *OUTPUTS)), [])
        if len(rows) < int(each):
            values = settled(lambda given=given: simple(*given), 150)
            rows.append([float(x).hex() for x in given] + [text(x) for x in values])
    write(path, f"exact_reference.py OUT.json {seed} {each}", tables)


if __name__ == "__main__":
    main(*sys.argv[1:])
