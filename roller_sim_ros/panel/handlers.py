# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What answers the browser: the page, its files, and the socket of each page."""

from __future__ import annotations

import asyncio
import hmac
import json
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import tornado.web
import tornado.websocket

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.panel.addresses import is_local
from roller_sim_ros.panel.frames import text

if TYPE_CHECKING:
    from roller_sim_ros.panel.server import Panel

PAGE = Path(__file__).parent / "page"


class _Guarded(tornado.web.RequestHandler):
    """Serves those who bring the token, under a name of this machine."""

    def initialize(self, panel: Panel, local: bool) -> None:
        self.panel = panel
        self._local = local

    def prepare(self) -> None:
        """Refuse others."""
        name = self.request.host_name.strip("[]")
        if self._local and name != "localhost" and not is_local(name):
            raise tornado.web.HTTPError(
                403, reason="Asked for by a name that is not this machine's"
            )
        given = self.get_query_argument("token", "")
        if not hmac.compare_digest(given.encode(), self.panel.token.encode()):
            raise tornado.web.HTTPError(403, reason="The address lacks the token")

    def write_error(self, status_code: int, **_: Any) -> None:
        """Say why in plain text."""
        self.set_header("Content-Type", "text/plain; charset=utf-8")
        self.finish(f"{status_code}: {self._reason}\n")


class Page(_Guarded):
    """The page."""

    def get(self) -> None:
        """Send it."""
        _say_what_is_allowed(self)
        self.write((PAGE / "index.html").read_bytes())


class Files(tornado.web.StaticFileHandler):
    """What the page is made with."""

    def set_extra_headers(self, path: str) -> None:  # noqa: ARG002
        """Let a newer one be taken at once."""
        self.set_header("Cache-Control", "no-cache")
        _say_what_is_allowed(self)


class Socket(_Guarded, tornado.websocket.WebSocketHandler):
    """The connection of one page."""

    def open(self, *_: str, **__: str) -> None:
        """Greet."""
        self.fresh = True
        self._sending: asyncio.Future[None] | None = None
        self._orders: set[asyncio.Task[None]] = set()
        self.set_nodelay(True)
        self.send(self.panel.greeting())
        self.send(self.panel.state())
        if self.panel.stability.map is not None:
            self.send(text(self.panel.stability.map))
        self.panel.pages.add(self)

    def on_close(self) -> None:
        """Forget the page."""
        self.panel.pages.discard(self)

    @property
    def idle(self) -> bool:
        """Whether all that was sent has gone out: a page that is slow gets fewer frames."""
        return self._sending is None or self._sending.done()

    def send(self, message: str | bytes) -> None:
        """Send a text or a frame."""
        with suppress(tornado.websocket.WebSocketClosedError):
            self._sending = asyncio.ensure_future(
                self.write_message(message, binary=isinstance(message, bytes))
            )
            self._sending.add_done_callback(asyncio.Future.exception)

    def on_message(self, message: str | bytes) -> None:
        """Take an order."""
        task = asyncio.create_task(self._obey(message))
        self._orders.add(task)
        task.add_done_callback(self._orders.discard)

    async def _obey(self, message: str | bytes) -> None:
        order: dict[str, Any] = {}
        failure = ""
        try:
            found = json.loads(message)
            if not isinstance(found, dict):
                raise RollerSimError("an order is an object")
            order = found
            await self.panel.obey(order)
        except ValueError:
            failure = "an order is JSON"
        except RollerSimError as error:
            failure = str(error)
        self.send(text({"kind": "answer", "of": str(order.get("do")), "failure": failure}))


def _say_what_is_allowed(handler: tornado.web.RequestHandler) -> None:
    # Nothing comes from elsewhere, and nobody shows the page in his own.
    handler.set_header(
        "Content-Security-Policy", "default-src 'self'; style-src 'self'; frame-ancestors 'none'"
    )
    handler.set_header("X-Content-Type-Options", "nosniff")
    handler.set_header("Referrer-Policy", "no-referrer")
