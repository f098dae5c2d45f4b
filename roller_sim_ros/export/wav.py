# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Acceleration as sound."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.interpolate import make_interp_spline
from scipy.io import wavfile

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.export.table import Table

RATE_HZ = 8000
"""Above twice the highest frequency of 128 samples per revolution at 60 Hz, and what every player plays."""

FULL_SCALE = 32767


def write_wav(table: Table, path: Path) -> None:
    """Write 16-bit stereo, vertical left and horizontal right, at a constant rate by cubic interpolation.

    The greatest acceleration of both is full scale. Where samples are missing there is silence.

    Raises
    ------
    RollerSimError
        If there are too few samples.
    """
    columns = table.whole()
    time_s = columns["time_s"]
    both = np.stack([columns["vertical_m_s2"], columns["horizontal_m_s2"]], axis=1)
    both = np.nan_to_num(both.astype(np.float64))
    # Duplicates and blocks out of order would make time run backwards.
    forward = np.concatenate([[True], time_s[1:] > np.maximum.accumulate(time_s)[:-1]])
    time_s, both = time_s[forward], both[forward]
    if len(time_s) < 4:
        raise RollerSimError(f"{path}: {len(time_s)} samples are too few to be heard")
    steps = np.diff(time_s)
    gaps = np.flatnonzero(steps > 2.0 * np.median(steps))
    at = np.arange(int((time_s[-1] - time_s[0]) * RATE_HZ) + 1) / RATE_HZ + time_s[0]
    sound = make_interp_spline(time_s, both, k=3)(at)
    for gap in gaps:
        sound[(at > time_s[gap]) & (at < time_s[gap + 1])] = 0.0
    greatest = np.abs(sound).max()
    scaled = np.rint(sound / greatest * FULL_SCALE) if greatest > 0.0 else sound
    wavfile.write(path, RATE_HZ, scaled.astype(np.int16))
