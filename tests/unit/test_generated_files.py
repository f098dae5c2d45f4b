# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What `make docs` writes is what the declarations say, and the parameter files are accepted."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
import yaml

from roller_sim_ros.parameters import PARAMETERS, Configuration
from roller_sim_ros.parameters.file import read_parameters
from roller_sim_ros.wire.topics import TOPICS
from tools import generate_docs, generate_picture
from tools.generated import stale

ROOT = Path(__file__).resolve().parents[2]


def test_generated_files_are_not_stale() -> None:
    assert stale(generate_docs.ROOT, generate_docs.contents()) == [], "run make docs"


def test_picture_of_the_data_flow_is_that_of_the_imports() -> None:
    assert stale(ROOT, generate_picture.contents()) == [], "run make docs"
    graph = generate_picture.reduced(generate_picture.imports())
    assert "drum_soil" in graph["session"]
    # What follows from other arrows is not drawn.
    assert "half_space" in generate_picture.imports()["drum_soil"]
    assert "half_space" not in graph["session"]


def test_a_changed_file_is_found_and_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(generate_docs, "ROOT", tmp_path)
    for folder in ("docs", "config"):
        (tmp_path / folder).mkdir()
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    shutil.copy(ROOT / "README.md", tmp_path)
    assert generate_docs.main(["--check"]) == 1
    assert not list(tmp_path.glob("docs/*"))
    assert generate_docs.main([]) == 0
    assert generate_docs.main(["--check"]) == 0
    page = tmp_path / "docs" / "topics.md"
    page.write_text(page.read_text(encoding="utf-8") + "by hand\n", encoding="utf-8")
    assert stale(generate_docs.ROOT, generate_docs.contents()) == ["docs/topics.md"]


def test_pages_name_every_parameter_and_every_topic() -> None:
    parameters, topics = generate_docs.parameters_page(), generate_docs.topics_page()
    for name, (quantity, _) in PARAMETERS.items():
        (row,) = [line for line in parameters.splitlines() if line.startswith(f"| `{name}` |")]
        assert quantity.doc in row
        assert quantity.flag in row
    for topic in TOPICS:
        (row,) = [line for line in topics.splitlines() if line.startswith(f"| `{topic.name}` |")]
        assert topic.doc in row


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("paper_roller", {}),
        ("loose", {"soil.shear_modulus_pa": 35e6, "soil.plastic_parameter_m": 0.8e-3}),
        ("medium", {"soil.shear_modulus_pa": 50e6, "soil.plastic_parameter_m": 0.65e-3}),
        ("dense", {"soil.shear_modulus_pa": 80e6, "soil.plastic_parameter_m": 0.5e-3}),
    ],
)
def test_parameter_files_say_the_paper_s_roller_and_soils(
    name: str, expected: dict[str, float]
) -> None:
    path = ROOT / "config" / f"{name}.yaml"
    values = read_parameters(path)
    assert Configuration().changed(values) == Configuration().changed(expected)
    # Whatever reads YAML 1.1 has to see numbers, not texts.
    section = yaml.safe_load(path.read_text(encoding="utf-8"))["/**"]["ros__parameters"]
    for group, content in section.items():
        for short, value in content.items():
            assert type(value) is type(PARAMETERS[f"{group}.{short}"][1])
