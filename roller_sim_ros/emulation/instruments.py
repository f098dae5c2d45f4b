# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Sensors and faults between the session and the messages."""

from __future__ import annotations

from collections.abc import Sequence

from roller_sim_ros.faults import Delivery, FaultEngine, Installed, Scheduled
from roller_sim_ros.faults.stale_position import Held
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION
from roller_sim_ros.sensors import AccelerometerSheet, Reading, Slot
from roller_sim_ros.sensors.suite import Choice, Suite
from roller_sim_ros.session import Block, Session
from roller_sim_ros.wire import instruments as wire
from roller_sim_ros.wire.messages import Message, sample_stamp


class Instruments:
    """What the roller's sensors deliver, faults included, block by block.

    Parameters
    ----------
    session : Session
        The roller; its exciter's faults are set from here.
    sensors : sequence of Choice
        Its sensors.
    faults : sequence of Scheduled
        Scheduled faults.
    seed : int
        Of the run.

    Attributes
    ----------
    suite : Suite
        The sensors.
    faults : FaultEngine
        The faults.

    Raises
    ------
    ParameterError
        If a sensor or a fault cannot be.
    """

    def __init__(
        self,
        session: Session,
        sensors: Sequence[Choice] = (),
        faults: Sequence[Scheduled] = (),
        seed: int = 0,
    ) -> None:
        self.suite = Suite(sensors, seed)
        sheet = self.suite.sheets[Slot.ACCELERATION]
        range_m_s2 = sheet.range_m_s2 if isinstance(sheet, AccelerometerSheet) else 0.0
        self.faults = FaultEngine(Installed(self.suite.slots, range_m_s2), faults, seed)
        self._session = session
        self._held = {slot: Held() for slot in (Slot.SPEED, Slot.POSITION)}
        self._told: object = None
        self._delivery = Delivery(self.suite.accelerometer.latency_s)
        session.supervision = self.faults

    def read(self, block: Block) -> list[Reading]:
        """Return the accelerometer's readings that arrive with a block, the next one of the session."""
        faults = self.faults
        faults.observe(block)
        now_s = block.time_s + len(block) * block.sample_period_s
        now_sample = block.first_sample + len(block)
        for reading in self.suite.accelerometer.read(block, faults):
            effects = faults.message_effects(reading.revolution)
            self._delivery.put(reading, effects, now_s, now_sample)
        return self._delivery.due(now_s, now_sample)

    def tell_again(self) -> None:
        """Let the faults be told once more, though they have not changed."""
        self._told = None

    def messages(self, block: Block, start_ns: int) -> list[Message]:
        """Return what the other sensors deliver in the same block, and the faults where they change.

        Parameters
        ----------
        block : Block
            The block that was read last.
        start_ns : int
            Stamp of the first sample of the run.
        """
        out: list[Message] = []
        revolution = block.first_sample // SAMPLES_PER_REVOLUTION
        position = self._session.site.position
        tacho, speed, gnss = (
            self.suite.get(slot) for slot in (Slot.TACHO, Slot.SPEED, Slot.POSITION)
        )
        if tacho is not None:
            lost = self.faults.loses_pulse(revolution)
            out += [wire.tacho_pulse(pulse, start_ns) for pulse in tacho.read(block, lost=lost)]
        if speed is not None:
            for travelled in speed.read(block, position):
                stale = self.faults.stale(revolution, Slot.SPEED)
                held = self._held[Slot.SPEED].follow(travelled, stale)
                out.append(wire.odometry(held, start_ns))
        if gnss is not None:
            for found in gnss.read(block, position):
                stale = self.faults.stale(revolution, Slot.POSITION)
                out.append(wire.fix(self._held[Slot.POSITION].follow(found, stale), start_ns))
        active = [(item.handle, item.since_sample) for item in self.faults.active]
        if (active, self.faults.held_back) != self._told:
            self._told = (active, self.faults.held_back)
            stamp_ns = sample_stamp(block, 0, start_ns)
            out.append(
                wire.fault_states(
                    self.faults.active, self.faults.held_back, block.first_sample, stamp_ns
                )
            )
        return out
