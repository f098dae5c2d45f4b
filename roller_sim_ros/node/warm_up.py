"""Everything the pacing thread will need is compiled and built once before, so that no block waits for it."""

from __future__ import annotations

from dataclasses import replace

from roller_sim_ros import session
from roller_sim_ros.emulation import Emulator
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration
from roller_sim_ros.wire import messages
from roller_sim_ros.wire.types import decode


def warm_up(configuration: Configuration) -> None:
    """Run a roller of the same build for a moment, with all that it can send and receive.

    Raises
    ------
    ParameterError
        If the configuration is one that cannot be emulated.
    """
    exciter = replace(configuration.exciter, vibrate=True, frequency_hz=28.0, amplitude_m=2e-3)
    emulator = Emulator(replace(configuration, exciter=exciter), start_ns=0)
    session.warm_up(configuration)
    for _ in range(2):
        emulator.command(vibrate=True, frequency_hz=29.0, amplitude_m=1e-3)
        emulator.change({"soil.shear_modulus_pa": 0.9 * configuration.soil.shear_modulus_pa})
        for _ in range(SAMPLES_PER_REVOLUTION // configuration.pacing.samples_per_message):
            emulator.advance(configuration.pacing.samples_per_message)
            emulator.imu_messages()
    command = messages.exciter_command(session.ExciterCommand(True, 28.0, 1e-3), 0)
    decode(command.data, command.type_name)
    messages.diagnostic_array([messages.Diagnostic("warm-up", values={"blocks": 0})], 0)
