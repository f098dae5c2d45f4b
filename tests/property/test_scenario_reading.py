# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Whatever a scenario file holds: it can be run, or one line says what is wrong. Never a traceback."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import yaml
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from roller_sim_ros.scenario import Scenario, ScenarioError, parse_scenario, start_of
from roller_sim_ros.scenario.shipped import shipped_scenarios
from roller_sim_ros.site import FEATURES, LAWS
from roller_sim_ros.site.declaration import members

FILE = Path("any.yaml")
TEXTS = [path.read_text(encoding="utf-8") for path in shipped_scenarios().values()]
WORDS = sorted(
    {word for text in TEXTS for word in re.findall(r"[a-z_0-9.]+", text)}
    | {member.name for record in (*FEATURES.values(), *LAWS.values()) for member in members(record)}
)


def outcome(text: str) -> Scenario | str:
    refusal = None
    try:
        scenario = parse_scenario(text, FILE)
    except ScenarioError as error:
        refusal = error
    if refusal is not None:
        message = str(refusal)
        assert re.match(r"any\.yaml:\d+: \S", message)
        assert "\n" not in message
        assert 1 <= refusal.line <= len(text.splitlines()) + 1
        return message
    # What is read can be begun.
    start = start_of(scenario)
    start.site.move(0.1, 1.0)
    start.site.soil(start.configuration.soil)
    return scenario


scalars = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(-(2**70), 2**70),
    st.integers(-3, 50),
    st.floats(),
    st.floats(0.1, 50.0),
    st.sampled_from(WORDS),
    st.text(max_size=6),
)
trees = st.recursive(
    scalars,
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(WORDS) | st.text(max_size=4), inner, max_size=4)
    ),
    max_leaves=12,
)


@settings(max_examples=200, deadline=None)
@given(st.text())
def test_any_text(text: str) -> None:
    outcome(text)


@settings(max_examples=200, deadline=None)
@given(st.text(alphabet="abcdelnth_m0123456789.:-[]{}&*!|>'\"#%@,?~ \n\t", max_size=80))
def test_any_text_of_yaml_s_own_characters(text: str) -> None:
    outcome(text)
    outcome("lane: {length_m: 20}\n" + text)


@settings(max_examples=200, deadline=None)
@given(
    st.dictionaries(
        st.sampled_from([member.name for member in members(Scenario)]), trees, max_size=6
    )
)
def test_any_tree_of_known_and_unknown_keys(tree: dict[str, Any]) -> None:
    outcome(yaml.safe_dump({"lane": {"length_m": 5.0}, **tree}, allow_unicode=True))


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(
    text=st.sampled_from(TEXTS),
    at=st.floats(0.0, 1.0),
    length=st.integers(0, 12),
    put=st.sampled_from(WORDS)
    | st.text(max_size=5)
    | st.integers(-5, 5000).map(str)
    | st.just("\n"),
)
def test_scenarios_of_the_package_with_a_piece_replaced(
    text: str, at: float, length: int, put: str
) -> None:
    place = int(at * len(text))
    outcome(text[:place] + put + text[place + length :])


@st.composite
def features(draw: st.DrawFn) -> dict[str, Any]:
    kind = draw(st.sampled_from(sorted(FEATURES)))
    values: dict[str, Any] = {"kind": kind}
    for member in members(FEATURES[kind]):
        if not member.required and draw(st.booleans()):
            continue
        low, high = member.declaration.minimum or 0.0, member.declaration.maximum or 60.0
        if member.kind is float:
            values[member.name] = draw(st.floats(low, max(low, min(high, 60.0))))
        elif member.kind is int:
            values[member.name] = draw(st.integers(0, 9))
    return values


@settings(max_examples=100, deadline=None)
@given(
    ground=st.lists(features(), max_size=4),
    length=st.floats(0.5, 60.0),
    cell=st.floats(0.02, 5.0),
    seed=st.integers(0, 2**63 - 1),
)
def test_any_ground_is_refused_or_within_the_model(
    ground: list[dict[str, Any]], length: float, cell: float, seed: int
) -> None:
    content = {
        "lane": {"length_m": length, "cell_m": cell},
        "ground": {
            "features": ground,
            "compaction": {"kind": "exponential", "limit_shear_modulus_mpa": 90.0},
        },
        "travel": {"passes": 2},
        "seed": seed,
    }
    scenario = outcome(yaml.safe_dump(content))
    if isinstance(scenario, str):
        return
    start = start_of(scenario)
    for _ in range(5):
        start.site.move(7.0, 2.0)
        start.site.soil(start.configuration.soil)
