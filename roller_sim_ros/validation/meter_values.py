# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Statements on CMV: Figure 19."""

from __future__ import annotations

import math

import numpy as np

from roller_sim_ros.meters import Mode
from roller_sim_ros.validation.statement import Finding, Statement, Verdict
from roller_sim_ros.validation.study import (
    HIGH_M,
    LOW_M,
    Array,
    Study,
    cmv_curves,
    covarying,
    settled,
)

_LOW, _HIGH = 0, 1

_FINE_BEFORE_PA, _FINE_BEHIND_PA, _FINE_STEP_PA = 1e6, 7e6, 0.1e6


def low_never_jumps(study: Study) -> Finding:
    """Modes at the low amplitude."""
    modulus, values = cmv_curves(study)
    jumps = values["mode"][_LOW] > Mode.PARTIAL_UPLIFT
    where = f"from {modulus[np.argmax(jumps)] / 1e6:.0f} MPa on" if jumps.any() else ""
    return Finding.of(
        not jumps.any(),
        f"{LOW_M * 1e3:g} mm: " + (f"jumps {where}" if where else "period 1 from 15 to 120 MPa"),
    )


def low_rises(study: Study) -> Finding:
    """CMV at the low amplitude."""
    _, values = cmv_curves(study)
    cmv = values["cmv"][_LOW]
    return Finding.of(
        bool(np.all(np.diff(cmv) > 0.0)), f"CMV {cmv[0]:.0f} at 15 MPa to {cmv[-1]:.0f} at 120"
    )


def high_jumps(study: Study) -> Finding:
    """Double jump and the fall of CMV at the high amplitude."""
    modulus, values = cmv_curves(study)
    cmv, jumps = values["cmv"][_HIGH], values["mode"][_HIGH] == Mode.DOUBLE_JUMP
    if not jumps.any():
        return Finding(Verdict.FAILS, "no double jump")
    onset = int(np.argmax(jumps))
    peak, low = _dip(cmv)
    return Finding.of(
        cmv[low] < 0.8 * cmv[peak],
        f"double jump from {modulus[onset] / 1e6:.0f} MPa on; CMV {cmv[peak]:.0f} at {modulus[peak] / 1e6:.0f} MPa "
        f"falls to {cmv[low]:.0f} at {modulus[low] / 1e6:.0f}",
    )


def discontinuity(study: Study) -> Finding:
    """Greatest step of CMV behind its dip, in a fine scan."""
    modulus, values = cmv_curves(study)
    _, low = _dip(values["cmv"][_HIGH])
    fine = np.arange(modulus[low] - _FINE_BEFORE_PA, modulus[low] + _FINE_BEHIND_PA, _FINE_STEP_PA)
    scan = settled(
        [study.on(covarying(float(value)), amplitude_m=HIGH_M) for value in fine],
        workers=study.workers,
    )
    steps = np.abs(np.diff(scan["cmv"]))
    at = int(np.argmax(steps))
    return Finding.of(
        bool(steps[at] > 3.0 * np.sort(steps)[-2]),
        f"{scan['cmv'][at]:.1f} at {fine[at] / 1e6:.1f} MPa, {scan['cmv'][at + 1]:.1f} at {fine[at + 1] / 1e6:.1f}; "
        f"before it CMV passes {scan['cmv'].min():.0f} steadily",
        otherwise=Verdict.PARTLY,
    )


def high_rises_again(study: Study) -> Finding:
    """CMV at the high amplitude beyond the dip."""
    modulus, values = cmv_curves(study)
    cmv = values["cmv"][_HIGH]
    _, low = _dip(cmv)
    rest = cmv[low:]
    falls = np.flatnonzero(np.diff(rest) < -0.5)
    text = f"CMV {rest[0]:.0f} at {modulus[low] / 1e6:.0f} MPa to {rest[-1]:.0f} at 120"
    if len(falls):
        text += f", but falls at {modulus[low + falls[0]] / 1e6:.0f} MPa"
    return Finding.of(
        not len(falls) and rest[-1] > rest[0],
        text,
        otherwise=Verdict.PARTLY if rest[-1] > rest[0] else Verdict.FAILS,
    )


def high_stays_below(study: Study) -> Finding:
    """CMV at the high amplitude beyond the dip against that at the low one."""
    modulus, values = cmv_curves(study)
    jumps = values["mode"][_HIGH] > Mode.PARTIAL_UPLIFT
    if not jumps.any():
        return Finding(Verdict.FAILS, "no double jump")
    share = values["cmv"][_HIGH] / values["cmv"][_LOW]
    _, low = _dip(values["cmv"][_HIGH])
    text = f"beyond the fall at most {share[low:].max():.2f} of it"
    before = (np.arange(len(share)) < low) & jumps & (share > 1.0)
    if before.any():
        text += (
            f"; above it before the fall, where the double jump begins gently "
            f"({modulus[before][0] / 1e6:.0f} to {modulus[before][-1] / 1e6:.0f} MPa)"
        )
    return Finding.of(bool(np.all(share[low:] < 1.0)), text)


def calibration_amplitude(study: Study) -> Finding:
    """What the same CMV means at the other amplitude."""
    modulus, values = cmv_curves(study)
    at = int(np.argmin(np.abs(modulus - 80e6)))
    high = float(values["cmv"][_HIGH][at])
    read = (
        float(np.interp(high, values["cmv"][_LOW], modulus))
        if np.all(np.diff(values["cmv"][_LOW]) > 0)
        else math.nan
    )
    return Finding.of(
        abs(read / modulus[at] - 1.0) > 0.1,
        f"{modulus[at] / 1e6:.0f} MPa under {HIGH_M * 1e3:g} mm reads as {read / 1e6:.0f} MPa "
        f"on the curve of {LOW_M * 1e3:g} mm",
    )


def _dip(cmv: Array) -> tuple[int, int]:
    """Return where the deepest fall of the curve begins and where it ends."""
    highest = np.maximum.accumulate(cmv)
    low = int(np.argmax(highest - cmv))
    return int(np.argmax(cmv[: low + 1])), low


STATEMENTS = (
    Statement(
        "low_never_jumps",
        "Figure 19",
        "the low amplitude never puts the roller into double jump",
        low_never_jumps,
        "figures 19",
    ),
    Statement(
        "low_rises",
        "Figure 19",
        "at the low amplitude CMV rises monotonously with the stiffness",
        low_rises,
        "figures 19",
        sensitivity=True,
    ),
    Statement(
        "high_jumps",
        "Figure 19",
        "the high amplitude forces it into double jump",
        high_jumps,
        "figures 19",
        sensitivity=True,
    ),
    Statement(
        "discontinuity",
        "Figure 19",
        "there the CMV curve has a discontinuity",
        discontinuity,
    ),
    Statement(
        "high_rises_again",
        "Figure 19",
        "beyond it CMV increases again monotonously",
        high_rises_again,
        "figures 19",
    ),
    Statement(
        "high_stays_below",
        "Figure 19",
        "but never reaches the level it has for the low amplitude",
        high_stays_below,
        "figures 19",
        sensitivity=True,
    ),
    Statement(
        "calibration_amplitude",
        "Compaction meter results",
        "mode and amplitude have to be those of the calibration",
        calibration_amplitude,
        "figures misleading",
    ),
)
