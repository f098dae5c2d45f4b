# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The JSON Schema: not stale, and of one mind with the reader."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

from roller_sim_ros.faults import FAULTS
from roller_sim_ros.scenario import ScenarioError, parse_scenario
from roller_sim_ros.scenario.schema import json_schema
from roller_sim_ros.scenario.shipped import shipped_scenarios
from roller_sim_ros.sensors import SENSORS
from roller_sim_ros.site import FEATURES, LAWS
from tools import generate_schema
from tools.generated import stale

ROOT = Path(__file__).resolve().parents[3]
SHIPPED = shipped_scenarios()
_TYPES: dict[str, Any] = {
    "object": dict,
    "array": list,
    "string": str,
    "boolean": bool,
    "null": type(None),
}


def breaches(value: object, schema: Any, root: Any) -> Iterator[str]:
    """The part of JSON Schema, draft 7, that the schema uses."""
    if "$ref" in schema:
        name = schema["$ref"].removeprefix("#/definitions/")
        yield from breaches(value, root["definitions"][name], root)
        return
    for part in schema.get("allOf", []):
        yield from breaches(value, part, root)
    if "anyOf" in schema and all(any(breaches(value, it, root)) for it in schema["anyOf"]):
        yield f"{value!r} is none of these"
    if "const" in schema and value != schema["const"]:
        yield f"{value!r} is not {schema['const']!r}"
    if "enum" in schema and value not in schema["enum"]:
        yield f"{value!r} is none of {schema['enum']}"
    if "type" in schema and not _is(value, schema["type"]):
        yield f"{value!r} is no {schema['type']}"
        return
    numeric = isinstance(value, int | float) and not isinstance(value, bool)
    if numeric and not schema.get("minimum", value) <= value <= schema.get("maximum", value):  # type: ignore[operator]
        yield f"{value!r} is out of bounds"
    if isinstance(value, list):
        for item in value:
            yield from breaches(item, schema.get("items", {}), root)
    if isinstance(value, dict):
        yield from (
            f"{name} is missing" for name in schema.get("required", ()) if name not in value
        )
        for name, item in value.items():
            known = schema.get("properties", {}).get(name, schema.get("additionalProperties", True))
            if known is False:
                yield f"{name} is unknown"
            elif known is not True:
                yield from breaches(item, known, root)


def _is(value: object, kind: str) -> bool:
    if kind in ("number", "integer"):
        number = isinstance(value, int | float) and not isinstance(value, bool)
        return number and (kind == "number" or value == int(value))  # type: ignore[arg-type, call-overload]
    return isinstance(value, _TYPES[kind])


@pytest.fixture(scope="module")
def schema() -> dict[str, Any]:
    return json_schema()


def test_generated_files_are_not_stale() -> None:
    assert stale(generate_schema.ROOT, generate_schema.contents()) == [], "run make docs"


def test_a_changed_file_is_found_and_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(generate_schema, "ROOT", tmp_path)
    for folder in ("docs", "scenarios"):
        (tmp_path / folder).mkdir()
    assert generate_schema.main(["--check"]) == 1
    assert generate_schema.main([]) == 0
    assert generate_schema.main(["--check"]) == 0
    (tmp_path / "scenarios" / "scenario.schema.json").write_text("{}", encoding="utf-8")
    assert stale(generate_schema.ROOT, generate_schema.contents()) == [
        "scenarios/scenario.schema.json"
    ]


def test_make_docs_calls_the_generator() -> None:
    recipe = re.search(r"^docs: .*\n((?:\t.*\n)+)", (ROOT / "Makefile").read_text(), re.MULTILINE)
    assert recipe is not None
    assert "tools.generate_schema" in recipe.group(1)


@pytest.mark.parametrize("name", SHIPPED)
def test_the_package_s_scenarios_are_valid_and_name_the_schema(
    name: str, schema: dict[str, Any]
) -> None:
    text = SHIPPED[name].read_text(encoding="utf-8")
    assert list(breaches(yaml.safe_load(text), schema, schema)) == []
    assert text.startswith("# yaml-language-server: $schema=scenario.schema.json\n")
    assert parse_scenario(text, SHIPPED[name]).title.replace("-", " ").replace(" ", "_") == name


def test_every_alternative_of_every_registry_is_in_it(schema: dict[str, Any]) -> None:
    text = json.dumps(schema)
    for name in (*FEATURES, *LAWS, *SENSORS, *FAULTS):
        assert f'{{"const": "{name}"}}' in text


SAME_MIND = {
    "misspelt": {"lane": {"lenght_m": 20}},
    "too short": {"lane": {"length_m": 0.1}},
    "a text": {"lane": {"length_m": "long"}},
    "no lane": {"seed": 1},
    "half a pass": {"lane": {"length_m": 20}, "travel": {"passes": 1.5}},
    "an unknown preset": {"lane": {"length_m": 20}, "ground": {"preset": "mud"}},
    "an unknown feature": {"lane": {"length_m": 20}, "ground": {"features": [{"kind": "hole"}]}},
    "a feature without its place": {
        "lane": {"length_m": 20},
        "ground": {"features": [{"kind": "soft_spot", "length_m": 1}]},
    },
    "a key of another feature": {
        "lane": {"length_m": 20},
        "ground": {
            "features": [{"kind": "hard_object", "at_m": 1, "length_m": 1, "compactability": 0.5}]
        },
    },
    "an unknown fault": {"lane": {"length_m": 20}, "faults": [{"id": "tired"}]},
    "an unknown parameter of a fault": {
        "lane": {"length_m": 20},
        "faults": [{"id": "gain_change", "parameters": {"gain": 2}}],
    },
    "a refused parameter of a sensor": {
        "lane": {"length_m": 20},
        "sensors": [{"name": "mems_10g", "parameters": {"range_m_s2": -1}}],
    },
    "an unknown parameter": {"lane": {"length_m": 20}, "parameters": {"half_space.modle": "exact"}},
    "a parameter with a section": {
        "lane": {"length_m": 20},
        "parameters": {"soil.density_kg_m3": 2e3},
    },
    "a list for a mapping": {"lane": [20]},
    "null for a number": {"lane": {"length_m": None}},
}


@pytest.mark.parametrize("content", SAME_MIND.values(), ids=SAME_MIND)
def test_what_the_reader_refuses_the_schema_refuses(
    content: dict[str, Any], schema: dict[str, Any]
) -> None:
    assert list(breaches(content, schema, schema))
    with pytest.raises(ScenarioError):
        parse_scenario(yaml.safe_dump(content), Path("s.yaml"))


@pytest.mark.parametrize(
    "content",
    [
        {"lane": {"length_m": 20}},
        {"lane": {"length_m": 20, "cell_m": 1}, "duration_s": None, "ground": {"compaction": None}},
        {"lane": {"length_m": 20}, "parameters": {"meter.window_revolutions": 8}},
    ],
)
def test_what_the_reader_takes_the_schema_takes(
    content: dict[str, Any], schema: dict[str, Any]
) -> None:
    assert list(breaches(content, schema, schema)) == []
    parse_scenario(yaml.safe_dump(content), Path("s.yaml"))
