"""The page's catalogue holds the rows of the core."""

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[1]
SCRIPT = ROOT / "scripts" / "lab_catalogue.py"
CATALOGUE = ROOT / "web" / "src" / "core" / "catalogue.json"


def test_the_page_has_the_rows_of_the_core() -> None:
    told = subprocess.run(
        [sys.executable, SCRIPT, "--check"], check=False, capture_output=True, text=True
    )
    assert told.returncode == 0, f"python scripts/lab_catalogue.py writes it anew; {told.stderr}"


def test_every_slider_holds_the_standard_value_and_no_value_that_is_refused() -> None:
    systems = json.loads(CATALOGUE.read_text(encoding="utf-8"))["systems"]
    rows = [row for system in systems for form in system["forms"] for row in form["parameters"]]
    assert rows
    for row in rows:
        least, most = row["slider"]
        assert least < most
        if row["standard"] is not None:
            assert least <= row["standard"] <= most, row["name"]
        if row["range"] == "positive":
            assert least > 0.0, row["name"]
        if row["range"] == "not_negative":
            assert least >= 0.0, row["name"]
