# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Two-pole runs side by side in the lanes of one core, each until it repeats or has run its revolutions.

All lanes are at the same sample of the revolution. Whole steps are taken by `two_pole_lanes`; where a phase changes,
the lane's step is split as everywhere, by `contact.split_step`. A lane whose run is over takes the next one.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil.contact import split_step
from roller_sim_ros.drum_soil.modes import Modes
from roller_sim_ros.jit import njit
from roller_sim_ros.sweep import lane_rows as of
from roller_sim_ros.sweep.lane_rows import EMPTY, LANES, Array, load, unload
from roller_sim_ros.sweep.records import DEPTH, FORCE, PHASE, VERTICAL
from roller_sim_ros.sweep.repetition import WATCH_ROWS, begin_watch, repeats
from roller_sim_ros.sweep.two_pole_lanes import step_in_air, step_loading, step_unloading

Counts = NDArray[np.int64]

# What is known of a lane's run: its number, −1 for none; revolutions done; how many are being recorded, and are.
_RUN, _DONE, _RECORDING, _RECORDED = range(4)


class LaneMemory:
    """Scratch of `settle`, to be used again."""

    def __init__(self) -> None:
        self.lanes = np.zeros(of.SIZE)
        self.runs = np.zeros((LANES, 4), dtype=np.int64)
        self.watches = np.zeros((LANES, WATCH_ROWS, at.STATE_SIZE))


@njit
def settle(
    constants: Array,
    states: Array,
    scales: Array,
    before: int,
    kept: int,
    early_stop: bool,
    sine: Array,
    cosine: Array,
    modes: Modes,
    bends: Array,
    lanes: Array,
    runs: Counts,
    watches: Array,
    places: Counts,
    samples: Array,
    recorded: Counts,
    computed: Counts,
) -> None:
    """Step runs over their revolutions, all alike, and record the last ones.

    Parameters
    ----------
    constants : ndarray, shape (runs, CONSTANTS_SIZE)
        Of each run's revolutions, which are of constant amplitude and begin at phase zero.
    states : ndarray, shape (runs, STATE_SIZE)
        Physical states at the start; on return at the end.
    scales : ndarray, shape (runs, STATE_SIZE)
        Sizes of the states' values, see `repetition`.
    before, kept : int
        Revolutions before those that are recorded, and those.
    early_stop : bool
        Record one period, and no more, of a motion that repeats to rounding.
    sine, cosine : ndarray, shape (samples per revolution + 1,)
        Of the eccentric.
    modes, bends : ndarray
        As the kernels take them.
    lanes, runs, watches : ndarray
        Scratch, see `LaneMemory`.
    places : ndarray of int, shape (runs,)
        Places of the runs in what follows.
    samples, recorded, computed : ndarray
        Receive what `Records` has; `computed` is added to.
    """
    in_revolution = sine.shape[0] - 1
    following = 0
    for n in range(LANES):
        runs[n, _RUN] = -1
        lanes[of.PHASE + n] = EMPTY
        lanes[of.CHANGES + n] = 0.0
    while True:
        busy = 0
        recording = False
        for n in range(LANES):
            if runs[n, _RUN] < 0 and following < states.shape[0]:
                load(lanes, n, states[following], constants[following])
                begin_watch(scales[following], watches[n])
                runs[n, _RUN] = following
                runs[n, _DONE] = 0
                runs[n, _RECORDING] = kept if before == 0 else 0
                runs[n, _RECORDED] = 0
                following += 1
            busy += 1 if runs[n, _RUN] >= 0 else 0
            recording = recording or (runs[n, _RUN] >= 0 and runs[n, _RECORDING] > 0)
        if busy == 0:
            return
        loading, unloading, air = _phases(lanes)
        for j in range(in_revolution):
            if recording:
                _record(lanes, runs, j, sine[j], places, samples)
            waiting = 0
            if loading > 0:
                waiting += step_loading(lanes, sine[j], cosine[j])
            if unloading > 0:
                waiting += step_unloading(lanes, sine[j], cosine[j])
            if air > 0:
                waiting += step_in_air(lanes, sine[j], cosine[j])
            if waiting > 0:
                _split(lanes, sine[j], cosine[j], modes, bends)
                loading, unloading, air = _phases(lanes)
        for n in range(LANES):
            if runs[n, _RUN] >= 0:
                _end_revolution(
                    lanes,
                    n,
                    runs[n],
                    watches[n],
                    states,
                    before,
                    kept,
                    early_stop,
                    places,
                    recorded,
                    computed,
                )


@njit
def _phases(lanes: Array) -> tuple[int, int, int]:
    """Return how many lanes are loading, unloading and in the air."""
    loading, unloading, air = 0, 0, 0
    for n in range(LANES):
        phase = lanes[of.PHASE + n]
        loading += 1 if phase == at.LOADING else 0
        unloading += 1 if phase == at.UNLOADING else 0
        air += 1 if phase == at.AIR else 0
    return loading, unloading, air


@njit
def _record(
    lanes: Array, runs: Counts, j: int, sine: float, places: Counts, samples: Array
) -> None:
    """Record sample j of the lanes that are being recorded."""
    for n in range(LANES):
        if runs[n, _RUN] >= 0 and runs[n, _RECORDING] > 0:
            rows = samples[places[runs[n, _RUN]], runs[n, _RECORDED]]
            force, load_n = lanes[of.FORCE + n], lanes[of.STATIC_LOAD + n]
            rows[VERTICAL, j] = (
                lanes[of.AMPLITUDE + n] * sine + (force - load_n) / lanes[of.MASS + n]
            )
            rows[FORCE, j] = force
            rows[DEPTH, j] = lanes[of.DEPTH + n]
            rows[PHASE, j] = lanes[of.PHASE + n]


@njit
def _split(lanes: Array, sine: float, cosine: float, modes: Modes, bends: Array) -> None:
    """Take the step of the lanes that wait, their phase changes located."""
    for n in range(LANES):
        if lanes[of.CHANGES + n] == 0.0:
            continue
        lanes[of.CHANGES + n] = 0.0
        phase, state, _, unsettled = split_step(
            int(lanes[of.PHASE + n]),
            (
                lanes[of.DEPTH + n],
                lanes[of.VELOCITY + n],
                lanes[of.FORCE + n],
                lanes[of.SURFACE + n],
                lanes[of.SURFACE_RATE + n],
                lanes[of.PLASTIC + n],
                lanes[of.DATUM + n],
            ),
            lanes[of.STEP + n],
            (
                lanes[of.MASS + n],
                lanes[of.STATIC_LOAD + n],
                lanes[of.PLASTIC_COMPLIANCE + n],
            ),
            (lanes[of.OMEGA + n], sine, cosine, lanes[of.AMPLITUDE + n], 0.0),
            at.TWO_POLE,
            (0.0, 0.0, 0.0, 0.0, 0.0, 0.0),
            (0.0, 0.0),
            (
                lanes[of.NATURAL_FREQUENCY + n],
                lanes[of.QUALITY + n],
                lanes[of.COMPLIANCE + n],
            ),
            modes,
            bends,
            (
                lanes[of.NEXT_SLOPE_START + n],
                lanes[of.NEXT_SLOPE_END + n],
                lanes[of.NEXT_DEPTH + n],
                lanes[of.NEXT_VELOCITY + n],
                lanes[of.NEXT_FORCE + n],
                lanes[of.NEXT_SURFACE + n],
                lanes[of.NEXT_SURFACE_RATE + n],
            ),
        )
        lanes[of.DEPTH + n] = state[0]
        lanes[of.VELOCITY + n] = state[1]
        lanes[of.FORCE + n] = state[2]
        lanes[of.SURFACE + n] = state[3]
        lanes[of.SURFACE_RATE + n] = state[4]
        lanes[of.PLASTIC + n] = state[5]
        lanes[of.DATUM + n] = state[6]
        lanes[of.PHASE + n] = phase
        lanes[of.UNSETTLED + n] += unsettled


@njit
def _end_revolution(
    lanes: Array,
    n: int,
    run: Counts,
    watch: Array,
    states: Array,
    before: int,
    kept: int,
    early_stop: bool,
    places: Counts,
    recorded: Counts,
    computed: Counts,
) -> None:
    """Decide at the end of a revolution whether a lane's run goes on, is recorded from now on, or is over."""
    state = states[run[_RUN]]
    unload(lanes, n, state)
    run[_DONE] += 1
    if run[_RECORDING] > 0:
        run[_RECORDED] += 1
        if run[_RECORDED] == run[_RECORDING]:
            recorded[places[run[_RUN]]] = run[_RECORDED]
            computed[places[run[_RUN]]] += run[_DONE]
            run[_RUN] = -1
            lanes[of.PHASE + n] = EMPTY
        return
    period = repeats(state, watch) if early_stop else 0
    if period > 0 and (before - run[_DONE]) % period == 0:
        # What is recorded ends where the whole run would end in the period.
        run[_RECORDING] = period
    elif run[_DONE] == before:
        run[_RECORDING] = kept
