# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a run says: a JSON object and a short table."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from roller_sim_ros.meters import Summary, summarise
from roller_sim_ros.offline.run import Tail
from roller_sim_ros.parameters import Configuration

NO_REVOLUTIONS = ("period", "cmv", "rmv", "blows_per_period", "mode")
"""What has no meaning where the samples are not revolutions of the eccentric at one frequency."""


def as_object(configuration: Configuration, tail: Tail, revolutions: int) -> dict[str, Any]:
    """Return the settled values and the parameters of a run as an object of JSON values.

    Values that are unknown are None; ``notes`` says why.

    Parameters
    ----------
    configuration : Configuration
        As the run began.
    tail : Tail
        Its last revolutions.
    revolutions : int
        Revolutions of the whole run.
    """
    summary = summarise(
        tail.vertical,
        tail.soil_force,
        tail.contact_state,
        configuration.machine.static_load_n,
        tail.samples_per_revolution,
    )
    values: dict[str, Any] = {
        "period": summary.period,
        "force_ratio_max": summary.force_ratio_max,
        "cmv": summary.cmv,
        "rmv": summary.rmv,
        "acceleration_max_g": summary.acceleration_max_g,
        "acceleration_min_g": summary.acceleration_min_g,
        "air_fraction": summary.air_fraction,
        "blows_per_period": summary.blows_per_period,
        "mode": summary.mode.label,
    }
    if not tail.synchronous:
        values.update(dict.fromkeys(NO_REVOLUTIONS))
    return {
        **{name: _plain(value) for name, value in values.items()},
        "revolutions": revolutions,
        "summary_revolutions": tail.revolutions,
        "duration_s": tail.duration_s,
        "excitation_hz": float(tail.excitation_hz[-1]),
        "notes": _notes(configuration, tail, summary),
        "parameters": configuration.flat(),
    }


def as_table(report: Mapping[str, Any]) -> str:
    """Return the table of a report made by `as_object`."""
    parameters = report["parameters"]
    mode = "unknown" if report["mode"] is None else report["mode"]
    rows = [
        ("excitation", _excitation(report)),
        (
            "ground",
            (
                f"G {parameters['soil.shear_modulus_pa'] / 1e6:g} MPa, "
                f"p {parameters['soil.plastic_parameter_m'] * 1e3:g} mm, "
                f"half space {parameters['half_space.model']}"
            ),
        ),
        (
            "run",
            (
                f"{report['revolutions']} revolutions, {report['duration_s']:.3f} s; "
                f"below: the last {report['summary_revolutions']}"
            ),
        ),
        ("mode", f"{mode}, period {_period(report['period'])}"),
        ("CMV", _number(report["cmv"], 3)),
        ("RMV", _number(report["rmv"], 3)),
        ("F_max/F_stat", _number(report["force_ratio_max"], 4)),
        (
            "acceleration",
            f"{_number(report['acceleration_min_g'], 4)} to {_number(report['acceleration_max_g'], 4)} g",
        ),
        ("in the air", f"{100.0 * report['air_fraction']:.2f} %"),
    ]
    rows += [("note", note) for note in report["notes"]]
    width = max(len(title) for title, _ in rows)
    return "\n".join(f"{title:<{width}}  {text}" for title, text in rows)


def _notes(configuration: Configuration, tail: Tail, summary: Summary) -> list[str]:
    """Return why values are unknown."""
    unknown = "period, CMV and RMV are unknown"
    floor_hz = configuration.sampling.floor_hz
    first_hz, last_hz = float(tail.excitation_hz[0]), float(tail.excitation_hz[-1])
    if tail.synchronous:
        return [] if summary.period is not None else ["too few revolutions to tell the period"]
    if first_hz == last_hz == 0.0:
        why = f"the eccentric stands: {unknown}"
    elif max(first_hz, last_hz) < floor_hz:
        why = (
            f"below the sampling floor of {floor_hz:g} Hz, {tail.samples_per_revolution} samples are "
            f"1/{floor_hz:g} s and no revolution of the eccentric: {unknown}"
        )
    else:
        why = (
            f"the frequency changed within the last {tail.revolutions} revolutions, "
            f"{first_hz:.4g} to {last_hz:.4g} Hz: {unknown}; run more revolutions"
        )
    return [why]


def _excitation(report: Mapping[str, Any]) -> str:
    parameters = report["parameters"]
    commanded = f"{parameters['exciter.frequency_hz']:g} Hz"
    if not parameters["exciter.vibrate"]:
        commanded = "none"
    text = f"{report['excitation_hz']:.6g} Hz, {parameters['exciter.amplitude_m'] * 1e3:g} mm"
    if f"{report['excitation_hz']:g} Hz" != commanded:
        text += f" (commanded: {commanded})"
    return text


def _period(period: int | None) -> str:
    return {None: "unknown", 0: "none"}.get(period, str(period))


def _number(value: float | None, digits: int) -> str:
    return "unknown" if value is None else f"{value:.{digits}f}"


def _plain(value: Any) -> Any:
    """Return a value without NaN, which JSON does not have."""
    return None if isinstance(value, float) and not math.isfinite(value) else value
