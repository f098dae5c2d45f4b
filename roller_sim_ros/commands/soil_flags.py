# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Flags that give ground and roller by name, or the ground in the terms of soil mechanics."""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import replace

from roller_sim_ros.commands.flags import add_flag, given_value
from roller_sim_ros.parameters import Configuration, Machine, ParameterError, Soil, Value
from roller_sim_ros.parameters.quantity import declared
from roller_sim_ros.soil_mechanics import (
    MACHINES,
    SOILS,
    GranularSoil,
    machine_preset,
    soil_preset,
)

BASE = "medium-gravel"
"""Ground of which the flags of soil mechanics change something when no other is named."""


def add_soil_flags(parser: argparse.ArgumentParser) -> None:
    """Add ``--machine`` and ``--soil``, and the flags of a granular soil."""
    presets = parser.add_argument_group("presets")
    presets.add_argument(
        "--machine",
        metavar="NAME",
        help=f"roller with its exciter's setting: {_listed(MACHINES)}",
    )
    presets.add_argument(
        "--soil",
        metavar="NAME",
        help=f"ground, its plastic parameter for the roller at hand: {_listed(SOILS)}",
    )
    mechanics = parser.add_argument_group(
        "soil mechanics",
        f"give the ground by its state instead of G and p; what is left out is that of --soil, else of {BASE}",
    )
    for name, quantity, default in declared(GranularSoil):
        if quantity.flag:
            add_flag(mechanics, f"{GranularSoil.group}.{name}", quantity, default)


def soil_from(arguments: argparse.Namespace, machine: Machine) -> Soil | None:
    """Return the model's soil that the flags give under a machine, None when they give none.

    Raises
    ------
    ParameterError
        If there is no such preset, it is not given by a state that flags could change, a value is out of
        bounds, or the soil that comes out is.
    """
    state: dict[str, Value] = {}
    flags: list[str] = []
    for name, quantity, default in declared(GranularSoil):
        value = given_value(arguments, f"{GranularSoil.group}.{name}", quantity, default)
        if value is not None:
            state[name] = value
            flags.append(quantity.flag)
    if arguments.soil is None and not state:
        return None
    ground = soil_preset(arguments.soil or BASE).ground
    if state:
        if not isinstance(ground, GranularSoil):
            raise ParameterError(
                "--soil",
                arguments.soil,
                f"this ground is given by G and p alone, so that {', '.join(flags)} cannot change it",
            )
        ground = replace(ground, **state)  # type: ignore[arg-type]
    return ground.soil(machine)


def machine_values(arguments: argparse.Namespace) -> dict[str, Value]:
    """Return {dotted name: SI value} of the roller that ``--machine`` names, empty without one.

    Raises
    ------
    ParameterError
        If there is no such preset.
    """
    return {} if arguments.machine is None else machine_preset(arguments.machine).values()


def with_presets(
    configuration: Configuration, arguments: argparse.Namespace, given: Mapping[str, Value]
) -> Configuration:
    """Return a configuration with the presets and, over them, the parameters' own flags.

    Parameters
    ----------
    configuration : Configuration
        Defaults and what a file says.
    arguments : argparse.Namespace
        Of a parser with `add_soil_flags`.
    given : mapping
        {dotted name: SI value} of the parameters' flags. They also count before the ground is made: its plastic
        parameter is that under the roller that runs.

    Raises
    ------
    ParameterError
        As `soil_from` and `machine_values` do.
    """
    configuration = configuration.changed({**machine_values(arguments), **given})
    soil = soil_from(arguments, configuration.machine)
    if soil is None:
        return configuration
    return replace(configuration, soil=soil).changed(given)


def _listed(presets: Mapping[str, object]) -> str:
    return ", ".join(presets)
