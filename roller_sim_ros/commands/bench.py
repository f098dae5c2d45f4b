# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim bench``: a scenario, a meter under test and the verdict in one go."""

from __future__ import annotations

import argparse
import os
import shlex
import sys
from contextlib import nullcontext
from pathlib import Path

from roller_sim_ros.commands.numbers import positive
from roller_sim_ros.commands.parser import command_parser
from roller_sim_ros.commands.score import add_score_arguments, judge
from roller_sim_ros.commands.termination import ends_like_ctrl_c
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION

DESCRIPTION = """\
Run a scenario with a compaction meter beside it, and judge the meter: the roller and the meter run as processes
in a ROS domain of their own, everything is recorded, and the rows of roller-sim score tell what was found.

In lock step, the default, the roller goes on revolution by revolution as fast as the meter answers: the samples are
the same every time.
"""

EPILOG = """\
examples:
  roller-sim bench soft_to_stiff --meter "python3 my_meter.py" --topic /my_cmv
  roller-sim bench site.yaml --meter "ros2 run my_meters cmv" --limits limits.yaml --junit score.xml --out bench
  roller-sim bench sensor_failure_campaign               # the roller's own meter
  roller-sim bench soft_spot --meter ./meter --clock sim --speed 10

The folder of --out holds trace.mcap, roller.log, meter.log, score.json and score.xml. The exit code is 0 when no row
failed and the meter ran to the end, 1 when not, 2 when there is nothing to judge.
"""

BLOCKS = "pacing.samples_per_message"

CLOCKS = ("lock-step", "sim", "real")


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    argv : list of str, optional
        Arguments; those of the process when left out.

    Returns
    -------
    int
        0 when the meter passed, 1 when it failed, 2 when it could not be judged.
    """
    arguments = _parser().parse_args(argv)
    try:
        with ends_like_ctrl_c():
            return _bench(arguments)
    except RollerSimError as error:
        print(f"roller-sim bench: error: {error}", file=sys.stderr)
        return 2


def _bench(arguments: argparse.Namespace) -> int:
    # What takes long to import, or needs ROS 2, comes after --help.
    from roller_sim_ros.bench.bench import Bench, run_bench
    from roller_sim_ros.bench.domain import own_domain
    from roller_sim_ros.node.bench_client import someone_there
    from roller_sim_ros.scenario import read_scenario
    from roller_sim_ros.scenario.shipped import scenario_path
    from roller_sim_ros.score.limits import read_limits

    # What is wrong in a file is told before anything is started.
    path = scenario_path(arguments.scenario)
    scenario = read_scenario(path)
    if arguments.limits is not None:
        read_limits(arguments.limits)
    # What is on this machine is for it alone.
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    folder: Path = arguments.out or Path("bench") / path.stem
    given = os.environ.get("ROS_DOMAIN_ID", "") if arguments.domain is None else arguments.domain
    domain = own_domain(someone_there) if given == "" else nullcontext(_domain(str(given)))
    as_said = arguments.clock == "real" or BLOCKS in scenario.parameters
    with domain as number:
        ran = run_bench(
            Bench(
                scenario=str(path),
                meter=tuple(arguments.meter),
                topic=arguments.topic,
                folder=folder,
                clock=arguments.clock,
                speed=arguments.speed,
                domain=number,
                # Time that is not the wall clock's goes faster in messages of a revolution.
                samples_per_message=None if as_said else SAMPLES_PER_REVOLUTION,
            )
        )
    arguments.topic = ran.topic
    if arguments.junit is None:
        arguments.junit = folder / "score.xml"
    if arguments.json is None:
        arguments.json = str(folder / "score.json")
    code = judge(ran.trace, arguments)
    if ran.meter_ended:
        print(f"roller-sim bench: {ran.meter_ended}", file=sys.stderr)
        return 1
    return code


def _parser() -> argparse.ArgumentParser:
    parser = command_parser("bench", DESCRIPTION, EPILOG)
    parser.add_argument(
        "scenario",
        metavar="SCENARIO",
        help="scenario file, or the name of one that the package brings, as in soft_to_stiff",
    )
    parser.add_argument(
        "--meter",
        metavar="COMMAND",
        type=_command,
        default=[],
        help="what starts the meter under test, with its arguments; left out: the roller's own meter is judged",
    )
    parser.add_argument(
        "--topic",
        metavar="NAME",
        default="",
        help="topic of the meter (default: the only one that it publishes)",
    )
    parser.add_argument(
        "--out",
        metavar="FOLDER",
        type=Path,
        help="where trace, logs and verdict go (default: bench/ and the scenario's name); what an earlier bench left "
        "there is replaced",
    )
    parser.add_argument(
        "--clock",
        choices=CLOCKS,
        default=CLOCKS[0],
        help="lock-step: as fast as the meter answers; sim: simulated time at --speed; real: real time (default: "
        "%(default)s)",
    )
    parser.add_argument(
        "--speed",
        metavar="X",
        type=positive,
        default=10.0,
        help="simulated over real time, with --clock sim (default: %(default)g)",
    )
    parser.add_argument(
        "--domain",
        metavar="N",
        help="ROS domain (default: ROS_DOMAIN_ID where it is set, else one that nobody on this machine uses)",
    )
    add_score_arguments(parser)
    return parser


def _command(text: str) -> list[str]:
    try:
        words = shlex.split(text)
    except ValueError as error:
        raise argparse.ArgumentTypeError(f"{text!r} is no command: {error}") from None
    if not words:
        raise argparse.ArgumentTypeError("is empty; leave it out for the roller's own meter")
    return words


def _domain(text: str) -> int:
    number = int(text) if text.isdecimal() else -1
    if not 0 <= number <= 232:
        raise RollerSimError(f"{text!r} is not a ROS domain, 0 to 232")
    return number
