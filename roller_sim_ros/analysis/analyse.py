# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Evaluation of a bag, from its first message to its last, in one pass and bounded memory."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from roller_sim_ros.analysis.bag import Bag, BagError, open_bag
from roller_sim_ros.analysis.comparison import Comparison, Matcher
from roller_sim_ros.analysis.continuity import Continuity
from roller_sim_ros.analysis.excerpt import ExcerptKeeper
from roller_sim_ros.analysis.imu import PROBE_SAMPLES, ImuRate, ImuReader, find_rate
from roller_sim_ros.analysis.machine import machine_facts
from roller_sim_ros.analysis.result import Analysis, Options
from roller_sim_ros.analysis.samples import (
    IMU_TYPE,
    NANOSECONDS,
    AccelerationReader,
    Piece,
    stamp_ns,
)
from roller_sim_ros.analysis.topics import Selection, select
from roller_sim_ros.meters import CompactionMeter, MeterValue, Status
from roller_sim_ros.parameters import PARAMETERS

PROGRESS_MESSAGES = 1000
"""Messages between two reports of progress."""

DRIFT_RAD = 0.3
"""Turn of an Imu stream's fundamental within a window at which its frequency is not what was found."""

WINDOW = "meter.window_revolutions"
NOISE_FLOOR = "meter.noise_floor_m_s2"
PERIOD_TOLERANCE = "meter.period_tolerance"
SAMPLES = "sampling.samples_per_revolution"

RECORDED, TRUE = "recorded", "true"
"""What is compared with the values computed anew; also the prefix of its columns in the history."""


def analyse(
    path: Path,
    options: Options | None = None,
    on_progress: Callable[[float], None] | None = None,
) -> Analysis:
    """Evaluate a bag.

    Parameters
    ----------
    path : Path
        MCAP file or rosbag2 folder.
    options : Options, optional
        How.
    on_progress : callable, optional
        Called now and then with the share that is done, 0 to 1.

    Returns
    -------
    Analysis
        Of a damaged bag: of what could be read, with `damage` set.

    Raises
    ------
    BagError
        If nothing can be evaluated.
    """
    options = options or Options()
    bag = open_bag(path)
    try:
        selection = select(path, bag.topics, options.topic, options.meter)
    except BagError as error:
        raise BagError(f"{error}{bag.damage and f' ({bag.damage})'}") from None
    try:
        return _Pass(path, bag, selection, options).run(on_progress or _ignore)
    except BagError as error:
        text = str(error)
        raise BagError(text if text.startswith(str(path)) else f"{path}: {text}") from None


class _Pass:
    """One pass over a bag."""

    def __init__(self, path: Path, bag: Bag, selection: Selection, options: Options) -> None:
        self._bag = bag
        self._selection = selection
        rate = None
        facts = machine_facts(bag, selection)
        count = options.samples_per_revolution or int(self._parameter(SAMPLES))
        self._reader: AccelerationReader | ImuReader = AccelerationReader()
        if selection.source.type == IMU_TYPE:
            rate = self._imu_rate(options.excitation_hz)
            count = rate.samples_per_revolution
            self._reader = ImuReader(rate)
            # Without the eccentric's phase the machine is of no use.
            facts = None
        window = options.window_revolutions or self._recorded_window()
        floor = options.noise_floor_m_s2
        if floor is None:
            floor = self._parameter(NOISE_FLOOR)
        self._meter = CompactionMeter(
            window,
            floor,
            count,
            drum=None if facts is None else facts.drum,
            period_tolerance=self._parameter(PERIOD_TOLERANCE),
        )
        self._amplitude_m = math.nan if facts is None else facts.amplitude_m
        self._kept = ExcerptKeeper(count)
        self._clean = 0
        self._count = count
        self._next_stamp: tuple[int, int] | None = None
        self._recorded_cmv: float | None = None
        self._recorded_sample: int | None = None
        self._last: MeterValue | None = None
        self._samples_per_turn = 0.0
        self._other_window = 0
        self._matchers: dict[str, Matcher] = {}
        self.result = Analysis(
            path=path,
            selection=selection,
            window_revolutions=window,
            samples_per_revolution=count,
            imu_rate=rate,
            specific_force=rate is not None,
            continuity=Continuity(window * count),
            meter=self._comparison(RECORDED, selection.meter),
            truth=self._comparison(TRUE, selection.truth),
            cmv=Comparison() if selection.cmv else None,
            further=Comparison() if selection.further else None,
        )

    def _comparison(self, kind: str, topic: str) -> Comparison | None:
        """Return a comparison, filled as values come, when its topic is there."""
        if not topic:
            return None
        self._matchers[kind] = Matcher(Comparison())
        return self._matchers[kind].comparison

    def _imu_rate(self, excitation_hz: float | None) -> ImuRate:
        """Look at the first samples of an Imu stream."""
        name = self._selection.source.name
        probe = [
            (stamp_ns(received.message), float(received.message.linear_acceleration.z))
            for received in islice(self._bag.messages({name}), PROBE_SAMPLES)
        ]
        return find_rate([item[0] for item in probe], [item[1] for item in probe], excitation_hz)

    def _recorded_window(self) -> int:
        """Return the window of the recorded meter, the parameter when there is none."""
        if self._selection.meter:
            for received in self._bag.messages({self._selection.meter}):
                return int(received.message.window_revolutions)
        return int(self._parameter(WINDOW))

    def _parameter(self, name: str) -> float:
        """Return a parameter as the bag states it, or its default."""
        try:
            return float(self._bag.parameters.get(name, PARAMETERS[name][1]))
        except ValueError:
            return float(PARAMETERS[name][1])

    def run(self, on_progress: Callable[[float], None]) -> Analysis:
        """Read everything and return the result."""
        result = self.result
        handlers: dict[str, Callable[[Any], None]] = {
            self._selection.source.name: self._on_source,
            self._selection.meter: self._on_meter,
            self._selection.cmv: self._on_cmv,
            self._selection.truth: self._on_truth,
            self._selection.exciter: self._on_exciter,
            **{
                topic: partial(self._on_further, name)
                for topic, name in self._selection.further.items()
            },
        }
        for number, received in enumerate(self._bag.messages(self._selection.names)):
            result.messages[received.topic] = result.messages.get(received.topic, 0) + 1
            handlers[received.topic](received.message)
            if number % PROGRESS_MESSAGES == 0:
                on_progress(self._bag.progress)
        if isinstance(self._reader, ImuReader):
            for piece in self._reader.flush():
                self._on_piece(piece)
        if not result.continuity.samples:
            raise BagError(f"no samples on {self._selection.source.name} could be read")
        for matcher in self._matchers.values():
            matcher.finish()
        result.excerpt = self._kept.excerpt()
        result.damage = self._bag.damage
        self._warn()
        on_progress(1.0)
        return result

    def _on_source(self, message: Any) -> None:
        for piece in self._reader.read(message):
            self._on_piece(piece)

    def _on_piece(self, piece: Piece) -> None:
        result = self.result
        if result.continuity.blocks == 0:
            result.start_ns = piece.stamp_ns
        result.specific_force = piece.specific_force
        result.continuity.feed(piece.first_sample, len(piece))
        end = piece.first_sample + len(piece)
        if self._next_stamp is not None and self._next_stamp[0] == piece.first_sample:
            deviation = abs(piece.stamp_ns - self._next_stamp[1]) / NANOSECONDS
            result.stamp_error_s = max(result.stamp_error_s, deviation)
        self._next_stamp = (end, piece.stamp_of(end))
        result.end_ns = max(result.end_ns, piece.stamp_of(end))
        if piece.excitation_hz > 0.0:
            self._samples_per_turn = 1.0 / (piece.sample_period_s * piece.excitation_hz)
        self._kept.acceleration.write(
            piece.first_sample, np.stack([piece.vertical, piece.horizontal])
        )
        for value in self._meter.feed(
            piece.first_sample,
            piece.vertical,
            piece.sample_period_s,
            piece.excitation_hz,
            piece.phase_rad,
            piece.phase_increment_rad,
            self._amplitude_m,
            piece.clipped,
        ):
            self._on_value(value, piece)

    def _on_value(self, value: MeterValue, piece: Piece) -> None:
        time_s = (piece.stamp_of(value.last_sample) - self.result.start_ns) / NANOSECONDS
        row = self.result.history.append(value, time_s)
        self._last = value
        if value.status in (Status.NONE, Status.CLIPPED):
            self._clean += 1
            revolutions = self.result.window_revolutions + self._clean - 1
            self._kept.settled(value.last_sample, revolutions, value.excitation_frequency)
        else:
            self._clean = 0
            self._kept.interrupted()
        whole = not value.status & (Status.WINDOW_FILLING | Status.GAP)
        for kind, matcher in self._matchers.items():
            found = matcher.computed(value.last_sample, row, _quantities(value), window_whole=whole)
            self._note(kind, found)

    def _on_meter(self, message: Any) -> None:
        clipped = Status.CLIPPED in Status(int(message.status))
        self._recorded_cmv = math.nan if clipped else float(message.cmv)
        self._recorded_sample = int(message.last_sample)
        if message.window_revolutions != self.result.window_revolutions:
            self._other_window = int(message.window_revolutions)
        matcher = self._matchers[RECORDED]
        recorded = {
            "cmv": float(message.cmv),
            "rmv": float(message.rmv),
            "fundamental_amplitude": float(message.fundamental_amplitude),
            "period": int(message.period),
            "mode": int(message.mode),
        }
        self._note(RECORDED, matcher.recorded(int(message.last_sample), recorded))

    def _on_truth(self, message: Any) -> None:
        first, count = int(message.sequence), len(message.soil_force)
        height = np.asarray(message.drum_height, dtype=np.float64) + float(message.datum)
        self._kept.truth.write(first, np.stack([message.soil_force, height, message.contact_state]))
        if (first + count) % self._count == 0:
            matcher = self._matchers[TRUE]
            recorded = {
                "cmv": float(message.cmv),
                "rmv": float(message.rmv),
                "period": int(message.period),
                "mode": int(message.mode),
            }
            self._note(TRUE, matcher.recorded(first + count - 1, recorded))

    def _on_cmv(self, message: Any) -> None:
        comparison = self.result.cmv
        if comparison is None:
            return
        before = self._recorded_cmv
        if not self._selection.meter and self._last is not None:
            before = self._last.alone(self._last.cmv)
        if before is None:
            comparison.unmatched += 1
        else:
            comparison.add({"cmv": float(message.data)}, {"cmv": before})

    def _on_exciter(self, message: Any) -> None:
        self._amplitude_m = float(message.amplitude)

    def _on_further(self, name: str, message: Any) -> None:
        """Compare with the last value computed: such a message comes right after ``meter`` and its samples."""
        comparison, last = self.result.further, self._last
        if comparison is None:
            return
        recorded = float(message.data)
        if last is None or self._recorded_sample not in (None, last.last_sample):
            comparison.unmatched += 1
        elif math.isnan(recorded) or not last.status & (Status.WINDOW_FILLING | Status.GAP):
            comparison.add({name: recorded}, {name: last.alone(last.further[name])})
        else:
            comparison.window_incomplete += 1

    def _note(self, kind: str, found: tuple[int, Mapping[str, float]] | None) -> None:
        """Write a matched value into the history."""
        if found is not None:
            row, values = found
            self.result.history.note(
                row, {f"{kind}_cmv": values["cmv"], f"{kind}_rmv": values["rmv"]}
            )

    def _warn(self) -> None:
        """Say what makes the values less than they seem."""
        result = self.result
        per_turn = round(self._samples_per_turn)
        if per_turn not in (0, self._count) and abs(self._samples_per_turn - per_turn) < 1e-6:
            result.warnings.append(
                f"the stream has {per_turn} samples per revolution, not {self._count}, which are interpolated: "
                f"evaluate it with --samples-per-rev {per_turn}"
            )
        if self._other_window:
            result.warnings.append(
                f"the recorded meter has a window of {self._other_window} revolutions, not of "
                f"{result.window_revolutions}: the values need not agree"
            )
        if result.imu_rate is not None:
            phase = np.exp(1j * result.history.floats("fundamental_phase_rad"))
            window = result.window_revolutions
            turn = np.abs(np.angle(phase[window:] * np.conj(phase[:-window])))
            if np.count_nonzero(turn > DRIFT_RAD) * 5 > np.count_nonzero(np.isfinite(turn)) > 0:
                result.warnings.append(
                    "the fundamental's phase drifts: the excitation does not stay at "
                    f"{result.imu_rate.excitation_hz:.3f} Hz, so the values are not exact"
                )


def _quantities(value: MeterValue) -> dict[str, float]:
    """Return what of a value is compared."""
    return {
        "cmv": value.cmv,
        "rmv": value.rmv,
        "fundamental_amplitude": value.fundamental_amplitude,
        "period": value.period,
        "mode": int(value.mode),
    }


def _ignore(_share: float) -> None:
    """Show no progress."""
