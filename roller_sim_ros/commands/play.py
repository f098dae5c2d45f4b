# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim play``: a trace on the ROS 2 network."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

from roller_sim_ros.commands.numbers import positive, whole
from roller_sim_ros.commands.parser import command_parser
from roller_sim_ros.errors import RollerSimError

if TYPE_CHECKING:
    from roller_sim_ros.node.player import Played

DESCRIPTION = """\
Republish a trace over ROS 2 with its original spacing, stamps and quality of service, so that a meter can be
run on recorded data. The messages are published byte by byte as they were recorded.

TRACE is an MCAP file or a rosbag2 folder. Commands and parameter events are held back unless --topics names
them, so that what is played does not steer a roller that runs.
"""

EPILOG = """\
examples:
  roller-sim play trace.mcap
  roller-sim play trace.mcap --topics drum/acceleration --namespace replay --rate 2
  roller-sim play trace.mcap --subscribers 1 --ros-args -r /drum/acceleration:=/sensor/acceleration

Ctrl-C ends it. The exit code is 1 when the trace cannot be read to its end: then what can be read is played.
"""

STATUS_PERIOD_S = 0.5


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    argv : list of str, optional
        Arguments; those of the process when left out.

    Returns
    -------
    int
        0, also after Ctrl-C.

    Raises
    ------
    RollerSimError
        If the trace cannot be read to its end, a topic is not in it, or its type is not installed.
    """
    given = sys.argv[1:] if argv is None else argv
    cut = given.index("--ros-args") if "--ros-args" in given else len(given)
    arguments = _parser().parse_args(given[:cut])
    # What takes long to import, and what needs ROS 2, comes after --help.
    from roller_sim_ros.node.player import play
    from roller_sim_ros.traces.playback import select_topics
    from roller_sim_ros.traces.reader import TraceReader

    reader = TraceReader(arguments.trace)
    topics = select_topics(reader, arguments.topics)
    seconds = (reader.end_ns - reader.start_ns) * 1e-9
    print(f"{reader.path}: {seconds:.1f} s, at {arguments.rate:g} times its pace", flush=True)
    width = max(len(topic.name) for topic in topics)
    for topic in topics:
        print(
            f"  {topic.name:<{width}}  {topic.messages:>8} messages  {topic.type_name}", flush=True
        )
    silent = sum(topic.messages for topic in reader.topics.values() if topic not in topics)
    if silent and not arguments.topics:
        print(
            f"  held back: {silent} commands and parameter events (--topics plays them)", flush=True
        )
    played = play(
        reader,
        topics,
        given[cut:],
        rate=arguments.rate,
        loop=arguments.loop,
        namespace=arguments.namespace,
        subscribers=arguments.subscribers,
        delay_s=arguments.delay,
        on_message=_status() if sys.stderr.isatty() else None,
    )
    end = "interrupted after" if played.interrupted else "played"
    print(
        f"{end} {played.messages} messages in {played.seconds:.1f} s, "
        f"at most {1e3 * played.latest_s:.1f} ms late"
    )
    damage = reader.damage_text()
    if damage:
        raise RollerSimError(damage)
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = command_parser(
        "play", DESCRIPTION, EPILOG, usage="%(prog)s [OPTION ...] TRACE [--ros-args ...]"
    )
    parser.add_argument("trace", metavar="TRACE", type=Path, help="MCAP file or rosbag2 folder")
    parser.add_argument(
        "--rate",
        metavar="X",
        type=positive,
        default=1.0,
        help="speed over the original one; the stamps stay as they are (default: %(default)s)",
    )
    parser.add_argument("--loop", action="store_true", help="begin anew at the end, without end")
    parser.add_argument(
        "--topics",
        metavar="NAME",
        nargs="+",
        default=(),
        help="what to play, absolute names or their ends as in drum/acceleration (default: all but "
        "commands and parameter events)",
    )
    parser.add_argument(
        "--namespace",
        metavar="NS",
        default="",
        help="put in front of all names (default: none)",
    )
    parser.add_argument(
        "--subscribers",
        metavar="N",
        type=whole(0),
        default=0,
        help="wait until there are so many subscriptions to the topics together (default: %(default)s)",
    )
    parser.add_argument(
        "--delay",
        metavar="S",
        type=_seconds,
        default=1.0,
        help="time from then to the first message, for subscribers to find the topics, s "
        "(default: %(default)s)",
    )
    return parser


def _seconds(text: str) -> float:
    number = float(text)
    if not 0.0 <= number <= 3600.0:
        raise argparse.ArgumentTypeError(f"{text} is not a number from 0 to 3600")
    return number


def _status() -> Callable[[Played], None]:
    """Return what shows on the terminal how many messages were played, twice a second."""
    shown = time.monotonic()

    def show(played: Played) -> None:
        nonlocal shown
        now = time.monotonic()
        if now - shown >= STATUS_PERIOD_S:
            shown = now
            print(f"\r{played.messages} messages\x1b[K\r", end="", file=sys.stderr, flush=True)

    return show
