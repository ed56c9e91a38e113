"""`pendula lab --export`: the page as one file, and as a folder."""

from __future__ import annotations

import base64
import hashlib
import re
from pathlib import Path

import pytest

from commands import Call
from lab_pages import FILES, write_page
from pendula.lab import page

LINK = "#system=simple&length=0.5&state=3,0.1&t_max=2&method=rk4&step=0.01"


@pytest.fixture(autouse=True)
def small_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "static"
    write_page(folder)
    monkeypatch.setattr(page, "STATIC", folder)


def policy_and_page(path: Path) -> tuple[str, bytes]:
    """The policy that an export has put into its page, and the page without it."""
    html = path.read_bytes()
    found = re.search(rb'\n    <meta http-equiv="Content-Security-Policy" content="(.*)" />', html)
    assert found is not None
    assert html[: found.start()].endswith(b"<head>")
    return found[1].decode(), html.replace(found[0], b"")


def test_one_file_is_exported(call: Call, tmp_path: Path) -> None:
    assert call(f"lab '{LINK}' --export class.html") == (0, f"class.html{LINK}\n", "")
    policy, html = policy_and_page(tmp_path / "class.html")
    assert html == FILES["lab.html"]
    for text in (b"f()", b"a{}\nb{}"):
        digest = base64.b64encode(hashlib.sha256(text).digest()).decode()
        assert f"'sha256-{digest}'" in policy
    assert "script-src 'self'" not in policy
    assert "unsafe-inline" not in policy
    code, _, err = call("lab --export class.html")
    assert code == 2
    assert "class.html exists" in err
    assert "--force" in err
    assert call("lab --export class.html --force")[0] == 0


def test_a_folder_is_exported(call: Call, tmp_path: Path) -> None:
    assert call("lab --export site") == (0, "site/index.html\n", "")
    written = {
        path.relative_to(tmp_path / "site").as_posix(): path.read_bytes()
        for path in (tmp_path / "site").rglob("*")
        if path.is_file()
    }
    policy, written["index.html"] = policy_and_page(tmp_path / "site/index.html")
    assert "script-src 'self' 'wasm-unsafe-eval'" in policy
    assert written == {
        name: data for name, data in FILES.items() if name not in ("lab.html", "assets/notes.md")
    }
    assert call("lab --export site")[0] == 2
    (tmp_path / "site/assets/old.js").touch()
    assert call("lab --export site --force")[0] == 0
    assert not (tmp_path / "site/assets/old.js").exists()


def test_a_folder_with_anything_else_is_never_emptied(call: Call, tmp_path: Path) -> None:
    (tmp_path / "site").mkdir()
    (tmp_path / "site/thesis.tex").write_text("years of work")
    code, _, err = call("lab --export site --force")
    assert code == 2
    assert err.startswith("pendula: site holds 'thesis.tex', which is no part of the laboratory")
    assert (tmp_path / "site/thesis.tex").read_text() == "years of work"


def test_an_export_that_fails_leaves_nothing(call: Call, tmp_path: Path) -> None:
    assert call("lab --export nowhere/lab.html")[0] == 2
    (page.STATIC / "assets/a.js").unlink()
    (page.STATIC / "assets/a.js").symlink_to(page.STATIC / "gone.js")
    (page.STATIC / "lab.html").unlink()
    assert call("lab --export lab.html")[0] == 1
    assert [each.name for each in tmp_path.iterdir()] == ["static"]
