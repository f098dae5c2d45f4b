# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Why a meter value is unknown or uncertain."""

from __future__ import annotations

from enum import IntFlag


class Status(IntFlag):
    """Bits of the ``status`` field of a meter value; none set: the value stands."""

    NONE = 0
    WINDOW_FILLING = 1
    """Fewer revolutions since the start, a gap or slow running than the window has."""
    STANDING = 2
    """The exciter does not turn."""
    BELOW_NOISE = 4
    """The amplitude at the excitation frequency is below the noise floor."""
    FREQUENCY_CHANGING = 8
    """The window holds revolutions of different frequencies; the values are computed all the same."""
    GAP = 16
    """Samples were lost so recently that the window had to begin anew and is not full yet."""
    CLIPPED = 32
    """The window holds samples at the end of the sensor's range; the values are computed all the same."""

    @property
    def label(self) -> str:
        """The bits as a reader wants them, ``ok`` when none is set."""
        names = [bit.name.lower().replace("_", " ") for bit in Status if bit in self and bit.name]
        return ", ".join(name for name in names if name != "none") or "ok"
