"""Elliptic integrals and functions all over their domain, with 30 digits: elliptic.json.

Usage: python elliptic_reference.py OUT.json SEED EACH (of every kind the first EACH cases are kept)
The values are those of tests/truth.py, with 120 digits or more and again with twice as many.
"""

import math
import random
import sys
from pathlib import Path

from mpmath import mp, mpf

sys.path.insert(0, str(Path(__file__).parents[1]))
from exact_reference import text, write
from truth import F_of, complement, complete_E, complete_K, digits, inverted, jacobi_of, settled

MODULI = {
    "k uniform": lambda draw: {"k": draw.uniform(0, 1)},
    "k near 1": lambda draw: {"k": 1 - draw.power(-16, -1)},
    "k tiny": lambda draw: {"k": draw.power(-300, -1)},
    "kc log": lambda draw: {"kc": draw.power(-300, 0)},
    "kc moderate": lambda draw: {"kc": draw.power(-20, 0)},
    "kc uniform": lambda draw: {"kc": draw.uniform(0, 1)},
}
AMPLITUDES = {
    "phi uniform": lambda draw: draw.uniform(-math.pi / 2, math.pi / 2),
    "phi near n pi/2": lambda draw: draw.near_quarter_turns(),
    "phi tiny": lambda draw: draw.sign() * draw.power(-300, -1),
    "phi large": lambda draw: draw.sign() * draw.power(0.2, 6),
}
ARGUMENTS = {
    "u uniform": lambda draw, m: draw.uniform(-20, 20),
    "u tiny": lambda draw, m: draw.sign() * draw.power(-300, 0),
    "u large": lambda draw, m: draw.sign() * draw.power(0, 15),
    "u near nK": lambda draw, m: draw.near_quarter_periods(m),
}
EDGES = [
    {"k": 0.0}, {"k": math.nextafter(1, 0)}, {"k": 0.5}, {"k": 5e-324}, {"k": 1e-300}, {"kc": 1.0},
    {"kc": math.nextafter(1, 0)}, {"kc": 0.5}, {"kc": 1e-300}, {"kc": 5e-324},
    {"kc": 2.2250738585072014e-308}, {"k": math.sqrt(0.5)}, {"kc": math.sqrt(0.5)},
]  # fmt: skip


class Draw:
    def __init__(self, seed):
        self.random = random.Random(seed)
        self.uniform, self.choice = self.random.uniform, self.random.choice

    def sign(self):
        return self.choice([-1.0, 1.0])

    def power(self, low, high):
        return 10 ** self.uniform(low, high)

    def modulus(self, name):
        while True:
            m = MODULI[name](self)
            if m.get("k") != 1.0 and m.get("kc") != 0.0:
                return m

    def above_one(self):
        return 1 + self.power(-15, 0) if self.random.random() < 0.5 else self.power(0.01, 6)

    def count(self, few, most):
        sign = self.choice([-1, 1])
        return sign * (self.choice(few) if self.random.random() < 0.4 else round(self.power(0, most)))

    def near_quarter_turns(self):
        if self.random.random() >= 0.7:
            return self.sign() * (math.pi / 2 - self.power(-15, -1))
        sign = self.choice([-1, 1])
        n = sign * (1 if self.random.random() < 0.4 else round(self.power(0, 4)))
        x = float(n * mp.pi / 2)
        for _ in range(self.choice([0, 0, 0, 1, 2])):
            x = math.nextafter(x, self.choice([-1e9, 1e9]))
        return x

    def near_quarter_periods(self, m):
        with mp.workdps(digits(**m)):
            n = self.count([1, 2, 3, 4], 3)
            if m.get("k", 0) > 1:  # and none of them moved
                k, kc = inverted(m["k"])
                return float(n * complete_K(kc) / k)
            x = float(n * complete_K(complement(**m)))
        return x if self.random.random() < 0.7 else math.nextafter(x, 1e9 * self.sign())


def complete_integrals(draw):
    for name in MODULI:
        for _ in range(120):
            yield name, draw.modulus(name)
    for _ in range(60):
        yield "kc near 1", {"kc": 1 - draw.power(-16, -1)}
    for m in EDGES:
        yield "edge", m
    yield from (("k=1", {"k": 1.0}), ("k=1", {"kc": 0.0}))


def incomplete_integrals(draw):
    """Amplitude first, then modulus."""
    for modulus in MODULI:
        for kind, amplitude in AMPLITUDES.items():
            for _ in range(55):
                yield f"{modulus}, {kind}", amplitude(draw), draw.modulus(modulus)
    for kind, amplitude in AMPLITUDES.items():
        for _ in range(5):
            yield f"k=0, {kind}", amplitude(draw), {"k": 0.0}
    for kind in ("phi uniform", "phi tiny"):
        for _ in range(15):
            yield f"k=1, {kind}", AMPLITUDES[kind](draw), {"k": 1.0}
    for _ in range(15):
        away = draw.sign() * (math.pi / 2 - draw.choice([0, draw.power(-15, -1)]))
        yield "k=1, phi near pi/2", away, {"k": 1.0}
    for _ in range(10):
        yield "phi subnormal", draw.sign() * draw.power(-323, -308), draw.modulus("k uniform")
    yield from (("phi = 0", 0.0, {"k": 0.5}), ("phi = 0", 0.0, {"kc": 1e-300}))
    parts = {
        "k>1, phi uniform": lambda: draw.uniform(-1, 1),
        "k>1, phi near the edge": lambda: draw.sign() * (1 - draw.power(-16, -1)),
        "k>1, phi tiny": lambda: draw.sign() * draw.power(-290, -1),
    }
    for kind, part in parts.items():
        found = 0
        while found < 80:
            k = draw.above_one()
            phi = float(mp.asin(1 / mpf(k))) * part()
            if k > 1 and abs(k * mp.sin(mpf(phi))) < 1 and abs(phi) < math.pi / 2:
                yield kind, phi, {"k": k}
                found += 1


def jacobi_functions(draw):
    """Argument first, but drawn after the modulus."""
    for modulus in MODULI:
        for kind, argument in ARGUMENTS.items():
            for _ in range(75):
                m = draw.modulus(modulus)
                yield f"{modulus}, {kind}", argument(draw, m), m
    for kind, argument in ARGUMENTS.items():
        for _ in range(12):
            yield f"k=0, {kind}", argument(draw, {"k": 0.0}), {"k": 0.0}
        for _ in range(0 if kind == "u near nK" else 20):
            yield f"k=1, {kind}", argument(draw, {"k": 1.0}), {"k": 1.0}
        for _ in range(50):
            m = {"k": max(draw.above_one(), math.nextafter(1, 2))}
            yield f"k>1, {kind}", argument(draw, m), m
    for _ in range(10):
        yield "u subnormal", draw.sign() * draw.power(-323, -308), draw.modulus("k uniform")
    yield from (("u = 0", 0.0, {"k": 0.5}), ("u = 0", 0.0, {"kc": 1e-300}))


def main(path, seed, each):
    mp.dps = 60
    draw, tables = Draw(int(seed)), {}

    def keep(function, kind, m, given, columns, values):
        name, modulus = next(iter(m.items()))
        rows = tables.setdefault((f"{function}: {kind}", (name, *given, *columns)), [])
        if len(rows) < int(each):
            inputs = [float(x).hex() for x in (modulus, *given.values())]
            rows.append(inputs + [text(x) for x in settled(values, digits(**m))])

    for kind, m in complete_integrals(draw):
        keep("K", kind, m, {}, ("value",), lambda m=m: [complete_K(complement(**m))])
        keep("E", kind, m, {}, ("value",), lambda m=m: [complete_E(complement(**m))])
    for kind, phi, m in incomplete_integrals(draw):
        keep("F", kind, m, {"phi": phi}, ("value",), lambda phi=phi, m=m: [F_of(phi, **m)])
    for kind, u, m in jacobi_functions(draw):
        columns = ("am", "sn", "cn", "dn")
        keep("jacobi", kind, m, {"u": u}, columns, lambda u=u, m=m: jacobi_of(u, **m))
    write(path, f"elliptic_reference.py OUT.json {seed} {each}", tables)


if __name__ == "__main__":
    main(*sys.argv[1:])
