"""How often true values lie within two standard errors: 200 simulated recordings a cell.

PYTHONPATH=tests python -m benchmarks.coverage
"""

from itertools import product

import numpy as np

from pendula.measured import fit
from simulated import swing

FRICTIONS = (
    ("viscous",),
    ("coulomb",),
    ("quadratic",),
    ("viscous", "coulomb"),
    ("viscous", "quadratic"),
    ("coulomb", "quadratic"),
)
CORRELATIONS = (0.0, 0.9, 0.98)  # of the noise of neighbouring samples
RECORDINGS = 200


def inside(frictions: tuple[str, ...], correlation: float, first: int) -> dict[str, list[bool]]:
    """Whether each true value is within two standard errors, for every recording of a cell."""
    found: dict[str, list[bool]] = {}
    for seed in range(first, first + RECORDINGS):
        made, true = swing(seed, correlation, frictions)
        fitted = fit(made, frictions)
        for name in fitted.names:
            value = fitted[name]
            near = abs(value.value - true[name]) <= 2.0 * value.standard_error
            found.setdefault(name, []).append(near)
    return found


def report() -> None:
    """Print a row a cell: of all its values, and of each parameter [%]."""
    everything = []
    for i, (frictions, correlation) in enumerate(product(FRICTIONS, CORRELATIONS)):
        found = inside(frictions, correlation, RECORDINGS * i)
        shares = {name: 100.0 * float(np.mean(each)) for name, each in found.items()}
        everything += list(shares.values())
        own = ", ".join(f"{name} {share:.1f}" for name, share in shares.items())
        whole = float(np.mean(list(shares.values())))
        print(f"{' + '.join(frictions):20} {correlation:4}  {whole:5.1f}   {own}", flush=True)
    print(f"{'all':20} {'':4}  {np.mean(everything):5.1f}   (asked: 90 to 98)")


if __name__ == "__main__":
    report()
