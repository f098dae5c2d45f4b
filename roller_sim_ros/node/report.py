# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the node tells of itself once a second, for the diagnostics and for the status line."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from roller_sim_ros.emulation import Emulator
from roller_sim_ros.meters import MeterValue
from roller_sim_ros.node.clock_owner import said
from roller_sim_ros.node.lateness import LatenessSummary
from roller_sim_ros.scenario import Scenario
from roller_sim_ros.session import ExciterStatus
from roller_sim_ros.site import Position
from roller_sim_ros.traces.recorder import RecorderStatus
from roller_sim_ros.traces.ring import State
from roller_sim_ros.wire.messages import Diagnostic, Level


@dataclass(frozen=True)
class Drive:
    """What an active roller does.

    Attributes
    ----------
    simulated_s : float
        Time since it was activated, by its samples.
    samples : int
        Since it was activated.
    sample_period_s : float
        Now.
    shear_modulus_pa, plastic_parameter_m : float
        The ground under the drum.
    exciter : ExciterStatus
        What the exciter does and was told.
    meter : MeterValue or None
        Last value.
    unsettled_steps : int
        Steps whose phase changes did not settle.
    finite : bool
        Whether the motion is still given in numbers.
    position : Position or None
        Where the roller is on its lane; none: there is no scenario.
    """

    simulated_s: float
    samples: int
    sample_period_s: float
    shear_modulus_pa: float
    plastic_parameter_m: float
    exciter: ExciterStatus
    meter: MeterValue | None
    unsettled_steps: int
    finite: bool
    position: Position | None

    @classmethod
    def of(cls, emulator: Emulator, scenario: Scenario | None) -> Drive | None:
        """Return what an emulator's roller does, once it has done something."""
        block = emulator.block
        if block is None:
            return None
        return cls(
            simulated_s=block.time_s + len(block) * block.sample_period_s,
            samples=block.first_sample + len(block),
            sample_period_s=block.sample_period_s,
            shear_modulus_pa=block.shear_modulus_pa,
            plastic_parameter_m=block.plastic_parameter_m,
            exciter=emulator.session.exciter_status(),
            meter=emulator.meter_value,
            unsettled_steps=emulator.session.unsettled_steps,
            finite=bool(np.isfinite(block.acceleration_vertical).all()),
            position=None if scenario is None else emulator.session.site.position,
        )


@dataclass(frozen=True)
class RecordingReport:
    """How the recording is doing.

    Attributes
    ----------
    path : str
        The file.
    status : RecorderStatus
        What the recorder says.
    problems : dict
        Topics that cannot be recorded, and why.
    awaited : tuple of str
        Topics that nobody publishes yet.
    """

    path: str
    status: RecorderStatus
    problems: dict[str, str]
    awaited: tuple[str, ...]

    @property
    def dropped(self) -> int:
        """Messages that were refused because the hand-over was full or the recording had failed."""
        return sum(self.status.dropped.values())


@dataclass(frozen=True)
class Report:
    """What the node tells of itself.

    Attributes
    ----------
    node : str
        Fully qualified name.
    drive : Drive or None
        None while the roller is not active.
    paused : bool
        Whether it is active and time stands still.
    simulated_time : bool
        Whether time is that of the samples.
    rivals : tuple of str
        Nodes that publish ``/clock`` beside this one.
    recent, total : LatenessSummary
        Lateness of the blocks since the last report and since the roller was activated.
    unsent, recently_unsent : int
        Messages that the middleware refused to send since the node was configured and since the last report.
    real_time_factor : float
        Simulated over real time since the last report; NaN when unknown.
    realtime : tuple of str
        What was tried for real time, and what came of it.
    recording : RecordingReport or None
        None: nothing is recorded.
    refused : int
        Commands refused since the node began.
    refusal : str
        Why the last of them was, or what the watchdog did; empty: nothing of the kind.
    refusing : bool
        Whether that happened after the last accepted command.
    travel_refused, travel_refusal, travel_refusing
        The same of travel commands.
    """

    node: str
    drive: Drive | None
    paused: bool
    simulated_time: bool
    rivals: tuple[str, ...]
    recent: LatenessSummary
    total: LatenessSummary
    unsent: int
    recently_unsent: int
    real_time_factor: float
    realtime: tuple[str, ...]
    recording: RecordingReport | None
    refused: int
    refusal: str
    refusing: bool
    travel_refused: int
    travel_refusal: str
    travel_refusing: bool


def diagnostics(report: Report) -> list[Diagnostic]:
    """Return the entries of ``/diagnostics``."""
    entries = [_pacing(report), _exciter(report), _travel(report), _recording(report)]
    return [*entries, _clock(report)] if report.simulated_time else entries


def _pacing(report: Report) -> Diagnostic:
    drive, recent = report.drive, report.recent
    level, message = Level.OK, "on time"
    if drive is None:
        level, message = Level.OK, "not active"
    elif not drive.finite:
        level, message = Level.ERROR, "the motion is no number any more: deactivate and activate"
    elif report.recently_unsent:
        level, message = Level.ERROR, f"{report.recently_unsent} messages could not be sent"
    elif drive.unsettled_steps:
        level, message = Level.WARN, f"{drive.unsettled_steps} steps did not settle"
    elif report.paused:
        level, message = Level.OK, "paused"
    elif recent.late:
        level, message = Level.WARN, f"{recent.late} of {recent.blocks} blocks late"
    return Diagnostic(
        name=f"{report.node}: pacing",
        level=level,
        message=message,
        values={
            "sample_rate_hz": 1.0 / drive.sample_period_s if drive else math.nan,
            "lateness_p50_s": recent.p50_s,
            "lateness_p99_s": recent.p99_s,
            "lateness_max_s": recent.max_s,
            "late_blocks": report.total.late,
            "blocks": report.total.blocks,
            "unsent_messages": report.unsent,
            "samples": drive.samples if drive else 0,
            "real_time_factor": report.real_time_factor,
            "unsettled_steps": drive.unsettled_steps if drive else 0,
            "realtime": "; ".join(report.realtime) or "not asked for",
        },
        hardware_id=report.node,
    )


def _exciter(report: Report) -> Diagnostic:
    exciter = report.drive.exciter if report.drive else None
    return Diagnostic(
        name=f"{report.node}: exciter",
        level=Level.WARN if report.refusing else Level.OK,
        message=report.refusal if report.refusing else _does(report),
        values={
            "frequency_hz": exciter.frequency_hz if exciter else 0.0,
            "amplitude_m": exciter.amplitude_m if exciter else 0.0,
            "refused_commands": report.refused,
            "last_refused_command": report.refusal or "none",
        },
        hardware_id=report.node,
    )


def _travel(report: Report) -> Diagnostic:
    refusing = report.travel_refusing
    return Diagnostic(
        name=f"{report.node}: travel",
        level=Level.WARN if refusing else Level.OK,
        message=report.travel_refusal if refusing else "nothing refused",
        values={
            "refused_commands": report.travel_refused,
            "last_refused_command": report.travel_refusal or "none",
        },
        hardware_id=report.node,
    )


def _clock(report: Report) -> Diagnostic:
    return Diagnostic(
        name=f"{report.node}: clock",
        level=Level.WARN if report.rivals else Level.OK,
        message=said(report.rivals) if report.rivals else "no other publishes /clock",
        hardware_id=report.node,
    )


def _does(report: Report) -> str:
    if report.drive is None:
        return "not active"
    return "vibrating" if report.drive.exciter.vibrating else "not vibrating"


def _recording(report: Report) -> Diagnostic:
    name = f"{report.node}: recording"
    recording = report.recording
    if recording is None:
        return Diagnostic(name=name, message="nothing is recorded", hardware_id=report.node)
    status = recording.status
    level, message = Level.OK, f"{status.state.name.lower()} {recording.path}"
    if status.state is State.FAILED:
        level, message = Level.ERROR, status.reason
    elif recording.dropped:
        level, message = Level.ERROR, f"{recording.dropped} messages dropped"
    elif recording.problems:
        reasons = (f"{topic} is not recorded: {why}" for topic, why in recording.problems.items())
        level, message = Level.ERROR, "; ".join(reasons)
    elif recording.awaited:
        level = Level.WARN
        message = f"nobody publishes {', '.join(recording.awaited)} yet"
    return Diagnostic(
        name=name,
        level=level,
        message=message,
        values={
            "path": recording.path,
            "state": status.state.name.lower(),
            "messages": status.messages,
            "messages_written": status.messages_written,
            "bytes_written": status.bytes_written,
            "dropped": recording.dropped,
            **{f"dropped {topic}": count for topic, count in status.dropped.items() if count},
            "lost": status.lost,
        },
        hardware_id=report.node,
    )
