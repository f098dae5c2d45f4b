# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a run begins with: all parameters, and the scenario if there is one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.parameters import Configuration, ParameterError, Value
from roller_sim_ros.scenario import (
    Scenario,
    configuration_of,
    has_own_section,
    read_scenario,
    start_of,
)
from roller_sim_ros.scenario.metadata import scenario_metadata
from roller_sim_ros.scenario.shipped import scenario_path
from roller_sim_ros.traces.metadata import run_metadata

_OF_THE_RUN = ("recording.", "scenario.")
"""How parameters begin that are given beside a scenario, though no scenario says them."""


@dataclass(frozen=True)
class Beginning:
    """Makes the runs of a node, each from its start.

    Attributes
    ----------
    configuration : Configuration
        All parameters as the run begins.
    scenario : Scenario or None
        What is driven over, and with what; none: a roller on the spot, on ground that is everywhere the same.
    """

    configuration: Configuration
    scenario: Scenario | None = None

    def with_parameters(self, configuration: Configuration) -> Beginning:
        """Return the beginning with other parameters, but for those that the scenario says."""
        if self.scenario is None:
            return Beginning(configuration)
        said = {name: value for name, value in self.configuration.flat().items() if _is_said(name)}
        return Beginning(configuration.changed(said), self.scenario)

    def with_recording(self, values: Mapping[str, Value]) -> Beginning:
        """Return the beginning with other parameters of the recording."""
        return Beginning(self.configuration.changed(values), self.scenario)

    def emulator(self, start_ns: int) -> Emulator:
        """Return the roller at the start, its first sample stamped with `start_ns`.

        Without a scenario its exciter begins from standstill.
        """
        if self.scenario is None:
            return Emulator(self.configuration, start_ns=start_ns, run_up=True)
        start = start_of(self.scenario)._replace(configuration=self.configuration)
        return Emulator(start_ns=start_ns, **start._asdict())

    def metadata(self, start_ns: int) -> dict[str, dict[str, str]]:
        """Return what a trace says of the run."""
        if self.scenario is None:
            return run_metadata(self.configuration, start_ns)
        return {
            **run_metadata(self.configuration, start_ns, self.scenario.seed),
            **scenario_metadata(self.scenario),
        }


def beginning(given: Mapping[str, Value]) -> Beginning:
    """Return what parameters make, and the scenario that they may name.

    Parameters
    ----------
    given : mapping
        {dotted name: SI value} of what was given, not of what is left at its default.

    Raises
    ------
    RollerSimError
        If the scenario cannot be read, or a value is refused, also because the scenario says it.
    """
    path = Configuration().changed(given).scenario.path
    if not path:
        return Beginning(Configuration().changed(given))
    scenario = read_scenario(scenario_path(path))
    defaults = Configuration().flat()
    for name, value in given.items():
        # A file with all parameters at their defaults does not contradict.
        if _is_said(name) and value != defaults[name]:
            raise ParameterError(name, value, "is said by the scenario")
    values = {name: value for name, value in given.items() if not _is_said(name)}
    return Beginning(configuration_of(scenario).changed(values), scenario)


def _is_said(name: str) -> bool:
    return has_own_section(name) and not name.startswith(_OF_THE_RUN)
