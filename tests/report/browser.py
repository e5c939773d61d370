"""A page of the project in a real browser: sizes and texts as they are drawn, and what the console says.

The browser is driven over its debugging pipe: one JSON message after the other, each ended by a zero byte.
"""

from __future__ import annotations

import base64
import json
import os
import shlex
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

BROWSER = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)

PROBE = (Path(__file__).parent / "probe.js").read_text(encoding="utf-8")


class Browser:
    """One tab of a browser without a window."""

    def __init__(self, to: int, back: int) -> None:
        """Over two pipes, to the browser and back."""
        self._to, self._back, self._number, self._rest = to, back, 0, b""
        self._events: list[dict[str, Any]] = []
        self._session = ""
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self._session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Log"):
            self.call(f"{domain}.enable")

    def call(self, method: str, **values: Any) -> dict[str, Any]:
        """Result of a method of the protocol; events that come before it are kept."""
        self._number += 1
        session = {"sessionId": self._session} if self._session else {}
        os.write(
            self._to, json.dumps({"id": self._number, "method": method, "params": values, **session}).encode() + b"\0"
        )
        while True:
            message = self._next()
            if message.get("id") == self._number:
                assert "error" not in message, message
                result: dict[str, Any] = message["result"]
                return result
            self._events.append(message)

    def open(self, page: Path | str, width: int, height: int, *, dark: bool = False, media: str = "screen") -> None:
        """Show a page, a file or an address, in a window of ``width`` by ``height`` [px]."""
        self._events.clear()
        scheme = [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]
        self.call("Emulation.setEmulatedMedia", media=media, features=scheme)
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height, deviceScaleFactor=1, mobile=False)
        self.call("Page.navigate", url=page if isinstance(page, str) else page.resolve().as_uri())
        while not any(event["method"] == "Page.loadEventFired" for event in self._events):
            self._events.append(self._next())

    def value(self, expression: str) -> Any:
        """What an expression is in the page."""
        found = self.call("Runtime.evaluate", expression=expression, returnByValue=True, awaitPromise=True)
        assert "exceptionDetails" not in found, found
        return found["result"].get("value")

    def measured(self, page: Path, width: int = 1400, height: int = 900, *, dark: bool = False) -> dict[str, Any]:
        """Sizes and texts of a page, and `console`: what the browser said of it."""
        self.open(page, width, height, dark=dark)
        numbers: dict[str, Any] = self.value(PROBE)
        return numbers | {"console": self.said()}

    def said(self) -> list[dict[str, Any]]:
        """What the browser said of the page that is open."""
        said = ("Runtime.consoleAPICalled", "Runtime.exceptionThrown", "Log.entryAdded")
        return [event["params"] for event in self._events if event["method"] in said]

    def picture(self, file: Path, *, whole: bool = False) -> None:
        """What is shown, or the whole page, as PNG."""
        data = self.call("Page.captureScreenshot", captureBeyondViewport=whole, **(self._whole() if whole else {}))[
            "data"
        ]
        file.write_bytes(base64.b64decode(data))

    def _whole(self) -> dict[str, Any]:
        size = self.call("Page.getLayoutMetrics")["cssContentSize"]
        return {"clip": {**size, "scale": 1}}

    def _next(self) -> dict[str, Any]:
        while b"\0" not in self._rest:
            part = os.read(self._back, 1 << 20)
            assert part, "the browser has ended"
            self._rest += part
        message, _, self._rest = self._rest.partition(b"\0")
        found: dict[str, Any] = json.loads(message)
        return found


@contextmanager
def browser(folder: Path) -> Iterator[Browser]:
    """A browser with its profile in a folder."""
    assert BROWSER is not None
    command = [
        BROWSER, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--disable-background-networking",
        "--no-first-run", "--allow-file-access-from-files", f"--user-data-dir={folder / 'profile'}", "--remote-debugging-pipe",
    ]  # fmt: skip
    (read, to), (back, write) = os.pipe(), os.pipe()
    # the protocol is spoken on descriptors 3 and 4
    line = f"exec {shlex.join(command)} 3<&{read} 4>&{write}"
    with subprocess.Popen(["bash", "-c", line], pass_fds=(read, write), stderr=subprocess.DEVNULL) as process:
        os.close(read)
        os.close(write)
        try:
            yield Browser(to, back)
        finally:
            process.terminate()
            os.close(to)
            os.close(back)
