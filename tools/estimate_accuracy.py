# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""How well the ground is estimated back: round trips, and what wrong assumptions do (`docs/estimate.md`).

`python -m tools.estimate_accuracy [--write]`; some minutes on one core.
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.estimate import WindowEstimate, estimate_window
from roller_sim_ros.estimate.low_pass import low_pass, passed
from roller_sim_ros.offline.run import run, step_whole_revolutions
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION, Configuration
from roller_sim_ros.sensors.sheet import G
from tools.markdown_table import table
from tools.sections import write_section

Array = NDArray[np.float64]

PAGE = Path(__file__).resolve().parent.parent / "docs" / "estimate.md"
REVOLUTIONS = 600
WINDOW = 16

RANGE_M_S2 = 50.0 * G
STEP_M_S2 = 2.0 * RANGE_M_S2 / 2**12
NOISE_M_S2 = 0.005 * RANGE_M_S2
"""A sensor of ±50 g with 12 bits, and noise of 0.5 % of its range on every sample."""

UNKNOWN = {"soil.shear_modulus_pa": 50e6, "soil.plastic_parameter_m": 1e-3}
"""What an estimate is told of the ground: nothing that is so."""


@dataclass(frozen=True)
class Trip:
    """A ground, and a window of the motion on it.

    Attributes
    ----------
    configuration : Configuration
        With the true G and p.
    window : ndarray, shape (16, 128)
        Vertical acceleration, m/s².
    """

    configuration: Configuration
    window: Array

    def with_noise(self, draw: np.random.Generator) -> Array:
        """Return the window as the sensor shows it."""
        noisy = self.window + NOISE_M_S2 * draw.standard_normal(self.window.shape)
        held = np.clip(np.round(noisy / STEP_M_S2) * STEP_M_S2, -RANGE_M_S2, RANGE_M_S2 - STEP_M_S2)
        return np.asarray(held)

    def errors(self, found: WindowEstimate) -> tuple[float, float]:
        """Return the relative errors of G and p."""
        soil = self.configuration.soil
        return (
            found.shear_modulus_pa / soil.shear_modulus_pa - 1.0,
            found.plastic_parameter_m / soil.plastic_parameter_m - 1.0,
        )


def random_trips(model: str, count: int, seed: int) -> list[Trip]:
    """Return settled motions inside the paper's ranges, periodic or not.

    15 … 40 Hz, 0.1 … 2.5 mm, G 15 … 120 MPa, p 0.7 … 1.4 times that of the power law through Figure 14's points.
    """
    draw = np.random.default_rng(seed)
    trips = []
    for _ in range(count):
        modulus = draw.uniform(15e6, 120e6)
        configuration = Configuration().changed(
            {
                "half_space.model": model,
                "exciter.frequency_hz": draw.uniform(15.0, 40.0),
                "exciter.amplitude_m": draw.uniform(1e-4, 2.5e-3),
                "soil.shear_modulus_pa": modulus,
                "soil.plastic_parameter_m": 0.8e-3
                * (modulus / 35e6) ** -0.5686
                * draw.uniform(0.7, 1.4),
            }
        )
        step = step_whole_revolutions(configuration, run_up=False)
        tail = run(step, REVOLUTIONS, SAMPLES_PER_REVOLUTION, lambda _: None)
        rows = tail.vertical.reshape(-1, SAMPLES_PER_REVOLUTION)
        trips.append(Trip(configuration, rows[-WINDOW:]))
    return trips


def round_trip(
    trips: Sequence[Trip], noise_seed: int | None = None
) -> list[tuple[Trip, WindowEstimate, float]]:
    """Return each with its estimate and the CPU time that took, s; without noise when there is no seed."""
    draw = None if noise_seed is None else np.random.default_rng(noise_seed)
    results = []
    for trip in trips:
        window = trip.window if draw is None else trip.with_noise(draw)
        begin = time.thread_time()
        found = estimate_window(window, trip.configuration.changed(UNKNOWN))
        results.append((trip, found, time.thread_time() - begin))
    return results


def _percent(value: float) -> str:
    percent = 100.0 * value
    return f"{percent:.2g}" if percent > 1e-3 else "< 0.001"


def _signed(value: float) -> str:
    text = f"{100.0 * value:+.1f}"
    return "0.0" if float(text) == 0.0 else text.replace("-", "−")


def _round_trip_rows(count: int) -> list[tuple[str, ...]]:
    rows: list[tuple[str, ...]] = []
    for model, points in (("exact", count), ("two-pole", count), ("rational", count)):
        trips = random_trips(model, points, seed=5)
        for name, seed in (("none", None), ("0.5 %, 12 bit", 6)):
            results = round_trip(trips, seed)
            told = [(trip, found) for trip, found, _ in results if found.status.stands]
            errors = np.abs([trip.errors(found) for trip, found in told])
            spreads = np.array(
                [
                    (
                        found.shear_modulus_spread_pa / found.shear_modulus_pa,
                        found.plastic_spread_m / found.plastic_parameter_m,
                    )
                    for _, found in told
                ]
            )
            median, high = np.median(errors, axis=0), np.percentile(errors, 90, axis=0)
            within = (errors <= 2.0 * spreads + 1e-4).mean(axis=0)
            times = np.array(
                [taken for _, found, taken in results if np.isfinite(found.misfit_m_s2)]
            )
            rows.append(
                (
                    model,
                    name,
                    f"{len(told)} of {points}",
                    f"{_percent(median[0])} / {_percent(high[0])}",
                    f"{_percent(median[1])} / {_percent(high[1])}",
                    f"{100 * within[0]:.0f} / {100 * within[1]:.0f}",
                    f"{np.median(times):.3f} / {times.max():.2f}",
                )
            )
            print(*rows[-1], sep=" | ", flush=True)
    return rows


Assumption = Callable[[Configuration], Configuration]


def _scaled(name: str, factor: float) -> Assumption:
    return lambda known: known.changed({name: known.flat()[name] * factor})  # type: ignore[operator]


def _mass(factor: float) -> Assumption:
    """Another drum mass with the same eccentric moment: the nominal amplitude goes with its inverse."""
    return lambda known: known.changed(
        {
            "machine.drum_mass_kg": known.machine.drum_mass_kg * factor,
            "exciter.amplitude_m": known.exciter.amplitude_m / factor,
        }
    )


def _model(**values: object) -> Assumption:
    return lambda known: known.changed(
        {f"half_space.{name}": value for name, value in values.items()}
    )


ASSUMPTIONS: dict[str, Assumption] = {
    "what is so (`exact`)": lambda known: known,
    "`rational`, order 4": _model(model="rational", order=4),
    "`rational`, order 6": _model(model="rational", order=6),
    "`two-pole`": _model(model="two-pole"),
    "k 5 % more": _scaled("half_space.area_factor", 1.05),
    "k 5 % less": _scaled("half_space.area_factor", 0.95),
    "drum mass 5 % more": _mass(1.05),
    "drum mass 5 % less": _mass(0.95),
    "eccentric moment 5 % more": _scaled("exciter.amplitude_m", 1.05),
    "eccentric moment 5 % less": _scaled("exciter.amplitude_m", 0.95),
}
"""What is assumed of a motion on the exact half space."""

SIGNALS: dict[str, Callable[[Trip], Array]] = {
    "sensor reads 1 % more": lambda trip: 1.01 * trip.window,
    "sensor's low-pass of 1 kHz not known": lambda trip: _behind(trip, 1000.0),
}
"""What may be wrong with the samples."""


def _behind(trip: Trip, bandwidth_hz: float) -> Array:
    samples = trip.window.ravel()
    response = low_pass(
        len(samples), len(trip.window), trip.configuration.exciter.frequency_hz, bandwidth_hz
    )
    return passed(samples, response).reshape(trip.window.shape)


def _bias_rows(count: int) -> list[tuple[str, ...]]:
    trips = random_trips("exact", count, seed=7)
    rows = [
        _bias_row(name, trips, assumption, lambda trip: trip.window)
        for name, assumption in ASSUMPTIONS.items()
    ]
    rows += [
        _bias_row(name, trips, lambda known: known, signal) for name, signal in SIGNALS.items()
    ]
    return rows


def _bias_row(
    name: str, trips: Sequence[Trip], assumption: Assumption, signal: Callable[[Trip], Array]
) -> tuple[str, ...]:
    results = []
    for trip in trips:
        known = assumption(trip.configuration.changed(UNKNOWN))
        results.append((trip, estimate_window(signal(trip), known)))
    told = [(trip, found) for trip, found in results if np.isfinite(found.misfit_m_s2)]
    errors = np.array([trip.errors(found) for trip, found in told])
    cells = []
    for column in errors.T:
        low, middle, high = np.percentile(column, [25, 50, 75])
        cells.append(f"{_signed(middle)} ({_signed(low)} … {_signed(high)})")
    stands = np.mean([found.status.stands for _, found in told])
    misfit = np.median([found.misfit_share for _, found in told])
    row = (name, *cells, f"{100 * misfit:.1f}", f"{100 * stands:.0f}")
    print(*row, sep=" | ", flush=True)
    return row


def tables(count: int) -> dict[str, str]:
    """Return {name: Markdown table}."""
    return {
        "round trip": table(
            (
                "half space",
                "noise",
                "stand",
                "error of G, %: median / 90th",
                "error of p, %: median / 90th",
                "within 2 spreads, %: G / p",
                "CPU time, s: median / most",
            ),
            _round_trip_rows(count),
            numbers=True,
        ),
        "bias": table(
            ("assumed", "G off by, %", "p off by, %", "misfit, %", "stand, %"),
            _bias_rows(count // 2),
            numbers=True,
        ),
    }


def main() -> int:
    """Make the tables and show them."""
    parser = argparse.ArgumentParser(prog="python -m tools.estimate_accuracy", description=__doc__)
    parser.add_argument(
        "--points", type=int, default=200, help="random grounds and settings (default %(default)s)"
    )
    parser.add_argument("--write", action="store_true", help="put the tables into docs/estimate.md")
    arguments = parser.parse_args()
    found = tables(arguments.points)
    if arguments.write:
        for name, text in found.items():
            write_section(PAGE, name, text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
