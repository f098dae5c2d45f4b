# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``roller-sim fmu``: the roller as a functional mock-up unit."""

from __future__ import annotations

import argparse
from pathlib import Path

from roller_sim_ros.commands.flags import add_parameter_flags, add_params_flag, given_values
from roller_sim_ros.commands.parser import command_parser
from roller_sim_ros.commands.soil_flags import add_soil_flags, with_presets
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.parameters.file import read_parameters

DESCRIPTION = """\
Write the roller as a functional mock-up unit (FMI 2.0, co-simulation) for Simulink, OpenModelica and other tools.
Inputs, which act from the next revolution of the eccentric on: exciter.frequency_hz, exciter.amplitude_m,
soil.shear_modulus_pa, soil.plastic_parameter_m. Outputs: acceleration_vertical, acceleration_horizontal, m/s²,
soil_force, N, and cmv.

The unit brings this package along; the tool's computer needs a Python 3.10 or later with numpy and scipy, and numba
for speed.
"""

EPILOG = """\
example:
  roller-sim fmu roller.fmu --shear-modulus-mpa 80 --plastic-mm 0.5 --half-space two-pole
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
        If a parameter is refused, or the file cannot be written.
    """
    arguments = _parser().parse_args(argv)
    from roller_sim_ros.fmu.build import build

    configuration = Configuration()
    if arguments.params is not None:
        configuration = configuration.changed(read_parameters(arguments.params))
    configuration = with_presets(configuration, arguments, given_values(arguments))
    build(configuration, arguments.file)
    print(f"wrote {arguments.file}")
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = command_parser("fmu", DESCRIPTION, EPILOG)
    parser.add_argument("file", metavar="FILE", type=Path, help="what to write, ending in .fmu")
    add_params_flag(parser)
    add_soil_flags(parser)
    add_parameter_flags(parser, exclude=("recording.path",))
    return parser
