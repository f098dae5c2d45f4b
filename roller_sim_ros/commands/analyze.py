# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim analyze``: what a trace says."""

from __future__ import annotations

import argparse
from pathlib import Path

from roller_sim_ros.commands.numbers import not_negative, positive, whole
from roller_sim_ros.commands.output import write_json
from roller_sim_ros.commands.parser import command_parser
from roller_sim_ros.commands.progress import add_progress_flag, progress
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import PARAMETERS, SAMPLES_PER_REVOLUTION

DESCRIPTION = """\
Evaluate a trace: count gaps, duplicates and blocks out of order, compute CMV, RMV, period and mode
anew from the acceleration, once a revolution, and compare them with the values recorded beside it
and with the truth. ROS 2 need not be installed; the message types come from the bag.

BAG is an MCAP file or a rosbag2 folder. It has to hold roller_sim_ros/msg/DrumAcceleration, or
sensor_msgs/msg/Imu with a whole number of samples per revolution of a constant excitation (128 for
the simulated roller).
"""

EPILOG = """\
example:
  roller-sim analyze trace.mcap --plot trace.png --csv trace.csv

The exit code is 1 when the bag cannot be read, or not all of it: then what was read is shown all the
same. Differences between recorded and computed values are shown, not judged.
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
        0.

    Raises
    ------
    RollerSimError
        If the bag cannot be read to its end, or an output not be written.
    """
    arguments = _parser().parse_args(argv)
    # What takes long to import comes after --help.
    from roller_sim_ros.analysis.analyse import analyse
    from roller_sim_ros.analysis.report import as_object, as_table
    from roller_sim_ros.analysis.result import Options

    options = Options(
        topic=arguments.topic,
        meter=arguments.meter,
        window_revolutions=arguments.window_revolutions,
        noise_floor_m_s2=arguments.noise_floor,
        samples_per_revolution=arguments.samples_per_rev,
        excitation_hz=arguments.frequency_hz,
    )
    analysis = analyse(arguments.bag, options, progress("reading", always=arguments.progress))
    report = as_object(analysis)
    if arguments.json is not None:
        write_json(report, arguments.json)
    if arguments.json != "-":
        print(as_table(report))
    if arguments.csv is not None:
        from roller_sim_ros.analysis.table_file import write_csv

        write_csv(analysis.history, arguments.csv)
    if arguments.plot is not None:
        from roller_sim_ros.analysis.figure import write_figure

        write_figure(analysis, arguments.plot)
    if analysis.damage:
        raise RollerSimError(
            f"{analysis.damage}; {sum(analysis.messages.values())} messages over "
            f"{analysis.duration_s:.3f} s were read all the same"
        )
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = command_parser("analyze", DESCRIPTION, EPILOG)
    parser.add_argument("bag", metavar="BAG", type=Path, help="MCAP file or rosbag2 folder")
    parser.add_argument(
        "--topic",
        metavar="NAME",
        help="topic with the acceleration, as in /roller1/drum/acceleration; needed when the bag holds "
        "several",
    )
    parser.add_argument(
        "--meter",
        metavar="NAME",
        help="topic with the meter values to compare with: CompactionMeter, or std_msgs/Float64 taken for "
        "CMV (default: meter and cmv beside the acceleration)",
    )
    parser.add_argument(
        "--json",
        metavar="FILE",
        help="write the result as one JSON object; -: to the standard output",
    )
    parser.add_argument(
        "--csv", metavar="FILE", type=Path, help="write the meter values, one row a revolution"
    )
    parser.add_argument(
        "--plot",
        metavar="FILE",
        type=Path,
        help="draw acceleration, spectrum, force against displacement (where the bag holds the truth) and "
        "meter values over time; png, pdf or svg",
    )
    parser.add_argument(
        "--window-revolutions",
        metavar="N",
        type=_even,
        help="revolutions per meter value, an even number (default: that of the recorded meter or run, else "
        f"{PARAMETERS['meter.window_revolutions'][1]})",
    )
    parser.add_argument(
        "--noise-floor",
        metavar="A",
        type=not_negative,
        help="amplitude at the excitation frequency below which there is no value, m/s² (default: that "
        f"of the recorded run, else {PARAMETERS['meter.noise_floor_m_s2'][1]})",
    )
    parser.add_argument(
        "--samples-per-rev",
        metavar="N",
        type=whole(16),
        help="samples per revolution of a DrumAcceleration trace (default: that of the recorded run, else "
        f"{SAMPLES_PER_REVOLUTION})",
    )
    parser.add_argument(
        "--frequency-hz",
        metavar="HZ",
        type=positive,
        help="excitation frequency of an Imu stream, Hz (default: found from its spectrum)",
    )
    add_progress_flag(parser)
    return parser


def _even(text: str) -> int:
    number = int(text)
    if number < 2 or number % 2:
        raise argparse.ArgumentTypeError(f"{number} is not a positive even number")
    return number
