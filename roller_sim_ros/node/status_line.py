# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What the user of ``roller-sim sim`` reads: a line a second, and a summary at the end."""

from __future__ import annotations

from roller_sim_ros.meters import Mode
from roller_sim_ros.node.report import RecordingReport, Report
from roller_sim_ros.node.roller import Roller
from roller_sim_ros.site import Position
from roller_sim_ros.traces.ring import State


def status_line(report: Report) -> str:
    """Return the line of a report."""
    drive = report.drive
    if drive is None:
        return "not active" + _recording(report.recording)
    exciter, meter = drive.exciter, drive.meter
    cmv, rmv = (f"{meter.cmv:5.1f}", f"{meter.rmv:5.1f}") if meter else ("    –", "    –")
    mode = meter.mode if meter else Mode.UNKNOWN
    line = (
        f"{exciter.frequency_hz:5.2f} Hz {exciter.amplitude_m * 1e3:5.3f} mm  "
        f"G {drive.shear_modulus_pa / 1e6:5.1f} MPa  p {drive.plastic_parameter_m * 1e3:5.3f} mm  "
        f"CMV {cmv}  RMV {rmv}  {mode.name.lower().replace('_', ' '):18}  "
        f"{_where(drive.position)}{_pace(report)}"
    )
    if report.unsent:
        line += f", {report.unsent} messages not sent"
    return line + _recording(report.recording)


def _where(position: Position | None) -> str:
    if position is None:
        return ""
    if position.finished:
        return "all driven  "
    return f"pass {position.pass_number} {position.chainage_m:6.2f} m  "


def _pace(report: Report) -> str:
    if report.paused:
        drive = report.drive
        return f"paused at {drive.simulated_s if drive else 0.0:.3f} s"
    pace = f"×{report.real_time_factor:5.3f}"
    if not report.recent.blocks:
        return pace
    return f"{pace}  late p99 {report.recent.p99_s * 1e3:5.2f} ms, {report.total.late} blocks"


def summary(roller: Roller) -> str:
    """Return what is said at the end."""
    report = roller.last_report
    if report is None or report.drive is None:
        return "stopped before the roller ran" + _recorded(roller.last_recording)
    total = report.total
    lateness = (
        f" in {total.blocks} blocks, "
        f"{total.late} late; lateness p50 {total.p50_s * 1e3:.2f}, p99 {total.p99_s * 1e3:.2f}, "
        f"p99.9 {total.p999_s * 1e3:.2f}, max {total.max_s * 1e3:.2f} ms"
    )
    return (
        f"ran {report.drive.simulated_s:.1f} s: {report.drive.samples} samples{lateness if total.blocks else ''}; "
        f"{report.refused} commands refused"
        + (f", {report.unsent} messages not sent" if report.unsent else "")
        + _recorded(roller.last_recording)
    )


def _recording(recording: RecordingReport | None) -> str:
    if recording is None:
        return "  not recording"
    if recording.status.state is State.FAILED:
        return f"  RECORDING FAILED: {recording.status.reason}"
    dropped = f", {recording.dropped} dropped" if recording.dropped else ""
    return f"  rec {recording.status.bytes_written / 1e6:.1f} MB{dropped}"


def _recorded(recording: RecordingReport | None) -> str:
    if recording is None:
        return ""
    status = recording.status
    if status.state is State.FAILED:
        return f"\nrecording failed: {status.reason}; {status.lost} messages lost"
    return (
        f"\nrecorded {recording.path}: {status.messages_written} messages, "
        f"{status.bytes_written / 1e6:.1f} MB, {recording.dropped} dropped"
    )
