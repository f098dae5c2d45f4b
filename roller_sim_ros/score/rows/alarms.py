# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Whether the meter knows that the drum double-jumps."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from roller_sim_ros.score.evidence import Evidence
from roller_sim_ros.score.row import Row, at_most, not_judged

WRONG, MISSING = "wrong_alarms", "missing_alarms"


def rows(evidence: Evidence) -> Iterator[Row]:
    """Yield the rows: by the true RMV, which is 0 unless the motion repeats only after several revolutions."""
    limits = evidence.limits
    said = np.isfinite(evidence.values.alarm) & ~evidence.values.flagged & evidence.sound
    if not np.isfinite(evidence.values.alarm).any():
        for name in (WRONG, MISSING):
            yield not_judged(name, "not given: the messages hold neither RMV nor double_jump")
        return
    alarm = evidence.values.alarm > (limits.alarm_rmv if evidence.alarm_is_rmv else 0.5)
    band = limits.alarm_band_percent / 100.0
    jumps = evidence.truth.rmv > limits.alarm_rmv * (1.0 + band)
    calm = evidence.truth.rmv < limits.alarm_rmv * (1.0 - band)
    for name, state, answer, limit, otherwise in (
        (WRONG, calm, alarm, limits.wrong_alarms_percent, "the drum always jumps"),
        (MISSING, jumps, ~alarm, limits.missing_alarms_percent, "the drum never jumps"),
    ):
        judged = _lasting(state, limits.alarm_delay_revolutions) & said
        count = int(np.count_nonzero(judged))
        if count == 0:
            yield not_judged(name, otherwise)
            continue
        found = int(np.count_nonzero(judged & answer))
        detail = f"{found} of {count} revolutions"
        yield at_most(name, 100.0 * found / count, limit, "%", detail)


def _lasting(state: NDArray[np.bool_], revolutions: int) -> NDArray[np.bool_]:
    """Return where a state has held for more than some revolutions."""
    places = np.arange(len(state))
    last_other = np.maximum.accumulate(np.where(state, -1, places))
    return state & (places - last_other > revolutions)
