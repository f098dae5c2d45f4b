# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Scenario files: what is read, and that whatever is wrong is told by file and line."""

from __future__ import annotations

from pathlib import Path

import pytest

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.faults import FAULTS
from roller_sim_ros.parameters import Configuration
from roller_sim_ros.scenario import (
    Scenario,
    ScenarioError,
    configuration_of,
    parse_scenario,
    read_scenario,
    start_of,
)
from roller_sim_ros.scenario.nodes import LARGEST_BYTES
from roller_sim_ros.scenario.shipped import scenario_path, shipped_scenarios
from roller_sim_ros.site.compaction import Exponential
from roller_sim_ros.site.features import SoftSpot

FILE = Path("site.yaml")

FULL = """\
title: all keys
machine:
  preset: cs-563e
  frame_mass_kg: 3000
lane: {length_m: 30, cell_m: 0.5}
travel: {speed_m_s: 1.5, passes: 3, direction: backward, turn_s: 2}
ground:
  preset: medium-gravel
  features:
    - kind: soft_spot
      at_m: 10
      length_m: 3
  compaction:
    kind: exponential
    passes: 4
exciter:
  kind: directed
  tilt_deg: 30
  amplitude_mm: 1.7
  programme:
    - {from_pass: 2, to_m: 10, amplitude_mm: 0.85}
sensors:
  - name: mems_10g
    parameters: {range_m_s2: 98.0}
faults:
  - {id: stuck, from_s: 3, to_s: 4}
parameters:
  half_space.model: two-pole
  exciter.frequency_rate_hz_per_s: 5e0
duration_s: 12.5
seed: 42
"""


def parse(text: str) -> Scenario:
    return parse_scenario(text, FILE)


def test_a_file_says_all_of_a_run() -> None:
    scenario = parse(FULL)
    assert scenario.title == "all keys"
    assert (scenario.lane.length_m, scenario.lane.cells) == (30.0, 60)
    assert scenario.ground.features == (SoftSpot(at_m=10.0, length_m=3.0),)
    assert scenario.ground.compaction == Exponential(passes=4.0)
    assert scenario.travel.direction == "backward"
    assert scenario.exciter.programme[0].amplitude_mm == 0.85
    assert (scenario.faults[0].id, scenario.faults[0].to_s) == ("stuck", 4.0)
    assert (scenario.duration_s, scenario.seed) == (12.5, 42)
    assert (scenario.path, scenario.text) == ("site.yaml", FULL)


def test_the_configuration_has_all_of_it_in_si_units() -> None:
    configuration = configuration_of(parse(FULL))
    assert configuration.machine.frame_mass_kg == 3000.0
    assert configuration.machine.drum_width_m == 2.13
    assert configuration.exciter.kind == "directed"
    assert configuration.exciter.tilt_rad == pytest.approx(0.5235987755982988)
    assert (configuration.exciter.frequency_hz, configuration.exciter.amplitude_m) == (31.9, 1.7e-3)
    assert configuration.exciter.frequency_rate_hz_per_s == 5.0
    assert configuration.half_space.model == "two-pole"


def test_a_lane_is_all_that_is_needed() -> None:
    start = start_of(parse("lane: {length_m: 20}"))
    assert start.configuration == Configuration()
    assert start.site.soil(start.configuration.soil) == start.configuration.soil
    assert not start.run_up
    assert (start.sensors, start.faults, start.seed) == ((), (), 0)


def test_values_that_only_look_different_are_the_same() -> None:
    anchored = "lane: &it {length_m: 20.0}\nground: {shear_modulus_mpa: 5e1}\nduration_s: .5e2"
    assert parse(anchored) == parse(
        "lane: {length_m: 20}\nground: {shear_modulus_mpa: 50}\nduration_s: 50"
    )
    assert parse("lane: {length_m: 20}\nground: {compaction: }\nduration_s: ~") == parse(
        "lane: {length_m: 20}"
    )
    assert parse("lane: {length_m: 20}\ntitle: 2026").title == "2026"


BAD = {
    "nothing": ("", 1, "holds no scenario"),
    "only a remark": ("# nothing\n", 1, "holds no scenario"),
    "a list": ("- lane\n", 1, "holds no scenario"),
    "a text": ("lane\n", 1, "holds no scenario"),
    "no YAML": ("lane: {length_m: 20\nseed: 1\n", 2, "is no YAML"),
    "a tab": ("lane:\n\tlength_m: 20\n", 2, "is no YAML"),
    "a character that YAML does not have": ("lane:\n  length_m: \x07\n", 2, "is no YAML"),
    "an unknown alias": ("lane: *it\n", 1, "is no YAML: found undefined alias"),
    "two documents": ("lane: {length_m: 20}\n---\nseed: 1\n", 2, "is no YAML"),
    "a bottomless nesting": ("[" * 20000, 1, "is nested too deeply"),
    "a tag": ("lane: {length_m: !metre 20}", 1, "tag !metre means nothing here"),
    "a key that is none": ("lane: {length_m: 20}\n? [a]\n: 1\n", 2, "a key must be a text"),
    "a key twice": (
        "lane: {length_m: 20}\nseed: 1\nseed: 2\n",
        3,
        "key 'seed' is there already, in line 2",
    ),
    "no lane": ("seed: 1\n", 1, "lane is missing: the lane"),
    "an empty lane": ("seed: 1\nlane: {}\n", 2, "lane: length_m is missing: length of the lane"),
    "a misspelt key": (
        "lane:\n  lenght_m: 20\n",
        2,
        "lane: unknown key 'lenght_m'; did you mean length_m?",
    ),
    "a key from nowhere": (
        "lane: {length_m: 20}\nzzz: 1\n",
        2,
        "unknown key 'zzz'; there are lane",
    ),
    "a unit that is not the key's": (
        "lane: {length_m: 20}\nground:\n  shear_modulus_pa: 5e7\n",
        3,
        "ground: unknown key 'shear_modulus_pa'; did you mean shear_modulus_mpa?",
    ),
    "a text for a number": (
        "lane:\n  length_m: long\n",
        2,
        "lane.length_m = 'long': must be a number",
    ),
    "a quoted number": ("lane: {length_m: '20'}", 1, "lane.length_m = '20': must be a number"),
    "a number with its unit": (
        "lane: {length_m: 20 m}",
        1,
        "lane.length_m = '20 m': must be a number",
    ),
    "not a number": ("lane: {length_m: .nan}", 1, "lane.length_m = nan: must be finite"),
    "without end": ("lane: {length_m: -.inf}", 1, "lane.length_m = -inf: must be finite"),
    "a number of many digits": (
        "lane: {length_m: 20}\nseed: " + "9" * 5000,
        2,
        "seed = inf: must be finite",
    ),
    "too short": ("lane:\n  length_m: 0.1\n", 2, "lane.length_m = 0.1: must be 0.5 … 10000"),
    "half a pass": (
        "lane: {length_m: 20}\ntravel:\n  passes: 2.5\n",
        3,
        "travel.passes = 2.5: must be a whole number",
    ),
    "yes for true": (
        "lane: {length_m: 20}\nexciter: {run_up: yes}\n",
        2,
        "exciter.run_up = 'yes': must be true or false",
    ),
    "no value": ("lane:\n  length_m:\n", 2, "lane.length_m has no value"),
    "a mapping for a number": (
        "lane:\n  length_m: {a: 1}\n",
        2,
        "lane.length_m: must be a single value",
    ),
    "a number for a mapping": ("lane: 20\n", 1, "lane: must be keys with values"),
    "a mapping for a list": (
        "lane: {length_m: 20}\nfaults: {id: stuck}\n",
        2,
        "faults: must be a list",
    ),
    "a text in a list": (
        "lane: {length_m: 20}\nfaults:\n  - stuck\n",
        3,
        "faults[0]: must be keys with values",
    ),
    "an unknown preset": (
        "lane: {length_m: 20}\nground:\n  preset: paper-sotf\n",
        3,
        "ground.preset = 'paper-sotf': must be one of loose-gravel",
    ),
    "a feature without a kind": (
        "lane: {length_m: 20}\nground:\n  features:\n    - at_m: 1\n",
        4,
        "ground.features[0]: kind is missing; it is one of section, gradient",
    ),
    "an unknown feature": (
        "lane: {length_m: 20}\nground:\n  features:\n    - kind: soft_spt\n",
        4,
        "ground.features[0].kind: there is no 'soft_spt'; did you mean soft_spot?",
    ),
    "a kind that is no text": (
        "lane: {length_m: 20}\nground:\n  compaction:\n    kind: [1]\n",
        4,
        "ground.compaction.kind: there is no ''; there are exponential, hyperbolic",
    ),
    "a feature without its place": (
        "lane: {length_m: 20}\nground:\n  features:\n    - kind: soft_spot\n      length_m: 2\n",
        4,
        "ground.features[0]: at_m is missing: chainage of its middle",
    ),
    "a stretch that ends before it begins": (
        "lane: {length_m: 20}\nground:\n  features:\n    - kind: section\n      from_m: 5\n      to_m: 4\n",
        6,
        "ground.features[0].to_m = 4.0: must be beyond from_m, 5 m",
    ),
    "a gradient to nothing": (
        "lane: {length_m: 20}\nground:\n  features:\n    - kind: gradient\n",
        4,
        "ground.features[0].shear_modulus_mpa: a gradient needs",
    ),
    "ground beyond the model": (
        "lane: {length_m: 20}\nseed: 1\nground:\n  shear_modulus_mpa: 3\n  features: [*it]\n".replace(
            "*it", "{kind: soft_spot, at_m: 5, length_m: 2, stiffness_ratio: 0.1}"
        ),
        3,
        "soil.shear_modulus_pa = ",
    ),
    "a limit beyond the model": (
        "lane: {length_m: 20}\nmachine: {drum_radius_m: 0.1}\nground:\n  compaction: {*it}\n".replace(
            "*it", "kind: exponential, limit_shear_modulus_mpa: 2"
        ),
        3,
        "soil.plastic_parameter_m = ",
    ),
    "cells beyond number": (
        "lane:\n  length_m: 10000\n  cell_m: 0.02\n",
        3,
        "lane.cell_m = 0.02: must be at least 0.05",
    ),
    "a start beyond the lane": (
        "lane: {length_m: 20}\ntravel:\n  start_m: 21\n",
        3,
        "travel.start_m = 21.0: must be on the lane",
    ),
    "a roller that stands without end": (
        "lane: {length_m: 20}\ntravel: {speed_m_s: 0}\n",
        1,
        "duration_s: must be given for a roller that stands",
    ),
    "a step of the programme without a value": (
        "lane: {length_m: 20}\nexciter:\n  programme:\n    - from_s: 2\n",
        4,
        "exciter.programme[0].vibrate: a step needs vibrate, frequency_hz or amplitude_mm",
    ),
    "a step that ends before it begins": (
        "lane: {length_m: 20}\nexciter:\n  programme:\n    - from_pass: 3\n      to_pass: 2\n      vibrate: false\n",
        5,
        "exciter.programme[0].to_pass = 2: must be at least from_pass, 3",
    ),
    "an amplitude in metres that is none in millimetres": (
        "lane: {length_m: 20}\nexciter:\n  amplitude_mm: 16\n",
        3,
        "exciter.amplitude_mm = 16: must be 0 … 5",
    ),
    "an unknown sensor": (
        "lane: {length_m: 20}\nsensors:\n  - name: mems_50\n",
        3,
        "sensors[0].name = 'mems_50': there is no such sensor; did you mean mems_50g?",
    ),
    "a sensor without a name": (
        "lane: {length_m: 20}\nsensors:\n  - parameters: {}\n",
        3,
        "sensors[0]: name is missing: which sensor",
    ),
    "two sensors for the same": (
        "lane: {length_m: 20}\nsensors:\n  - name: ideal\n  - name: mems_10g\n",
        4,
        "sensors[1].name = 'mems_10g': there is a sensor for the acceleration",
    ),
    "an unknown parameter of a sensor": (
        "lane: {length_m: 20}\nsensors:\n  - name: mems_10g\n    parameters:\n      colour: 3\n",
        5,
        "sensors[0].parameters.colour = 3: there is no such parameter",
    ),
    "a list as a parameter": (
        "lane: {length_m: 20}\nsensors:\n  - name: mems_10g\n    parameters:\n      bits: [3]\n",
        5,
        "sensors[0].parameters.bits: must be a single value",
    ),
    "an unknown fault": (
        "lane: {length_m: 20}\nfaults:\n  - id: stuc\n",
        3,
        "faults[0].id = 'stuc': there is no fault 'stuc'; did you mean stuck?",
    ),
    "a fault of what is not there": (
        "lane: {length_m: 20}\nfaults:\n  - id: lost_pulse\n",
        3,
        "faults[0].id = 'lost_pulse': lost_pulse: there is no sensor for the pulses",
    ),
    "a refused parameter of a fault": (
        "lane: {length_m: 20}\nfaults:\n  - id: gain_change\n    parameters:\n      factor: -1\n",
        5,
        "faults[0].parameters.factor = -1: must be at least 0.01",
    ),
    "faults that exclude each other": (
        "lane: {length_m: 20}\nfaults:\n  - {id: stuck, from_s: 1}\n  - {id: spike, to_s: 2}\n",
        4,
        "faults[1].id = 'spike': cannot be together with faults[0]",
    ),
    "an unknown parameter": (
        "lane: {length_m: 20}\nparameters:\n  half_space.modle: exact\n",
        3,
        "half_space.modle = 'exact': there is no such parameter; did you mean half_space.model?",
    ),
    "a parameter that has a section": (
        "lane: {length_m: 20}\nparameters:\n  soil.shear_modulus_pa: 5e7\n",
        3,
        "soil.shear_modulus_pa = 50000000.0: is said in another section",
    ),
    "a refused parameter": (
        "lane: {length_m: 20}\nparameters:\n  meter.window_revolutions: 15\n",
        3,
        "meter.window_revolutions = 15: must be an even number",
    ),
    "a negative seed": ("lane: {length_m: 20}\nseed: -1\n", 2, "seed = -1: must be 0 … "),
}


@pytest.mark.parametrize(("text", "line", "reason"), BAD.values(), ids=BAD)
def test_whatever_is_wrong_is_told_by_file_and_line(text: str, line: int, reason: str) -> None:
    with pytest.raises(ScenarioError) as caught:
        parse(text)
    message = str(caught.value)
    assert message.startswith(f"site.yaml:{line}: {reason}")
    assert "\n" not in message
    assert (caught.value.path, caught.value.line) == (FILE, line)


def test_files_that_cannot_be_read_are_told(tmp_path: Path) -> None:
    missing = tmp_path / "none.yaml"
    with pytest.raises(ScenarioError, match=r"none.yaml: cannot be read: No such file"):
        read_scenario(missing)
    with pytest.raises(ScenarioError, match="cannot be read: Is a directory"):
        read_scenario(tmp_path)
    latin = tmp_path / "latin.yaml"
    latin.write_bytes("lane: {length_m: 20}\ntitle: Gerät\n".encode("latin-1"))
    with pytest.raises(ScenarioError, match=r"latin.yaml:2: is no text in UTF-8"):
        read_scenario(latin)
    large = tmp_path / "large.yaml"
    large.write_bytes(b"#" * (LARGEST_BYTES + 1))
    with pytest.raises(ScenarioError, match="is larger than 1000000 bytes"):
        read_scenario(large)
    marked = tmp_path / "marked.yaml"
    marked.write_bytes(b"\xef\xbb\xbflane: {length_m: 20}\r\n")
    assert read_scenario(marked).lane.length_m == 20.0


def test_every_fault_of_the_catalogue_can_be_scheduled_or_says_what_it_lacks() -> None:
    lacking = []
    for name in FAULTS:
        text = f"lane: {{length_m: 20}}\nsensors: [{{name: mems_50g}}]\nfaults: [{{id: {name}}}]"
        try:
            scenario = parse(text)
        except ScenarioError as error:
            lacking.append(str(error))
        else:
            assert start_of(scenario).faults[0].id == name
    assert all("there is no sensor for" in reason for reason in lacking)
    assert len(lacking) < len(FAULTS) / 2


def test_scenarios_of_the_package_are_found_by_their_names(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    shipped = shipped_scenarios()
    assert len(shipped) == 7
    assert scenario_path("soft_to_stiff") == shipped["soft_to_stiff"]
    Path("soft_to_stiff").write_text("lane: {length_m: 2}", encoding="utf-8")
    assert scenario_path("soft_to_stiff") == Path("soft_to_stiff")
    assert scenario_path("mine.yaml") == Path("mine.yaml")
    assert scenario_path("folder/mine") == Path("folder/mine")
    with pytest.raises(RollerSimError, match="no scenario of the package; did you mean soft_spot"):
        scenario_path("soft_spto")
