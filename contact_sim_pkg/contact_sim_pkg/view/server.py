"""The server of the live page, for this machine alone: the page, and the newest frame for each page that asks."""

from __future__ import annotations

import asyncio
import json
import threading
from contextlib import suppress
from http import HTTPStatus
from queue import SimpleQueue
from typing import Any

from websockets.asyncio.server import Server, ServerConnection, serve
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from contact_sim_pkg.files import RefusedError
from contact_sim_pkg.report.page import LIVE_SCRIPTS, rendered, shell_of
from contact_sim_pkg.report.timeline import colours_as_text
from contact_sim_pkg.view.scope import Scope

__all__ = ["HOST", "RATE", "ServeError", "ViewServer"]

HOST = "127.0.0.1"
RATE = 25.0
"""[Hz] of frames, at most"""
LONGEST_WISH = 200
"""[bytes] of a message of a page"""
ENDS = ("127.0.0.1", "localhost")


class ServeError(RefusedError):
    """The address cannot be had."""


class ViewServer:
    """Serves the frames of a scope in a thread of its own; `wishes` holds what pages ask of the source.

    A page asks for each frame once it has the one before, so that nothing waits for a slow page and it gets the newest.
    """

    def __init__(self, scope: Scope, title: str, port: int = 0) -> None:
        """Listen on a port of 127.0.0.1; 0: any that is free. ServeError where it is taken."""
        self.wishes: SimpleQueue[dict[str, Any]] = SimpleQueue()
        self._scope, self._wanted_port, self.port = scope, port, 0
        shell = shell_of(LIVE_SCRIPTS, "; connect-src 'self'")
        self._page = rendered("live.html.j2", {"title": title, "colours": colours_as_text()}, shell=shell).encode()
        self._policy = f"{shell.policy}; frame-ancestors 'none'; base-uri 'none'; form-action 'none'"
        self._started = threading.Event()
        self._error: OSError | None = None
        self._thread = threading.Thread(target=lambda: asyncio.run(self._serve()), daemon=True)

    @property
    def address(self) -> str:
        """Of the page."""
        return f"http://{HOST}:{self.port}/"

    def __enter__(self) -> ViewServer:
        """Start to serve."""
        self._thread.start()
        self._started.wait()
        if self._error is not None:
            raise ServeError(
                f"port {self._wanted_port} of {HOST} cannot be had: {self._error.strerror}; --port 0 takes a free one"
            )
        return self

    def __exit__(self, *_: object) -> None:
        """Close every connection."""
        self._loop.call_soon_threadsafe(self._over.set)
        self._thread.join()

    async def _serve(self) -> None:
        self._loop, self._over = asyncio.get_running_loop(), asyncio.Event()
        try:
            server: Server = await serve(
                self._attend, HOST, self._wanted_port, process_request=self._answer, compression=None, max_size=LONGEST_WISH,
                server_header=None, close_timeout=1,
            )  # fmt: skip
        except OSError as error:
            self._error = error
            self._started.set()
            return
        self.port = server.sockets[0].getsockname()[1]
        self._started.set()
        async with server:
            await self._over.wait()

    def _answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """The page, or None for a connection that frames go over; 403 for whoever comes from elsewhere.

        A name of somebody else that leads to this machine is seen by Host, a page of somebody else by Origin.
        """
        own = {f"{end}:{self.port}" for end in ENDS}
        hosts, origins = request.headers.get_all("Host"), request.headers.get_all("Origin")
        if len(hosts) != 1 or hosts[0] not in own or not {*origins} <= {f"http://{each}" for each in own}:
            return self._response(HTTPStatus.FORBIDDEN, b"This page is for this machine alone.\n")
        if request.path == "/frames" and "Upgrade" in request.headers:
            return None
        if request.path == "/":
            return self._response(HTTPStatus.OK, self._page, "text/html; charset=utf-8")
        if request.path == "/favicon.ico":
            return self._response(HTTPStatus.NO_CONTENT, b"")
        return self._response(HTTPStatus.NOT_FOUND, b"The page is at /.\n")

    def _response(self, status: HTTPStatus, body: bytes, kind: str = "text/plain; charset=utf-8") -> Response:
        return Response(status.value, status.phrase, Headers({
            "Content-Type": kind, "Content-Length": str(len(body)), "Connection": "close", "Cache-Control": "no-store",
            "Content-Security-Policy": self._policy, "X-Content-Type-Options": "nosniff", "Referrer-Policy": "no-referrer",
            "Cross-Origin-Resource-Policy": "same-origin",
        }), body)  # fmt: skip

    async def _attend(self, connection: ServerConnection) -> None:
        """Send frames to one page as it asks for them, until it goes."""
        wanted = asyncio.Event()
        sending = asyncio.create_task(self._send(connection, wanted))
        with suppress(ConnectionClosed):
            async for text in connection:
                wish = _wish(text)
                if wish.get("do") == "next":
                    wanted.set()
                elif wish:
                    self.wishes.put(wish)
        sending.cancel()

    async def _send(self, connection: ServerConnection, wanted: asyncio.Event) -> None:
        last = 0
        with suppress(ConnectionClosed):
            while True:
                await wanted.wait()
                wanted.clear()
                while self._scope.number <= last:
                    await asyncio.sleep(0.5 / RATE)
                last, frame = self._scope.frame(last)
                await connection.send(frame)
                await asyncio.sleep(1.0 / RATE)


def _wish(text: str | bytes) -> dict[str, Any]:
    """What a page asks for; empty where it is nothing that a page says."""
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}
