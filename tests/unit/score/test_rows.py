# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Each row passes a meter that is right, and fails the one that is wrong in what the row is named for."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from roller_sim_ros.faults.fault import Behaviour, Expectation
from roller_sim_ros.score.evidence import Evidence
from roller_sim_ros.score.latency import Latency
from roller_sim_ros.score.limits import Limits
from roller_sim_ros.score.row import Verdict
from tests.unit.score.evidence import REVOLUTIONS, fault, right, rows_of, silenced

UNAFFECTED = Expectation(Behaviour.UNAFFECTED, tolerance_percent=2.0)
FLAGGED = Expectation(Behaviour.FLAGGED, within_revolutions=5)
NAN = Expectation(Behaviour.NAN, within_revolutions=17)


def failed(evidence: Evidence) -> list[str]:
    return [name for name, row in rows_of(evidence).items() if row.verdict is Verdict.FAIL]


def with_values(evidence: Evidence, value: np.ndarray) -> Evidence:
    return replace(evidence, values=replace(evidence.values, value=value))


def test_a_meter_that_is_right_passes_all() -> None:
    rows = rows_of(right())
    assert {name for name, row in rows.items() if row.verdict is Verdict.NOT_JUDGED} == {"standing"}
    assert failed(right()) == []


def test_bias_and_rms_are_those_of_the_definition() -> None:
    evidence = right()
    higher = with_values(evidence, 1.15 * evidence.truth.cmv)
    rows = rows_of(higher)
    for name in ("bias", "rms", "rms_in_double_jump"):
        assert rows[name].found == pytest.approx(15.0)
    assert failed(higher) == ["bias", "rms", "rms_in_double_jump"]
    scatter = np.where(np.arange(REVOLUTIONS) % 2, 1.08, 0.92) * evidence.truth.cmv
    assert failed(with_values(evidence, scatter)) == ["rms"]
    where = evidence.truth.rmv > 20.0
    jumping = np.where(where, 0.8, 1.0) * evidence.truth.cmv
    assert rows_of(with_values(evidence, jumping))["rms_in_double_jump"].found == pytest.approx(
        20.0
    )


def test_any_number_is_judged() -> None:
    evidence = right()
    for odd in (1e308, -1e308, 0.0, math.inf):
        value = evidence.truth.cmv.copy()
        value[300:400] = odd
        assert failed(with_values(evidence, value))


def test_too_few_values_are_no_verdict() -> None:
    evidence = right()
    few = np.where(np.arange(REVOLUTIONS) < 40, evidence.truth.cmv, np.nan)
    assert "values" in failed(with_values(evidence, few))
    rows = rows_of(with_values(evidence, np.full(REVOLUTIONS, np.nan)))
    assert rows["values"].verdict is Verdict.FAIL
    assert "bias" not in rows


@pytest.mark.parametrize(
    ("seconds", "verdict"),
    [(0.4, Verdict.PASS), (-0.1, Verdict.PASS), (0.6, Verdict.FAIL), (math.inf, Verdict.FAIL)],
)
def test_latency_is_held_against_its_limit(seconds: float, verdict: Verdict) -> None:
    evidence = replace(right(), latency=Latency(0, seconds))
    assert rows_of(evidence)["latency"].verdict is verdict


def test_a_ceiling_is_found_and_a_steady_value_is_none() -> None:
    evidence = right()
    row = rows_of(with_values(evidence, np.minimum(evidence.truth.cmv, 50.0)))["ceiling"]
    assert row.verdict is Verdict.FAIL
    assert "are 50" in row.detail
    # A display in whole numbers stands at its greatest one only as long as the true value is near.
    assert "ceiling" not in failed(with_values(evidence, np.round(evidence.truth.cmv)))
    steady = replace(evidence, truth=replace(evidence.truth, cmv=np.full(REVOLUTIONS, 37.0)))
    assert failed(with_values(steady, np.full(REVOLUTIONS, 37.0))) == []


def test_gaps_are_told_by_share_and_length() -> None:
    evidence = right()
    assert failed(silenced(evidence, slice(300, 310))) == []
    rows = rows_of(silenced(evidence, slice(300, 340)))
    assert rows["gap"].verdict is Verdict.FAIL
    assert rows["gap"].found == pytest.approx(40 / 28.0, abs=0.05)
    assert rows["gap"].detail.startswith("at 10.")
    assert rows["availability"].found == pytest.approx(100.0 * (1.0 - 40 / 570.0), abs=0.5)
    flagged = evidence.values.flagged.copy()
    flagged[300:340] = True
    assert failed(replace(evidence, values=replace(evidence.values, flagged=flagged))) == [
        "availability",
        "gap",
    ]


def test_a_slow_meter_has_no_gaps() -> None:
    evidence = right()
    values = evidence.values
    given = np.arange(REVOLUTIONS) % 14 == 0
    slow = replace(
        values,
        given=given,
        value=np.where(given, values.value, np.nan),
        alarm=np.where(given, values.alarm, np.nan),
    )
    assert failed(replace(evidence, values=slow)) == []


def test_the_first_value_has_to_come_in_time() -> None:
    evidence = right()
    assert failed(silenced(evidence, slice(0, 15 + 28 * 4))) == []
    assert failed(silenced(evidence, slice(0, 15 + 28 * 6))) == ["first_value"]


def test_no_value_is_due_where_the_frequency_changes() -> None:
    evidence = right()
    frequency = np.where(np.arange(REVOLUTIONS) < 300, 28.0, 30.0)
    changing = replace(evidence, truth=replace(evidence.truth, frequency_hz=frequency))
    flagged = evidence.values.flagged.copy()
    flagged[300:315] = True
    assert failed(replace(changing, values=replace(evidence.values, flagged=flagged))) == []


def test_a_value_while_the_eccentric_stands_is_wrong_and_so_is_a_zero() -> None:
    evidence = right()
    standing = np.arange(REVOLUTIONS) >= 500
    truth = replace(
        evidence.truth,
        frequency_hz=np.where(standing, 0.0, 28.0),
        cmv=np.where(standing, np.nan, evidence.truth.cmv),
    )
    zero = np.where(standing, 0.0, evidence.truth.cmv)
    assert "standing" in failed(replace(with_values(evidence, zero), truth=truth))
    none = np.where(standing, np.nan, evidence.truth.cmv)
    assert failed(replace(with_values(evidence, none), truth=truth)) == []


def test_alarms_are_held_against_the_true_rmv() -> None:
    evidence = right()

    def saying(alarm: np.ndarray, *, rmv: bool = True) -> list[str]:
        values = replace(evidence.values, alarm=alarm)
        return failed(replace(evidence, values=values, alarm_is_rmv=rmv))

    places = np.arange(REVOLUTIONS)
    assert saying(np.full(REVOLUTIONS, 100.0)) == ["wrong_alarms"]
    assert saying(np.zeros(REVOLUTIONS)) == ["missing_alarms"]
    assert saying((places >= 410).astype(float), rmv=False) == []
    assert saying((places >= 440).astype(float), rmv=False) == ["missing_alarms"]


def test_near_the_threshold_either_answer_is_right() -> None:
    evidence = right()
    truth = replace(evidence.truth, rmv=np.full(REVOLUTIONS, 22.0))
    for alarm in (0.0, 100.0):
        values = replace(evidence.values, alarm=np.full(REVOLUTIONS, alarm))
        rows = rows_of(replace(evidence, truth=truth, values=values))
        assert rows["wrong_alarms"].verdict is Verdict.NOT_JUDGED
        assert rows["missing_alarms"].verdict is Verdict.NOT_JUDGED


def test_a_meter_without_alarms_is_not_judged_by_them() -> None:
    evidence = right()
    values = replace(evidence.values, alarm=np.full(REVOLUTIONS, np.nan))
    rows = rows_of(replace(evidence, values=values))
    assert rows["wrong_alarms"].verdict is Verdict.NOT_JUDGED
    assert "not given" in rows["missing_alarms"].detail


def spoilt(evidence: Evidence, where: slice, factor: float) -> Evidence:
    value = evidence.values.value.copy()
    value[where] *= factor
    return with_values(evidence, value)


def test_under_a_fault_that_must_not_matter_the_value_stays_or_is_flagged() -> None:
    evidence = right(None, fault(UNAFFECTED))
    assert failed(evidence) == []
    row = rows_of(spoilt(evidence, slice(230, 232), 1.05))["fault/1/some"]
    assert (row.verdict, row.limit) == (Verdict.FAIL, 2.5)
    assert row.found == pytest.approx(5.0)
    # The meter's window holds some of it for a while.
    assert failed(spoilt(evidence, slice(270, 272), 1.05)) == ["fault/1/some"]
    assert failed(spoilt(evidence, slice(290, 292), 1.05)) == []
    bad = spoilt(evidence, slice(230, 232), 1.05)
    flagged = bad.values.flagged.copy()
    flagged[230:232] = True
    assert failed(replace(bad, values=replace(bad.values, flagged=flagged))) == []


def test_a_value_without_a_stamp_may_be_of_a_little_earlier() -> None:
    evidence = right(None, fault(UNAFFECTED))
    late = with_values(evidence, np.roll(evidence.values.value, 8))
    assert failed(late) == ["fault/1/some"]
    assert failed(replace(late, stamped=False)) == []


def flagging(evidence: Evidence, where: slice) -> Evidence:
    flagged = evidence.values.flagged.copy()
    flagged[where] = True
    return replace(evidence, values=replace(evidence.values, flagged=flagged))


def test_what_has_to_be_flagged_is_flagged_in_time_and_stays_so_while_it_is_wrong() -> None:
    evidence = right(None, fault(FLAGGED))
    assert failed(evidence) == ["fault/1/some"]
    assert failed(flagging(evidence, slice(203, 260))) == []
    assert rows_of(flagging(evidence, slice(203, 260)))["fault/1/some"].found == 3.0
    assert failed(flagging(evidence, slice(206, 260))) == ["fault/1/some"]
    assert failed(silenced(evidence, slice(201, 260))) == []
    assert failed(flagging(evidence, slice(203, 240))) == []
    wrong = spoilt(evidence, slice(200, 260), 1.5)
    row = rows_of(flagging(wrong, slice(203, 240)))["fault/1/some"]
    assert row.verdict is Verdict.FAIL
    assert "20 values not flagged afterwards, up to 50 % off" in row.detail


def test_where_there_can_be_no_value_there_is_none() -> None:
    evidence = right(None, fault(NAN))
    value = evidence.values.value.copy()
    assert failed(evidence) == ["fault/1/some"]
    value[217:270] = np.nan
    assert failed(with_values(evidence, value)) == []
    value[240] = 40.0
    assert "1 numbers afterwards" in rows_of(with_values(evidence, value))["fault/1/some"].detail
    row = rows_of(silenced(evidence, slice(201, 260)))["fault/1/some"]
    assert row.verdict is Verdict.FAIL
    assert "it was silent" in row.detail


@pytest.mark.parametrize("expected", [FLAGGED, NAN])
def test_a_fault_that_is_over_too_soon_is_not_judged(expected: Expectation) -> None:
    evidence = right(None, fault(expected, 200, 203))
    assert rows_of(evidence)["fault/1/some"].verdict is Verdict.NOT_JUDGED


def test_faults_at_the_same_time_add_up_or_leave_out() -> None:
    both = right(None, fault(UNAFFECTED), fault(UNAFFECTED, 220, 280, handle=2))
    assert failed(spoilt(both, slice(230, 232), 1.04)) == []
    assert failed(spoilt(both, slice(230, 232), 1.06)) == ["fault/1/some", "fault/2/some"]
    covered = right(None, fault(UNAFFECTED), fault(FLAGGED, 220, 280, handle=2))
    assert failed(flagging(spoilt(covered, slice(221, 280), 3.0), slice(224, 280))) == []
    assert failed(flagging(spoilt(covered, slice(210, 212), 3.0), slice(224, 280))) == [
        "fault/1/some"
    ]


def test_limits_are_what_rows_are_held_against() -> None:
    strict = right(Limits(bias_percent=0.1, gap_s=0.1))
    value = 1.002 * strict.values.value
    assert failed(with_values(strict, value)) == ["bias"]
    assert failed(silenced(strict, slice(300, 310))) == ["gap"]
