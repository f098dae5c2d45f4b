"""Sensors and faults between the session and the messages."""

from __future__ import annotations

from collections.abc import Sequence

from roller_sim_ros.faults import Delivery, FaultEngine, Installed, Scheduled
from roller_sim_ros.sensors import AccelerometerSheet, Reading, Slot
from roller_sim_ros.sensors.suite import Choice, Suite
from roller_sim_ros.session import Block, Session


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
    ParameterError, FaultRefused
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
