"""The page on a port of this machine: a fixed list of files, for this machine alone."""

from __future__ import annotations

import errno
import sys
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from typing import TYPE_CHECKING, Any
from urllib.parse import urlsplit

from pendula._messages import ArgumentError, Message
from pendula.lab.page import MIME_TYPES, START, page_files, policy

if TYPE_CHECKING:
    from pathlib import Path

ADDRESS = "127.0.0.1"
USUAL_PORT = 8642  # so that a page that was left open finds its server again
_LARGEST_PORT = 65535
_HEADERS = {
    "Cache-Control": "no-cache",
    "Content-Security-Policy": policy("'self'", "frame-ancestors 'self'"),
    "Cross-Origin-Resource-Policy": "same-origin",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class LabServer(ThreadingHTTPServer):
    """The server of the page.

    Args:
        port: to listen on, 0 for any that is free; None: the usual one, or any where it is taken.

    Raises:
        MissingExtraError: where the page was not built.
        ArgumentError: for a port that is none.
        OSError: where it is taken.
    """

    daemon_threads = True  # a browser keeps connections open: none may keep the process

    def __init__(self, port: int | None = None) -> None:
        self.files: dict[str, Path] = {f"/{name}": path for name, path in page_files().items()}
        self.files["/"] = self.files[f"/{START}"]
        if port is not None and not 0 <= port <= _LARGEST_PORT:
            rule = "must be a whole number from 1 to {most}, or 0 for any that is free, got {value}"
            raise ArgumentError("port", rule, most=_LARGEST_PORT, value=port)
        super().__init__((ADDRESS, USUAL_PORT if port is None else port), _Handler, False)
        try:
            self._bind(any_port=port is None)
            self.server_activate()
        except BaseException:
            self.server_close()
            raise

    @property
    def url(self) -> str:
        """Of the page."""
        return f"http://{ADDRESS}:{self.server_port}/"

    @property
    def hosts(self) -> tuple[str, str]:
        """What a browser on this machine calls the server."""
        return f"{ADDRESS}:{self.server_port}", f"localhost:{self.server_port}"

    def handle_error(self, request: Any, client_address: Any) -> None:
        """A browser that closes a connection early is no error of the server."""
        if not isinstance(sys.exception(), ConnectionError):
            super().handle_error(request, client_address)

    def _bind(self, *, any_port: bool) -> None:
        try:
            self.server_bind()
        except OSError as error:
            if error.errno not in (errno.EADDRINUSE, errno.EACCES):
                raise
            if not any_port:
                rule, way_out = "= {value} cannot be had: {text}", "take another, or leave it out"
                details = {"value": self.server_address[1], "text": error.strerror}
                raise OSError(Message("port", rule, way_out, **details)) from None
            self.server_address = (ADDRESS, 0)
            self.server_bind()


class _Handler(BaseHTTPRequestHandler):
    """Answers GET and HEAD for the files of the list."""

    server: LabServer
    protocol_version = "HTTP/1.1"
    server_version = "pendula"
    sys_version = ""
    timeout = 60  # seconds that a connection may be idle

    def do_GET(self) -> None:
        """A file."""
        self._answer(body=True)

    def do_HEAD(self) -> None:
        """Its headers."""
        self._answer(body=False)

    def log_message(self, format: str, *args: Any) -> None:
        """Say nothing: a line for each file would hide the one that has the address."""

    def end_headers(self) -> None:
        """Every answer has the headers that keep the page to itself."""
        for name, value in _HEADERS.items():
            self.send_header(name, value)
        super().end_headers()

    def _answer(self, *, body: bool) -> None:
        # a page elsewhere can name this machine by a host name of its own (DNS rebinding)
        if self.headers.get("Host") not in self.server.hosts:
            told = f"this server answers {self.server.url} alone\n"
            self._send(HTTPStatus.MISDIRECTED_REQUEST, told.encode(), ".txt", body=body)
            return
        path = self.server.files.get(urlsplit(self.path).path)
        if path is None:
            self._send(HTTPStatus.NOT_FOUND, b"there is no such file\n", ".txt", body=body)
            return
        self._send(HTTPStatus.OK, path.read_bytes(), path.suffix, body=body)

    def _send(self, status: HTTPStatus, data: bytes, kind: str, *, body: bool) -> None:
        self.send_response(status)
        self.send_header("Content-Type", MIME_TYPES[kind])
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        if body:
            self.wfile.write(data)
