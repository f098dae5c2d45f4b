# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Exciter commands over DDS: obeyed, refused whole, missed."""

from __future__ import annotations

import math

import pytest
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from roller_sim_ros.msg import AppliedChange, ExciterState
from tests.integration.harness import entry, values

REFUSED = {
    "frequency NaN": (math.nan, 1e-3, ExciterState.NOT_FINITE, ["frequency nan Hz", "finite"]),
    "frequency infinite": (math.inf, 1e-3, ExciterState.NOT_FINITE, ["frequency inf Hz", "finite"]),
    "frequency −infinite": (-math.inf, 1e-3, ExciterState.NOT_FINITE, ["frequency -inf Hz"]),
    "frequency negative": (-1.0, 1e-3, ExciterState.NEGATIVE, ["frequency -1 Hz", "negative"]),
    "frequency too high": (80.5, 1e-3, ExciterState.OUT_OF_RANGE, ["80.5 Hz", "at most 80 Hz"]),
    "amplitude NaN": (28.0, math.nan, ExciterState.NOT_FINITE, ["amplitude nan m", "finite"]),
    "amplitude infinite": (28.0, math.inf, ExciterState.NOT_FINITE, ["amplitude inf m", "finite"]),
    "amplitude −infinite": (28.0, -math.inf, ExciterState.NOT_FINITE, ["amplitude -inf m"]),
    "amplitude negative": (28.0, -1e-3, ExciterState.NEGATIVE, ["-0.001 m", "negative"]),
    "amplitude too great": (28.0, 6e-3, ExciterState.OUT_OF_RANGE, ["0.006 m", "at most 0.005 m"]),
}


@pytest.mark.parametrize(("frequency", "amplitude", "code", "words"), REFUSED.values(), ids=REFUSED)
def test_refused_command_is_named_and_changes_nothing(
    visitor, shared_sim, frequency, amplitude, code, words
):
    states = visitor.listen("exciter/state", ExciterState)
    diagnostics = visitor.listen("/diagnostics", DiagnosticArray)
    applied = visitor.listen("applied", AppliedChange)
    before = visitor.spin_until(lambda: states and states[-1])
    logged = len(shared_sim.complaints)

    visitor.command(frequency=frequency, amplitude=amplitude)
    state = visitor.spin_until(lambda: states[-1].refusal_code == code and states[-1])

    for word in words:
        assert word in state.refusal_reason
    assert state.vibrating == before.vibrating
    assert state.commanded_frequency == before.commanded_frequency
    assert state.commanded_amplitude == before.commanded_amplitude
    assert state.applied_sample == before.applied_sample
    told = visitor.spin_until(
        lambda: (
            (status := entry(diagnostics, "exciter"))
            and status.message == state.refusal_reason
            and status
        )
    )
    assert told.level == DiagnosticStatus.WARN
    assert values(told)["last_refused_command"] == state.refusal_reason
    new = shared_sim.complaints[logged:]
    assert len(new) == 1
    assert state.refusal_reason in new[0]
    assert applied == []

    # Accepted again, it is forgotten.
    visitor.command(frequency=before.commanded_frequency, amplitude=before.commanded_amplitude)
    state = visitor.spin_until(lambda: states[-1].refusal_code == ExciterState.NONE and states[-1])
    assert state.refusal_reason == ""


def test_command_takes_effect_at_a_multiple_of_128(visitor):
    states = visitor.listen("exciter/state", ExciterState)
    applied = visitor.listen("applied", AppliedChange)
    visitor.spin_until(lambda: states)

    visitor.command(frequency=30.0, amplitude=1.2e-3)
    visitor.spin_until(lambda: len(applied) == 2)
    assert {item.name: item.value for item in applied} == {
        "exciter.frequency_hz": 30.0,
        "exciter.amplitude_m": 1.2e-3,
    }
    assert all(item.sample % 128 == 0 for item in applied)
    state = visitor.spin_until(lambda: states[-1].frequency == 30.0 and states[-1])
    assert state.applied_sample == applied[0].sample
    visitor.spin_until(lambda: states[-1].amplitude == 1.2e-3)
    # The parameters follow what is commanded.
    visitor.spin_until(lambda: visitor.get_parameter("exciter.frequency_hz") == 30.0)

    visitor.command(vibrate=False, frequency=30.0, amplitude=1.2e-3)
    state = visitor.spin_until(lambda: states[-1].frequency == 0.0 and states[-1])
    assert not state.vibrating
    visitor.command(frequency=28.0, amplitude=1.6e-3)
    visitor.spin_until(lambda: states[-1].amplitude == 1.6e-3 and states[-1].frequency == 28.0)


def test_refusals_in_a_row_are_counted_but_logged_once(visitor, shared_sim):
    diagnostics = visitor.listen("/diagnostics", DiagnosticArray)
    states = visitor.listen("exciter/state", ExciterState)

    def refused() -> int:
        status = visitor.spin_until(lambda: entry(diagnostics, "exciter"))
        return int(values(status)["refused_commands"])

    before, logged = refused(), len(shared_sim.complaints)
    for _ in range(5):
        visitor.command(frequency=99.0, amplitude=1e-3)
    visitor.spin_until(lambda: refused() == before + 5)
    assert len(shared_sim.complaints) == logged + 1
    visitor.command(frequency=28.0, amplitude=1.6e-3)
    visitor.spin_until(lambda: states and states[-1].refusal_code == ExciterState.NONE)


def test_watchdog_runs_the_exciter_down(start, client):
    sim = start(
        *("--ros-args", "-p", "exciter.command_timeout_s:=0.5"),
        *("-p", "exciter.frequency_rate_hz_per_s:=100.0"),
    )
    states = client.listen("exciter/state", ExciterState)
    applied = client.listen("applied", AppliedChange)
    diagnostics = client.listen("/diagnostics", DiagnosticArray)
    client.spin_until(lambda: states)

    def logged() -> int:
        return sum("exciter.command_timeout_s" in line for line in sim.complaints)

    # Commands keep it up, once they come often enough.
    def kept_up() -> bool:
        heard = len(states)
        for _ in range(10):
            client.command(frequency=28.0, amplitude=1.6e-3)
            client.spin_for(0.1)
        told = states[heard:]
        return bool(told) and all(
            state.vibrating and state.refusal_code == ExciterState.NONE for state in told
        )

    client.spin_until(kept_up)
    before = logged()  # more than 0 if it was silent for too long before

    state = client.spin_until(
        lambda: states[-1].refusal_code == ExciterState.TIMEOUT and states[-1]
    )
    assert "0.5 s" in state.refusal_reason
    client.spin_until(lambda: states[-1].frequency == 0.0)
    assert not states[-1].vibrating
    assert [item.text for item in applied if item.name == "exciter.vibrate"][-1] == "false"
    assert states[-1].refusal_code == ExciterState.TIMEOUT
    status = client.spin_until(
        lambda: (
            (found := entry(diagnostics, "exciter"))
            and found.level == DiagnosticStatus.WARN
            and found
        )
    )
    assert "exciter.command_timeout_s" in status.message
    assert logged() == before + 1

    client.command(frequency=28.0, amplitude=1.6e-3)
    client.spin_until(lambda: states[-1].vibrating and states[-1].frequency > 20.0)
    assert sim.end() == 0
