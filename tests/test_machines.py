"""The loops that are built for several machines: the same bits by all that this processor is."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from pendula._engine import machines

HERE = Path(__file__).parent
DIGEST = """
import hashlib
import numpy as np
from catalogue import SYSTEMS
from pendula import ensemble, exact, methods, solve
from pendula.chaos import megno
from pendula._engine import machines
from pendula.events import flip
digest, chance, t = hashlib.sha256(), np.random.default_rng(7), [0.3, 1.0]
for system in SYSTEMS:
    states = chance.uniform(-2.5, 2.5, (37, len(system.components)))
    for method in methods():
        if system.name not in method.systems:
            continue
        options = {} if method.adaptive else {"step": 0.01}
        many = ensemble(system, states, t, method.name, **options)
        digest.update(many.states.tobytes() + many.n_steps.tobytes())
        one = solve(system, states[0], t, method.name, certify=1e-9, **options)
        digest.update(one.states.tobytes() + np.float64(one.trust_horizon).tobytes())
    for made in (
        solve(system, states[0], t, derivatives="all"),
        ensemble(system, states, t, derivatives="state"),
    ):
        digest.update(made.states.tobytes() + made.derivatives.tobytes())
    measured = megno(system, states, t)
    digest.update(measured.mean.tobytes() + measured.growth.tobytes())
    if system.can.periodic:
        found = ensemble(system, 2.0 * states, [5.0], events=flip(1)).events[0]
        digest.update(found.times.tobytes())
    if system.can.closed_form:
        digest.update(exact(system, states, np.linspace(0.0, 9.0, 11)).states.tobytes())
print(machines()[-1], digest.hexdigest())
"""


def digest_on(machine: str) -> tuple[str, str]:
    """The machine that was taken, and a sum over the bits of all loops."""
    command = [sys.executable, "-c", DIGEST]
    environment = os.environ | {"PENDULA_MACHINE": machine}
    told = subprocess.run(
        command, cwd=HERE, env=environment, check=True, capture_output=True, text=True
    )
    used, digest = told.stdout.split()
    return used, digest


def test_every_machine_gives_the_same_bits() -> None:
    known = machines()
    if (HERE.parent / ".venv" / "every-machine").exists():
        assert known[0] == "plain"  # what `make test` builds has all of them
    if len(known) == 1:
        pytest.skip(f"on this processor this build runs the loops of {known[0]} alone")
    found = dict(map(digest_on, known))
    assert list(found) == known
    assert len(set(found.values())) == 1, found


def test_a_machine_beyond_this_one_is_the_best_here() -> None:
    assert digest_on("avx512")[0] == machines()[-1]
    assert digest_on("")[0] == machines()[-1]


def test_a_machine_that_there_is_not_is_one_line() -> None:
    line = "solve simple --theta 1rad --until 1s --every 1s"
    code = "import sys; from pendula.cli import main; sys.exit(main(sys.argv[1:]))"
    command = [sys.executable, "-c", code, *line.split()]
    environment = os.environ | {"PENDULA_MACHINE": "avx"}
    told = subprocess.run(command, env=environment, check=False, capture_output=True, text=True)
    assert (told.returncode, told.stdout) == (2, "")
    assert told.stderr == (
        "pendula: PENDULA_MACHINE must be one of plain, avx2, avx512; got 'avx'; "
        "unset it for the best that this processor is\n"
    )
