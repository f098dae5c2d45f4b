# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Parameters of a fault from texts."""

from __future__ import annotations

import pytest

from roller_sim_ros.faults import FAULTS, FaultRefused, make_fault
from roller_sim_ros.node.fault_services import typed
from roller_sim_ros.parameters.quantity import declared


@pytest.mark.parametrize("fault_id", FAULTS)
def test_every_default_comes_back_from_its_text(fault_id):
    defaults = {name: default for name, _, default in declared(FAULTS[fault_id])}
    texts = [
        str(value).lower() if isinstance(value, bool) else str(value) for value in defaults.values()
    ]
    values = typed(fault_id, list(defaults), texts)
    assert values == defaults
    assert [type(value) for value in values.values()] == [type(it) for it in defaults.values()]
    assert make_fault(fault_id, values) == make_fault(fault_id)


@pytest.mark.parametrize(
    ("names", "texts", "word"),
    [
        (["factor"], [], "one value for each name"),
        (["factor", "factor"], ["1", "2"], "given twice"),
        (["factor"], ["half"], "must be a number"),
        (["factor"], [""], "must be a number"),
    ],
)
def test_what_does_not_fit_is_refused(names, texts, word):
    with pytest.raises(FaultRefused, match=word):
        typed("gain_change", names, texts)


def test_unknown_names_are_left_to_the_catalogue():
    assert typed("no_fault", ["a"], ["1"]) == {"a": "1"}
