# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim run``: the roller without ROS."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import TYPE_CHECKING

from roller_sim_ros.commands import scenario_run
from roller_sim_ros.commands.flags import add_parameter_flags, add_params_flag, given_values
from roller_sim_ros.commands.numbers import whole
from roller_sim_ros.commands.output import write_json
from roller_sim_ros.commands.parser import command_parser
from roller_sim_ros.commands.progress import add_progress_flag, progress
from roller_sim_ros.commands.soil_flags import add_soil_flags, with_presets
from roller_sim_ros.parameters import Configuration, ParameterError
from roller_sim_ros.parameters.file import read_parameters

if TYPE_CHECKING:
    from roller_sim_ros.offline.run import Tail

REVOLUTIONS = 1000
"""How many without a scenario, when nothing is said."""

DESCRIPTION = """\
Run the roller without ROS, as fast as it goes, from static equilibrium with the exciter at once at its full
frequency and amplitude, and show the settled values over the last 64 revolutions: period, CMV, RMV, greatest
soil force over the static one, extreme accelerations in g, share of the time in the air.

With a SCENARIO the roller drives over its lane, from start to end, and what is shown are the passes: ground, CMV,
RMV and modes. Flags change what the scenario does not say.
"""

EPILOG = """\
examples:
  roller-sim run soft_to_stiff --map map.png --record trace.mcap
  roller-sim run --shear-modulus-mpa 80 --plastic-mm 0.5 --plot run.png
  roller-sim run --params config/loose.yaml --run-up --record trace.mcap
  roller-sim run --amplitude-mm 0.8 --json - | python3 -m json.tool
  roller-sim run --machine cs-563e --soil dense-gravel
  roller-sim run --void-ratio 0.4 --friction-angle-deg 47 --unit-weight-kn-m3 20

A trace holds the topics that the node publishes, with the same bytes. The exit code is 0 when the run came to
its end, whatever the roller did.
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
        If a parameter is refused, or a file cannot be read or written.
    """
    arguments = _parser().parse_args(argv)
    if arguments.scenario is not None:
        report, table = scenario_run.run(arguments)
    elif arguments.map is not None:
        raise ParameterError("--map", str(arguments.map), "needs a scenario")
    else:
        report, table = _run_on_the_spot(arguments)
    if arguments.json is not None:
        write_json(report, arguments.json)
    if arguments.json != "-":
        print(table)
    return 0


def _run_on_the_spot(arguments: argparse.Namespace) -> tuple[dict[str, object], str]:
    """Run without a scenario, draw what is asked for, and return what there is to say as object and table."""
    configuration = _configuration(arguments)
    if arguments.revolutions is None:
        arguments.revolutions = REVOLUTIONS
    # What takes long to import comes after --help.
    from roller_sim_ros.offline.report import as_object, as_table

    tail = _run(configuration, arguments)
    report = as_object(configuration, tail, arguments.revolutions)
    if arguments.plot is not None:
        from roller_sim_ros.offline.figure import write_figure

        write_figure(configuration, tail, arguments.revolutions, arguments.plot)
    return report, as_table(report)


def _configuration(arguments: argparse.Namespace) -> Configuration:
    """Return the defaults, changed by the file, the presets and the flags, in this order."""
    configuration = Configuration()
    if arguments.params is not None:
        configuration = configuration.changed(read_parameters(arguments.params))
    return with_presets(configuration, arguments, given_values(arguments))


def _run(configuration: Configuration, arguments: argparse.Namespace) -> Tail:
    from roller_sim_ros.offline.run import run, step_whole_revolutions

    run_up = arguments.run_up
    samples = configuration.sampling.samples_per_revolution
    show = progress("running", always=arguments.progress)
    if not configuration.recording.path:
        step = step_whole_revolutions(configuration, run_up=run_up)
        return run(step, arguments.revolutions, samples, show)
    from roller_sim_ros.offline.recording import record_steps

    path = Path(configuration.recording.path)
    with record_steps(configuration, path, start_ns=time.time_ns(), run_up=run_up) as step:
        return run(step, arguments.revolutions, samples, show)


def _parser() -> argparse.ArgumentParser:
    parser = command_parser("run", DESCRIPTION, EPILOG)
    parser.add_argument(
        "--revolutions",
        metavar="N",
        type=whole(2),
        help="revolutions to run, at least 2; below the sampling floor: as many samples (default: "
        f"{REVOLUTIONS}; of a scenario: all, more cut it short)",
    )
    parser.add_argument(
        "--run-up",
        action="store_true",
        help="start the exciter from standstill, at its limited rates of frequency and amplitude",
    )
    parser.add_argument(
        "--json",
        metavar="FILE",
        help="write the values and all parameters as one JSON object; -: to the standard output",
    )
    parser.add_argument(
        "--plot",
        metavar="FILE",
        type=Path,
        help="draw the last revolutions: acceleration, force against displacement, spectrum in orders; "
        "png, pdf or svg",
    )
    add_progress_flag(parser)
    add_params_flag(parser)
    scenario_run.add_scenario_arguments(parser)
    add_soil_flags(parser)
    add_parameter_flags(parser)
    return parser
