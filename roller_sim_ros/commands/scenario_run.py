# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The part of ``roller-sim run`` that runs a scenario."""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import TYPE_CHECKING

from roller_sim_ros.commands.flags import given_value, given_values
from roller_sim_ros.commands.progress import progress
from roller_sim_ros.parameters import PARAMETERS, ParameterError
from roller_sim_ros.parameters.quantity import declared
from roller_sim_ros.soil_mechanics import GranularSoil

if TYPE_CHECKING:
    from roller_sim_ros.offline.scenario_run import ScenarioRun
    from roller_sim_ros.scenario import Scenario, Start

OF_THE_RUN = ("recording.path",)
"""Parameters that a flag gives beside a scenario, though no scenario says them."""


def add_scenario_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the scenario and what is drawn of it."""
    parser.add_argument(
        "scenario",
        metavar="SCENARIO",
        nargs="?",
        help="scenario file, or the name of one that the package brings, as in soft_to_stiff; without one the roller "
        "vibrates on the spot",
    )
    parser.add_argument(
        "--map",
        metavar="FILE",
        type=Path,
        help="of a scenario: true G, p, CMV and mode by chainage and pass, drawn (png, pdf, svg) or as a table (csv)",
    )


def run(arguments: argparse.Namespace) -> tuple[dict[str, object], str]:
    """Run a scenario, draw its map if asked for, and return what there is to say as an object and as a table.

    Parameters
    ----------
    arguments : argparse.Namespace
        Of ``roller-sim run``, with a scenario.

    Raises
    ------
    RollerSimError
        If the scenario or a flag is refused, or a file cannot be read or written.
    """
    # What takes long to import comes after --help.
    from roller_sim_ros.scenario import read_scenario, start_of
    from roller_sim_ros.scenario.shipped import scenario_path

    scenario = read_scenario(scenario_path(arguments.scenario))
    start = _with_flags(start_of(scenario), arguments)
    # What takes longer comes after wrong arguments.
    from roller_sim_ros.offline.scenario_report import as_object, as_table, write_csv

    result = _run(scenario, start, arguments)
    report = as_object(scenario, start.configuration, result)
    if arguments.map is not None and arguments.map.suffix == ".csv":
        write_csv(result.site_map, arguments.map)
    elif arguments.map is not None:
        from roller_sim_ros.offline.site_figure import write_figure

        write_figure(scenario, result.site_map, arguments.map)
    return report, as_table(report)


def _with_flags(start: Start, arguments: argparse.Namespace) -> Start:
    """Return the start with what flags change; none may say again what the scenario says.

    Raises
    ------
    ParameterError
        If one does.
    """
    from roller_sim_ros.scenario import has_own_section

    for flag, value in (
        ("--params", arguments.params),
        ("--machine", arguments.machine),
        ("--soil", arguments.soil),
        ("--plot", arguments.plot),
    ):
        if value is not None:
            raise ParameterError(flag, str(value), "does not go with a scenario")
    for name, quantity, default in declared(GranularSoil):
        value = given_value(arguments, f"{GranularSoil.group}.{name}", quantity, default)
        if value is not None:
            raise ParameterError(quantity.flag, value, "is said by the scenario")
    given = given_values(arguments)
    for name, value in given.items():
        if has_own_section(name) and name not in OF_THE_RUN:
            raise ParameterError(PARAMETERS[name][0].flag, value, "is said by the scenario")
    return start._replace(
        configuration=start.configuration.changed(given),
        run_up=start.run_up or arguments.run_up,
    )


def _run(scenario: Scenario, start: Start, arguments: argparse.Namespace) -> ScenarioRun:
    from roller_sim_ros.offline.scenario_run import run_scenario, step_with_faults

    show = progress("running", always=arguments.progress)
    path = start.configuration.recording.path
    if not path:
        session = start.session()
        step = step_with_faults(session, start)
        return run_scenario(scenario, session, step, show, arguments.revolutions)
    from roller_sim_ros.emulation import Emulator
    from roller_sim_ros.offline.recording import record
    from roller_sim_ros.scenario.metadata import scenario_metadata
    from roller_sim_ros.traces.metadata import run_metadata

    emulator = Emulator(start_ns=time.time_ns(), **start._asdict())
    metadata = {
        **run_metadata(start.configuration, emulator.start_ns, scenario.seed),
        **scenario_metadata(scenario),
    }
    with record(emulator, Path(path), metadata) as step:
        return run_scenario(scenario, emulator.session, step, show, arguments.revolutions)
