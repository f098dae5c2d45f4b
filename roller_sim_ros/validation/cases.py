# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Statements on single motions: Figures 10, 15 and 17, and the numerical solution."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from roller_sim_ros.meters import Mode
from roller_sim_ros.offline.run import Tail
from roller_sim_ros.parameters import GRAVITY_M_S2
from roller_sim_ros.session.block import AIR
from roller_sim_ros.soil_mechanics import contact_half_width
from roller_sim_ros.validation.statement import Finding, Statement, Verdict, percent
from roller_sim_ros.validation.study import (
    EXAMPLES_PA,
    LONG,
    SOFT,
    STIFF,
    Array,
    Study,
    covarying,
    motion,
    point,
)

_SPEED_M_S = 1.0
"""An example of a travel speed."""

SOFT_RUN = "run --shear-modulus-mpa 35 --plastic-mm 0.8"
STIFF_RUN = "run --shear-modulus-mpa 80 --plastic-mm 0.5"


def order_amplitude(values: Array, order: float, samples_per_revolution: int) -> float:
    """Return the amplitude of values over whole even revolutions at a multiple of the excitation frequency."""
    turns = order * np.arange(len(values)) / samples_per_revolution
    return float(2.0 * np.abs(np.mean(values * np.exp(-2j * math.pi * turns))))


def longest_flight(tail: Tail) -> float:
    """Return the longest stay in the air, revolutions; of a motion that is in contact at some time."""
    air = tail.contact_state == AIR
    # Cut where a contact is, so that no flight is divided by the ends.
    air = np.roll(air, -int(np.argmin(air)))
    edges = np.flatnonzero(np.diff(np.concatenate([[False], air, [False]]).astype(np.int8)))
    lengths = edges[1::2] - edges[::2]
    return float(lengths.max(initial=0)) / tail.samples_per_revolution


def repeats_within(tail: Tail, revolutions: int) -> float:
    """Return how much the acceleration differs after some revolutions, over its peak."""
    shift = revolutions * tail.samples_per_revolution
    change = np.abs(tail.vertical[shift:] - tail.vertical[:-shift]).max()
    return float(change / np.abs(tail.vertical).max())


def stable_on_soft(study: Study) -> Finding:
    """The first diagram of Figure 15."""
    values = point(study.on(SOFT))
    holds = values["period"] == 1 and values["air_fraction"] > 0.0
    change = repeats_within(motion(study.on(SOFT)), 1)
    return Finding.of(
        holds,
        f"period {_period(values['period'])}, in the air {percent(values['air_fraction'])} of each cycle, cycles "
        f"differ by {percent(change, 1)} of the peak after {LONG} revolutions",
    )


def asymmetric(study: Study) -> Finding:
    """Asymmetry of the acceleration and where its peak lies."""
    tail = motion(study.on(SOFT))
    up, down = tail.vertical.max() / GRAVITY_M_S2, tail.vertical.min() / GRAVITY_M_S2
    in_contact = tail.contact_state[int(np.argmax(tail.vertical))] != AIR
    return Finding.of(
        bool(up > -down and in_contact),
        f"{up:.2f} g up, {-down:.2f} g down; the peak is within the blow"
        + ("" if in_contact else ": no, in the air"),
    )


def double_jump(study: Study) -> Finding:
    """The second diagram of Figure 15."""
    values = point(study.on(STIFF))
    period, blows = values["period"], values["blows_per_period"]
    return Finding.of(
        period == 2 and blows == 1,
        f"period {_period(period)}, {_blows(values)}",
        otherwise=Verdict.PARTLY if values["mode"] >= Mode.DOUBLE_JUMP else Verdict.FAILS,
    )


def full_cycle_in_the_air(study: Study) -> Finding:
    """The longest flight on the stiffer ground."""
    flight = longest_flight(motion(study.on(STIFF)))
    return Finding.of(flight >= 1.0, f"the longest flight takes {flight:.2f} revolutions")


def stable_double_jump(study: Study) -> Finding:
    """How well the double jump repeats."""
    change = repeats_within(motion(study.on(STIFF)), 2)
    return Finding.of(
        change < 0.01,
        f"blows differ by {percent(change, 1)} of the peak after {LONG} revolutions",
    )


def halved_frequency(study: Study) -> Finding:
    """Orders of the drum's travel in double jump, and its size."""
    tails = {ground: motion(study.on(ground)) for ground in (SOFT, STIFF)}
    height = tails[STIFF].drum_height
    half, one = (
        order_amplitude(height - height.mean(), order, tails[STIFF].samples_per_revolution)
        for order in (0.5, 1.0)
    )
    travels = [float(np.ptp(tail.drum_height)) * 1e3 for tail in tails.values()]
    return Finding.of(
        half > one and travels[1] > 2.0 * travels[0],
        f"travel at half the excitation frequency {half * 1e3:.1f} mm, at it {one * 1e3:.1f} mm; from top to bottom "
        f"{travels[1]:.1f} mm against {travels[0]:.1f} mm on the softer ground",
    )


def peak_of_double_jump(study: Study) -> Finding:
    """Greatest force of the last example of Figure 17."""
    ratio = point(study.on(STIFF))["force_ratio_max"]
    return Finding.of(
        abs(ratio / 6.9 - 1.0) < 0.02,
        f"{ratio:.2f}, {percent(ratio / 6.9 - 1.0)}",
        otherwise=Verdict.PARTLY if abs(ratio / 6.9 - 1.0) < 0.1 else Verdict.FAILS,
    )


def twice_the_static_load(study: Study) -> Finding:
    """Force ratios of the examples of Figure 17."""
    ratios = [point(study.on(covarying(modulus)))["force_ratio_max"] for modulus in EXAMPLES_PA]
    texts = ", ".join(
        f"{ratio:.2f} at {modulus / 1e6:.0f}"
        for modulus, ratio in zip(EXAMPLES_PA, ratios, strict=True)
    )
    return Finding.of(
        1.8 <= ratios[0] <= 2.2,
        f"{texts} MPa; which grounds the paper drew is lost",
    )


def every_other_cycle(study: Study) -> Finding:
    """Blows of the last example of Figure 17."""
    values = point(study.on(STIFF))
    one_in_two = values["period"] == 2 and values["blows_per_period"] == 1
    return Finding.of(one_in_two, f"{_blows(values)} of {_period(values['period'])}")


def double_separation(study: Study) -> Finding:
    """Distance of the blows on the lane."""
    values = {ground: point(study.on(ground)) for ground in (SOFT, STIFF)}
    frequency = study.base.exciter.frequency_hz
    apart = {
        ground: _SPEED_M_S / frequency * found["period"] / max(found["blows_per_period"], 1.0)
        for ground, found in values.items()
    }
    heavier = values[STIFF]["force_ratio_max"] / values[SOFT]["force_ratio_max"]
    return Finding.of(
        apart[STIFF] == 2.0 * apart[SOFT],
        f"at {_SPEED_M_S:g} m/s {apart[STIFF] * 1e3:.0f} mm apart instead of {apart[SOFT] * 1e3:.0f}; the blows "
        f"{heavier:.1f} times as heavy as on the softer ground",
    )


def fresh_soil(study: Study) -> Finding:
    """Advance per revolution against the width of the contact."""
    configuration = study.on(SOFT)
    radius, plastic = configuration.machine.drum_radius_m, configuration.soil.plastic_parameter_m
    advance = _SPEED_M_S / configuration.exciter.frequency_hz
    still = 2.0 * contact_half_width(plastic, radius)
    blow = 2.0 * contact_half_width(plastic * point(configuration)["force_ratio_max"], radius)
    needed = still * configuration.exciter.frequency_hz
    return Finding.of(
        advance >= still,
        f"at {_SPEED_M_S:g} m/s the drum moves {advance * 1e3:.0f} mm a cycle at 35 MPa; its contact is "
        f"{still * 1e3:.0f} mm wide under the static load and {blow * 1e3:.0f} mm at the peak, so that "
        f"{needed:.1f} m/s would be needed",
    )


def biaxial(study: Study) -> Finding:
    """Horizontal and vertical acceleration on the softer ground."""
    tail = motion(study.on(SOFT))
    exciter = study.base.exciter
    sideways = exciter.amplitude_m * (2.0 * math.pi * exciter.frequency_hz) ** 2 / GRAVITY_M_S2
    up, down = tail.vertical.max() / GRAVITY_M_S2, tail.vertical.min() / GRAVITY_M_S2
    return Finding.of(
        bool(up > sideways),
        f"horizontal ±{sideways:.2f} g, harmonic; vertical −{-down:.2f} to {up:.2f} g: a loop drawn out upwards by the "
        "blow; the paper's numbers are lost",
    )


def directed_exciter(study: Study) -> Finding:
    """The same grounds under a directed exciter."""
    texts, holds = [], True
    for ground in (SOFT, STIFF):
        configuration = study.on(ground)
        directed = replace(configuration, exciter=replace(configuration.exciter, kind="directed"))
        one, other = point(configuration), point(directed)
        holds = holds and one["period"] == other["period"]
        apart = abs(other["force_ratio_max"] / one["force_ratio_max"] - 1.0)
        holds = holds and apart < 0.01
        texts.append(f"greatest force {percent(apart, 1)} apart at {ground[0] / 1e6:.0f} MPa")
    return Finding.of(holds, f"{'; '.join(texts)}: the vertical motion knows no horizontal force")


def no_flight(study: Study) -> Finding:
    """A gentle exciter, and soft ground."""
    gentle = point(study.on(STIFF, amplitude_m=0.1e-3))
    soft = point(study.on(covarying(10e6)))
    return Finding.of(
        gentle["air_fraction"] == 0.0 and soft["air_fraction"] == 0.0,
        f"in the air {percent(gentle['air_fraction'])} of the time at 80 MPa, 0.1 mm and "
        f"{percent(soft['air_fraction'])} at 10 MPa, 1.6 mm",
    )


def energy_lost(study: Study) -> Finding:
    """Where the energy of a cycle goes on the softer ground."""
    configuration = study.on(SOFT)
    tail = motion(configuration)
    load = configuration.machine.static_load_n
    period = tail.samples_per_revolution
    force, depth = tail.soil_force[-period - 1 :], -tail.drum_height[-period - 1 :]
    given = float(np.sum(0.5 * (force[1:] + force[:-1]) * np.diff(depth)))
    peak = float(force.max())
    # Eq. (13): each blow on fresh soil presses the layer from zero to its peak.
    plastic = configuration.soil.plastic_parameter_m * peak**2 / (2.0 * load)
    share = plastic / given
    return Finding.of(
        0.0 < share < 1.0,
        f"of {given:.0f} J that the ground gets per cycle at 35 MPa, {percent(share)} deform the plastic layer and "
        f"{percent(1.0 - share)} leave through the half space",
    )


def time_step(study: Study) -> Finding:
    """The paper's 128 samples per revolution against 512."""
    texts, holds = [], True
    for ground in (SOFT, STIFF):
        coarse = study.on(ground)
        fine = replace(coarse, sampling=replace(coarse.sampling, samples_per_revolution=512))
        one, other = point(coarse), point(fine)
        force = abs(one["force_ratio_max"] / other["force_ratio_max"] - 1.0)
        holds = holds and one["period"] == other["period"] and force < 0.01
        texts.append(f"greatest force {percent(force, 1)} apart at {ground[0] / 1e6:.0f} MPa")
    return Finding.of(holds, f"against 512: {'; '.join(texts)}")


def _period(revolutions: float) -> str:
    return f"{revolutions:.0f}" if revolutions > 0 else "none"


def _blows(values: dict[str, float]) -> str:
    """Return the blows in one period in words."""
    if values["period"] == 0:
        return "blows irregular"
    count = values["blows_per_period"]
    return f"{count:.0f} blow{'s' if count != 1 else ''} in each period"


STATEMENTS = (
    Statement(
        "stable_on_soft",
        "Figure 15, first diagram",
        "at (35 MPa, 0.8 mm) the vibration is stable, the cycles repeat, the drum lifts off in each",
        stable_on_soft,
        SOFT_RUN,
        sensitivity=True,
    ),
    Statement(
        "asymmetric",
        "Figure 15, first diagram",
        "the acceleration is asymmetric: where the drum hits the ground it has its upward peak",
        asymmetric,
        "figures 15",
    ),
    Statement(
        "double_jump",
        "Figure 15, second diagram",
        "at (80 MPa, 0.5 mm) the roller double-jumps: it hits the ground every other cycle",
        double_jump,
        STIFF_RUN,
        sensitivity=True,
    ),
    Statement(
        "full_cycle_in_the_air",
        "Figure 15, second diagram",
        "it makes a full cycle in the air",
        full_cycle_in_the_air,
        "figures 15",
    ),
    Statement(
        "stable_double_jump",
        "Figure 15, second diagram",
        "the vibration is stable",
        stable_double_jump,
        STIFF_RUN,
    ),
    Statement(
        "double_separation",
        "Drum accelerations",
        "very heavy blows hit the ground with double the normal separation",
        double_separation,
        STIFF_RUN,
    ),
    Statement(
        "halved_frequency",
        "Drum accelerations",
        "the fundamental frequency is halved and the amplitude of the drum gets very high",
        halved_frequency,
        "figures 17",
    ),
    Statement(
        "biaxial",
        "Figure 10",
        "a typical result of vertical against horizontal acceleration",
        biaxial,
        "figures 10",
    ),
    Statement(
        "directed_exciter",
        "Roller simulation program",
        "two counter-rotating masses adjusted for vertical forces give similar results",
        directed_exciter,
        f"{STIFF_RUN} --exciter directed",
    ),
    Statement(
        "no_flight",
        "Air phase",
        "it may never occur if the excitation is low or the soil very soft",
        no_flight,
        f"{STIFF_RUN} --amplitude-mm 0.1",
    ),
    Statement(
        "fresh_soil",
        "Soil model",
        "the roller is assumed fast enough to hit fresh soil every cycle",
        fresh_soil,
    ),
    Statement(
        "energy_lost",
        "Soil model",
        "energy is lost both by plastification and in the half space by radiation",
        energy_lost,
        "figures 17",
    ),
    Statement(
        "time_step",
        "Time step size",
        "128 samples per revolution",
        time_step,
        f"{STIFF_RUN} --samples-per-rev 512",
    ),
    Statement(
        "twice_the_static_load",
        "Figure 17",
        "the greatest force varies from twice the static load …",
        twice_the_static_load,
        "figures 17",
    ),
    Statement(
        "peak_of_double_jump",
        "Figure 17",
        "… to 6.9 times, in double jump",
        peak_of_double_jump,
        STIFF_RUN,
        sensitivity=True,
    ),
    Statement(
        "every_other_cycle",
        "Figure 17",
        "in the last case the force occurs only every other cycle",
        every_other_cycle,
        STIFF_RUN,
    ),
)
