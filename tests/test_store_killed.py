"""A store that is killed, at random moments and at every single one, ends in the same bytes."""

import re
import subprocess
import sys
from pathlib import Path


def killed(*arguments: str | Path) -> str:
    done = subprocess.run(
        [sys.executable, Path(__file__).with_name("killed.py"), *arguments],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout


def test_killed_ten_times_at_random_moments(tmp_path: Path) -> None:
    told = killed("at-random", tmp_path, "1")
    found = re.fullmatch(r"(\d+) kills, (\d+) of 25 chunks there\n", told)
    assert found
    kills, chunks = map(int, found.groups())
    assert kills >= 5
    assert chunks > 0


def test_power_goes_at_every_step(tmp_path: Path) -> None:
    steps = killed("at-every-step", tmp_path)
    assert int(steps.removesuffix(" steps\n")) > 50
