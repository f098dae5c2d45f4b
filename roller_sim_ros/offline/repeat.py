# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Runs made again from what a trace says came into them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.emulation.inputs import Input, InputError, InputKind
from roller_sim_ros.emulation.snapshot import restore
from roller_sim_ros.faults import Span
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.parameters.quantity import shown
from roller_sim_ros.scenario import parse_scenario, start_of
from roller_sim_ros.sensors import Choice
from roller_sim_ros.session import Refusal

LATEST_NS = 2**31 * 1_000_000_000
"""Stamps of ROS 2 end there."""
_ODD = (KeyError, TypeError, ValueError, AttributeError, OverflowError)
"""What arguments that are none lead to."""


def begun(item: Input) -> Emulator:
    """Return the emulator that an input of the kind BEGIN or RESTORE begins.

    Raises
    ------
    RollerSimError
        If it was made of parts that the input does not tell, or this version cannot make them.
    """
    if item.kind is InputKind.RESTORE:
        return restore(item.state, told=True)
    try:
        return _begun(item.arguments)
    except _ODD as error:
        raise _not_understood(item, error) from None


def apply(item: Input, emulator: Emulator) -> None:
    """Let an input come in as it did.

    Raises
    ------
    RollerSimError
        If it is refused now.
    """
    try:
        _APPLY[item.kind](emulator, item.arguments)
    except _ODD as error:
        raise _not_understood(item, error) from None


def _begun(arguments: Mapping[str, Any]) -> Emulator:
    untold = arguments["parts"]
    if untold:
        raise InputError(
            f"the run was made with {' and '.join(untold)} of no scenario file: only the program that made it can "
            "run it again"
        )
    start_ns = arguments["start_ns"]
    if not isinstance(start_ns, int) or not 0 <= start_ns < LATEST_NS:
        raise ValueError(f"start_ns is {shown(start_ns)}")
    configuration = Configuration().changed(arguments["parameters"])
    sensors = tuple(Choice(name, parameters) for name, parameters in arguments["sensors"])
    start: dict[str, Any] = {}
    if arguments["scenario"]:
        scenario = parse_scenario(arguments["scenario"], Path("the trace's scenario"))
        start = start_of(scenario)._asdict()
    start |= {"run_up": arguments["run_up"], "sensors": sensors, "seed": arguments["seed"]}
    return Emulator(**{**start, "configuration": configuration}, start_ns=start_ns)


def _command(emulator: Emulator, arguments: Mapping[str, Any]) -> None:
    emulator.command(**arguments)


def _inject(emulator: Emulator, arguments: Mapping[str, Any]) -> None:
    emulator.inject(arguments["fault_id"], arguments["parameters"], span=Span(**arguments["span"]))


def _refuse(emulator: Emulator, arguments: Mapping[str, Any]) -> None:
    emulator.refuse(Refusal(arguments["code"]), arguments["reason"])


_APPLY: dict[InputKind, Callable[[Emulator, Mapping[str, Any]], None]] = {
    InputKind.COMMAND: _command,
    InputKind.TRAVEL: lambda emulator, it: emulator.command_travel(it["speed_m_s"]),
    InputKind.RELEASE: lambda emulator, _: emulator.release(),
    InputKind.CHANGE: lambda emulator, it: emulator.change(it["values"]),
    InputKind.INJECT: _inject,
    InputKind.CLEAR: lambda emulator, it: emulator.clear(it["handle"]),
    InputKind.REFUSE: _refuse,
}


def _not_understood(item: Input, error: Exception) -> InputError:
    return InputError(
        f"the input {item.kind.value} at sample {item.sample} is not understood by this version: "
        f"{type(error).__name__}, {shown(str(error))}"
    )
