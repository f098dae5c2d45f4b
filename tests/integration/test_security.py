# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the node may do, opens and writes: its policy against its graph, its ports, its files, as another user."""

from __future__ import annotations

import os
import re
import shutil
import signal
import stat
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

import pytest

from roller_sim_ros.bench.domain import own_domain
from roller_sim_ros.jit import cache_directory
from tests.integration.harness import NODE as NAME
from tests.integration.harness import PATIENCE_S, Client, Sim

POLICY = Path(__file__).resolve().parents[2] / "security" / "roller_sim.policy.xml"
STRANGER = 64123
"""A user that owns nothing."""
PRIVILEGES = {
    "topics": ("publish", "subscribe"),
    "services": ("reply", "request"),
}
Graph = dict[str, set[str]]


def allowed(text: str) -> Graph:
    """Return {privilege: absolute names} of a policy, as sros2 resolves them."""
    found: Graph = {"publish": set(), "subscribe": set(), "reply": set(), "request": set()}
    root = ElementTree.fromstring(text)
    assert (root.tag, root.get("version")) == ("policy", "0.2.0")
    (profile,) = root.findall("enclaves/enclave/profiles/profile")
    namespace, node = profile.attrib["ns"], profile.attrib["node"]
    assert node == NAME
    prefix = namespace.rstrip("/") + "/"
    for rules in profile:
        for privilege in PRIVILEGES[rules.tag]:
            if rules.get(privilege) is None:
                continue
            assert rules.get(privilege) == "ALLOW"
            for item in rules:
                name = item.text or ""
                if name.startswith("~/"):
                    name = f"{prefix}{node}{name[1:]}"
                elif not name.startswith("/"):
                    name = f"{prefix}{name}"
                assert name not in found[privilege], f"{name} is there twice"
                found[privilege].add(name)
    return found


def differences(policy: Graph, graph: Graph) -> list[str]:
    """Return what is done without being allowed, and allowed without being done."""
    return [
        f"{name}: {privilege} {what}"
        for privilege in policy
        for what, names in (
            ("without an entry in the policy", graph[privilege] - policy[privilege]),
            ("in the policy, which the node never does", policy[privilege] - graph[privilege]),
        )
        for name in sorted(names)
    ]


@dataclass
class Run:
    """A node that does all that it can do, as it was found while it ran."""

    graph: Graph
    sockets: dict[str, int]
    bare_sockets: dict[str, int]


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> Run:
    folder = tmp_path_factory.mktemp("run")
    bare = "import rclpy; rclpy.init(); node = rclpy.create_node('bare'); print('ready', flush=True); input()"
    with (
        own_domain() as number,
        Client(number) as client,
        subprocess.Popen(
            [sys.executable, "-c", bare],
            env={**os.environ, "ROS_DOMAIN_ID": str(number)},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
        ) as other,
        Sim(folder, number, "--lock-step", "--record", str(folder / "trace.mcap")) as sim,
    ):
        try:
            assert other.stdout is not None
            assert other.stdout.readline() == b"ready\n"
            graph = client.spin_until(lambda: settled(client))
            family = [sim.process.pid, sim.child()]
            found = {
                kind: sum(sockets(pid, number)[kind] for pid in family)
                for kind in sockets(other.pid, number)
            }
            return Run(graph, found, sockets(other.pid, number))
        finally:
            other.kill()


def settled(client: Client) -> Graph | None:
    """Return what the roller does, once no more of it comes to be known: entities of a kind are not told in order."""
    graph = complete(client)
    if graph is not None:
        client.spin_for(1.0)
    return graph if graph == complete(client) else None


def complete(client: Client) -> Graph | None:
    """Return what is known of what the roller does, once it is active."""
    if (NAME, "/") not in client.node.get_node_names_and_namespaces():
        return None
    graph = {
        privilege: {name for name, _ in ask(NAME, "/")}
        for privilege, ask in (
            ("publish", client.node.get_publisher_names_and_types_by_node),
            ("subscribe", client.node.get_subscriber_names_and_types_by_node),
            ("reply", client.node.get_service_names_and_types_by_node),
            ("request", client.node.get_client_names_and_types_by_node),
        )
    }
    active = client.state() == "active" and "/clock" in graph["publish"]
    return graph if active else None


def sockets(pid: int, number: int) -> dict[str, int]:
    """Count the sockets of a process: UDP at a port of DDS in this domain, UDP at a port that the system chose, …"""
    own = set()
    for link in Path(f"/proc/{pid}/fd").iterdir():
        try:
            found = re.fullmatch(r"socket:\[(\d+)\]", str(link.readlink()))
        except FileNotFoundError:
            continue
        if found:
            own.add(found[1])
    first = 7400 + 250 * number
    low, high = map(int, Path("/proc/sys/net/ipv4/ip_local_port_range").read_text("ascii").split())
    counts = {"dds": 0, "chosen by the system": 0, "other": 0, "tcp": 0, "unix with a name": 0}
    for table in ("udp", "udp6", "tcp", "tcp6"):
        for line in Path(f"/proc/{pid}/net/{table}").read_text("ascii").splitlines()[1:]:
            fields = line.split()
            if fields[9] not in own:
                continue
            port = int(fields[1].rpartition(":")[2], 16)
            if table.startswith("tcp"):
                counts["tcp"] += 1
            elif first <= port < first + 250:
                counts["dds"] += 1
            elif low <= port <= high:
                counts["chosen by the system"] += 1
            else:
                counts["other"] += 1
    for line in Path(f"/proc/{pid}/net/unix").read_text("utf-8").splitlines()[1:]:
        fields = line.split()
        counts["unix with a name"] += fields[6] in own and len(fields) > 7
    return counts


def written_to(pid: int) -> Iterator[Path]:
    """Yield the regular files that a process has open for writing."""
    for link in Path(f"/proc/{pid}/fd").iterdir():
        try:
            target = link.readlink()
            flags = re.search(
                r"flags:\s+(\d+)", Path(f"/proc/{pid}/fdinfo/{link.name}").read_text("ascii")
            )
            regular = stat.S_ISREG(link.stat().st_mode)
        except FileNotFoundError:
            continue
        assert flags is not None
        if regular and int(flags[1], 8) & os.O_ACCMODE != os.O_RDONLY:
            yield target


def test_policy_allows_what_the_node_does_and_no_more(run: Run) -> None:
    assert differences(allowed(POLICY.read_text(encoding="utf-8")), run.graph) == []


def test_a_new_topic_and_a_needless_entry_are_found(run: Run) -> None:
    text = POLICY.read_text(encoding="utf-8")
    less = allowed(text.replace("<topic>cmv</topic>", ""))
    assert differences(less, run.graph) == ["/cmv: publish without an entry in the policy"]
    more = allowed(text.replace("<topic>cmd_vel</topic>", "<topic>cmd_vel</topic><topic>x</topic>"))
    assert differences(more, run.graph) == [
        "/x: subscribe in the policy, which the node never does"
    ]


def test_node_opens_no_port_but_those_of_dds(run: Run) -> None:
    # As many as the barest node of ROS 2, in all of its processes.
    assert run.sockets == run.bare_sockets
    assert run.sockets["dds"] > 0
    assert run.sockets["tcp"] == run.sockets["unix with a name"] == 0


def as_a_stranger(told: Path) -> list[str]:
    """Return what a command begins with that is run by another user, where the tests' may do that.

    The stranger may read what the tests' user may where its Python is for that user alone, if the system lets it; it
    may write nothing but its own.
    """
    if os.geteuid() != 0 or shutil.which("setpriv") is None:
        return []
    user = ["setpriv", f"--reuid={STRANGER}", f"--regid={STRANGER}", "--clear-groups"]
    reads = ["--inh-caps=+dac_read_search", "--ambient-caps=+dac_read_search"]
    for before in ([*user, *reads], user):
        if (
            subprocess.run(
                [*before, sys.executable, "-c", "import rclpy"], cwd="/", capture_output=True
            ).returncode
            == 0
        ):
            for path in (told, *told.rglob("*")):
                os.chown(path, STRANGER, STRANGER)
            return before
    return []


def of_the_stranger() -> set[Path]:
    """Return what is the stranger's where everybody may write."""
    found = set()
    for place in (Path("/tmp"), Path("/var/tmp"), Path("/dev/shm")):
        for path in place.iterdir():
            with suppress(FileNotFoundError):
                if path.lstat().st_uid == STRANGER:
                    found.add(path)
    return found


def test_any_user_may_run_it_and_it_writes_only_where_it_is_told(
    tmp_path: Path, own_domain: int
) -> None:
    working, told = tmp_path / "working", tmp_path / "told"
    cache = told / "cache"
    told.mkdir()
    # What is compiled already, so that nobody waits for it again.
    if Path(cache_directory()).is_dir():
        compiled = cache / "roller_sim_ros" / Path(cache_directory()).name
        shutil.copytree(cache_directory(), compiled)
    working.mkdir()
    working.chmod(0o555)
    before = of_the_stranger()
    stranger = as_a_stranger(told)
    with (tmp_path / "said").open("wb") as said:
        process = subprocess.Popen(
            [
                *stranger,
                *(sys.executable, "-m", "roller_sim_ros.commands", "sim"),
                *("--record", str(told / "trace.mcap")),
            ],
            cwd=working,
            env={
                **os.environ,
                "ROS_DOMAIN_ID": str(own_domain),
                "ROS_LOG_DIR": str(told / "log"),
                "XDG_CACHE_HOME": str(cache),
                "HOME": str(working),
            },
            stdout=said,
            stderr=said,
            start_new_session=True,
        )
    try:
        wait_for(lambda: "CMV" in (tmp_path / "said").read_text("utf-8"))
        family = [process.pid, *children(process.pid)]
        assert len(family) == 2, "the recording has a process of its own"
        users = {Path(f"/proc/{pid}").stat().st_uid for pid in family}
        assert users == {STRANGER if stranger else os.geteuid()}
        open_files = {path for pid in family for path in written_to(pid)}
        process.send_signal(signal.SIGINT)
        assert process.wait(PATIENCE_S) == 0, (tmp_path / "said").read_text("utf-8")
    finally:
        process.kill()
        process.wait()
    # In memory: what DDS shares with other nodes, and the recording's process with the node.
    memory = re.compile(r"/dev/shm/(fastrtps_|fastdds_|sem\.fast|lttng-)|/memfd:")
    new = of_the_stranger() - before
    left = open_files | new
    stray = {path for path in left if told not in path.parents and not memory.match(str(path))}
    assert stray == {tmp_path / "said"}
    assert list(working.iterdir()) == []
    assert {path.name for path in told.iterdir()} == {"cache", "log", "trace.mcap"}
    assert (told / "trace.mcap").stat().st_size > 0
    for path in new - {tmp_path}:
        if memory.match(str(path)):
            path.unlink()


def children(pid: int) -> list[int]:
    return [int(it) for it in Path(f"/proc/{pid}/task/{pid}/children").read_text("ascii").split()]


def wait_for(done: Callable[[], bool]) -> None:
    deadline = time.monotonic() + PATIENCE_S
    while not done():
        assert time.monotonic() < deadline, f"not within {PATIENCE_S:g} s"
        time.sleep(0.05)
