"""Write the catalogue that the laboratory's page reads, from the rows of the core.

Usage: python scripts/lab_catalogue.py [--check]
"""

from __future__ import annotations

import json
import math
import sys
from pathlib import Path
from typing import Any

from pendula import _core
from pendula._version import __version__

TARGET = Path(__file__).parents[1] / "web" / "src" / "core" / "catalogue.json"
PI = math.pi
# Ends of the sliders, in SI units; any sound value can still be typed. Lower ends of positive
# parameters are above 0.
SLIDERS: dict[str, tuple[float, float]] = {
    "length": (0.05, 5.0),
    "gravity": (0.1, 30.0),
    "mass": (0.05, 5.0),
    "viscous": (0.0, 2.0),
    "viscous1": (0.0, 2.0),
    "viscous2": (0.0, 2.0),
    "coulomb": (0.0, 2.0),
    "coulomb1": (0.0, 2.0),
    "coulomb2": (0.0, 2.0),
    "quadratic": (0.0, 2.0),
    "cubic": (0.0, 2.0),
    "torque": (0.0, 20.0),
    "drive_frequency": (0.0, 20.0),
    "drive_phase": (-PI, PI),
    "pivot_amplitude": (0.0, 0.5),
    "pivot_frequency": (0.0, 100.0),
    "pivot_phase": (-PI, PI),
    "pivot_direction": (0.0, PI),
    "centre": (0.05, 5.0),
    "inertia": (0.01, 10.0),
    "q": (0.5, 20.0),
    "a": (0.0, 3.0),
    "m1": (0.05, 5.0),
    "m2": (0.05, 5.0),
    "l1": (0.05, 5.0),
    "l2": (0.05, 5.0),
    "c1": (0.0, 5.0),
    "c2": (0.0, 5.0),
    "I1": (0.0, 10.0),
    "I2": (0.0, 10.0),
}


def finite(value: float) -> float | None:
    """JSON has no infinity and no NaN."""
    return value if math.isfinite(value) else None


def parameter(row: dict[str, Any]) -> dict[str, Any]:
    """A parameter with the ends of its slider."""
    return {**row, "standard": finite(row["standard"]), "slider": list(SLIDERS[row["name"]])}


def system(row: dict[str, Any]) -> dict[str, Any]:
    """A system with the names of its constants, and of what works on it and takes its energy."""
    works, heats = _core.powers(row["name"])
    ones = [1.0] * len(row["forms"][0]["parameters"])
    constants = list(_core.constants(_core.Description(row["name"], 0, ones)))
    forms = [
        {**form, "parameters": [parameter(each) for each in form["parameters"]]}
        for form in row["forms"]
    ]
    return {**row, "forms": forms, "constants": constants, "works": works, "heats": heats}


def catalogue() -> dict[str, Any]:
    """The rows as data that JSON can hold."""
    names = "english", "way_out_in_english", "spanish", "way_out_in_spanish"
    return {
        "version": __version__,
        "systems": [system(row) for row in _core.systems()],
        "methods": [
            {name: value for name, value in row.items() if name != "stability_polynomial"}
            for row in _core.methods()
        ],
        "options": [{**row, "most": finite(row["most"])} for row in _core.option_rows()],
        "rules": {
            key: dict(zip(names, sentences, strict=True)) for key, *sentences in _core.rule_rows()
        },
    }


def text() -> str:
    """The file as it should stand."""
    return json.dumps(catalogue(), ensure_ascii=False, indent=1) + "\n"


def main() -> int:
    """Write the file, or, with --check, say whether it is as it should be."""
    wanted = text()
    if "--check" in sys.argv[1:]:
        return 0 if TARGET.exists() and TARGET.read_text(encoding="utf-8") == wanted else 1
    TARGET.write_text(wanted, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
