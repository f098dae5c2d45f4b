# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim score``: the verdict on a meter under test."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from roller_sim_ros.commands.output import write_json
from roller_sim_ros.commands.parser import command_parser
from roller_sim_ros.commands.progress import progress
from roller_sim_ros.errors import RollerSimError

DESCRIPTION = """\
Judge a compaction meter: the values that it published are held against the truth in the same trace, row by
row: bias, RMS, latency, a ceiling, gaps, wrong and missing double-jump alarms, and what it did under each fault
against what that fault declares. ROS 2 need not be installed.

BAG is an MCAP file or a rosbag2 folder with the roller's truth and the meter's topic, as roller-sim sim
--record --record-topic makes it, or roller-sim bench.
"""

EPILOG = """\
examples:
  roller-sim score trace.mcap --topic /my_meter/cmv
  roller-sim score trace.mcap --topic meter --limits limits.yaml --junit score.xml --json score.json

The exit code is 0 when no row failed, 1 when one did, 2 when there is nothing to judge: no such trace, topic or
field, or a wrong file of limits. The rows and their limits: docs/score.md.
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
        0 when the meter passed, 1 when it failed, 2 when it could not be judged.
    """
    arguments = _parser().parse_args(argv)
    try:
        return judge(arguments.bag, arguments)
    except RollerSimError as error:
        print(f"roller-sim score: error: {error}", file=sys.stderr)
        return 2


def judge(bag: Path, arguments: argparse.Namespace) -> int:
    """Judge a trace as the flags say, show and write what was found, and return the exit code.

    Parameters
    ----------
    bag : Path
        The trace.
    arguments : argparse.Namespace
        With what `add_score_arguments` adds.

    Raises
    ------
    RollerSimError
        If it cannot be judged, or an output not be written.
    """
    # What takes long to import comes after --help.
    from roller_sim_ros.score.limits import Limits, read_limits
    from roller_sim_ros.score.meter_topic import Choice
    from roller_sim_ros.score.report import as_object, as_table, write_junit
    from roller_sim_ros.score.score import Options, score

    limits = Limits() if arguments.limits is None else read_limits(arguments.limits)
    options = Options(
        topic=arguments.topic,
        choice=Choice(arguments.field, arguments.flag_field, arguments.alarm_field),
        matching=arguments.match,
        truth=arguments.truth,
    )
    found = score(bag, options, limits, progress("reading", always=False))
    if arguments.junit is not None:
        write_junit(found, arguments.junit)
    if arguments.json is not None:
        write_json(as_object(found), arguments.json)
    if arguments.json != "-":
        print(as_table(found))
    return 0 if found.passed else 1


def add_score_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what says how a trace is judged."""
    parser.add_argument(
        "--limits",
        metavar="FILE.yaml",
        type=Path,
        help="limits that differ from the defaults, one `name: value` a line (docs/score.md)",
    )
    parser.add_argument(
        "--junit", metavar="FILE.xml", type=Path, help="write the rows as JUnit XML, for CI"
    )
    parser.add_argument(
        "--json",
        metavar="FILE",
        help="write the verdict as one JSON object; -: to the standard output, instead of the table",
    )
    parser.add_argument(
        "--field",
        metavar="NAME",
        default="",
        help="number that is the value, dotted where it is nested (default: cmv, data or value, or the only "
        "floating-point number)",
    )
    parser.add_argument(
        "--flag-field",
        metavar="NAME",
        default="",
        help="number that is not 0, or true, when the value is not to be trusted (default: status; -: none)",
    )
    parser.add_argument(
        "--alarm-field",
        metavar="NAME",
        default="",
        help="whether the drum double-jumps: true or false, or an RMV (default: double_jump or rmv; -: none)",
    )
    parser.add_argument(
        "--match",
        choices=("auto", "stamp", "log"),
        default="auto",
        help="which revolution a value is of: that of its header's stamp, or the last before it came (default: "
        "by stamp where there is one)",
    )
    parser.add_argument(
        "--truth",
        metavar="NAME",
        default="",
        help="topic with the truth, as in /roller_1/truth; needed when the trace holds several",
    )


def _parser() -> argparse.ArgumentParser:
    parser = command_parser("score", DESCRIPTION, EPILOG)
    parser.add_argument("bag", metavar="BAG", type=Path, help="MCAP file or rosbag2 folder")
    parser.add_argument(
        "--topic", metavar="NAME", required=True, help="topic of the meter under test"
    )
    add_score_arguments(parser)
    return parser
