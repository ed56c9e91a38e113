"""A small page of the laboratory in place of the built one, and its server."""

from __future__ import annotations

import threading
from contextlib import contextmanager
from http.client import HTTPConnection
from typing import TYPE_CHECKING

from pendula.lab.server import LabServer

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

FILES = {
    "index.html": b'<head><script type="module" src="./assets/a.js"></script></head>',
    "lab.html": b'<head><script type="module">f()</script>\n<style>a{}\nb{}</style></head>\r\n',
    "assets/a.js": b"console.log(1)",
    "assets/a.css": b"body{}",
    "assets/core.wasm": b"\0asm\1\0\0\0",
    "assets/notes.md": b"not of the page",
}


def write_page(folder: Path) -> None:
    """Write what a build leaves."""
    for name, data in FILES.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data)


@contextmanager
def serving(port: int | None = 0) -> Iterator[LabServer]:
    """A server that answers in the background."""
    with LabServer(port) as server:
        thread = threading.Thread(target=server.serve_forever, args=(0.01,))
        thread.start()
        try:
            yield server
        finally:
            server.shutdown()
            thread.join()


def asked(
    server: LabServer, path: str, method: str = "GET", host: str | None = ""
) -> tuple[int, dict[str, str], bytes]:
    """Status, headers and body of an answer; `host`: another name of the server, None: none."""
    connection = HTTPConnection("127.0.0.1", server.server_port, timeout=10)
    try:
        connection.putrequest(method, path, skip_host=True)
        if host is not None:
            connection.putheader("Host", host or f"127.0.0.1:{server.server_port}")
        connection.endheaders()
        answer = connection.getresponse()
        return answer.status, dict(answer.getheaders()), answer.read()
    finally:
        connection.close()
