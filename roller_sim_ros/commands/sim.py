# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim sim``: the roller as a ROS 2 node, in real time or in time of its own."""

from __future__ import annotations

import argparse
import json
import os
import sys
from itertools import pairwise
from pathlib import Path

from roller_sim_ros.commands.flags import add_parameter_flags, given_values
from roller_sim_ros.commands.parser import command_parser
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.node.signals import handled
from roller_sim_ros.parameters import PARAMETERS, Value
from roller_sim_ros.parameters.file import read_parameters

ROS_LEVEL = "ros__parameters"

DESCRIPTION = """\
Run the roller as the ROS 2 node roller_sim: it vibrates, drives what a scenario plans, publishes
acceleration, meter values and the truth, and obeys exciter/command and cmd_vel; in real time, in
simulated time, or step by step. One status line a second until Ctrl-C.
"""

EPILOG = """\
Values given here hold over those of parameter files. Arguments for ROS 2 itself follow --ros-args, as
everywhere; other parameters are set there by their dotted names.

example:
  roller-sim sim --frequency-hz 30 --shear-modulus-mpa 80 --record trace.mcap --namespace roller_1
  roller-sim sim --scenario soft_to_stiff --clock sim --speed 10 --record trace.mcap --exit-at-end
  roller-sim sim --scenario site.yaml --lock-step
  roller-sim sim --ros-args -p pacing.samples_per_message:=32 -r drum/acceleration:=acc
"""


def main(argv: list[str] | None = None) -> int:
    """Run the command.

    Parameters
    ----------
    argv : list of str, optional
        Arguments; those of the process when left out.

    Returns
    -------
    int
        0 after Ctrl-C or SIGTERM, also while it starts, and at the end that was asked for; 1 when the node could not
        start.

    Raises
    ------
    RollerSimError
        If an argument, a parameter or a file is refused.
    """
    own, ros = _split(sys.argv[1:] if argv is None else argv)
    arguments = _parser().parse_args(own)
    overrides = given_values(arguments)
    overrides.update(_time_and_scenario(arguments))
    if arguments.record_topic:
        overrides["recording.topics"] = ",".join(arguments.record_topic)
    if arguments.params is not None:
        # Before the others, so that what is set by -p holds over the file.
        ros = [*_from_file(arguments.params), *ros]
    _check_files(ros)
    # Before numpy is there: its matrices here are small, and threads for them only hold up the pacing.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    with handled() as signals:
        try:
            # What takes long to import, or needs ROS 2, comes after --help and wrong arguments.
            from roller_sim_ros.node.process import run_node
            from roller_sim_ros.node.status_line import status_line, summary

            return run_node(
                ros,
                signals,
                namespace=arguments.namespace,
                overrides=overrides,
                exit_at_end=arguments.exit_at_end,
                on_report=lambda report: print(status_line(report), flush=True),
                on_end=lambda roller: print(summary(roller), flush=True),
            )
        except KeyboardInterrupt:
            print("stopped before the roller ran", flush=True)
            return 0


def _time_and_scenario(arguments: argparse.Namespace) -> dict[str, Value]:
    """Return {dotted name: value} of what flags say of time and scenario."""
    given: dict[str, Value | None] = {
        "scenario.path": arguments.scenario,
        "pacing.clock": arguments.clock,
        "pacing.speed": arguments.speed,
        "pacing.lock_step": arguments.lock_step or None,
    }
    return {name: value for name, value in given.items() if value is not None}


def _doc(name: str) -> str:
    return PARAMETERS[name][0].doc


def _split(arguments: list[str]) -> tuple[list[str], list[str]]:
    """Return the command's own arguments and those for ROS 2: each run from --ros-args to -- or the end."""
    own: list[str] = []
    ros: list[str] = []
    to_ros = False
    for item in arguments:
        if item == "--ros-args":
            to_ros = True
        (ros if to_ros else own).append(item)
        if item == "--":
            to_ros = False
    return own, ros


def _from_file(path: Path) -> list[str]:
    """Return the arguments for ROS 2 that set what a file says, once it is found to be right."""
    values = read_parameters(path)
    if ROS_LEVEL in path.read_text(encoding="utf-8"):
        return ["--ros-args", "--params-file", str(path), "--"]
    # Plainly nested, as ROS 2 does not read it. JSON is YAML, which ROS 2 takes the values for.
    items = (f"{name}:={json.dumps(value)}" for name, value in values.items())
    return ["--ros-args", *(word for item in items for word in ("-p", item)), "--"]


def _check_files(ros: list[str]) -> None:
    """Name a parameter file that is not there before ROS 2 does so in its own way."""
    for flag, path in pairwise(ros):
        if flag == "--params-file" and not Path(path).is_file():
            raise RollerSimError(f"{path}: there is no such file")


def _parser() -> argparse.ArgumentParser:
    parser = command_parser("sim", DESCRIPTION, EPILOG)
    parser.add_argument(
        "--namespace", default="", metavar="NAME", help="namespace of the node and its topics"
    )
    parser.add_argument(
        "--params",
        type=Path,
        metavar="FILE.yaml",
        help="parameters, plainly nested or in the form that ROS 2 reads; some are installed under "
        "share/roller_sim_ros/config",
    )
    parser.add_argument(
        "--scenario",
        metavar="SCENARIO",
        help="scenario file, or the name of one that the package brings, as in soft_to_stiff: it says roller, ground, "
        "lane, programme, sensors, faults and seed",
    )
    parser.add_argument(
        "--exit-at-end",
        action="store_true",
        help="end with 0 when all that the scenario plans has been driven; else the roller stands then, and goes on "
        "publishing",
    )
    parser.add_argument("--clock", metavar="real|sim", help=_doc("pacing.clock"))
    parser.add_argument("--speed", type=float, metavar="X", help=_doc("pacing.speed"))
    parser.add_argument("--lock-step", action="store_true", help=_doc("pacing.lock_step"))
    # The messages are for 128 samples per revolution.
    add_parameter_flags(parser, exclude=("sampling.samples_per_revolution",))
    parser.add_argument(
        "--record-topic",
        action="append",
        metavar="NAME",
        help="a further topic to record, as that of a meter under test, or drum/imu; may be repeated",
    )
    return parser
