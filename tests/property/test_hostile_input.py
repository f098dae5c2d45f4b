# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Whatever comes in: no crash, and each refusal says in one line why. ``make fuzz`` feeds 100 000 items of these."""

from __future__ import annotations

import pytest

from fuzz.run import run
from fuzz.targets import targets

ITEMS = {"bags": 25, "command bytes": 1000}


@pytest.mark.parametrize("name", targets())
def test_hostile_items(name: str) -> None:
    result = run(targets()[name], ITEMS.get(name, 250), 0)
    # Of either kind, or the items do not reach what they are meant for.
    assert 0 < result.accepted < result.items
