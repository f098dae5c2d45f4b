# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How a bag is evaluated, and what comes out."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from roller_sim_ros.analysis.comparison import Comparison
from roller_sim_ros.analysis.continuity import Continuity
from roller_sim_ros.analysis.excerpt import Excerpt
from roller_sim_ros.analysis.history import History
from roller_sim_ros.analysis.imu import ImuRate
from roller_sim_ros.analysis.samples import NANOSECONDS
from roller_sim_ros.analysis.topics import Selection


@dataclass(frozen=True)
class Options:
    """How a bag is evaluated.

    Attributes
    ----------
    topic, meter : str or None
        Topic with the acceleration, and with the meter values to compare with; found when None.
    window_revolutions : int or None
        Even number of revolutions per value; that of the recorded meter, of the bag's parameters, or the
        default, when None.
    noise_floor_m_s2 : float or None
        Amplitude at the excitation frequency below which there is no value.
    samples_per_revolution : int or None
        Samples per revolution of a DrumAcceleration stream. Both: as the bag's parameters say, or the
        defaults, when None.
    excitation_hz : float or None
        Excitation frequency of an Imu stream; found from its spectrum when None.
    """

    topic: str | None = None
    meter: str | None = None
    window_revolutions: int | None = None
    noise_floor_m_s2: float | None = None
    samples_per_revolution: int | None = None
    excitation_hz: float | None = None


@dataclass
class Analysis:
    """What a bag says.

    Attributes
    ----------
    path : Path
        The bag.
    damage : str
        What kept it from being read to its end; empty when nothing did.
    selection : Selection
        Topics that were read.
    imu_rate : ImuRate or None
        Rate of an Imu stream.
    window_revolutions, samples_per_revolution : int
        As evaluated.
    messages : dict
        Messages read, by topic.
    start_ns, end_ns : int
        Stamps of the first and after the last sample, ns.
    stamp_error_s : float
        Largest deviation of a stamp from the previous block's stamp plus its samples' time.
    continuity : Continuity
        Gaps and the like.
    history : History
        Meter values computed anew, and what was recorded beside them.
    meter, truth : Comparison or None
        Recorded meter and truth against the values computed anew.
    cmv : Comparison or None
        The plain CMV topic against the meter message before it, or against the values computed anew when
        no meter was recorded.
    further : Comparison or None
        Further meter values, each recorded on a topic of its own, against those computed anew.
    excerpt : Excerpt or None
        The last settled revolutions.
    specific_force : bool
        Whether the acceleration contains gravity.
    warnings : list of str
        What a reader should know.
    """

    path: Path
    selection: Selection
    window_revolutions: int
    samples_per_revolution: int
    imu_rate: ImuRate | None = None
    damage: str = ""
    messages: dict[str, int] = field(default_factory=dict)
    start_ns: int = 0
    end_ns: int = 0
    stamp_error_s: float = 0.0
    continuity: Continuity = field(default_factory=lambda: Continuity(0))
    history: History = field(default_factory=History)
    meter: Comparison | None = None
    truth: Comparison | None = None
    cmv: Comparison | None = None
    further: Comparison | None = None
    excerpt: Excerpt | None = None
    specific_force: bool = False
    warnings: list[str] = field(default_factory=list)

    @property
    def duration_s(self) -> float:
        """Time from the first sample to the end of the last."""
        return (self.end_ns - self.start_ns) / NANOSECONDS
