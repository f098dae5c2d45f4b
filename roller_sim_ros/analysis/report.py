# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""An analysis as a JSON object and as a short table."""

from __future__ import annotations

import math
from collections.abc import Mapping
from datetime import datetime, timezone
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.analysis.comparison import Comparison
from roller_sim_ros.analysis.excerpt import Excerpt
from roller_sim_ros.analysis.result import Analysis
from roller_sim_ros.analysis.samples import NANOSECONDS
from roller_sim_ros.meters import Mode, Status
from roller_sim_ros.meters.harmonics import order_amplitudes
from roller_sim_ros.meters.period import period
from roller_sim_ros.meters.registry import FURTHER, ORDERS, column, evaluate
from roller_sim_ros.parameters import GRAVITY_M_S2
from roller_sim_ros.session.block import AIR

_MEGA = {"Pa": (1e6, "MPa"), "N/m": (1e6, "MN/m")}
"""Units that are shown in millions."""


def as_object(analysis: Analysis) -> dict[str, Any]:
    """Return the analysis as an object of JSON values: numbers that are unknown are None."""
    history = analysis.history
    continuity = analysis.continuity
    status = history.integers("status")
    known = np.isfinite(history.floats("cmv"))
    frequency = history.floats("excitation_frequency_hz")
    found: dict[str, Any] = {
        "bag": str(analysis.path),
        "complete": not analysis.damage,
        "damage": analysis.damage,
        "topic": analysis.selection.source.name,
        "type": analysis.selection.source.type,
        "messages": dict(sorted(analysis.messages.items())),
        "start_time": datetime.fromtimestamp(
            analysis.start_ns / NANOSECONDS, timezone.utc
        ).isoformat(),
        "duration_s": analysis.duration_s,
        "samples": continuity.samples,
        "samples_per_revolution": analysis.samples_per_revolution,
        "excitation_hz": _range(frequency),
        "gaps": continuity.gaps,
        "missing_samples": continuity.missing,
        "duplicate_blocks": continuity.duplicates,
        "out_of_order_blocks": continuity.out_of_order,
        "restarts": continuity.restarts,
        "stamp_error_max_s": analysis.stamp_error_s,
        "window_revolutions": analysis.window_revolutions,
        "values": len(history),
        "values_known": int(np.count_nonzero(known)),
        "status": {
            bit.label: int(np.count_nonzero(status & bit))
            for bit in Status
            if bit and np.any(status & bit)
        },
        "cmv": _range(history.floats("cmv")),
        "rmv": _range(history.floats("rmv")),
        **{column(meter): _range(history.floats(column(meter))) for meter in FURTHER},
        "periods": _periods(history.integers("period")[known], history.integers("mode")[known]),
        "modes": {
            Mode(int(number)).label: count
            for number, count in _counts(history.integers("mode")[known]).items()
        },
        "settled": None if analysis.excerpt is None else _settled(analysis),
        "recorded_meter": _compared(analysis.meter),
        "recorded_cmv": _compared(analysis.cmv),
        "recorded_further": _compared(analysis.further),
        "truth": _compared(analysis.truth),
        "warnings": analysis.warnings,
    }
    if analysis.imu_rate is not None:
        found["imu_excitation_hz"] = analysis.imu_rate.excitation_hz
    return {name: _plain(value) for name, value in found.items()}


def _settled(analysis: Analysis) -> dict[str, Any]:
    excerpt = analysis.excerpt
    assert excerpt is not None
    offset = GRAVITY_M_S2 if analysis.specific_force else 0.0
    vertical = excerpt.vertical - offset
    harmonics = order_amplitudes(vertical, ORDERS, excerpt.samples_per_revolution)
    values: dict[str, Any] = {
        "last_sample": excerpt.first_sample + len(vertical) - 1,
        "revolutions": excerpt.revolutions,
        "excitation_hz": excerpt.excitation_hz,
        "period": period(vertical, excerpt.samples_per_revolution),
        **evaluate(harmonics),
        "acceleration_max_g": float(vertical.max()) / GRAVITY_M_S2,
        "acceleration_min_g": float(vertical.min()) / GRAVITY_M_S2,
        **_soil(excerpt),
    }
    return values


def _soil(excerpt: Excerpt) -> dict[str, Any]:
    if excerpt.soil_force is None or excerpt.contact_state is None:
        return {}
    return {
        "soil_force_max_n": float(excerpt.soil_force.max()),
        "air_fraction": float(np.mean(excerpt.contact_state == AIR)),
    }


def _range(values: NDArray[np.float64]) -> dict[str, float] | None:
    known = values[np.isfinite(values)]
    if not len(known):
        return None
    return {
        "min": float(known.min()),
        "median": float(np.median(known)),
        "max": float(known.max()),
        "last": float(known[-1]),
    }


def _counts(values: NDArray[np.int64]) -> dict[str, int]:
    numbers, counts = np.unique(values, return_counts=True)
    return {str(int(number)): int(count) for number, count in zip(numbers, counts, strict=True)}


def _periods(periods: NDArray[np.int64], modes: NDArray[np.int64]) -> dict[str, int]:
    """Return how often each period was found; 0 means none, or unknown where the mode is unknown too."""
    unknown = (periods == 0) & (modes == Mode.UNKNOWN)
    counts = _counts(periods[~unknown])
    if "0" in counts:
        counts["none"] = counts.pop("0")
    if np.any(unknown):
        counts["unknown"] = int(np.count_nonzero(unknown))
    return counts


def _compared(comparison: Comparison | None) -> dict[str, Any] | None:
    if comparison is None:
        return None
    return {
        "pairs": comparison.pairs,
        "unmatched": comparison.unmatched,
        "window_incomplete": comparison.window_incomplete,
        "max_difference": {
            name: difference.largest for name, difference in comparison.differences.items()
        },
        "one_unknown": {
            name: difference.one_unknown for name, difference in comparison.differences.items()
        },
        "disagreements": dict(comparison.disagreements),
    }


def _plain(value: Any) -> Any:
    """Return a value without NaN, which JSON does not have."""
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, dict):
        return {name: _plain(item) for name, item in value.items()}
    return value


def as_table(report: Mapping[str, Any]) -> str:
    """Return the table of a report made by `as_object`."""
    rows: list[tuple[str, str]] = [
        ("bag", f"{report['bag']}{'' if report['complete'] else ' (not whole)'}"),
        ("topic", f"{report['topic']} ({report['type']})"),
        ("start", report["start_time"]),
        ("duration", f"{report['duration_s']:.3f} s, {report['samples']} samples"),
        ("stream", _stream(report)),
        ("excitation", _frequency(report["excitation_hz"])),
        ("meter values", _values(report)),
        ("CMV", _spread(report["cmv"])),
        ("RMV", _spread(report["rmv"])),
        *((meter.label, _spread(report[column(meter)], meter.unit)) for meter in FURTHER),
        ("mode", _shares(report["modes"], report["values_known"])),
        ("period", _shares(report["periods"], report["values_known"])),
    ]
    if (settled := report["settled"]) is not None:
        rows.append((f"last {settled['revolutions']} rev.", _settled_text(settled)))
    for name, title in (
        ("recorded_meter", "recorded meter"),
        ("recorded_cmv", "recorded CMV"),
        ("recorded_further", "other values"),
        ("truth", "truth"),
    ):
        if report[name] is not None:
            rows.append((title, _agreement(report[name])))
    rows += [("note", text) for text in report["warnings"]]
    width = max(len(title) for title, _ in rows)
    return "\n".join(f"{title:<{width}}  {text}" for title, text in rows)


def _stream(report: Mapping[str, Any]) -> str:
    counted = [
        (report["gaps"], f"gaps ({report['missing_samples']} samples missing)"),
        (report["duplicate_blocks"], "duplicate blocks"),
        (report["out_of_order_blocks"], "blocks out of order"),
        (report["restarts"], "restarts of the sender"),
    ]
    found = [f"{count} {text}" for count, text in counted if count]
    text = ", ".join(found) or "no gaps, no duplicates, all in order"
    return f"{text}; stamps within {report['stamp_error_max_s'] * 1e6:.3g} µs of the sample count"


def _frequency(values: Mapping[str, float] | None) -> str:
    if values is None:
        return "unknown: no whole revolution"
    if values["min"] == values["max"]:
        return f"{values['last']:.6g} Hz"
    return f"{values['min']:.6g} to {values['max']:.6g} Hz, at the end {values['last']:.6g} Hz"


def _values(report: Mapping[str, Any]) -> str:
    text = (
        f"{report['values']}, over {report['window_revolutions']} revolutions each; "
        f"{report['values_known']} known"
    )
    reasons = ", ".join(f"{name} {count}" for name, count in report["status"].items())
    return f"{text} ({reasons})" if reasons else text


def _spread(values: Mapping[str, float] | None, unit: str = "") -> str:
    if values is None:
        return "unknown"
    scale, shown = _MEGA.get(unit, (1.0, unit))
    last, median, low, high = (
        f"{values[name] / scale:.2f}" for name in ("last", "median", "min", "max")
    )
    return f"last {last}, median {median}, {low} to {high} {shown}".rstrip()


def _shares(counts: Mapping[str, int], total: int) -> str:
    if not total:
        return "unknown"
    ordered = sorted(counts.items(), key=lambda item: -item[1])
    return ", ".join(f"{name} {count / total:.0%}" for name, count in ordered)


def _settled_text(settled: Mapping[str, Any]) -> str:
    period_text = {None: "unknown", 0: "none"}.get(settled["period"], str(settled["period"]))
    text = (
        f"CMV {settled['cmv']:.3f}, RMV {settled['rmv']:.3f}, period {period_text}, "
        f"{settled['acceleration_min_g']:.3f} to {settled['acceleration_max_g']:.3f} g"
    )
    if "air_fraction" in settled:
        text += (
            f", {settled['air_fraction']:.1%} in the air, "
            f"force up to {settled['soil_force_max_n'] / 1e3:.1f} kN"
        )
    return text


def _agreement(compared: Mapping[str, Any]) -> str:
    parts = [f"{compared['pairs']} values compared"]
    parts += [
        f"{name.replace('_', ' ')} within {value:.3g}"
        for name, value in compared["max_difference"].items()
        if value is not None
    ]
    parts += [
        f"{name.replace('_', ' ')} known to one side only {count}×"
        for name, count in compared["one_unknown"].items()
        if count
    ]
    parts += [
        f"{name} differs {count}×" for name, count in compared["disagreements"].items() if count
    ]
    if compared["window_incomplete"]:
        parts.append(f"{compared['window_incomplete']} with a window that the bag does not hold")
    if compared["unmatched"]:
        parts.append(f"{compared['unmatched']} without counterpart")
    return ", ".join(parts)
