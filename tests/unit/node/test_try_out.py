# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What cannot be computed is refused before a running roller becomes like that."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.node import warm_up
from roller_sim_ros.parameters import Configuration, ParameterError


class Emulator:
    outcome: Exception | float = 0.0

    def __init__(self, _configuration, *, start_ns):
        assert start_ns == 0
        self.block = None

    def advance(self, samples):
        if isinstance(self.outcome, Exception):
            raise self.outcome
        self.block = SimpleNamespace(acceleration_vertical=np.full(samples, self.outcome))


@pytest.mark.parametrize("outcome", [np.nan, np.inf, ValueError("no fit"), ZeroDivisionError()])
def test_what_cannot_be_computed_is_refused(monkeypatch, outcome):
    monkeypatch.setattr(warm_up, "Emulator", Emulator)
    monkeypatch.setattr(Emulator, "outcome", outcome)
    with pytest.raises(RollerSimError, match="cannot be computed"):
        warm_up.try_out(Configuration())


def test_the_rest_passes():
    warm_up.try_out(Configuration())
    with pytest.raises(ParameterError, match="samples_per_revolution"):
        warm_up.try_out(Configuration().changed({"sampling.samples_per_revolution": 64}))
