# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The accelerometer of a data sheet: stages from the true motion to the numbers that it delivers."""

from __future__ import annotations

from functools import partial

import numpy as np

from roller_sim_ros.sensors.bandwidth import LowPass
from roller_sim_ros.sensors.bias import Bias
from roller_sim_ros.sensors.clock import Clock
from roller_sim_ros.sensors.converter import Converter
from roller_sim_ros.sensors.kernels import warm_up
from roller_sim_ros.sensors.mounting import Mounting
from roller_sim_ros.sensors.noise import Noise
from roller_sim_ros.sensors.sampling import FixedRate, Instants, Synchronous
from roller_sim_ros.sensors.sensor import Disturbance, Kind, Reading, specific_force
from roller_sim_ros.sensors.sheet import AccelerometerSheet
from roller_sim_ros.sensors.stage import Signals, Stage
from roller_sim_ros.session.block import Block
from roller_sim_ros.site.streams import stream


class Accelerometer:
    """Specific force → mounting → sensitivity, bias, drift → low-pass → sampling → noise → range → converter.

    Noise comes after sampling, as the process that the low-pass makes of white noise, exact at the samples.

    Parameters
    ----------
    sheet : AccelerometerSheet
        The data sheet.
    seed : int
        Of the run; each error of each axis has random numbers of its own.
    """

    def __init__(self, sheet: AccelerometerSheet, seed: int = 0) -> None:
        warm_up()
        numbers = partial(_stream, seed)
        self.latency_s = sheet.latency_s
        self._clock = Clock(sheet.clock_skew_ppm)
        self._before: list[Stage] = [Mounting(sheet), Bias(sheet, numbers)]
        if sheet.bandwidth_hz:
            self._before.append(LowPass(sheet.bandwidth_hz))
        self._sampling: Synchronous | FixedRate = Synchronous()
        if sheet.sample_rate_hz:
            self._sampling = FixedRate(sheet.sample_rate_hz, sheet.jitter_s, numbers)
        self._noise: Stage | None = None
        if sheet.noise_density:
            self._noise = Noise(sheet.noise_density, sheet.bandwidth_hz, numbers)
        self._converter = Converter(sheet.range_m_s2, sheet.adc_bits)

    def read(self, block: Block, disturbance: Disturbance | None = None) -> list[Reading]:
        """Return what the sensor has to deliver after a block."""
        skew_ppm = (
            disturbance.clock_skew_ppm(block.first_sample // 128)
            if disturbance is not None
            else 0.0
        )
        begins = self._clock.begin(block, skew_ppm)
        signals = Signals(
            *specific_force(block.acceleration_vertical, block.acceleration_horizontal),
            block.sample_period_s,
        )
        for stage in self._before:
            signals = stage.apply(signals)
        return [
            self._reading(instants, piece, disturbance)
            for instants, piece in self._sampling.take(block, signals, self._clock, begins=begins)
        ]

    def _reading(
        self, instants: Instants, signals: Signals, disturbance: Disturbance | None
    ) -> Reading:
        if self._noise is not None:
            signals = self._noise.apply(signals)
        noticed = None
        if disturbance is not None:
            noticed = disturbance.signal(instants.revolution, signals.vertical, signals.horizontal)
        vertical, horizontal = (
            self._converter.convert(axis) for axis in (signals.vertical, signals.horizontal)
        )
        clipped = vertical.clipped.astype(np.uint8) + horizontal.clipped
        if noticed is not None:
            clipped = np.maximum(clipped, noticed)
        return Reading(
            kind=Kind.SPECIFIC_FORCE,
            vertical=vertical.values,
            horizontal=horizontal.values,
            first_sample=instants.first_sample,
            time_s=instants.time_s,
            sample_period_s=instants.sample_period_s,
            excitation_hz=instants.excitation_hz,
            eccentric_phase_rad=instants.eccentric_phase_rad,
            phase_increment_rad=instants.phase_increment_rad,
            revolution=instants.revolution,
            scale=self._converter.scale,
            raw_vertical=vertical.counts,
            raw_horizontal=horizontal.counts,
            clipped=clipped,
            sensor_time_s=instants.sensor_time_s,
        )


def _stream(seed: int, purpose: str) -> np.random.Generator:
    return stream(seed, f"sensors/accelerometer/{purpose}")
