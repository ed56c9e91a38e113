"""The system's Chromium, asked by its DevTools protocol through pipes, without other packages.

https://chromedevtools.github.io/devtools-protocol/: messages of JSON, each ended by a NUL byte.
"""

from __future__ import annotations

import base64
import json
import os
import select
import shutil
import subprocess
import time
from contextlib import contextmanager
from typing import IO, TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

NAMES = ("chromium", "chromium-browser", "google-chrome")
PROGRAM = next((each for each in map(shutil.which, NAMES) if each), None)
_PATIENCE = 30.0  # seconds
_OPTIONS = (
    "--headless",
    "--no-sandbox",  # of the browser's processes, which containers do not have
    "--disable-gpu",
    "--no-first-run",
    "--remote-debugging-pipe",
)


class Browser:
    """A running browser with one page.

    Attributes:
        said: errors and warnings of the page and its frames: a refused request or script, say.
        requested: the addresses that they asked for.
    """

    def __init__(self, to: IO[bytes], of: IO[bytes]) -> None:
        self._to, self._of, self._rest = to, of, b""
        self._count = 0
        self._sessions: list[str] = []  # of the page, and of frames in processes of their own
        self._workers: set[str] = set()
        self._contexts: list[tuple[str, int]] = []  # of scripts, in a session
        self.said: list[str] = []
        self.requested: list[str] = []

    def open(self, url: str) -> None:
        """Open the page."""
        targets = self._ask("Target.getTargets")["targetInfos"]
        blank = next(each["targetId"] for each in targets if each["type"] == "page")
        self._ask("Target.attachToTarget", targetId=blank, flatten=True)
        self._ask("Page.navigate", self._sessions[0], url=url)

    def shows(self, text: str) -> bool:
        """Whether the page or a frame shows the text within some time."""
        end = time.monotonic() + _PATIENCE
        while time.monotonic() < end:
            for session, context in list(self._contexts):
                asked = {"expression": "document.body.innerText", "contextId": context}
                found = self._ask("Runtime.evaluate", session, **asked)
                if text in str(found.get("result", {}).get("value", "")):
                    return True
            self._wait(0.1)
        return False

    def value(self, expression: str) -> Any:
        """What an expression, or a promise, gives in the page."""
        asked = {"expression": expression, "awaitPromise": True, "returnByValue": True}
        found = self._ask("Runtime.evaluate", self._sessions[0], **asked)
        assert "exceptionDetails" not in found, found
        return found["result"].get("value")

    def picture(self, width: int, height: int) -> bytes:
        """The page at this size, as PNG."""
        page, size = self._sessions[0], {"width": width, "height": height}
        self._ask("Emulation.setScrollbarsHidden", page, hidden=True)
        self._ask(
            "Emulation.setDeviceMetricsOverride", page, deviceScaleFactor=1, mobile=False, **size
        )
        self._wait(0.5)
        return base64.b64decode(self._ask("Page.captureScreenshot", page)["data"])

    def _ask(self, method: str, session: str = "", **parameters: Any) -> dict[str, Any]:
        """What a call returns; a call to a frame that is gone returns nothing."""
        number = self._send(method, session, **parameters)
        end = time.monotonic() + _PATIENCE
        while time.monotonic() < end:
            for message in self._wait(0.1):
                if message.get("id") == number:
                    found: dict[str, Any] = message.get("result", {})
                    return found
        raise TimeoutError(method)

    def _send(self, method: str, session: str, **parameters: Any) -> int:
        self._count += 1
        message = {"id": self._count, "method": method, "params": parameters}
        if session:
            message["sessionId"] = session
        self._to.write(json.dumps(message).encode() + b"\0")
        self._to.flush()
        return self._count

    def _wait(self, seconds: float) -> list[dict[str, Any]]:
        """The messages that come within so many seconds, noted."""
        if not select.select([self._of], [], [], seconds)[0]:
            return []
        *whole, self._rest = (self._rest + os.read(self._of.fileno(), 1 << 20)).split(b"\0")
        messages = [json.loads(each) for each in whole]
        for message in messages:
            self._note(message)
        return messages

    def _note(self, message: dict[str, Any]) -> None:
        given, session = message.get("params", {}), message.get("sessionId", "")
        match message.get("method"):
            case "Target.attachedToTarget":
                self._sessions.append(given["sessionId"])
                for method in ("Runtime.enable", "Log.enable", "Network.enable"):
                    self._send(method, given["sessionId"])
                if given["targetInfo"]["type"] == "worker":  # which shows nothing, and is busy
                    self._workers.add(given["sessionId"])
                how = {"autoAttach": True, "waitForDebuggerOnStart": False, "flatten": True}
                self._send("Target.setAutoAttach", given["sessionId"], **how)
            case "Runtime.executionContextCreated" if session not in self._workers:
                self._contexts.append((session, given["context"]["id"]))
            case "Runtime.exceptionThrown":
                self.said.append(json.dumps(given["exceptionDetails"]))
            case "Log.entryAdded" if given["entry"]["level"] in ("error", "warning"):
                self.said.append(given["entry"]["text"])
            case "Network.requestWillBeSent":
                self.requested.append(given["request"]["url"])


@contextmanager
def browser(folder: Path) -> Iterator[Browser]:
    """A browser with its profile in this folder."""
    ways = folder / "to", folder / "of"
    for way in ways:
        os.mkfifo(way)
    line = f'exec "$0" "$@" 3<{ways[0]} 4>{ways[1]}'
    profile = f"--user-data-dir={folder / 'profile'}"
    arguments = ["sh", "-c", line, str(PROGRAM), *_OPTIONS, profile, "about:blank"]
    with subprocess.Popen(
        arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as process:
        with ways[0].open("wb") as to, ways[1].open("rb", buffering=0) as of:
            yield Browser(to, of)
        process.wait(_PATIENCE)  # it ends with its pipes
