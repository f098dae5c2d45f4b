# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What compiled loops take on trust, checked in objects that come out of a file: sizes, types and places of arrays.

A loop that is compiled does not look where an array ends. Objects that are made as usual cannot have others; those
of a forged state could.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from roller_sim_ros.drum_soil import state as at
from roller_sim_ros.drum_soil.exact_ground import ExactGround
from roller_sim_ros.drum_soil.finite_memory import BENDS_SHAPE
from roller_sim_ros.drum_soil.ground import Ground
from roller_sim_ros.drum_soil.modes import ROWS
from roller_sim_ros.drum_soil.rational_ground import RationalGround
from roller_sim_ros.meters.harmonics import HarmonicsWindow
from roller_sim_ros.meters.order_tracking import OrderTracker
from roller_sim_ros.meters.period import PeriodWindow
from roller_sim_ros.meters.revolutions import RevolutionCollector
from roller_sim_ros.meters.truth import TruthMeter
from roller_sim_ros.parameters import SAMPLES_PER_REVOLUTION
from roller_sim_ros.sensors.bandwidth import LowPass
from roller_sim_ros.sensors.bias import GaussMarkov
from roller_sim_ros.sensors.kernels import HALF_WIDTH
from roller_sim_ros.sensors.noise import Noise
from roller_sim_ros.sensors.sampling import FixedRate
from roller_sim_ros.session import Session

N = SAMPLES_PER_REVOLUTION
Shape = tuple[int, ...]


class UnsoundError(Exception):
    """An object is not as compiled loops need it."""


def check(item: object) -> None:
    """Check one object of a state; those that no compiled loop looks into are as they may be.

    Raises
    ------
    UnsoundError
        If a loop would leave an array of it.
    """
    for kind, sound in _CHECKS.items():
        if isinstance(item, kind):
            sound(item)


def _check_session(session: Session) -> None:
    _require(session, session._samples == N)
    _require(session, type(session._next_sample) is int and session._next_sample >= 0)


def _check_ground(ground: Ground) -> None:
    _require(ground, ground._samples == N)
    _array(ground, ground.state, (at.STATE_SIZE,))
    _array(ground, ground._constants, (at.CONSTANTS_SIZE,))
    for angles in (ground._angle, ground._sine, ground._cosine):
        _array(ground, angles, (N + 1,))
    _array(ground, getattr(ground, "_bends", None), BENDS_SHAPE)


def _check_exact(ground: ExactGround) -> None:
    if not ground._answers:
        return  # not begun: the arrays are made with the first revolution
    middle, ramp_2, ramp, step, chord, chord_rate, bulge_rate = ground._answers
    memory = len(chord)
    _array(ground, middle, (3,))
    for answer in (ramp_2, ramp, step):
        _array(ground, answer, (memory + 1,))
    for answer in (chord, chord_rate, bulge_rate):
        _array(ground, answer, (memory,))
    for free in (ground._free, ground._free_rate):
        _array(ground, free, (memory + 1 + N,))


def _check_rational(ground: RationalGround) -> None:
    modes = ground._modes
    _require(ground, isinstance(modes, np.ndarray) and modes.ndim == 2)
    _array(ground, modes, (ROWS, modes.shape[1]), np.complex128)


def _check_collector(collector: RevolutionCollector) -> None:
    _require(collector, collector._count == N)
    _array(collector, collector._samples, (len(collector._samples), N))


def _check_harmonics(window: HarmonicsWindow) -> None:
    waves = 2 * len(window.orders)
    _array(window, window._waves, (N, waves))
    _array(window, window._products, (waves,))
    length = window.window_revolutions
    _array(window, window._turns, (2, length, waves // 2))
    _array(window, window._sums, (2, waves // 2, 2 * length))
    _require(window, type(window._next) is int and 0 <= window._next < length)


def _check_period(window: PeriodWindow) -> None:
    revolutions, candidates = window.window_revolutions, len(window._back)
    _require(window, type(window._pushed) is int and window._pushed >= 0)
    _array(window, window._back, (candidates,), np.int64)
    _array(window, window._revolutions, (revolutions, N))
    _array(window, window._changes, (candidates, revolutions))
    _array(window, window._extremes, (3, revolutions))


def _check_truth(meter: TruthMeter) -> None:
    window = meter.window_revolutions
    _require(meter, type(meter._revolutions) is int and meter._revolutions >= 0)
    _array(meter, meter._air, (window, N), np.bool_)
    _array(meter, meter._forces, (window,))


def _check_tracker(tracker: OrderTracker) -> None:
    _require(tracker, tracker._count == N)
    _array(tracker, tracker._kept, (len(tracker._kept),))
    if tracker._expected is not None:
        _require(tracker, tracker._kept_from + len(tracker._kept) == tracker._expected)
    for item in tracker._begun:
        _require(tracker, math.isfinite(item.start) and 0.0 < item.length < math.inf)


def _check_drift(drift: GaussMarkov) -> None:
    _array(drift, drift._state, (1,))


def _check_pair_of_states(stage: LowPass | Noise) -> None:
    for state in stage._states:
        _array(stage, state, (2,))


def _check_sampling(sampling: FixedRate) -> None:
    kept, begin = sampling._kept, sampling._kept_from
    _require(sampling, isinstance(kept, np.ndarray) and kept.ndim == 2)
    _array(sampling, kept, (2, kept.shape[1]))
    for revolution in sampling._waiting:
        places = revolution.places
        _array(sampling, places, (len(revolution.times_s),))
        _array(sampling, revolution.sensor_times_s, (len(places),))
        first = HALF_WIDTH - 1 - (N * revolution.number - begin)
        in_order = bool(np.isfinite(places).all() and (np.diff(places) >= 0.0).all())
        _require(sampling, in_order and (not len(places) or places[0] >= first))


def _array(item: object, array: Any, shape: Shape, dtype: type[np.generic] = np.float64) -> None:
    _require(
        item,
        isinstance(array, np.ndarray) and array.shape == shape and array.dtype == np.dtype(dtype),
    )


def _require(item: object, sound: bool) -> None:
    if not sound:
        raise UnsoundError(f"{type(item).__name__} has arrays of wrong size or place")


_CHECKS: dict[type[Any], Callable[[Any], None]] = {
    Session: _check_session,
    Ground: _check_ground,
    ExactGround: _check_exact,
    RationalGround: _check_rational,
    RevolutionCollector: _check_collector,
    HarmonicsWindow: _check_harmonics,
    PeriodWindow: _check_period,
    TruthMeter: _check_truth,
    OrderTracker: _check_tracker,
    GaussMarkov: _check_drift,
    LowPass: _check_pair_of_states,
    Noise: _check_pair_of_states,
    FixedRate: _check_sampling,
}
