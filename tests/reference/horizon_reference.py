"""Angles of two chaotic double pendulums at many times, with 60 digits: tests/reference/horizon.json.

Usage: python horizon_reference.py OUT.json   (needs: pip install python-flint)
The solutions are those of reference.py (FLINT, arb, Taylor series); 20 digits after the point of the angles are kept.
"""

import json
import sys
from decimal import Decimal

from reference import double_reference

CASES = [  # the paper's rods, and others
    {"params": {"m1": "1", "m2": "1", "l1": "1", "l2": "1", "g": "9.81"}, "state": ["2", "2.5", "0", "0"]},
    {"params": {"m1": "0.7", "m2": "1.3", "l1": "0.5", "l2": "0.9", "g": "9.80665"},
     "state": ["-1.75", "2.875", "1.5", "-2.25"]},
]
TIMES = [n / 32 for n in range(1, 32 * 26 + 1)]  # exact in doubles

if __name__ == "__main__":
    cases = []
    for case in CASES:
        states = double_reference({**case, "times": [repr(t) for t in TIMES]})
        angles = [[f"{Decimal(component):.20f}" for component in row[:2]] for row in states]
        cases.append({**case, "spacing": "1/32", "angles": angles})
    with open(sys.argv[1], "w") as out:
        json.dump(cases, out, indent=0)
