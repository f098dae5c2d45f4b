# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Statements on the plane of frequency and amplitude: Figures 16, 18 and 20."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label

from roller_sim_ros.meters import Mode
from roller_sim_ros.validation.statement import Finding, Statement, Verdict, percent
from roller_sim_ros.validation.study import HIGH_M, LOW_M, Array, Study, amplitude_scan, plane

if TYPE_CHECKING:
    import xarray

BAND_HZ = (15.0, 18.0)
"""Where the paper sees an instability from the resonance."""

_MM = 1e3

_GRADUAL = 0.2
"""Of F_max/F_stat, from one frequency of the map to the next."""


def unstable(found: xarray.Dataset) -> NDArray[np.bool_]:
    """Return where the motion does not repeat every revolution, shape (frequencies, amplitudes)."""
    return np.asarray(
        (found.period.values != 1) & (found["mode"].values != Mode.CONTINUOUS_CONTACT)
    )


def stable(found: xarray.Dataset) -> NDArray[np.bool_]:
    """Return where the drum lifts off and the motion repeats every revolution."""
    return np.asarray(found["mode"].values == Mode.PARTIAL_UPLIFT)


def resonance(found: xarray.Dataset) -> Array:
    """Return the frequency at which the drum lags 90° behind the eccentric, Hz, for each amplitude.

    There the ground's stiffness as the meter k_s reads it is that of the drum's inertia, m_d ω²: below it the ground
    governs, above it the mass. NaN where the plane has no such frequency; the first one where it has several.
    """
    frequency = found.frequency_hz.values
    mass_kg = float(found.attrs["machine.drum_mass_kg"])
    excess = found.k_s.values - (mass_kg * (2.0 * math.pi * frequency) ** 2)[:, np.newaxis]
    at = np.full(found.sizes["amplitude_m"], np.nan)
    for column in range(len(at)):
        values = excess[:, column]
        falls = np.flatnonzero((values[:-1] > 0.0) & (values[1:] <= 0.0))
        if len(falls):
            first = int(falls[0])
            share = values[first] / (values[first] - values[first + 1])
            at[column] = frequency[first] + share * (frequency[first + 1] - frequency[first])
    return at


def first_amplitudes(found: xarray.Dataset, periods: tuple[int, ...]) -> Array:
    """Return the least amplitude, m, at which the motion has one of some periods; shape (frequencies,), NaN: none."""
    has = np.isin(found.period.values, periods) & unstable(found)
    amplitudes = found.amplitude_m.values
    return np.array([amplitudes[int(np.argmax(row))] if row.any() else math.nan for row in has])


def longer_periods(found: xarray.Dataset) -> NDArray[np.bool_]:
    """Return the region of period 4 and more that reaches farthest to the left, single points left out."""
    longer = unstable(found) & (found.period.values != 2)
    parts, count = label(longer, structure=np.ones((3, 3)))
    smallest = max(3, longer.size // 2000)
    leftmost = sorted(
        (int(np.flatnonzero((parts == number).any(axis=1))[0]), number)
        for number in range(1, count + 1)
        if np.count_nonzero(parts == number) >= smallest
    )
    return np.asarray(parts == leftmost[0][1]) if leftmost else np.zeros_like(longer)


def doubling(study: Study) -> Finding:
    """What comes as the amplitude rises at the nominal frequency."""
    amplitude, period = amplitude_scan(study)
    firsts = {}
    for name, periods in (("double jump", (2,)), ("quad jump", (4,)), ("chaos", (8, 0))):
        # Two in a row: where a region begins, a single point may not have settled.
        has = np.isin(period, periods)
        begins = np.flatnonzero(has[:-1] & has[1:])
        firsts[name] = float(amplitude[begins[0]]) if len(begins) else math.nan
    two, four, none = firsts.values()
    text = ", ".join(
        f"{name} from {first * _MM:.2f} mm" if math.isfinite(first) else f"no {name}"
        for name, first in firsts.items()
    )
    return Finding.of(
        two < four < none,
        f"{study.base.exciter.frequency_hz:g} Hz: {text}",
        otherwise=Verdict.PARTLY if two < none else Verdict.FAILS,
    )


def doubling_everywhere(study: Study) -> Finding:
    """Order in which double jump, quad jump and chaos come at each frequency of the plane."""
    found = plane(study)
    two, four, none = (first_amplitudes(found, periods) for periods in ((2,), (4,), (8, 0)))
    chaotic = np.isfinite(none)
    if not chaotic.any():
        return Finding(Verdict.FAILS, "no chaos")
    by_two = float(np.mean((two < none)[chaotic]))
    by_four = float(np.mean(((two < four) & (four < none))[chaotic]))
    return Finding.of(
        by_four > 0.8,
        f"of the frequencies with chaos {percent(by_two, 3)} come to it by double jump, {percent(by_four, 3)} by "
        "double and quad jump; the others lie where regions end",
        otherwise=Verdict.PARTLY if by_two > 0.5 else Verdict.FAILS,
    )


def settling(study: Study) -> Finding:
    """Revolutions until the motion repeats to rounding."""
    found = plane(study)
    settled = found.period.values > 0
    computed = found.revolutions_computed.values[settled]
    stops = computed < study.revolutions
    middle = float(np.median(computed[stops])) if stops.any() else math.nan
    return Finding.of(
        middle > 20.0,
        f"half of the points that settle repeat to rounding after {middle:.0f} revolutions, "
        f"{percent(float(np.mean(~stops)))} take more than {study.revolutions}",
    )


def resonance_falls(study: Study) -> Finding:
    """Frequency of the resonance against amplitude."""
    found = plane(study)
    at, amplitude = resonance(found), found.amplitude_m.values * _MM
    known = np.isfinite(at)
    if np.count_nonzero(known) < 3:
        return Finding(Verdict.FAILS, "no resonance between 15 and 40 Hz")
    values = at[known]
    within = amplitude[known][(values >= BAND_HZ[0]) & (values <= BAND_HZ[1])]
    text = f"{values[0]:.1f} Hz at {amplitude[known][0]:.1f} mm to {values[-1]:.1f} Hz at {amplitude[known][-1]:.2f} mm"
    if len(within):
        text += f"; at 15–18 Hz from {within[0]:.2f} to {within[-1]:.2f} mm"
    return Finding.of(bool(np.all(np.diff(values) < 0.05)), text)


def instability_at_resonance(study: Study) -> Finding:
    """What is unstable at 15 to 18 Hz, and where longer periods begin."""
    found = plane(study)
    frequency, amplitude = found.frequency_hz.values, found.amplitude_m.values * _MM
    band = (frequency >= BAND_HZ[0]) & (frequency <= BAND_HZ[1])
    inside = unstable(found)[band]
    text = f"{percent(float(inside.mean()))} of the band does not repeat every revolution"
    if inside.any():
        rows, columns = np.nonzero(inside)
        text += (
            f", from {amplitude[columns.min()]:.2f} mm and {frequency[band][rows.min()]:.1f} Hz on "
            f"(period {_periods(found.period.values[band][inside])})"
        )
    part = longer_periods(found)
    columns = np.flatnonzero(part.any(axis=0))
    if len(columns):
        ends = [
            f"{frequency[int(np.argmax(part[:, column]))]:.1f} Hz at {amplitude[column]:.2f} mm"
            for column in (columns[0], columns[-1])
        ]
        text += f"; the left edge of longer periods goes from {ends[0]} to {ends[1]}"
    share = float(inside.mean())
    return Finding.of(share > 0.1, text, otherwise=Verdict.PARTLY if share > 0.0 else Verdict.FAILS)


def edge_falls(study: Study) -> Finding:
    """Lowest frequency of the instability against amplitude."""
    found = plane(study)
    frequency, amplitude = found.frequency_hz.values, found.amplitude_m.values * _MM
    columns = np.flatnonzero(unstable(found).any(axis=0))
    if len(columns) < 3:
        return Finding(Verdict.FAILS, "no instability")
    edge = frequency[[int(np.argmax(unstable(found)[:, column])) for column in columns]]
    # Single points may lie off: one step of the grid is no rise.
    step = 1.01 * (frequency[1] - frequency[0])
    return Finding.of(
        bool(np.all(np.diff(edge) <= step) and edge[-1] < edge[0]),
        f"the instability's lowest frequency falls from {edge[0]:.1f} Hz at {amplitude[columns[0]]:.2f} mm to "
        f"{edge[-1]:.1f} Hz at {amplitude[columns[-1]]:.2f} mm",
        otherwise=Verdict.PARTLY if edge[-1] < edge[0] else Verdict.FAILS,
    )


def three_to_six(study: Study) -> Finding:
    """Greatest soil force over the static one where the vibration is stable."""
    found = plane(study)
    ratio, where = found.force_ratio_mean.values, stable(found)
    if not where.any():
        return Finding(Verdict.FAILS, "no stable vibration with lift-off")
    values = ratio[where]
    strong = ratio[where & (found.amplitude_m.values >= LOW_M)]
    within = float(np.mean((strong >= 3.0) & (strong <= 6.0)))
    steps = np.abs(np.diff(ratio, axis=0))[where[1:] & where[:-1]]
    text = (
        f"where it is stable and lifts off {values.min():.1f} to {values.max():.1f}; from {LOW_M * _MM:g} mm on "
        f"{percent(within)} of that within 3 and 6. {percent(float(np.mean(steps < _GRADUAL)), 3)} of neighbours are "
        f"less than {_GRADUAL:g} apart, at a fold {steps.max(initial=0.0):.1f}"
    )
    top = 5.0 <= values.max() <= 7.0
    return Finding.of(
        bool(top and np.percentile(values, 5.0) >= 2.7),
        text,
        otherwise=Verdict.PARTLY if top else Verdict.FAILS,
    )


def cmv_varies(study: Study) -> Finding:
    """CMV against frequency on one ground."""
    found = plane(study)
    texts = []
    for amplitude in (LOW_M, HIGH_M):
        row = found.cmv.sel(amplitude_m=amplitude, method="nearest")
        kept = row.values[
            stable(found)[:, int(np.argmin(np.abs(found.amplitude_m.values - amplitude)))]
        ]
        texts.append(
            f"{kept.min():.0f} to {kept.max():.0f} at {amplitude * _MM:g} mm" if len(kept) else ""
        )
    cmv = found.cmv.values[stable(found)]
    return Finding.of(
        bool(len(cmv)) and float(np.ptp(cmv)) > 10.0,
        f"where the vibration is stable: {', '.join(text for text in texts if text)}",
    )


def _periods(values: NDArray[Any]) -> str:
    """Return the periods that occur, as a reader wants them."""
    names = {0: "none"}
    found = sorted({int(value) for value in values}, key=lambda value: value or math.inf)
    return ", ".join(names.get(value, str(value)) for value in found)


MAP = (
    "sweep --shear-modulus-mpa 80 --plastic-mm 0.5 --frequency-hz 15:40:101 "
    "--amplitude-mm 0.1:2.5:101 --out map.nc"
)

STATEMENTS = (
    Statement(
        "doubling",
        "Vibration stability, Figure 16",
        "with more amplitude there come period doubling, quad jump, chaos",
        doubling,
        "figures 16",
        sensitivity=True,
    ),
    Statement(
        "doubling_everywhere",
        "Vibration stability, Figure 16",
        "the same at every frequency",
        doubling_everywhere,
        "figures 16",
    ),
    Statement(
        "settling",
        "Vibration stability",
        "the vibration needs many periods to settle",
        settling,
        MAP,
    ),
    Statement(
        "instability_at_resonance",
        "Vibration stability, Figure 16",
        "to the left, at 15–18 Hz, there is an instability from the drum/soil resonance",
        instability_at_resonance,
        "figures 16",
        sensitivity=True,
    ),
    Statement(
        "resonance_falls",
        "Vibration stability",
        "the frequency of this resonance falls with the amplitude",
        resonance_falls,
        "figures 16",
        sensitivity=True,
    ),
    Statement(
        "edge_falls",
        "Vibration stability",
        "the same of the instability itself",
        edge_falls,
        "figures 16",
    ),
    Statement(
        "three_to_six",
        "Figure 18",
        "F_max/F_stat varies gradually from 3 to 6 in the area of stable vibration",
        three_to_six,
        "figures 18",
        sensitivity=True,
    ),
    Statement(
        "cmv_varies",
        "Figure 20",
        "CMV varies with frequency, all else constant",
        cmv_varies,
        "figures 20",
    ),
)
