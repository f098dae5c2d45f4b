# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The ground along a trace: windows over the acceleration of a bag, phase from its samples or its tacho."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.analysis.bag import Bag, BagError, open_bag
from roller_sim_ros.analysis.samples import (
    ACCELERATION_TYPE,
    IMU_TYPE,
    NANOSECONDS,
    AccelerationReader,
    Piece,
    stamp_ns,
)
from roller_sim_ros.analysis.topics import Selection, select
from roller_sim_ros.estimate.arrays import WINDOW_REVOLUTIONS, step_of
from roller_sim_ros.estimate.imu_pieces import imu_pieces
from roller_sim_ros.estimate.known import known_of
from roller_sim_ros.estimate.pulses import PulsePhase
from roller_sim_ros.estimate.sliding import (
    CONSTANT,
    CONSTANT_PULSES,
    SlidingWindow,
    Window,
    estimate_turns,
)
from roller_sim_ros.estimate.status import Status
from roller_sim_ros.estimate.turns import Turn, TurnCollector
from roller_sim_ros.estimate.window import WindowEstimate
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration, Value

Array = NDArray[np.float64]

TACHO_TYPE = "roller_sim_ros/msg/TachoPulse"

PROGRESS_MESSAGES = 200
"""Messages between two reports of progress."""

REACH = 16 * SAMPLES_PER_REVOLUTION
"""Samples by which a piece may be late."""


@dataclass(frozen=True)
class TraceOptions:
    """How a trace is to be estimated.

    Attributes
    ----------
    topic : str or None
        Topic with the acceleration; needed when there are several.
    window_revolutions : int
        Revolutions in a window.
    step_revolutions : int or None
        From one window to the next; None: half a window.
    tacho : bool
        Take the phase from the pulses on ``tacho`` though the samples tell it.
    sensor_bandwidth_hz : float
        Frequency of −3 dB of the sensor's second-order Butterworth low-pass; 0: none.
    given : mapping
        {dotted name: SI value} of parameters that are known better than the trace tells: of the machine, the exciter,
        the half space; density and Poisson's ratio.
    machine_given : bool
        Whether `given` holds the whole machine, so that the trace need not tell it.
    amplitude_m : float or None
        Nominal amplitude, whatever the trace says of it.
    """

    topic: str | None = None
    window_revolutions: int = WINDOW_REVOLUTIONS
    step_revolutions: int | None = None
    tacho: bool = False
    sensor_bandwidth_hz: float = 0.0
    given: Mapping[str, Value] = field(default_factory=dict)
    machine_given: bool = False
    amplitude_m: float | None = None


@dataclass(frozen=True)
class WindowOfTrace:
    """One window.

    Attributes
    ----------
    start_s, end_s : float
        Its begin and end, s since the trace's first sample.
    start_ns : int
        Stamp of its begin, ns since the epoch.
    revolutions : int
        In it; 0 where the eccentric stands.
    excitation_hz, amplitude_m : float
        Frequency and nominal amplitude of the exciter, their means.
    estimate : WindowEstimate
        The ground.
    """

    start_s: float
    end_s: float
    start_ns: int
    revolutions: int
    excitation_hz: float
    amplitude_m: float
    estimate: WindowEstimate


@dataclass(frozen=True)
class TraceEstimate:
    """All windows of a trace.

    Attributes
    ----------
    path : pathlib.Path
        The trace.
    topic : str
        With the acceleration.
    known : Configuration
        What was known; its G and p mean nothing.
    windows : list of WindowOfTrace
        In the order of time.
    damage : str
        What of the trace could not be read, empty when all could.
    """

    path: Path
    topic: str
    known: Configuration
    windows: list[WindowOfTrace]
    damage: str


def estimate_trace(
    path: Path,
    options: TraceOptions | None = None,
    on_progress: Callable[[float], None] | None = None,
) -> TraceEstimate:
    """Estimate the ground in windows that slide over a trace.

    Parameters
    ----------
    path : pathlib.Path
        MCAP file or rosbag2 folder with DrumAcceleration, or with Imu and TachoPulse.
    options : TraceOptions, optional
        How.
    on_progress : callable, optional
        Called now and then with the share that is done, 0 to 1.

    Raises
    ------
    RollerSimError
        If there is nothing that can be estimated from: no such file or topic, no pulses, an unknown machine.
    """
    options = options or TraceOptions()
    step_of(options.window_revolutions, options.step_revolutions)
    bag = open_bag(path)
    try:
        selection = select(path, bag.topics, options.topic)
        known = known_of(bag, selection, options.given, machine_given=options.machine_given)
        return _Pass(path, bag, selection, known, options).run(on_progress)
    except BagError as error:
        text = str(error)
        raise BagError(text if text.startswith(str(path)) else f"{path}: {text}") from None


class _Pass:
    """One pass over a trace."""

    def __init__(
        self,
        path: Path,
        bag: Bag,
        selection: Selection,
        known: Configuration,
        options: TraceOptions,
    ) -> None:
        self._path = path
        self._bag = bag
        self._selection = selection
        self._known = known
        self._collector = TurnCollector(SAMPLES_PER_REVOLUTION)
        revolutions = options.window_revolutions
        self._sliding = SlidingWindow(revolutions, step_of(revolutions, options.step_revolutions))
        self._bandwidth_hz = options.sensor_bandwidth_hz
        self._fixed_m = options.amplitude_m
        self._amplitude_m = math.nan if self._fixed_m is None else self._fixed_m
        self._start_ns: int | None = None
        self._next_sample: int | None = None
        self._standing_from_s = math.nan
        self._standing_to_s = math.nan
        self._windows: list[WindowOfTrace] = []
        imu = selection.source.type == IMU_TYPE
        self._pulses: PulsePhase | None = None
        if options.tacho or imu:
            self._pulses = self._pulse_phase()
        self._constant = CONSTANT if self._pulses is None else CONSTANT_PULSES

    def _pulse_phase(self) -> PulsePhase:
        """Read all pulses."""
        base = self._selection.source.name.rpartition("/")[0].rpartition("/")[0]
        of_type = [item.name for item in self._bag.topics.values() if item.type == TACHO_TYPE]
        named = [name for name in of_type if name == f"{base}/tacho"] or of_type
        if len(named) != 1:
            raise BagError(
                f"{self._selection.source.name} has no phase without a tacho: one topic of {TACHO_TYPE} is needed, "
                f"there are {len(of_type)}"
            )
        self._start_ns = self._first_stamp()
        times: list[float] = []
        phases: list[float] = []
        for received in self._bag.messages({named[0]}):
            time_s = (stamp_ns(received.message) - self._start_ns) / NANOSECONDS
            if not times or time_s > times[-1]:
                times.append(time_s)
                phases.append(float(received.message.eccentric_phase))
        if len(times) < 2:
            raise BagError(f"{named[0]} holds fewer than two pulses: the phase is unknown")
        return PulsePhase(times, phases)

    def _first_stamp(self) -> int:
        for received in self._bag.messages({self._selection.source.name}):
            return stamp_ns(received.message)
        raise BagError(f"no samples on {self._selection.source.name} could be read")

    def run(self, on_progress: Callable[[float], None] | None) -> TraceEstimate:
        """Read everything and estimate."""
        source = self._selection.source
        pieces = _pieces if source.type == ACCELERATION_TYPE else imu_pieces
        names = {name for name in (source.name, self._selection.exciter) if name}
        for piece in pieces(self._messages(names, on_progress)):
            self._on_piece(piece)
        self._end_standing()
        for window in self._sliding.finish():
            self._on_window(window)
        if self._start_ns is None:
            raise BagError(f"no samples on {source.name} could be read")
        if not self._windows:
            self._windows.append(
                WindowOfTrace(
                    0.0, 0.0, self._start_ns, 0, math.nan, math.nan, WindowEstimate(Status.TOO_FEW)
                )
            )
        return TraceEstimate(self._path, source.name, self._known, self._windows, self._bag.damage)

    def _messages(
        self, names: set[str], on_progress: Callable[[float], None] | None
    ) -> Iterator[Any]:
        """Yield the messages with acceleration; note those of the exciter, and the progress."""
        for number, received in enumerate(self._bag.messages(names)):
            if on_progress is not None and number % PROGRESS_MESSAGES == 0:
                on_progress(self._bag.progress)
            if received.topic == self._selection.exciter:
                if self._fixed_m is None:
                    self._amplitude_m = float(received.message.amplitude)
            else:
                yield received.message
        if on_progress is not None:
            on_progress(1.0)

    def _on_piece(self, piece: Piece) -> None:
        if self._start_ns is None:
            self._start_ns = piece.stamp_ns
        since_s = (piece.stamp_ns - self._start_ns) / NANOSECONDS
        number = np.arange(len(piece), dtype=np.float64)
        times = since_s + number * piece.sample_period_s
        end = piece.first_sample + len(piece)
        if self._next_sample is not None and piece.first_sample != self._next_sample:
            if end <= self._next_sample <= piece.first_sample + REACH:
                # Repeated, or come too late: what is far back is a sender that was restarted.
                return
            self._interrupt()
        self._next_sample = end
        if self._pulses is None:
            turns = (piece.phase_rad + number * piece.phase_increment_rad) / (2.0 * math.pi)
            frequency = piece.excitation_hz
            turning = piece.phase_increment_rad > 0.0 and frequency > 0.0
        else:
            turns = self._pulses.turns(times)
            frequency = math.nan
            turning = bool(np.isfinite(turns).all())
        if not turning:
            self._interrupt()
            if math.isnan(self._standing_from_s):
                self._standing_from_s = since_s
            self._standing_to_s = since_s + len(piece) * piece.sample_period_s
            return
        self._end_standing()
        for turn in self._collector.feed(
            times, turns, piece.vertical, excitation_hz=frequency, amplitude_m=self._amplitude_m
        ):
            self._on_turn(turn)

    def _interrupt(self) -> None:
        """Something is missing or the eccentric stands: what comes next does not follow."""
        self._collector.interrupt()
        for window in self._sliding.finish():
            self._on_window(window)

    def _end_standing(self) -> None:
        """Note a stretch over which the eccentric stood or its phase was unknown."""
        if not math.isnan(self._standing_from_s):
            self._add(
                self._standing_from_s,
                self._standing_to_s,
                0,
                0.0,
                self._amplitude_m,
                WindowEstimate(Status.STANDING),
            )
        self._standing_from_s = math.nan

    def _on_turn(self, turn: Turn) -> None:
        for window in self._sliding.push(turn):
            self._on_window(window)

    def _on_window(self, window: Window) -> None:
        estimate, known = estimate_turns(
            window,
            self._known,
            constant=self._constant,
            sensor_bandwidth_hz=self._bandwidth_hz,
        )
        last = window.turns[-1]
        self._add(
            window.turns[0].time_s,
            last.time_s + 1.0 / last.excitation_hz,
            len(window.turns),
            known.exciter.frequency_hz,
            known.exciter.amplitude_m,
            estimate,
        )

    def _add(
        self,
        start_s: float,
        end_s: float,
        revolutions: int,
        excitation_hz: float,
        amplitude_m: float,
        estimate: WindowEstimate,
    ) -> None:
        start_ns = (self._start_ns or 0) + round(start_s * NANOSECONDS)
        self._windows.append(
            WindowOfTrace(
                start_s, end_s, start_ns, revolutions, excitation_hz, amplitude_m, estimate
            )
        )


def _pieces(messages: Iterator[Any]) -> Iterator[Piece]:
    reader = AccelerationReader()
    for message in messages:
        yield from reader.read(message)
