# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The server without a network behind it."""

from __future__ import annotations

import asyncio
import json
from typing import Any

import pytest
import tornado.testing
import tornado.websocket
from tornado.httpclient import HTTPClientError, HTTPRequest

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.panel.addresses import is_local, url
from roller_sim_ros.panel.picture import Picture
from roller_sim_ros.panel.server import Panel

TOKEN = "grün & 7"
QUERY = "?token=gr%C3%BCn%20%26%207"


class FakeRoller:
    """Notes what it is told."""

    roller = "/roller_sim"

    def __init__(self) -> None:
        self.told: list[Any] = []

    def received(self) -> list[Any]:
        return []

    def command(self, **values: Any) -> None:
        self.told.append(values)

    async def limits(self, _names: Any) -> dict[str, tuple[float, float]]:
        return {}

    async def set_parameters(self, values: Any) -> None:
        self.told.append(values)

    async def inject(self, fault_id: str, duration_s: float) -> None:
        raise RollerSimError(f"there is no fault {fault_id}, {duration_s:g}")

    async def clear(self, handle: int) -> None:
        self.told.append(handle)

    async def release(self) -> None:
        self.told.append("release")

    async def record(self, path: str) -> None:
        self.told.append(path)


class ServerTest(tornado.testing.AsyncHTTPTestCase):
    token = ""

    def get_app(self) -> Any:
        self.roller = FakeRoller()
        self.panel = Panel(self.roller, Picture("/roller_sim"), token=self.token)
        return self.panel.application(local=True)

    async def connect(self, query: str = "", **headers: str) -> Any:
        address = f"ws://127.0.0.1:{self.get_http_port()}/socket{query}"
        return await tornado.websocket.websocket_connect(HTTPRequest(address, headers=headers))

    async def answer(self, socket: Any, order: Any) -> str:
        await socket.write_message(order if isinstance(order, str) else json.dumps(order))
        while True:
            message = json.loads(await asyncio.wait_for(socket.read_message(), 30))
            if message["kind"] == "answer":
                return str(message["failure"])


class TestOpen(ServerTest):
    def test_page_and_its_files_are_served(self) -> None:
        page = self.fetch("/")
        assert page.code == 200
        assert "frame-ancestors 'none'" in page.headers["Content-Security-Policy"]
        for name in ("panel.css", "panel.js", "charts.js", "controls.js", "plot.js", "icon.svg"):
            assert self.fetch(f"/{name}").code == 200
        assert self.fetch("/../server.py").code == 404

    def test_a_name_that_is_not_this_machines_is_refused(self) -> None:
        assert self.fetch("/", headers={"Host": "evil.example"}).code == 403
        assert self.fetch("/", headers={"Host": f"localhost:{self.get_http_port()}"}).code == 200

    @tornado.testing.gen_test
    async def test_a_page_from_elsewhere_cannot_connect(self) -> None:
        with pytest.raises(HTTPClientError, match="403"):
            await self.connect(Origin="http://evil.example")

    @tornado.testing.gen_test
    async def test_a_page_is_greeted_and_obeyed(self) -> None:
        socket = await self.connect()
        hello = json.loads(await socket.read_message())
        assert hello["modes"][3] == "double jump"
        assert hello["orders"] == {"CMV": [1.0, 2.0], "RMV": [0.5, 1.0]}
        state = json.loads(await socket.read_message())
        assert not state["heard"]
        assert state["limits"]["exciter.frequency_hz"] == [0.0, 80.0]
        command = {"vibrate": True, "frequency_hz": 30.0, "amplitude_m": 1e-3}
        assert await self.answer(socket, {"do": "command", **command}) == ""
        ground = {"soil.shear_modulus_pa": 6e7, "machine.drum_mass_kg": 1.0}
        assert await self.answer(socket, {"do": "soil", **ground}) == ""
        assert await self.answer(socket, {"do": "clear", "handle": 3}) == ""
        assert await self.answer(socket, {"do": "record", "on": False, "path": "/etc/x"}) == ""
        assert self.roller.told == [command, {"soil.shear_modulus_pa": 6e7}, 3, ""]

    @tornado.testing.gen_test
    async def test_orders_that_are_none_are_refused_in_words(self) -> None:
        socket = await self.connect()
        for order, says in (
            ("{", "JSON"),
            ("[]", "object"),
            ({"do": "fly"}, "no order 'fly'"),
            ({"do": "command", "frequency_hz": "30"}, "frequency_hz = '30': must be a number"),
            ('{"do": "command", "frequency_hz": NaN}', "must be a number"),
            ({"do": "inject", "fault": "x", "duration_s": 1}, "no fault x"),
        ):
            assert says in await self.answer(socket, order)
        assert self.roller.told == []


class TestGuarded(ServerTest):
    token = TOKEN

    def test_the_page_asks_for_the_token(self) -> None:
        assert self.fetch("/").code == 403
        assert self.fetch("/?token=x").code == 403
        assert self.fetch(f"/{QUERY}").code == 200

    @tornado.testing.gen_test
    async def test_so_does_the_socket(self) -> None:
        with pytest.raises(HTTPClientError, match="403"):
            await self.connect()
        socket = await self.connect(QUERY)
        assert json.loads(await socket.read_message())["kind"] == "hello"


def test_addresses() -> None:
    assert is_local("127.0.0.1")
    assert is_local("::1")
    assert is_local("localhost")
    assert not is_local("0.0.0.0")
    assert not is_local("roller.example")
    assert url("::1", 80, "") == "http://[::1]:80/"
    assert url("127.0.0.1", 80, TOKEN) == "http://127.0.0.1:80/?token=gr%C3%BCn%20%26%207"


def test_a_port_that_is_taken_is_said() -> None:
    async def twice() -> None:
        opened: list[str] = []
        stop = asyncio.Event()
        first = asyncio.create_task(
            Panel(FakeRoller(), Picture("/a")).serve("127.0.0.1", 0, stop, opened.append)
        )
        while not opened:
            await asyncio.sleep(0.01)
        port = int(opened[0].rsplit(":", 1)[1].strip("/"))
        with pytest.raises(RollerSimError, match=f"port {port}"):
            await Panel(FakeRoller(), Picture("/b")).serve("127.0.0.1", port, stop, opened.append)
        stop.set()
        await first

    asyncio.run(twice())
