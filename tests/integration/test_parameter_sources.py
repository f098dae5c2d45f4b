# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Where parameters come from: flags, files, ROS arguments; what is wrong with them is said in one line."""

from __future__ import annotations

import pytest

from roller_sim_ros.msg import DrumAcceleration

HEAD = "/**:\n  ros__parameters:\n"

BAD_FILES = {
    "wrong key": (
        f"{HEAD}    soil:\n      shear_modulus: 80.0e6\n",
        ["soil.shear_modulus", "no such parameter", "soil.shear_modulus_pa"],
    ),
    "other unit in the key": (
        f"{HEAD}    soil.shear_modulus_mpa: 80.0\n",
        ["soil.shear_modulus_mpa", "soil.shear_modulus_pa"],
    ),
    "other unit in the value": (
        f"{HEAD}    soil.shear_modulus_pa: 80.0\n",
        ["soil.shear_modulus_pa = 80.0", "at least 2e+06 Pa"],
    ),
    "unit as text": (
        f'{HEAD}    soil.shear_modulus_pa: "80 MPa"\n',
        ["soil.shear_modulus_pa = '80 MPa'", "number"],
    ),
    "wrong choice": (
        f"{HEAD}    half_space.model: elastic\n",
        ["half_space.model = 'elastic'", "exact", "two-pole"],
    ),
    "makes no sense together": (
        f"{HEAD}    pacing.samples_per_message: 48\n",
        ["pacing.samples_per_message = 48", "divisor of 128"],
    ),
    "for another node": (
        "roller:\n  ros__parameters:\n    soil.shear_modulus_pa: 80.0e6\n",
        ["roller_sim", "/roller"],
    ),
    "no YAML": ("soil: [1, 2", ["no YAML"]),
    "empty": ("", ["no parameters"]),
    "plainly nested": ("soil:\n  shear_modulus_mpa: 80\n", ["soil.shear_modulus_pa"]),
}


@pytest.mark.parametrize(("text", "words"), BAD_FILES.values(), ids=BAD_FILES)
def test_bad_file_is_refused_in_one_line(start, tmp_path, text, words):
    path = tmp_path / "parameters.yaml"
    path.write_text(text)
    words = [str(path), *words]
    sim = start("--params", str(path))
    assert sim.wait() == 1
    assert len(sim.complaints) == 1
    for word in words:
        assert word in sim.complaints[0]
    assert sim.said == ""


@pytest.mark.parametrize(
    ("arguments", "code", "words"),
    [
        (["--params", "missing.yaml"], 1, ["missing.yaml", "cannot be read"]),
        (["--ros-args", "--params-file", "missing.yaml"], 1, ["missing.yaml"]),
        (["--ros-args", "-p", "soil.shear_modulus:=1.0"], 1, ["soil.shear_modulus_pa"]),
        (
            ["--ros-args", "-p", "qos_overrides./meter.publisher.reliability:=perhaps"],
            1,
            ["meter", "perhaps", "reliable"],
        ),
        (
            ["--ros-args", "-p", "qos_overrides./meter.publisher.depth:=many"],
            1,
            ["qos_overrides", "meter"],
        ),
        (["--ros-args", "-p", "autostart:=3"], 1, ["autostart = 3", "true or false"]),
        (["--frequency-hz", "81"], 1, ["--frequency-hz = 81", "0 … 80 Hz"]),
        (["--plastic-mm", "nan"], 1, ["--plastic-mm = nan", "0.02 … 20 mm"]),
        (["--half-space", "elastic"], 1, ["--half-space", "exact"]),
        (["--namespace", "1 2"], 1, ["1 2"]),
        (["--frequency-hz", "fast"], 2, ["--frequency-hz", "fast"]),
        (["--frequency"], 2, ["--frequency"]),
    ],
)
def test_bad_argument_is_refused(start, arguments, code, words):
    sim = start(*arguments)
    assert sim.wait() == code
    if code == 1:
        assert len(sim.complaints) == 1
    for word in words:
        assert word in sim.complaints[-1]


def test_plainly_nested_file_is_taken(start, client, tmp_path):
    path = tmp_path / "parameters.yaml"
    path.write_text(
        "soil:\n  shear_modulus_pa: 80e6\n  plastic_parameter_m: 5e-4\n"
        "exciter: {vibrate: false}\nhalf_space.model: two-pole\npacing: {samples_per_message: 64}\n"
    )
    sim = start("--params", str(path), "--ros-args", "-p", "soil.plastic_parameter_m:=6e-4")
    assert client.get_parameter("soil.shear_modulus_pa") == 80e6
    assert client.get_parameter("soil.plastic_parameter_m") == 6e-4
    assert client.get_parameter("exciter.vibrate") is False
    assert client.get_parameter("half_space.model") == "two-pole"
    assert client.get_parameter("pacing.samples_per_message") == 64
    assert sim.end() == 0
    assert sim.complaints == []


def test_flags_hold_over_files_and_files_over_defaults(start, client, tmp_path):
    path = tmp_path / "parameters.yaml"
    path.write_text(
        f"{HEAD}    soil:\n      shear_modulus_pa: 80000000\n      density_kg_m3: 1900.0\n"
        "    exciter.frequency_hz: 31.0\n    qos_overrides:\n"
        "      /acc:\n        publisher:\n          depth: 7\n"
    )
    sim = start(
        *("--params", str(path), "--frequency-hz", "33", "--plastic-mm", "0.5"),
        *("--ros-args", "-p", "meter.window_revolutions:=8", "-r", "drum/acceleration:=acc"),
    )
    blocks = client.listen("acc", DrumAcceleration)
    client.spin_until(lambda: blocks)
    assert client.get_parameter("exciter.frequency_hz") == 33.0
    assert client.get_parameter("soil.plastic_parameter_m") == 0.5e-3
    assert client.get_parameter("soil.shear_modulus_pa") == 80e6
    assert client.get_parameter("soil.density_kg_m3") == 1900.0
    assert client.get_parameter("meter.window_revolutions") == 8
    assert client.get_parameter("exciter.amplitude_m") == 1.6e-3
    assert client.get_parameter("qos_overrides./acc.publisher.depth") == 7
    assert sim.end() == 0
    assert sim.complaints == []
