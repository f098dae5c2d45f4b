# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Values that no sound sender sends, found by fuzzing: each is refused with its name, in one line."""

from __future__ import annotations

from pathlib import Path

import pytest

from roller_sim_ros.analysis.bag import BagError
from roller_sim_ros.analysis.decoding import Decoder
from roller_sim_ros.parameters import Configuration, ParameterError
from roller_sim_ros.parameters.file import ParameterFileError, read_parameters
from roller_sim_ros.site import Lane

BEYOND_FLOATS = 10**400
BEYOND_TEXT = 10**5000  # Python refuses to write it


@pytest.mark.parametrize(
    "value",
    [BEYOND_FLOATS, -BEYOND_FLOATS, BEYOND_TEXT, [BEYOND_TEXT]],
    ids=["large", "negative", "larger", "list"],
)
@pytest.mark.parametrize("name", ["soil.density_kg_m3", "meter.window_revolutions"])
def test_integer_beyond_all_floats(name: str, value: object) -> None:
    with pytest.raises(ParameterError, match=f"^{name} = an? .*: must be"):
        Configuration().changed({name: value})


def test_integer_beyond_all_floats_where_there_is_no_upper_bound() -> None:
    with pytest.raises(ParameterError, match="^length_m = an integer of 1329 bits: must be"):
        Lane(length_m=BEYOND_FLOATS)


def test_a_long_value_is_shown_shortened() -> None:
    with pytest.raises(ParameterError) as refusal:
        Configuration().changed({"half_space.model": "x\n" * 10_000})
    assert len(str(refusal.value)) < 300
    assert "\n" not in str(refusal.value)


@pytest.mark.parametrize("name", ["", "a\nb", "x" * 1000])
def test_a_name_that_no_parameter_can_have_is_shown_in_one_line(name: str) -> None:
    with pytest.raises(ParameterError, match="^'.* = 1.0: there is no such parameter") as refusal:
        Configuration().changed({name: 1.0})
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) < 300


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("soil: {density_kg_m3: 2001-99-99}", "holds a value that is none"),
        ("soil: {density_kg_m3: 1" + "0" * 5000 + "}", "holds a value that is none"),
        ("soil: {density_kg_m3: !!int x}", "holds a value that is none"),
        ("soil: {density_kg_m3: !!timestamp x}", "holds a value that is none"),
        ("[" * 3000, "is nested too deeply"),
        ("a: &a {b: *a}", "aliases are not taken"),
        ("a: &a {x: 1}\nb: [*a, *a]", "in line 2: aliases are not taken"),
    ],
)
def test_parameter_file(tmp_path: Path, text: str, words: str) -> None:
    path = tmp_path / "odd.yaml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ParameterFileError) as refusal:
        read_parameters(path)
    assert str(refusal.value).startswith(f"{path}: ")
    assert words in str(refusal.value)
    assert "\n" not in str(refusal.value)


def test_definition_that_cannot_be_parsed_is_told_in_one_line() -> None:
    with pytest.raises(
        BagError, match="^the definition of a/msg/B in the bag cannot be parsed: "
    ) as refusal:
        Decoder().add("a/msg/B", "MSG: a\nno field\n" * 100)
    assert "\n" not in str(refusal.value)
    assert len(str(refusal.value)) <= 300
