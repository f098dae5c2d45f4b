# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A roller that is advanced to points in time, as a co-simulation master asks for them."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.meters import CompactionMeter
from roller_sim_ros.meters.drum import Drum
from roller_sim_ros.parameters import Configuration, Value
from roller_sim_ros.session import Block, Session

INPUTS = (
    "exciter.frequency_hz",
    "exciter.amplitude_m",
    "soil.shear_modulus_pa",
    "soil.plastic_parameter_m",
)
"""What may change while it runs, by dotted name."""

CMV_UNKNOWN = 0.0
"""Tools for co-simulation take NaN for a failure; a CMV of 0 does not occur while the drum vibrates."""


@dataclass
class Outputs:
    """What is seen at a point in time: of the last sample that is not after it.

    Attributes
    ----------
    acceleration_vertical, acceleration_horizontal : float
        Coordinate acceleration of the drum axle, m/s², up and forward.
    soil_force : float
        F_s on the drum, N.
    cmv : float
        Of the last revolution that is complete; `CMV_UNKNOWN` when there is none.
    """

    acceleration_vertical: float = 0.0
    acceleration_horizontal: float = 0.0
    soil_force: float = 0.0
    cmv: float = CMV_UNKNOWN


class SteppedRoller:
    """A session, computed a revolution ahead; inputs take effect where the next revolution begins.

    Parameters
    ----------
    configuration : Configuration
        What is simulated, from static equilibrium, the exciter at once at full frequency and amplitude.

    Attributes
    ----------
    inputs : dict
        {dotted name: SI value} of `INPUTS`; to be set at will.
    outputs : Outputs
        At the time that was last asked for.
    """

    def __init__(self, configuration: Configuration) -> None:
        flat = configuration.flat()
        self.inputs: dict[str, Value] = {name: flat[name] for name in INPUTS}
        self.outputs = Outputs()
        self._session = Session(configuration)
        meter = configuration.meter
        self._meter = CompactionMeter(
            meter.window_revolutions,
            meter.noise_floor_m_s2,
            configuration.sampling.samples_per_revolution,
            drum=Drum.of(configuration.machine, configuration.exciter),
            period_tolerance=meter.period_tolerance,
        )
        self._applied = dict(self.inputs)
        self._block: Block | None = None
        self._next_cmv = CMV_UNKNOWN

    def advance_to(self, time_s: float) -> None:
        """Let `outputs` be those of a time, not before the last one.

        Raises
        ------
        ParameterError
            If an input cannot be; the time stays.
        RollerSimError
            If the time lies before the last revolution.
        """
        # A master adds up its steps; what it means is the sample a rounding error further on.
        block = self._block
        if block is None:
            block = self._next_revolution()
        while time_s >= _end(block) - 0.01 * block.sample_period_s:
            self.outputs.cmv = self._next_cmv
            block = self._next_revolution()
        index = int((time_s - block.time_s) / block.sample_period_s + 0.01)
        if index < 0:
            raise RollerSimError(f"time {time_s:g} s: the roller is at {block.time_s:g} s already")
        if index == len(block) - 1:
            self.outputs.cmv = self._next_cmv
        self.outputs.acceleration_vertical = float(block.acceleration_vertical[index])
        self.outputs.acceleration_horizontal = float(block.acceleration_horizontal[index])
        self.outputs.soil_force = float(block.soil_force[index])

    def _next_revolution(self) -> Block:
        changed = {
            name: value for name, value in self.inputs.items() if value != self._applied[name]
        }
        if changed:
            self._session.change(changed)
            self._applied |= changed
        block = self._session.advance(self._session.samples_per_revolution)
        self._block = block
        # As the meter of the node, which reads published samples.
        for value in self._meter.feed(
            block.first_sample,
            block.acceleration_vertical.astype(np.float32),
            block.sample_period_s,
            block.excitation_hz,
            block.eccentric_phase_rad,
            block.phase_increment_rad,
            self._session.exciter_status().amplitude_m,
        ):
            self._next_cmv = CMV_UNKNOWN if math.isnan(value.cmv) else value.cmv
        return block


def _end(block: Block) -> float:
    return block.time_s + len(block) * block.sample_period_s
