# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim panel``: a live page on a roller that runs."""

from __future__ import annotations

import argparse
import asyncio
import os
import signal
import sys

DESCRIPTION = """\
Show a roller that runs as a live page in a browser: acceleration, orbit, force loop, spectrum, meter values, map of
the operating modes; exciter, ground, faults and recording at hand. An ordinary ROS 2 client in a process of its own.
"""

EPILOG = """\
examples:
  roller-sim sim &  roller-sim panel
  roller-sim panel --namespace roller_1 --port 8081
  roller-sim panel --bind 0.0.0.0 --token "$(openssl rand -hex 16)"     # for a tablet at the bench

Whoever opens the page can command the roller. It is there for this machine alone unless --bind says otherwise; then
use --token. What goes over the network is not encrypted. Arguments for ROS 2 itself follow --ros-args.
"""

NICENESS = 10
"""The page is less urgent than the roller's blocks."""


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    argv : list of str, optional
        Arguments; those of the process when left out.

    Returns
    -------
    int
        0 after Ctrl-C or SIGTERM.

    Raises
    ------
    RollerSimError
        If the port is taken or ROS 2 refuses an argument.
    """
    given = sys.argv[1:] if argv is None else argv
    cut = given.index("--ros-args") if "--ros-args" in given else len(given)
    arguments = _parser().parse_args(given[:cut])
    os.nice(NICENESS)
    asyncio.run(_serve(arguments, given[cut:]))
    return 0


async def _serve(arguments: argparse.Namespace, ros_arguments: list[str]) -> None:
    stop = asyncio.Event()
    loop = asyncio.get_running_loop()
    for signal_number in (signal.SIGINT, signal.SIGTERM):
        loop.add_signal_handler(signal_number, stop.set)
    # What takes long to import, or needs ROS 2, comes after --help and wrong arguments.
    from roller_sim_ros.panel.addresses import is_local
    from roller_sim_ros.panel.client import Client
    from roller_sim_ros.panel.picture import TOPICS, Picture
    from roller_sim_ros.panel.server import Panel

    def say(url: str) -> None:
        local = is_local(arguments.bind)
        who = "for this machine alone" if local else f"for all that reach {arguments.bind}"
        print(f"panel: {url} {who}", flush=True)
        if not local and not arguments.token:
            print(
                "panel: whoever opens it can command the roller; --token asks for one", flush=True
            )

    client = Client(ros_arguments, TOPICS, namespace=arguments.namespace, roller=arguments.node)
    try:
        panel = Panel(client, Picture(client.roller), token=arguments.token)
        await panel.serve(arguments.bind, arguments.port, stop, say)
    finally:
        client.close()


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="roller-sim panel",
        usage="%(prog)s [OPTION ...] [--ros-args ...]",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--namespace", default="", metavar="NAME", help="namespace of the roller (default: none)"
    )
    parser.add_argument(
        "--node",
        default="roller_sim",
        metavar="NAME",
        help="name of the roller's node (default: %(default)s)",
    )
    parser.add_argument(
        "--bind",
        default="127.0.0.1",
        metavar="ADDRESS",
        help="address to listen on; 0.0.0.0: all of this machine (default: %(default)s, this machine alone)",
    )
    parser.add_argument(
        "--port",
        type=_port,
        default=8080,
        metavar="N",
        help="port; 0: any that is free (default: %(default)s)",
    )
    parser.add_argument(
        "--token", default="", metavar="TEXT", help="what the address of the page must hold"
    )
    return parser


def _port(text: str) -> int:
    number = int(text)
    if not 0 <= number <= 65535:
        raise argparse.ArgumentTypeError(f"{number} is not a port, 0 to 65535")
    return number
