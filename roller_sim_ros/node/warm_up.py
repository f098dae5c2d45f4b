# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Everything the pacing thread will need is compiled and built once before, so that no block waits for it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from roller_sim_ros import session
from roller_sim_ros.emulation import Emulator
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.node.beginning import Beginning
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration
from roller_sim_ros.wire import messages
from roller_sim_ros.wire.types import decode


def warm_up(beginning: Beginning) -> None:
    """Run a roller of the same build for a moment, with all that it can send and receive.

    Raises
    ------
    ParameterError
        If the configuration is one that cannot be emulated.
    """
    configuration = beginning.configuration
    exciter = replace(configuration.exciter, vibrate=True, frequency_hz=28.0, amplitude_m=2e-3)
    emulator = Emulator(replace(configuration, exciter=exciter), start_ns=0)
    session.warm_up(configuration)
    for _ in range(2):
        emulator.command(vibrate=True, frequency_hz=29.0, amplitude_m=1e-3)
        emulator.change({"soil.shear_modulus_pa": 0.9 * configuration.soil.shear_modulus_pa})
        for _ in range(SAMPLES_PER_REVOLUTION // configuration.pacing.samples_per_message):
            emulator.advance(configuration.pacing.samples_per_message)
            emulator.imu_messages()
    if beginning.scenario is not None:
        begun = beginning.emulator(0)
        for _ in range(2):
            begun.advance(SAMPLES_PER_REVOLUTION)
    command = messages.exciter_command(session.ExciterCommand(True, 28.0, 1e-3), 0)
    decode(command.data, command.type_name)
    messages.clock(0)
    messages.diagnostic_array([messages.Diagnostic("warm-up", values={"blocks": 0})], 0)


def try_out(configuration: Configuration) -> None:
    """Compute the first block of a roller, so that a running one cannot fail when it becomes like that.

    What takes long to work out of the parameters is in the caches then.

    Raises
    ------
    RollerSimError
        If it cannot be emulated or what comes out is no number.
    """
    emulator = Emulator(configuration, start_ns=0)
    try:
        emulator.advance(configuration.pacing.samples_per_message)
    except (ArithmeticError, ValueError) as error:
        raise RollerSimError(f"the roller cannot be computed with that: {error}") from error
    block = emulator.block
    assert block is not None  # there is one after every advance
    if not np.isfinite(block.acceleration_vertical).all():
        raise RollerSimError("the roller cannot be computed with that: its motion is no number")
