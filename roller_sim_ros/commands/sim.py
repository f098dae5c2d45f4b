"""``roller-sim sim``: the roller in real time as a ROS 2 node."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from roller_sim_ros.commands.flags import add_parameter_flags, given_values

DESCRIPTION = """\
Run the roller in real time as the ROS 2 node roller_sim: it vibrates, publishes acceleration, meter
values and the truth, and obeys exciter/command. One status line a second until Ctrl-C.
"""

EPILOG = """\
Values given here hold over those of parameter files. Arguments for ROS 2 itself follow --ros-args, as
everywhere; other parameters are set there by their dotted names.

example:
  roller-sim sim --frequency-hz 30 --shear-modulus-mpa 80 --record trace.mcap --namespace roller_1
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
        0 after Ctrl-C or SIGTERM; 1 when the node could not start.

    Raises
    ------
    RollerSimError
        If an argument, a parameter or a file is refused.
    """
    own, ros = _split(sys.argv[1:] if argv is None else argv)
    arguments = _parser().parse_args(own)
    overrides = given_values(arguments)
    if arguments.record_topic:
        overrides["recording.topics"] = ",".join(arguments.record_topic)
    # What takes long to import, or needs ROS 2, comes after --help and wrong arguments.
    from roller_sim_ros.node.parameter_file import check_parameter_file
    from roller_sim_ros.node.process import run_node
    from roller_sim_ros.node.status_line import status_line, summary

    if arguments.params is not None:
        check_parameter_file(arguments.params)
        ros = ["--ros-args", "--params-file", str(arguments.params), "--", *ros]
    return run_node(
        ros,
        namespace=arguments.namespace,
        overrides=overrides,
        on_report=lambda report: print(status_line(report), flush=True),
        on_end=lambda roller: print(summary(roller), flush=True),
    )


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


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="roller-sim sim",
        description=DESCRIPTION,
        epilog=EPILOG,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--namespace", default="", metavar="NAME", help="namespace of the node and its topics"
    )
    parser.add_argument(
        "--params",
        type=Path,
        metavar="FILE.yaml",
        help="parameters in the form that ROS 2 reads; some are installed under share/roller_sim_ros/config",
    )
    # The messages are for 128 samples per revolution.
    add_parameter_flags(parser, exclude=("sampling.samples_per_revolution",))
    parser.add_argument(
        "--record-topic",
        action="append",
        metavar="NAME",
        help="a further topic to record, as that of a meter under test; may be repeated",
    )
    return parser
