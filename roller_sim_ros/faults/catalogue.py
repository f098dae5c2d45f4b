# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""All faults by id; a new one is one file and one line here."""

from __future__ import annotations

from collections.abc import Mapping
from difflib import get_close_matches

from roller_sim_ros.faults.bias_step import BiasStep
from roller_sim_ros.faults.clock_skew import ClockSkew
from roller_sim_ros.faults.delay import Delay
from roller_sim_ros.faults.disobedient_exciter import FrequencyDroop, SlowRunUp, StuckAmplitude
from roller_sim_ros.faults.dropout import Dropout
from roller_sim_ros.faults.duplicate import Duplicate
from roller_sim_ros.faults.fault import Fault, FaultRefused
from roller_sim_ros.faults.frozen_command_link import FrozenCommandLink
from roller_sim_ros.faults.gain_change import GainChange
from roller_sim_ros.faults.lost_pulse import LostPulse
from roller_sim_ros.faults.noise_burst import NoiseBurst
from roller_sim_ros.faults.reordered import Reordered
from roller_sim_ros.faults.saturation import Saturation
from roller_sim_ros.faults.spike import Spike
from roller_sim_ros.faults.stale_position import StalePosition
from roller_sim_ros.faults.stuck import Stuck
from roller_sim_ros.parameters import Value
from roller_sim_ros.sensors.registry import parameters_of

FAULTS: dict[str, type[Fault]] = {
    item.group: item
    for item in (
        Stuck,
        Dropout,
        Spike,
        BiasStep,
        GainChange,
        Saturation,
        NoiseBurst,
        Delay,
        Duplicate,
        Reordered,
        ClockSkew,
        LostPulse,
        StalePosition,
        FrozenCommandLink,
        StuckAmplitude,
        SlowRunUp,
        FrequencyDroop,
    )
}
"""All faults by their id."""


def make_fault(fault_id: str, values: Mapping[str, Value] | None = None) -> Fault:
    """Return a fault with some of its parameters changed.

    Raises
    ------
    FaultRefused
        If there is no fault of this id; the message offers the nearest.
    ParameterError
        If a parameter is unknown or its value refused.
    """
    if fault_id not in FAULTS:
        near = get_close_matches(fault_id, FAULTS, n=1, cutoff=0.5)
        offer = f"did you mean {near[0]}?" if near else f"there are {', '.join(FAULTS)}"
        raise FaultRefused(f"there is no fault {fault_id!r}; {offer}")
    return parameters_of(FAULTS[fault_id], values or {})


def conflict(one: Fault, other: Fault) -> str | None:
    """Return why two faults cannot be at the same time, None where they can."""
    if one.group == other.group:
        return f"{one.group} cannot be active twice"
    for first, second in ((one, other), (other, one)):
        if second.group in first.excludes:
            return (
                f"{one.group} and {other.group} exclude each other: {first.excludes[second.group]}"
            )
    return None
