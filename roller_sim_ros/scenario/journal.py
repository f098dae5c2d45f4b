# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What was true along the lane, revolution by revolution: the map of a run."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.meters import TruthMeter
from roller_sim_ros.session import Block, Session
from roller_sim_ros.site import Position

Array = NDArray[np.float64]

_TOGETHER = 64
"""Blocks that are worked off together: one loop after the other is faster than both in turns."""


@dataclass(frozen=True)
class SiteMap:
    """True values of a run; all arrays of the shape (revolutions,), in the order of time.

    Position and ground are those of the revolution, which begins there. The meters' windows end with it; what they
    say is of the ground half a window back, see `window_revolutions`.

    Attributes
    ----------
    window_revolutions : int
        Revolutions in a window of the meters.
    time_s, chainage_m, speed_m_s : ndarray
        At the beginning of the revolution.
    pass_number : ndarray of int64
        From 1.
    shear_modulus_pa, plastic_parameter_m : ndarray
        The ground under the drum.
    frequency_hz, amplitude_m : ndarray
        Of the exciter.
    cmv, rmv, air_fraction, force_ratio_max : ndarray
        From the motion itself; NaN when unknown.
    mode : ndarray of int64
        Operating mode from the contact states, `roller_sim_ros.meters.Mode`.
    """

    window_revolutions: int
    time_s: Array
    chainage_m: Array
    speed_m_s: Array
    pass_number: NDArray[np.int64]
    shear_modulus_pa: Array
    plastic_parameter_m: Array
    frequency_hz: Array
    amplitude_m: Array
    cmv: Array
    rmv: Array
    air_fraction: Array
    force_ratio_max: Array
    mode: NDArray[np.int64]

    def __len__(self) -> int:
        """Return the number of revolutions."""
        return len(self.time_s)

    @property
    def window_middle_m(self) -> Array:
        """Chainage of which the meters speak: where the drum was in the middle of the window."""
        back = np.maximum(np.arange(len(self)) - self.window_revolutions // 2, 0)
        return self.chainage_m[back]

    def of_pass(self, number: int) -> SiteMap:
        """Return the revolutions of one pass."""
        return self.where(self.pass_number == number)

    def where(self, inside: NDArray[np.bool_]) -> SiteMap:
        """Return some of the revolutions."""
        arrays = {
            item.name: getattr(self, item.name)[inside]
            for item in fields(self)
            if item.name != "window_revolutions"
        }
        return SiteMap(self.window_revolutions, **arrays)


class Journal:
    """Follows a session and keeps its map, until all is driven; `feed` it every block, right after it was stepped.

    Parameters
    ----------
    session : Session
        The session.
    """

    def __init__(self, session: Session) -> None:
        configuration = session.configuration
        self._session = session
        self._samples = session.samples_per_revolution
        self._window = configuration.meter.window_revolutions
        self._truth = TruthMeter(
            self._window,
            configuration.machine.static_load_n,
            session.samples_per_revolution,
            configuration.meter.period_tolerance,
        )
        self._waiting: list[tuple[Block, Position, float]] = []
        self._rows: list[tuple[float, ...]] = []

    def feed(self, block: Block) -> None:
        """Take a block; where a revolution ends with it, the map has one more."""
        session = self._session
        self._waiting.append((block, session.site.position, session.amplitude_m))
        if len(self._waiting) == _TOGETHER:
            self._work_off()

    def _work_off(self) -> None:
        for block, position, amplitude_m in self._waiting:
            self._note(block, position, amplitude_m)
        self._waiting.clear()

    def _note(self, block: Block, position: Position, amplitude_m: float) -> None:
        value = self._truth.feed(block)
        if position.finished or (block.first_sample + len(block)) % self._samples:
            return
        begins_s = block.time_s - block.first_sample % self._samples * block.sample_period_s
        self._rows.append(
            (
                begins_s,
                position.chainage_m,
                position.speed_m_s,
                position.pass_number,
                block.shear_modulus_pa,
                block.plastic_parameter_m,
                block.excitation_hz,
                amplitude_m,
                value.cmv,
                value.rmv,
                value.air_fraction,
                value.force_ratio_max,
                int(value.mode),
            )
        )

    def map(self) -> SiteMap:
        """Return the map of the revolutions so far."""
        self._work_off()
        names = [item.name for item in fields(SiteMap)][1:]
        columns = np.array(self._rows, dtype=np.float64).reshape(-1, len(names)).T
        arrays = {
            name: column.astype(np.int64) if name in ("pass_number", "mode") else column.copy()
            for name, column in zip(names, columns, strict=True)
        }
        return SiteMap(self._window, **arrays)
