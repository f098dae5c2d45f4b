# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the page shows, from the bytes of the topics; knows no ROS and no network."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rosbags.serde import SerdeError

from roller_sim_ros.panel.frames import packed
from roller_sim_ros.panel.track import Track
from roller_sim_ros.parameters import (
    PARAMETERS,
    SAMPLES_PER_REVOLUTION,
    Configuration,
    ParameterError,
    Value,
)
from roller_sim_ros.report.displacement import twice_integrated, without_sinking
from roller_sim_ros.wire import topics
from roller_sim_ros.wire.types import decode

WINDOW_REVOLUTIONS = 16
"""Revolutions of spectrum and orbit: as many as a meter's window has by default."""
SHOWN_REVOLUTIONS = 4
"""Of these, what orbit and loop draw: one period of a quad jump."""
HIGHEST_ORDER = 6
MOST_NEW = 4096
"""Samples of a frame at most: more than a screen has pixels, where simulated time runs fast."""
HISTORY = 12_000
"""Revolutions that are kept: five minutes at 40 Hz."""

TOPICS = (
    topics.ACCELERATION,
    topics.TRUTH,
    topics.METER,
    topics.SITE_STATE,
    topics.EXCITER_STATE,
    topics.FAULTS,
    topics.MACHINE,
    topics.SOIL,
    topics.DIAGNOSTICS,
)
"""What the picture is made from."""

_TURN = 2.0 * math.pi
_OF_THE_MACHINE = ("machine.", "half_space.", "sampling.", "exciter.kind", "exciter.tilt_rad")

Row = tuple[float, float, float, float, float]


class Picture:
    """The roller as far as its topics have told.

    Parameters
    ----------
    roller : str
        Fully qualified name of its node, by which its diagnostics are known among others'.

    Attributes
    ----------
    facts : dict
        {dotted name: text} of what ``machine`` and ``soil`` have said.
    diagnostics : list
        Entries of the last ``/diagnostics`` of a roller.
    """

    def __init__(self, roller: str) -> None:
        self._roller = roller
        self.facts: dict[str, str] = {}
        self.diagnostics: list[dict[str, Any]] = []
        self._acceleration = Track(("time", "turn", "vertical", "horizontal"), 4 * MOST_NEW)
        self._truth = Track(("height", "force", "horizontal"), MOST_NEW)
        self._turn = 0.0
        self._rate_hz = 0.0
        self._began_s = math.nan
        self._meter: dict[str, Any] = {}
        self._true: dict[str, Any] = {}
        self._site: dict[str, Any] = {}
        self._exciter: dict[str, Any] = {}
        self._faults: list[dict[str, Any]] = []
        self._held_back: list[str] = []
        self._rows: deque[Row] = deque(maxlen=HISTORY)
        self._new_rows: list[Row] = []
        self._anew = True
        self._takers: dict[str, Callable[[Any], None]] = {
            topics.ACCELERATION.name: self._take_acceleration,
            topics.TRUTH.name: self._take_truth,
            topics.METER.name: self._take_meter,
            topics.SITE_STATE.name: self._take_site,
            topics.EXCITER_STATE.name: self._take_exciter,
            topics.FAULTS.name: self._take_faults,
            topics.MACHINE.name: self._take_facts,
            topics.SOIL.name: self._take_facts,
        }

    def take(self, topic: topics.Topic, data: bytes) -> bool:
        """Take a message of one of `TOPICS`, in CDR; return whether it comes from the roller and is whole."""
        try:
            message = decode(data, topic.type_name)
        except SerdeError:
            return False
        if topic is topics.DIAGNOSTICS:
            return self._take_diagnostics(message)
        self._takers[topic.name](message)
        return True

    def configuration(self) -> Configuration | None:
        """Return machine and ground under the drum; None while they are not known."""
        values: dict[str, Value] = {}
        for name, fact in self.facts.items():
            if name.startswith((*_OF_THE_MACHINE, "soil.")) and name in PARAMETERS:
                with suppress(ValueError):
                    values[name] = type(PARAMETERS[name][1])(fact)
        if "machine.drum_mass_kg" not in values or not self._true:
            return None
        for name in ("shear_modulus_pa", "plastic_parameter_m"):
            values[f"soil.{name}"] = self._true[name]
        try:
            return Configuration().changed(values)
        except ParameterError:
            return None

    def frame(self) -> bytes:
        """Return what is new since the last frame."""
        rows, self._new_rows = self._new_rows, []
        anew, self._anew = self._anew, False
        return self._packed(rows, anew=anew)

    def whole(self) -> bytes:
        """Return a frame for a page that has just come: with all of the history."""
        return self._packed([*self._rows], anew=True)

    def state(self) -> dict[str, Any]:
        """Return what changes seldom, for JSON."""
        return {
            "exciter": self._exciter,
            "site": self._site,
            "soil": {
                name: self._true.get(name) for name in ("shear_modulus_pa", "plastic_parameter_m")
            },
            "faults": self._faults,
            "held_back": self._held_back,
            "diagnostics": self.diagnostics,
        }

    def forget(self) -> None:
        """Forget the run: another one has begun."""
        self._acceleration.clear()
        self._truth.clear()
        self._rows.clear()
        self._new_rows.clear()
        self._began_s = math.nan
        self._anew = True

    def _packed(self, rows: list[Row], *, anew: bool) -> bytes:
        track = self._acceleration
        new = min(len(track) if anew else track.new(), MOST_NEW)
        if anew:
            track.new()
        first = len(track) - new
        times = track["time"][first:]
        spectrum = self._spectrum()
        orbit = self._orbit()
        table = np.array(rows, dtype=np.float64).reshape(-1, 5)
        return packed(
            {
                "kind": "frame",
                "anew": anew,
                "first": (track.following or 0) - new,
                "time_s": float(times[0]) if new else None,
                "meter": self._meter,
                "truth": self._true,
            },
            {
                "time": times - times[0] if new else times,
                "vertical": track["vertical"][first:],
                "horizontal": track["horizontal"][first:],
                "spectrum": spectrum,
                **orbit,
                "rows": table.reshape(-1),
            },
        )

    def _spectrum(self) -> NDArray[np.float64]:
        """Return the amplitudes, m/s², of the DFT of the last whole revolutions up to the highest order."""
        turn = self._acceleration["turn"]
        end = math.floor(turn[-1] + 1.0 / SAMPLES_PER_REVOLUTION + 1e-6) if len(turn) else 0
        begin = end - WINDOW_REVOLUTIONS
        if not len(turn) or turn[0] > begin + 1e-6:
            return np.zeros(0)
        # A sensor with a rate of its own does not sample by the eccentric's phase.
        at = begin + np.arange(WINDOW_REVOLUTIONS * SAMPLES_PER_REVOLUTION) / SAMPLES_PER_REVOLUTION
        vertical = np.interp(at, turn, self._acceleration["vertical"])
        amplitudes = 2.0 * np.abs(np.fft.rfft(vertical)) / len(vertical)
        return np.asarray(amplitudes[: HIGHEST_ORDER * WINDOW_REVOLUTIONS + 1])

    def _orbit(self) -> dict[str, NDArray[np.float64]]:
        """Return forward and up displacement, mm, and soil force, kN, of the last whole revolutions."""
        track = self._truth
        following = track.following or 0
        end = len(track) - following % SAMPLES_PER_REVOLUTION
        begin = end - WINDOW_REVOLUTIONS * SAMPLES_PER_REVOLUTION
        if begin < 0 or self._rate_hz <= 0.0:
            return {name: np.zeros(0) for name in ("forward", "up", "force")}
        height, _ = without_sinking(track["height"][begin:end])
        forward = twice_integrated(track["horizontal"][begin:end], self._rate_hz)
        shown = -SHOWN_REVOLUTIONS * SAMPLES_PER_REVOLUTION
        return {
            "forward": forward[shown:] * 1e3,
            "up": (height - height.mean())[shown:] * 1e3,
            "force": track["force"][begin:end][shown:] * 1e-3,
        }

    def _take_acceleration(self, block: Any) -> None:
        track, length = self._acceleration, len(block.vertical)
        phases = (block.eccentric_phase, block.phase_increment, block.sample_period)
        if len(block.horizontal) != length or not all(map(math.isfinite, phases)):
            return
        if track.following is not None and block.sequence < track.following:
            # A fault may let blocks come late or twice; a new run that begins later than here shows in the truth.
            if block.sequence:
                return
            self.forget()
        first_s = _seconds(block.header.stamp)
        if track.following != block.sequence:
            if math.isnan(self._began_s):
                self._began_s = first_s - block.sequence * block.sample_period
            self._turn = block.eccentric_phase / _TURN
        steps = np.arange(length)
        track.append(
            int(block.sequence),
            {
                "time": first_s - self._began_s + steps * block.sample_period,
                "turn": self._turn + steps * (block.phase_increment / _TURN),
                "vertical": block.vertical,
                "horizontal": block.horizontal,
            },
        )
        self._turn += length * block.phase_increment / _TURN

    def _take_truth(self, block: Any) -> None:
        if not len(block.drum_height) == len(block.soil_force) == len(block.horizontal):
            return
        following = self._truth.following
        if following is not None and block.sequence < following:
            self.forget()
        turning = block.excitation_frequency > 0.0 and block.sample_period > 0.0
        self._rate_hz = 1.0 / block.sample_period if turning else 0.0
        self._truth.append(
            int(block.sequence),
            {
                "height": block.drum_height.astype(np.float64) + block.datum,
                "force": block.soil_force,
                "horizontal": block.horizontal,
            },
        )
        self._true = {
            "frequency_hz": block.excitation_frequency,
            "cmv": block.cmv,
            "rmv": block.rmv,
            "mode": int(block.mode),
            "air_fraction": block.air_fraction,
            "force_ratio_max": block.force_ratio_max,
            "shear_modulus_pa": block.shear_modulus,
            "plastic_parameter_m": block.plastic_parameter,
        }

    def _take_meter(self, value: Any) -> None:
        self._meter = {
            "last_sample": int(value.last_sample),
            "cmv": value.cmv,
            "rmv": value.rmv,
            "mode": int(value.mode),
            "period": int(value.period),
            "status": int(value.status),
            "frequency_hz": value.excitation_frequency,
        }
        time_s = _seconds(value.header.stamp) - self._began_s
        chainage_m = self._site.get("chainage_m", math.nan)
        row = (time_s, chainage_m, value.cmv, value.rmv, float(value.mode))
        self._rows.append(row)
        self._new_rows.append(row)
        del self._new_rows[:-HISTORY]

    def _take_site(self, state: Any) -> None:
        self._site = {
            "chainage_m": state.chainage,
            "pass_number": int(state.pass_number),
            "speed_m_s": state.speed,
            "finished": bool(state.finished),
        }

    def _take_exciter(self, state: Any) -> None:
        self._exciter = {
            "vibrating": bool(state.vibrating),
            "commanded_frequency_hz": state.commanded_frequency,
            "commanded_amplitude_m": state.commanded_amplitude,
            "frequency_hz": state.frequency,
            "amplitude_m": state.amplitude,
            "force_n": state.force_amplitude,
            "applied_sample": int(state.applied_sample),
            "refusal": state.refusal_reason,
            "master": int(state.master),
        }

    def _take_faults(self, states: Any) -> None:
        self._faults = [
            {
                "handle": int(item.handle),
                "id": item.id,
                "live": bool(item.live),
                "parameters": dict(zip(item.parameter_names, item.parameter_values, strict=True)),
            }
            for item in states.faults
        ]
        self._held_back = list(states.held_back)

    def _take_facts(self, status: Any) -> None:
        self.facts.update({item.key: item.value for item in status.values})

    def _take_diagnostics(self, array: Any) -> bool:
        entries = [
            {
                "name": item.name.rpartition(": ")[2],
                "level": int(item.level),
                "message": item.message,
                "values": {pair.key: pair.value for pair in item.values},
            }
            for item in array.status
            if item.hardware_id == self._roller
        ]
        if entries:
            self.diagnostics = entries
        return bool(entries)


def _seconds(stamp: Any) -> float:
    return float(stamp.sec + 1e-9 * stamp.nanosec)
