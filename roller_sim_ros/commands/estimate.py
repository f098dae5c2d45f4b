# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim estimate``: the ground that a trace was made on."""

from __future__ import annotations

import argparse
from pathlib import Path

from roller_sim_ros.commands.flags import add_parameter_flags, add_params_flag, given_values
from roller_sim_ros.commands.numbers import not_negative, whole
from roller_sim_ros.commands.output import write_json
from roller_sim_ros.commands.parser import terse_parser
from roller_sim_ros.commands.progress import add_progress_flag, progress
from roller_sim_ros.commands.soil_flags import machine_values
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import PARAMETERS, Value
from roller_sim_ros.parameters.file import read_parameters
from roller_sim_ros.soil_mechanics import MACHINES

DESCRIPTION = """\
Estimate the ground under the roller, shear modulus G and plastic parameter p, from the vertical acceleration of the
drum and the phase of the eccentric alone, in windows that slide over a trace. The machine must be known: from the
trace, else from --machine or --params. So must k, density and Poisson's ratio, and the half space is a choice: as the
trace states them unless flags say otherwise.

BAG is an MCAP file or a rosbag2 folder with roller_sim_ros/msg/DrumAcceleration, or with sensor_msgs/msg/Imu and
roller_sim_ros/msg/TachoPulse.
"""

EPILOG = """\
examples:
  roller-sim estimate trace.mcap
  roller-sim estimate trace.mcap --json - --half-space two-pole
  roller-sim estimate bag/ --machine paper-10t --amplitude-mm 1.6 --tacho

The spread is one standard deviation. The status says whether the values stand, and why there are none. Exit code 1: the
trace cannot be read, or not all of it; then what was read is shown all the same.
"""

_WINDOW = 16


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
        If the trace cannot be read to its end or tells too little, a parameter is refused, or an output cannot be
        written.
    """
    parser = _parser()
    arguments = parser.parse_args(argv)
    step, window = arguments.step_revolutions, arguments.window_revolutions
    if step is not None and step > window:
        parser.error(f"argument --step-revolutions: {step} is more than the window's {window}")
    given: dict[str, Value] = {}
    if arguments.params is not None:
        given.update(read_parameters(arguments.params))
    flags = given_values(arguments)
    given.update(machine_values(arguments))
    given.update(flags)
    # What takes long to import comes after --help.
    from roller_sim_ros.estimate.known import KNOWN
    from roller_sim_ros.estimate.report import as_list, as_table
    from roller_sim_ros.estimate.trace import TraceOptions, estimate_trace

    options = TraceOptions(
        topic=arguments.topic,
        window_revolutions=window,
        step_revolutions=step,
        tacho=arguments.tacho,
        sensor_bandwidth_hz=arguments.sensor_bandwidth_hz,
        given={name: value for name, value in given.items() if name in KNOWN},
        amplitude_m=_number(flags.get("exciter.amplitude_m")),
        machine_given=arguments.machine is not None or arguments.params is not None,
    )
    found = estimate_trace(
        arguments.bag, options, progress("estimating", always=arguments.progress)
    )
    if arguments.json is not None:
        write_json(as_list(found), arguments.json)
    if arguments.json != "-":
        print(as_table(found))
    if arguments.plot is not None:
        from roller_sim_ros.estimate.figure import write_figure

        write_figure(found, arguments.plot)
    if found.damage:
        raise RollerSimError(
            f"{found.damage}; {len(found.windows)} windows were estimated all the same"
        )
    return 0


def _number(value: Value | None) -> float | None:
    return None if value is None else float(value)


def _parser() -> argparse.ArgumentParser:
    parser = terse_parser("estimate", DESCRIPTION, EPILOG, "roller-sim estimate BAG [OPTION ...]")
    parser.add_argument("bag", metavar="BAG", type=Path, help="MCAP file or rosbag2 folder")
    parser.add_argument(
        "--topic",
        metavar="NAME",
        help="topic with the acceleration, as in /roller1/drum/acceleration; needed when the bag holds several",
    )
    parser.add_argument(
        "--json",
        metavar="FILE",
        help="write a list of the windows as JSON; -: to the standard output",
    )
    parser.add_argument(
        "--plot",
        metavar="FILE",
        type=Path,
        help="draw the modelled on the measured acceleration, and the ground over time; png, pdf or svg",
    )
    parser.add_argument(
        "--window-revolutions",
        metavar="N",
        type=whole(4),
        default=_WINDOW,
        help="revolutions in a window, at least 4 (default: %(default)s)",
    )
    parser.add_argument(
        "--step-revolutions",
        metavar="N",
        type=whole(1),
        help="revolutions from one window to the next, at most a window's (default: half a window)",
    )
    parser.add_argument(
        "--tacho",
        action="store_true",
        help="take the phase from the pulses on tacho, not from what DrumAcceleration tells",
    )
    parser.add_argument(
        "--sensor-bandwidth-hz",
        metavar="HZ",
        type=not_negative,
        default=0.0,
        help="frequency of −3 dB of the sensor's second-order Butterworth low-pass; 0: none (default: 0)",
    )
    add_progress_flag(parser)
    parser.add_argument(
        "--machine", metavar="NAME", help=f"roller that made the trace: {', '.join(MACHINES)}"
    )
    add_params_flag(parser)
    add_parameter_flags(parser, exclude=_not_known())
    return parser


def _not_known() -> list[str]:
    """Return the parameters that an estimate has no use for."""
    from roller_sim_ros.estimate.known import KNOWN

    return [name for name in PARAMETERS if name not in KNOWN]
