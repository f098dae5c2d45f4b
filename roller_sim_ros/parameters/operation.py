# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How a run is sampled, paced, metered and recorded."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from roller_sim_ros.parameters.quantity import ParameterError, ParameterGroup, parameter

SAMPLES_PER_REVOLUTION = 128

SLOWEST = 0.1
"""Least speed of simulated time: a slower one is a pause to those who wait."""


@dataclass(frozen=True)
class Sampling(ParameterGroup):
    """Samples per revolution and what happens at low speed."""

    group: ClassVar[str] = "sampling"

    samples_per_revolution: int = parameter(
        SAMPLES_PER_REVOLUTION,
        "",
        "samples per revolution of the eccentric; other than 128 is for convergence studies only",
        minimum=32,
        maximum=4096,
        flag="--samples-per-rev",
    )
    floor_hz: float = parameter(
        10.0,
        "Hz",
        "below this frequency the sample period stays and the phase advances more slowly",
        minimum=1.0,
        maximum=80.0,
    )


@dataclass(frozen=True)
class Meter(ParameterGroup):
    """The compaction meter."""

    group: ClassVar[str] = "meter"

    window_revolutions: int = parameter(
        16, "", "revolutions per meter value, an even number", minimum=2, maximum=256
    )
    noise_floor_m_s2: float = parameter(
        0.05,
        "m/s²",
        "amplitude at the excitation frequency below which there is no meter value",
        minimum=0.0,
        maximum=100.0,
    )
    period_tolerance: float = parameter(
        0.01,
        "",
        "share of the peak acceleration within which the motion has to repeat; on ground that changes under a "
        "travelling roller, 0.05",
        minimum=0.0001,
        maximum=0.5,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.window_revolutions % 2:
            raise ParameterError(
                "meter.window_revolutions", self.window_revolutions, "must be an even number"
            )


@dataclass(frozen=True)
class Travel(ParameterGroup):
    """Travel commands."""

    group: ClassVar[str] = "travel"

    command_timeout_s: float = parameter(
        0.0,
        "s",
        "the roller stops when no travel command came for so long after the last; 0 switches the watchdog off",
        minimum=0.0,
        maximum=3600.0,
        live=True,
    )


@dataclass(frozen=True)
class Pacing(ParameterGroup):
    """How the node's time passes."""

    group: ClassVar[str] = "pacing"

    clock: str = parameter(
        "real",
        "",
        "real: stamps and pace are the machine's; sim: time is the samples' own, from 0 on, and published on /clock",
        choices=("real", "sim"),
    )
    speed: float = parameter(
        1.0,
        "",
        "simulated time only: simulated over real time; 0: as fast as possible",
        minimum=0.0,
        maximum=1000.0,
    )
    lock_step: bool = parameter(
        False, "", "whether time stands still until a client steps it; in simulated time, implied"
    )
    publish_clock: bool = parameter(
        True, "", "simulated time only: whether the node publishes /clock; another may be its owner"
    )
    samples_per_message: int = parameter(
        16, "", "samples per block, a divisor of 128", minimum=1, maximum=SAMPLES_PER_REVOLUTION
    )
    imu_decimation: int = parameter(
        1, "", "every how many samples one drum/imu message is sent", minimum=1, maximum=128
    )
    realtime_priority: int = parameter(
        0,
        "",
        "SCHED_FIFO priority tried for the pacing thread; 0: not tried",
        minimum=0,
        maximum=98,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        if SAMPLES_PER_REVOLUTION % self.samples_per_message:
            raise ParameterError(
                "pacing.samples_per_message",
                self.samples_per_message,
                f"must be a divisor of {SAMPLES_PER_REVOLUTION}",
            )
        if 0.0 < self.speed < SLOWEST:
            raise ParameterError(
                "pacing.speed",
                self.speed,
                f"must be 0 (as fast as possible) or at least {SLOWEST:g}",
            )
        if self.speed != 1.0 and not self.simulated_time:
            raise ParameterError(
                "pacing.speed", self.speed, "needs simulated time: pacing.clock sim (--clock sim)"
            )

    @property
    def simulated_time(self) -> bool:
        """Whether time is that of the samples, whatever the machine's clock says."""
        return self.clock == "sim" or self.lock_step


@dataclass(frozen=True)
class ScenarioFile(ParameterGroup):
    """The scenario that the node runs."""

    group: ClassVar[str] = "scenario"

    path: str = parameter(
        "",
        "",
        "scenario file, or the name of one that the package brings; empty: the roller stands where it is",
    )


@dataclass(frozen=True)
class Recording(ParameterGroup):
    """The trace on disk."""

    group: ClassVar[str] = "recording"

    path: str = parameter(
        "", "", "MCAP file to record to; empty: no recording", of_node=True, flag="--record"
    )
    topics: str = parameter(
        "",
        "",
        "further topics to record, separated by commas (a meter under test; drum/imu)",
        of_node=True,
    )
    flush_period_s: float = parameter(
        0.5,
        "s",
        "an open chunk is written to disk at least this often",
        minimum=0.05,
        maximum=1.0,
        of_node=True,
    )
