# SPDX-License-Identifier: MIT OR Apache-2.0
"""The cockpit's door: one page and one WebSocket, on this machine alone, for whoever has the token.

It listens on 127.0.0.1 and answers requests whose Host is that, with the token in their address; a WebSocket must come from a
page of this server too (Origin). Every page has a place for one picture: a page that reads slowly misses pictures, nothing piles
up and the flight does not know. What a page says is checked; after `PATIENCE` broken messages its connection is closed.
"""

from __future__ import annotations

import asyncio
import contextlib
import hmac
import secrets
import threading
import time
from collections.abc import Callable
from http import HTTPStatus
from typing import TYPE_CHECKING, Any
from urllib.parse import parse_qs, urlsplit

from ..errors import InputError
from .messages import LARGEST, Message, read
from .page import page
from .picture import Shown

if TYPE_CHECKING:
    from websockets.asyncio.server import ServerConnection
    from websockets.http11 import Request, Response

HOST = "127.0.0.1"
PATIENCE = 100
"""Broken messages after which a connection is closed."""
MOST = 8
"""Pages at a time."""
PER_SECOND = 2000
"""Messages a second that are read of one page; more wait in its own machine."""
BUFFER = 1 << 16
"""Bytes that wait for a page that does not read, about."""


class Seat:
    """Of one page: the picture it is to see next."""

    def __init__(self) -> None:
        """Nothing yet."""
        self.picture: Shown | None = None
        self.fresh = asyncio.Event()
        self.run = self.sent = 0
        self.status = ""

    def show(self, picture: Shown) -> None:
        """The newest picture in place of the one that was not taken."""
        self.picture = picture
        self.fresh.set()


class Server:
    """Serves pages in a thread of its own. say: what a message is given to; models: what can be asked for."""

    def __init__(self, say: Callable[[Message], bool], models: tuple[str, ...], port: int = 0):
        """port: 0 for any that is free. InputError where it is taken, or websockets is not installed."""
        try:
            import websockets.asyncio.server  # noqa: F401
        except ImportError as reason:
            said = "is needed for the cockpit: pip install wakeflight[cockpit]"
            raise InputError.of("package", "websockets", said) from reason
        self.token = secrets.token_urlsafe(24)
        self._say, self._models = say, models
        self._seats: set[Seat] = set()
        self._last: Shown | None = None
        self.refused = 0
        """Messages that were no messages."""
        self.port = port
        self._loop = asyncio.new_event_loop()
        self._begun: threading.Event = threading.Event()
        self._failure: OSError | None = None
        self._stop: asyncio.Event | None = None
        self._thread = threading.Thread(target=self._run, name="cockpit-server", daemon=True)
        self._thread.start()
        self._begun.wait()
        if self._failure is not None:
            reason = self._failure
            raise InputError.of("port", port, f"cannot be listened on: {reason.strerror or reason}") from reason

    @property
    def url(self) -> str:
        """Address of the page, its token in it."""
        return f"http://{HOST}:{self.port}/?token={self.token}"

    def publish(self, picture: Shown) -> None:
        """The newest picture, from any thread; returns at once."""
        with contextlib.suppress(RuntimeError):  # the loop has ended
            self._loop.call_soon_threadsafe(self._hand_out, picture)

    def close(self) -> None:
        """No page is served any more."""
        if self._stop is not None and self._thread.is_alive():
            with contextlib.suppress(RuntimeError):
                self._loop.call_soon_threadsafe(self._stop.set)
        self._thread.join(10.0)

    # --- the thread that serves ---------------------------------------------------------------------------------

    def _run(self) -> None:
        try:
            self._loop.run_until_complete(self._serve())
        except OSError as reason:
            self._failure = reason
        finally:
            self._begun.set()
            self._loop.close()

    async def _serve(self) -> None:
        from websockets.asyncio.server import serve

        self._stop = asyncio.Event()
        async with serve(
            self._seat,
            HOST,
            self.port,
            process_request=self._request,
            compression=None,
            max_size=LARGEST,
            max_queue=4,
            write_limit=BUFFER,
            ping_interval=20.0,
            ping_timeout=20.0,
            open_timeout=10.0,
            close_timeout=1.0,
            server_header=None,
            logger=_quiet(),
        ) as server:
            self.port = server.sockets[0].getsockname()[1]
            self._begun.set()
            await self._stop.wait()

    def _hand_out(self, picture: Shown) -> None:
        self._last = picture
        for seat in self._seats:
            seat.show(picture)

    def _request(self, connection: ServerConnection, request: Request) -> Response | None:
        """The page, None for a WebSocket that may be opened, or why not."""
        hosts = (f"{HOST}:{self.port}", f"localhost:{self.port}")
        address = urlsplit(request.path)
        given = parse_qs(address.query).get("token", [""])[-1]
        if request.headers.get_all("Host") not in [[each] for each in hosts]:
            return connection.respond(HTTPStatus.FORBIDDEN, "this page is for this machine alone\n")
        if not hmac.compare_digest(given.encode("utf-8", "replace"), self.token.encode()):
            said = "the address must hold the token that was printed where the cockpit was started\n"
            return connection.respond(HTTPStatus.FORBIDDEN, said)
        if address.path == "/":
            return self._page(connection)
        if address.path != "/fly":
            return connection.respond(HTTPStatus.NOT_FOUND, "there is /, and /fly for the page itself\n")
        if request.headers.get_all("Origin") not in [[f"http://{each}"] for each in hosts]:
            return connection.respond(HTTPStatus.FORBIDDEN, "a WebSocket must come from the cockpit's own page\n")
        if len(self._seats) >= MOST:
            return connection.respond(HTTPStatus.SERVICE_UNAVAILABLE, f"{MOST} pages look already\n")
        return None

    def _page(self, connection: ServerConnection) -> Response:
        """The page, which asks nobody else for anything."""
        nonce = secrets.token_urlsafe(16)
        response = connection.respond(HTTPStatus.OK, page(nonce))
        rules = (
            f"default-src 'none'; script-src 'nonce-{nonce}'; style-src 'nonce-{nonce}'; connect-src 'self'; "
            "img-src data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
        )
        headers = response.headers
        del headers["Content-Type"]
        for name, value in (
            ("Content-Type", "text/html; charset=utf-8"),
            ("Content-Security-Policy", rules),
            ("Referrer-Policy", "no-referrer"),
            ("X-Content-Type-Options", "nosniff"),
            ("Cache-Control", "no-store"),
        ):
            headers[name] = value
        return response

    async def _seat(self, connection: ServerConnection) -> None:
        """A page has come: show and listen until it goes."""
        from websockets.exceptions import ConnectionClosed

        seat = Seat()
        if self._last is not None:
            seat.show(self._last)
        self._seats.add(seat)
        showing = asyncio.create_task(self._show(connection, seat))
        try:
            await self._listen(connection)
        except ConnectionClosed:
            pass
        finally:
            self._seats.discard(seat)
            showing.cancel()
            with contextlib.suppress(asyncio.CancelledError, ConnectionClosed):
                await showing

    async def _show(self, connection: ServerConnection, seat: Seat) -> None:
        """Send pictures, the newest each time; waits where the page does not read."""
        while True:
            await seat.fresh.wait()
            seat.fresh.clear()
            picture = seat.picture
            if picture is None:
                continue
            if picture.run != seat.run:
                seat.run = picture.run
                await connection.send(picture.opening)
            if picture.status != seat.status:
                seat.status = picture.status
                await connection.send(picture.status)
            await connection.send(picture.frame)
            seat.sent += 1

    async def _listen(self, connection: ServerConnection) -> None:
        """Read what a page says; close where it says too much that is nothing."""
        broken, count, since = 0, 0, time.monotonic()
        async for text in connection:
            count += 1
            if count >= PER_SECOND / 10:
                await asyncio.sleep(max(0.0, since + 0.1 - time.monotonic()))
                count, since = 0, time.monotonic()
            try:
                self._say(read(text, self._models))
            except InputError:
                self.refused += 1
                broken += 1
                if broken >= PATIENCE:
                    await connection.close(1008, "too many messages that are none")
                    return


def _quiet() -> Any:
    """Connections come and go: nothing of it is written anywhere."""
    import logging

    logger = logging.getLogger("wakeflight.cockpit")
    logger.addHandler(logging.NullHandler())
    logger.propagate = False
    return logger
