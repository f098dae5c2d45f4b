"""The emulated roller: session, sensor and meters in, messages out, for every driver alike."""

from roller_sim_ros.emulation.emulator import Emulator

__all__ = ["Emulator"]
