# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What holds for every motion, whatever is commanded and whatever the ground does."""

from __future__ import annotations

import io
import os
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roller_sim_ros.drum_soil import AIR
from roller_sim_ros.jit import DISABLE_VARIABLE
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.session import Block, Session

MODELS = ("exact", "rational", "two-pole")
FREQUENCIES = st.floats(0.0, 60.0)
AMPLITUDES = st.floats(0.0, 4e-3)
SHEAR_MODULI = st.floats(2e6, 1e9)
PLASTIC_PARAMETERS = st.floats(2e-5, 2e-2)

EVENTS = st.lists(
    st.one_of(
        st.tuples(st.just("command"), st.booleans(), FREQUENCIES, AMPLITUDES),
        st.tuples(st.just("soil"), SHEAR_MODULI, PLASTIC_PARAMETERS, st.floats(0.0, 0.49)),
    ),
    min_size=1,
    max_size=6,
)


def _session(
    model: str, frequency_hz: float, amplitude_m: float, modulus: float, plastic: float
) -> Session:
    values = {
        "half_space.model": model,
        "exciter.frequency_hz": frequency_hz,
        "exciter.amplitude_m": amplitude_m,
        "soil.shear_modulus_pa": modulus,
        "soil.plastic_parameter_m": plastic,
    }
    return Session(Configuration().changed(values))


def _apply(session: Session, event: tuple[object, ...]) -> None:
    if event[0] == "command":
        _, vibrate, frequency_hz, amplitude_m = event
        session.command_exciter(
            vibrate=vibrate,  # type: ignore[arg-type]
            frequency_hz=frequency_hz,  # type: ignore[arg-type]
            amplitude_m=amplitude_m,  # type: ignore[arg-type]
        )
    else:
        session.change(
            {
                "soil.shear_modulus_pa": event[1],  # type: ignore[dict-item]
                "soil.plastic_parameter_m": event[2],  # type: ignore[dict-item]
                "soil.poisson_ratio": event[3],  # type: ignore[dict-item]
            }
        )


def _check(block: Block) -> None:
    for name in ("acceleration_vertical", "drum_height", "soil_displacement", "soil_force"):
        assert np.all(np.isfinite(getattr(block, name))), name
    assert np.all(block.soil_force >= 0.0)
    in_air = block.contact_state == AIR
    assert np.all(block.soil_force[in_air] == 0.0)
    gap = block.drum_height - block.soil_displacement + block.plastic_depth + block.height_datum
    scale = 1.0 + np.abs(block.drum_height)
    assert np.all(np.abs(gap[~in_air]) < 1e-9 * scale[~in_air])
    assert np.all(gap[in_air] > -1e-9 * scale[in_air])


@pytest.mark.parametrize("model", MODELS)
@given(
    frequency_hz=FREQUENCIES,
    amplitude_m=AMPLITUDES,
    modulus=SHEAR_MODULI,
    plastic=PLASTIC_PARAMETERS,
    events=EVENTS,
)
@settings(max_examples=40, deadline=None)
def test_no_tension_and_contact_is_contact(
    model: str,
    frequency_hz: float,
    amplitude_m: float,
    modulus: float,
    plastic: float,
    events: list[tuple[object, ...]],
) -> None:
    session = _session(model, frequency_hz, amplitude_m, modulus, plastic)
    for event in events:
        _apply(session, event)
        for _ in range(12):
            _check(session.advance(128))


@pytest.mark.parametrize("model", MODELS)
@given(
    frequency_hz=st.floats(10.0, 50.0),
    amplitude_m=AMPLITUDES,
    modulus=SHEAR_MODULI,
    plastic=PLASTIC_PARAMETERS,
    revolutions=st.integers(1, 20),
    events=EVENTS,
)
@settings(max_examples=40, deadline=None)
def test_a_change_makes_no_step_in_force_or_acceleration(
    model: str,
    frequency_hz: float,
    amplitude_m: float,
    modulus: float,
    plastic: float,
    revolutions: int,
    events: list[tuple[object, ...]],
) -> None:
    # Up to and with the sample at which it takes effect, a run with a change is the run without.
    changed = _session(model, frequency_hz, amplitude_m, modulus, plastic)
    unchanged = _session(model, frequency_hz, amplitude_m, modulus, plastic)
    for _ in range(revolutions):
        changed.advance(128)
        unchanged.advance(128)
    for event in events:
        _apply(changed, event)
    first, same = changed.advance(1), unchanged.advance(1)
    load = changed.configuration.machine.static_load_n
    assert first.soil_force[0] == pytest.approx(same.soil_force[0], abs=1e-9 * load)
    for name in ("acceleration_vertical", "acceleration_horizontal", "drum_height"):
        assert getattr(first, name)[0] == pytest.approx(getattr(same, name)[0], rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("model", MODELS)
@given(
    frequency_hz=st.floats(15.0, 40.0),
    amplitude_m=st.floats(0.0, 2.5e-3),
    modulus=st.floats(15e6, 120e6),
    plastic=st.floats(3e-4, 1.5e-3),
    revolutions=st.integers(1, 20),
    factors=st.tuples(st.floats(0.8, 1.25), st.floats(0.8, 1.25)),
)
@settings(max_examples=40, deadline=None)
def test_the_force_goes_on_as_it_was_on_somewhat_different_ground(
    model: str,
    frequency_hz: float,
    amplitude_m: float,
    modulus: float,
    plastic: float,
    revolutions: int,
    factors: tuple[float, float],
) -> None:
    changed = _session(model, frequency_hz, amplitude_m, modulus, plastic)
    unchanged = _session(model, frequency_hz, amplitude_m, modulus, plastic)
    for _ in range(revolutions):
        changed.advance(128)
        unchanged.advance(128)
    _apply(changed, ("soil", modulus * factors[0], plastic * factors[1], 0.25))
    here, there = changed.advance(4).soil_force, unchanged.advance(4).soil_force
    change, expected = np.abs(np.diff(here)).max(), np.abs(np.diff(there)).max()
    assert change < 2.0 * expected + 0.02 * changed.configuration.machine.static_load_n


_PLAIN = """
import sys
import numpy as np
from roller_sim_ros.jit import JIT_ACTIVE
from tests.property.test_kernels import periodic_samples
assert not JIT_ACTIVE
np.save(sys.stdout.buffer, periodic_samples(sys.argv[1]))
"""


def periodic_samples(model: str) -> np.ndarray:
    """Return samples of a periodic motion with lift-off and of a change, shape (3, n)."""
    session = _session(model, 28.0, 1.6e-3, 35e6, 0.8e-3)
    blocks = []
    for revolution in range(40):
        if revolution == 20:
            session.command_exciter(vibrate=True, frequency_hz=29.0, amplitude_m=1.5e-3)
        blocks.append(session.advance(128))
    return np.concatenate(
        [np.stack([b.acceleration_vertical, b.soil_force, b.drum_height]) for b in blocks], axis=1
    )


@pytest.mark.parametrize("model", MODELS)
def test_plain_python_gives_the_compiled_samples(model: str) -> None:
    environment = {**os.environ, DISABLE_VARIABLE: "1"}
    plain = subprocess.run(
        [sys.executable, "-c", _PLAIN, model], env=environment, capture_output=True, check=True
    )
    samples = np.load(io.BytesIO(plain.stdout))
    compiled = periodic_samples(model)
    scale = np.abs(compiled).max(axis=1, keepdims=True)
    assert np.max(np.abs(samples - compiled) / scale) < 1e-9
