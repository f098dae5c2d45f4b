# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a run of a scenario says: a JSON object, a table of the passes, a CSV of the map."""

from __future__ import annotations

import csv
import math
from collections.abc import Mapping
from dataclasses import fields
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.meters import Mode
from roller_sim_ros.offline.scenario_run import ScenarioRun
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.scenario import Scenario, SiteMap
from roller_sim_ros.scenario.metadata import scenario_hash


def as_object(scenario: Scenario, configuration: Configuration, run: ScenarioRun) -> dict[str, Any]:
    """Return the passes and the parameters of a run as an object of JSON values; unknown ones are None.

    Parameters
    ----------
    scenario : Scenario
        What was run.
    configuration : Configuration
        As the run began.
    run : ScenarioRun
        What came of it.
    """
    site_map = run.site_map
    return {
        "scenario": {
            "title": scenario.title,
            "path": scenario.path,
            "sha256": scenario_hash(scenario),
            "seed": scenario.seed,
        },
        "finished": run.finished,
        "revolutions": len(site_map),
        "duration_s": run.duration_s,
        "passes": [
            _pass_object(site_map.of_pass(int(number)), int(number))
            for number in np.unique(site_map.pass_number)
        ],
        "parameters": configuration.flat(),
    }


def as_table(report: Mapping[str, Any]) -> str:
    """Return the table of a report made by `as_object`."""
    head = ("pass", "m", "G MPa", "p mm", "CMV", "RMV max", "F_max/F_stat", "modes")
    rows = [head, *(_pass_row(item) for item in report["passes"])]
    widths = [max(len(row[column]) for row in rows) for column in range(len(head) - 1)]
    lines = [
        "  ".join([*(text.rjust(width) for text, width in zip(row, widths, strict=False)), row[-1]])
        for row in rows
    ]
    scenario = report["scenario"]
    end = "" if report["finished"] else ", cut short"
    title = (
        f"{scenario['title'] or scenario['path']}: {report['revolutions']} revolutions, "
        f"{report['duration_s']:.2f} s{end}; seed {scenario['seed']}"
    )
    return "\n".join([title, *lines])


def write_csv(site_map: SiteMap, path: Path) -> None:
    """Write the map, one row a revolution, SI units in the names; what is unknown stays empty.

    Raises
    ------
    RollerSimError
        If the file cannot be written.
    """
    names = [item.name for item in fields(site_map) if item.name != "window_revolutions"]
    columns = [getattr(site_map, name).tolist() for name in names]
    try:
        with path.open("w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(["revolution", *names])
            for index, row in enumerate(zip(*columns, strict=True)):
                writer.writerow([index, *("" if value != value else value for value in row)])
    except OSError as error:
        raise RollerSimError(f"{path}: cannot be written: {error.strerror or error}") from None


def _pass_object(part: SiteMap, number: int) -> dict[str, Any]:
    modes = {
        mode.label: float(np.mean(part.mode == mode)) for mode in Mode if np.any(part.mode == mode)
    }
    return {
        "pass": number,
        "revolutions": len(part),
        "from_m": float(part.chainage_m[0]),
        "to_m": float(part.chainage_m[-1]),
        "shear_modulus_pa": _statistics(part.shear_modulus_pa),
        "plastic_parameter_m": _statistics(part.plastic_parameter_m),
        "cmv": _statistics(part.cmv),
        "rmv": _statistics(part.rmv),
        "force_ratio_max": _statistics(part.force_ratio_max)["maximum"],
        "mode_shares": modes,
    }


def _statistics(values: NDArray[np.float64]) -> dict[str, float | None]:
    known = values[np.isfinite(values)]
    if len(known) == 0:
        return {"mean": None, "minimum": None, "maximum": None}
    return {
        "mean": float(known.mean()),
        "minimum": float(known.min()),
        "maximum": float(known.max()),
    }


def _pass_row(item: Mapping[str, Any]) -> tuple[str, ...]:
    shares = sorted(item["mode_shares"].items(), key=lambda pair: -pair[1])
    return (
        str(item["pass"]),
        f"{item['from_m']:.1f}–{item['to_m']:.1f}",
        _range(item["shear_modulus_pa"], 1e-6, 1),
        _range(item["plastic_parameter_m"], 1e3, 2),
        _range(item["cmv"], 1.0, 1),
        _number(item["rmv"]["maximum"], 1),
        _number(item["force_ratio_max"], 1),
        ", ".join(f"{name} {100 * share:.0f} %" for name, share in shares if share >= 0.005),
    )


def _range(values: Mapping[str, float | None], scale: float, digits: int) -> str:
    low, high = values["minimum"], values["maximum"]
    if low is None or high is None:
        return "unknown"
    texts = [f"{value * scale:.{digits}f}" for value in (low, high)]
    return texts[0] if texts[0] == texts[1] else "–".join(texts)


def _number(value: float | None, digits: int) -> str:
    return "unknown" if value is None or math.isnan(value) else f"{value:.{digits}f}"
