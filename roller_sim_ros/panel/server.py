# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The web server: what goes out to the pages, and what they want done."""

from __future__ import annotations

import asyncio
import math
import time
from collections.abc import Awaitable
from contextlib import suppress
from typing import Any, Protocol

import tornado.httpserver
import tornado.netutil
import tornado.web

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.faults import FAULTS
from roller_sim_ros.meters.mode import Mode
from roller_sim_ros.meters.registry import METERS
from roller_sim_ros.panel.addresses import is_local, url
from roller_sim_ros.panel.frames import text
from roller_sim_ros.panel.handlers import PAGE, Files, Page, Socket
from roller_sim_ros.panel.picture import (
    HIGHEST_ORDER,
    SHOWN_REVOLUTIONS,
    WINDOW_REVOLUTIONS,
    Picture,
)
from roller_sim_ros.panel.stability import Stability, grid
from roller_sim_ros.parameters import PARAMETERS
from roller_sim_ros.wire import topics

FRAMES_HZ = 20.0
STATES_HZ = 5.0
SILENT_S = 3.0
"""A roller that is there says something every second."""
LARGEST_ORDER_BYTES = 4096

LIMITED = (
    "exciter.frequency_hz",
    "exciter.amplitude_m",
    "soil.shear_modulus_pa",
    "soil.plastic_parameter_m",
)
"""Parameters that the page has sliders for."""


class Roller(Protocol):
    """What the server needs of the network: see `roller_sim_ros.panel.client.Client`."""

    roller: str

    def received(self) -> list[tuple[topics.Topic, bytes]]:
        """Return what has come since the last call."""
        ...

    def command(self, *, vibrate: bool, frequency_hz: float, amplitude_m: float) -> None:
        """Publish an exciter command."""
        ...

    def limits(self, names: Any) -> Awaitable[dict[str, tuple[float, float]]]:
        """Return bounds of parameters."""
        ...

    def set_parameters(self, values: Any) -> Awaitable[None]:
        """Set parameters."""
        ...

    def inject(self, fault_id: str, duration_s: float) -> Awaitable[None]:
        """Inject a fault."""
        ...

    def clear(self, handle: int) -> Awaitable[None]:
        """Clear faults."""
        ...

    def release(self) -> Awaitable[None]:
        """Hand back to the scenario."""
        ...

    def record(self, path: str) -> Awaitable[None]:
        """Record to a file, or not."""
        ...


class Panel:
    """The page's server.

    Parameters
    ----------
    roller : Roller
        The network.
    picture : Picture
        What has come from it.
    token : str
        What a page must bring in its address; empty: nothing.
    """

    def __init__(self, roller: Roller, picture: Picture, *, token: str = "") -> None:
        self.roller = roller
        self.picture = picture
        self.token = token
        self.pages: set[Socket] = set()
        self.stability = Stability()
        self._limits: dict[str, tuple[float, float]] = {}
        self._heard_s = -math.inf

    def application(self, *, local: bool) -> tornado.web.Application:
        """Return the web application.

        Parameters
        ----------
        local : bool
            Whether only this machine is served: then other names for it are refused, behind which a foreign page
            might be.
        """
        given = {"panel": self, "local": local}
        return tornado.web.Application(
            [
                (r"/", Page, given),
                (r"/socket", Socket, given),
                (r"/(panel\.css|[a-z]+\.js|icon\.svg)", Files, {"path": str(PAGE)}),
            ],
            websocket_max_message_size=LARGEST_ORDER_BYTES,
        )

    async def serve(self, address: str, port: int, stop: asyncio.Event, on_open: Any) -> None:
        """Serve until `stop` is set.

        Parameters
        ----------
        address : str
            Address to listen on.
        port : int
            Port; 0: any that is free.
        stop : asyncio.Event
            What ends it.
        on_open : callable
            Called with the address to open in a browser.

        Raises
        ------
        RollerSimError
            If address and port cannot be had.
        """
        try:
            sockets = tornado.netutil.bind_sockets(port, address)
        except OSError as error:
            raise RollerSimError(
                f"cannot listen on {address}, port {port}: {error.strerror or error}; --port takes another"
            ) from None
        server = tornado.httpserver.HTTPServer(self.application(local=is_local(address)))
        server.add_sockets(sockets)
        on_open(url(address, sockets[0].getsockname()[1], self.token))
        tasks = [asyncio.create_task(work) for work in (self._send_frames(), self._send_states())]
        ended = asyncio.create_task(stop.wait())
        try:
            done, _ = await asyncio.wait([*tasks, ended], return_when=asyncio.FIRST_COMPLETED)
            for task in done - {ended}:
                task.result()
        finally:
            for task in (*tasks, ended):
                task.cancel()
            server.stop()
            for page in list(self.pages):
                page.close(1001, "the panel has ended")
            self.stability.close()

    def greeting(self) -> str:
        """Return what a page is told first, as JSON."""
        return text(
            {
                "kind": "hello",
                "node": self.roller.roller,
                "modes": [mode.label for mode in Mode],
                "faults": [
                    {"id": name, "doc": _first_sentence(fault.__doc__)}
                    for name, fault in FAULTS.items()
                ],
                "orders": {
                    meter.label: meter.orders for meter in METERS if meter.name in ("cmv", "rmv")
                },
                "highest_order": HIGHEST_ORDER,
                "window_revolutions": WINDOW_REVOLUTIONS,
                "shown_revolutions": SHOWN_REVOLUTIONS,
            }
        )

    def state(self) -> str:
        """Return what changes seldom, as JSON."""
        limits = {name: list(self._limits.get(name) or declared(name)) for name in LIMITED}
        heard = time.monotonic() - self._heard_s < SILENT_S
        return text({"kind": "state", "heard": heard, "limits": limits, **self.picture.state()})

    async def obey(self, order: dict[str, Any]) -> None:
        """Do what a page wants.

        Raises
        ------
        RollerSimError
            If it is nothing that can be done, or the roller refuses.
        """
        what = order.get("do")
        if what == "command":
            self.roller.command(
                vibrate=order.get("vibrate") is True,
                frequency_hz=number(order, "frequency_hz"),
                amplitude_m=number(order, "amplitude_m"),
            )
        elif what == "soil":
            names = [name for name in LIMITED if name.startswith("soil.") and name in order]
            await self.roller.set_parameters({name: number(order, name) for name in names})
        elif what == "inject":
            await self.roller.inject(str(order.get("fault")), number(order, "duration_s"))
        elif what == "clear":
            await self.roller.clear(int(number(order, "handle")))
        elif what == "release":
            await self.roller.release()
        elif what == "record":
            # The name is not the page's to choose: whoever sees it could write anywhere.
            on = order.get("on") is True
            await self.roller.record(time.strftime("panel_%Y%m%d_%H%M%S.mcap") if on else "")
        else:
            raise RollerSimError(f"there is no order {what!r}")

    async def _send_frames(self) -> None:
        loop = asyncio.get_running_loop()
        due = loop.time()
        while True:
            due = max(due + 1.0 / FRAMES_HZ, loop.time())
            await asyncio.sleep(due - loop.time())
            for topic, data in self.roller.received():
                if self.picture.take(topic, data):
                    self._heard_s = time.monotonic()
            if not self.pages:
                continue
            frame = self.picture.frame()
            whole: bytes | None = None
            for page in list(self.pages):
                if page.fresh:
                    whole = whole or self.picture.whole()
                    page.fresh = False
                    page.send(whole)
                elif page.idle:
                    page.send(frame)

    async def _send_states(self) -> None:
        known = ""
        while True:
            await asyncio.sleep(1.0 / STATES_HZ)
            await self._look_for_limits()
            if not self.pages:
                continue
            state = self.state()
            if state != known:
                known = state
                self.send(state)
            if self._look_at_map() and self.stability.map is not None:
                self.send(text(self.stability.map))

    def send(self, message: str) -> None:
        """Send a text to all pages."""
        for page in list(self.pages):
            page.send(message)

    async def _look_for_limits(self) -> None:
        """Ask the roller for its limits, once it is there and again when it comes back."""
        if time.monotonic() - self._heard_s > SILENT_S:
            self._limits = {}
        elif not self._limits:
            with suppress(RollerSimError):
                self._limits = await self.roller.limits(LIMITED)

    def _look_at_map(self) -> bool:
        configuration = self.picture.configuration()
        exciter = self.picture.state()["exciter"]
        if configuration is None or not exciter:
            return False
        return self.stability.look(
            grid(configuration, exciter["commanded_frequency_hz"], exciter["commanded_amplitude_m"])
        )


def declared(name: str) -> tuple[float, float]:
    """Return the bounds that a parameter is declared with."""
    quantity, _ = PARAMETERS[name]
    low = -math.inf if quantity.minimum is None else quantity.minimum
    return low, math.inf if quantity.maximum is None else quantity.maximum


def number(order: dict[str, Any], name: str) -> float:
    """Return a number of an order.

    Raises
    ------
    RollerSimError
        If it is missing or none.
    """
    value = order.get(name)
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        raise RollerSimError(f"{name} = {value!r}: must be a number")
    return float(value)


def _first_sentence(doc: str | None) -> str:
    return (doc or "").strip().split("\n\n")[0].replace("\n", " ").strip()
