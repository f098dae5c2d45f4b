# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The emulated roller: session, sensor and meters in, messages out, for every driver alike."""

from roller_sim_ros.emulation.emulator import Emulator

__all__ = ["Emulator"]
