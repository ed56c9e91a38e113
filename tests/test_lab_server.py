"""The server of the laboratory: by real requests on a free port."""

from __future__ import annotations

import errno
import os
import socket
from http.client import HTTPConnection
from pathlib import Path

import pytest

from lab_pages import FILES, asked, serving, write_page
from pendula.lab import page
from pendula.lab.server import USUAL_PORT, LabServer
from refusals import told


@pytest.fixture(autouse=True)
def small_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "static"
    write_page(folder)
    monkeypatch.setattr(page, "STATIC", folder)


@pytest.mark.parametrize(
    ("path", "name", "kind"),
    [
        ("/", "index.html", "text/html; charset=utf-8"),
        ("/?v=1", "index.html", "text/html; charset=utf-8"),
        ("/index.html", "index.html", "text/html; charset=utf-8"),
        ("/assets/a.js", "assets/a.js", "text/javascript; charset=utf-8"),
        ("/assets/a.css", "assets/a.css", "text/css; charset=utf-8"),
        ("/assets/core.wasm", "assets/core.wasm", "application/wasm"),
    ],
)
def test_the_files_of_the_page_are_served_as_what_they_are(path: str, name: str, kind: str) -> None:
    with serving() as server:
        status, headers, body = asked(server, path)
        assert (status, body) == (200, FILES[name])
        assert headers["Content-Type"] == kind
        status, only, nothing = asked(server, path, "HEAD")
        assert (status, nothing) == (200, b"")
        assert only["Content-Length"] == str(len(body))


@pytest.mark.parametrize(
    "path",
    [
        "/nothing",
        "/assets/",
        "/assets/notes.md",
        "/lab.html",  # would need inline scripts: it is for export
        "/../page.py",
        "/assets/../../page.py",
        "/%2e%2e/page.py",
        "/assets/late.js",
    ],
)
def test_nothing_else_is_served(path: str) -> None:
    with serving() as server:
        (page.STATIC / "assets/late.js").write_text("added later")
        status, headers, body = asked(server, path)
    assert status == 404
    assert headers["Content-Type"] == "text/plain; charset=utf-8"
    assert body == b"there is no such file\n"


@pytest.mark.parametrize("host", ["evil.example", "evil.example:80", "127.0.0.1", "0.0.0.0", None])
def test_another_host_is_refused(host: str | None) -> None:
    """A name that leads to this machine would let a page elsewhere read from it."""
    with serving() as server:
        status, _, body = asked(server, "/", host=host)
        assert status == 421
        assert b"index" not in body
        assert f"this server answers {server.url} alone\n".encode() == body
        assert asked(server, "/", host=f"localhost:{server.server_port}")[0] == 200


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE", "OPTIONS", "TRACE"])
def test_nothing_is_taken(method: str) -> None:
    with serving() as server:
        assert asked(server, "/", method)[0] == 501


def test_every_answer_keeps_the_page_to_itself() -> None:
    with serving() as server:
        for path, host in (("/", ""), ("/nothing", ""), ("/", "evil.example")):
            _, headers, _ = asked(server, path, host=host)
            rules = dict(
                rule.split(" ", 1) for rule in headers["Content-Security-Policy"].split("; ")
            )
            assert rules["default-src"] == "'none'"
            assert rules["connect-src"] == "'self'"
            for rule in rules.values():
                assert "'unsafe-inline'" not in rule
                assert "'unsafe-eval'" not in rule
                assert "http" not in rule
                assert "*" not in rule
            assert headers["X-Content-Type-Options"] == "nosniff"
            assert headers["Referrer-Policy"] == "no-referrer"
            assert "Access-Control-Allow-Origin" not in headers


def test_this_machine_alone_is_listened_to() -> None:
    with serving() as server:
        assert server.socket.getsockname()[0] == "127.0.0.1"


def test_a_connection_stays_open_for_the_next_file() -> None:
    with serving() as server:
        connection = HTTPConnection("127.0.0.1", server.server_port, timeout=10)
        bodies, lines = [], set()
        for path in ("/", "/assets/a.js"):
            connection.request("GET", path)
            bodies.append(connection.getresponse().read())
            lines.add(connection.sock)
        connection.close()
    assert len(lines) == 1
    assert None not in lines
    assert bodies == [FILES["index.html"], FILES["assets/a.js"]]


def test_a_browser_that_hangs_up_is_no_error(capfd: pytest.CaptureFixture[str]) -> None:
    (page.STATIC / "assets/core.wasm").write_bytes(bytes(30_000_000))
    with serving() as server:
        with socket.create_connection(("127.0.0.1", server.server_port)) as line:
            line.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, b"\1\0\0\0\0\0\0\0")
            host = f"127.0.0.1:{server.server_port}"
            line.sendall(f"GET /assets/core.wasm HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
            line.recv(1)
        assert asked(server, "/")[0] == 200
    assert capfd.readouterr().err == ""


# ---- ports ----


def test_a_port_that_is_taken_is_told() -> None:
    with serving() as first, pytest.raises(OSError, match="cannot be had") as error:
        LabServer(first.server_port)
    reason = os.strerror(errno.EADDRINUSE)
    said = f"port = {first.server_port} cannot be had: {reason}; take another, or leave it out"
    assert str(error.value) == said


def test_where_the_usual_port_is_taken_any_is_used() -> None:
    with serving(None) as first, serving(None) as second:
        assert second.server_port not in (first.server_port, USUAL_PORT)
        assert asked(second, "/")[0] == 200


@pytest.mark.parametrize("port", [-1, 65536])
def test_a_port_that_is_none_is_refused(port: int) -> None:
    def serve() -> None:
        with serving(port):
            pass

    said = f"port must be a whole number from 1 to 65535, or 0 for any that is free, got {port}"
    assert told(serve) == said


def test_without_a_page_there_is_no_server(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "STATIC", Path("nowhere"))
    with pytest.raises(ImportError, match=r"run: make lab"), serving():
        pass
