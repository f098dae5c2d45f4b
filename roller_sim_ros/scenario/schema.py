# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""JSON Schema of scenario files, for editors: made from the declarations that the reader follows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from roller_sim_ros.faults import FAULTS
from roller_sim_ros.parameters import PARAMETERS, ParameterGroup, Quantity, Value
from roller_sim_ros.parameters.quantity import declared
from roller_sim_ros.scenario.build import has_own_section
from roller_sim_ros.scenario.scenario import FaultPart, Scenario, SensorPart
from roller_sim_ros.sensors import SENSORS
from roller_sim_ros.site.declaration import TAG, Declaration, Member, Record, members

DIALECT = "http://json-schema.org/draft-07/schema#"
"""Draft 7, which all editors know."""

_TYPES: dict[type[Any], str] = {float: "number", int: "integer", bool: "boolean", str: "string"}


def json_schema() -> dict[str, Any]:
    """Return the schema of a scenario file as an object of JSON values."""
    definitions: dict[str, Any] = {}
    root = _object(Scenario, definitions)
    root["properties"]["parameters"] = _parameters()
    root["properties"]["sensors"]["items"] = _named(
        SensorPart, "name", {name: (model.doc, model.group) for name, model in SENSORS.items()}
    )
    root["properties"]["faults"]["items"] = _named(
        FaultPart, "id", {name: (_summary(fault), fault) for name, fault in FAULTS.items()}
    )
    for unused in (SensorPart, FaultPart):
        del definitions[unused.__name__]
    return {
        "$schema": DIALECT,
        "title": "Scenario of roller_sim_ros",
        **root,
        "definitions": dict(sorted(definitions.items())),
    }


def _object(
    record: type[Record], definitions: dict[str, Any], kind: str | None = None
) -> dict[str, Any]:
    """Return the schema of a record's mapping."""
    own = members(record)
    properties: dict[str, Any] = {} if kind is None else {TAG: {"const": kind}}
    for member in own:
        properties[member.name] = _member(member, definitions)
    required = [member.name for member in own if member.required]
    if kind is not None:
        required.insert(0, TAG)
    schema: dict[str, Any] = {
        "type": "object",
        "description": _summary(record),
        "properties": properties,
        "additionalProperties": False,
    }
    if required:
        schema["required"] = required
    return schema


def _member(member: Member, definitions: dict[str, Any]) -> dict[str, Any]:
    declaration = member.declaration
    if member.kind is dict:
        schema: dict[str, Any] = {
            "type": "object",
            "additionalProperties": {"type": ["number", "string", "boolean"]},
        }
    elif issubclass(member.kind, Record):
        schema = _records(member, definitions)
        if member.several:
            schema = {"type": "array", "items": schema}
    else:
        schema = _scalar(member.kind, declaration)
    if member.optional:
        schema = {"anyOf": [schema, {"type": "null"}]}
    # In draft 7 nothing counts beside a $ref.
    if "$ref" in schema:
        schema = {"allOf": [schema]}
    schema["description"] = _description(declaration)
    if not member.required and isinstance(member.default, bool | int | float | str):
        schema["default"] = member.default
    return schema


def _records(member: Member, definitions: dict[str, Any]) -> dict[str, Any]:
    registry = member.declaration.registry
    if registry is None:
        return _reference(member.kind, member.kind.__name__, definitions, None)
    return {
        "anyOf": [
            _reference(record, f"{member.kind.__name__}.{kind}", definitions, kind)
            for kind, record in registry.items()
        ]
    }


def _reference(
    record: type[Record], name: str, definitions: dict[str, Any], kind: str | None
) -> dict[str, Any]:
    if name not in definitions:
        definitions[name] = _object(record, definitions, kind)
    return {"$ref": f"#/definitions/{name}"}


def _scalar(kind: type[Any], declaration: Declaration | Quantity) -> dict[str, Any]:
    schema: dict[str, Any] = {"type": _TYPES[kind]}
    if declaration.choices:
        schema["enum"] = list(declaration.choices)
    if declaration.minimum is not None:
        schema["minimum"] = declaration.minimum
    if declaration.maximum is not None:
        schema["maximum"] = declaration.maximum
    return schema


def _named(
    record: type[Record], key: str, entries: Mapping[str, tuple[str, type[ParameterGroup]]]
) -> dict[str, Any]:
    """Return the schema of a sensor or fault: one alternative for each name, with the parameters that it has."""
    alternatives = []
    for name, (doc, group) in entries.items():
        schema = _object(record, {})
        schema["description"] = doc
        schema["properties"][key] = {"const": name}
        schema["properties"]["parameters"] = _values(
            {item: (quantity, default) for item, quantity, default in declared(group)},
            "how it differs from what its name says, SI units",
        )
        alternatives.append(schema)
    return {"anyOf": alternatives}


def _parameters() -> dict[str, Any]:
    """Return the schema of the parameters that a scenario may say by their dotted names."""
    own = {name: known for name, known in PARAMETERS.items() if not has_own_section(name)}
    return _values(own, "other parameters by their dotted names, SI units")


def _values(quantities: Mapping[str, tuple[Quantity, Value]], doc: str) -> dict[str, Any]:
    properties: dict[str, Any] = {}
    for name, (quantity, default) in quantities.items():
        unit = f", {quantity.unit}" if quantity.unit else ""
        properties[name] = {
            **_scalar(type(default), quantity),
            "description": f"{quantity.doc}{unit}",
            "default": default,
        }
    return {
        "type": "object",
        "description": doc,
        "properties": properties,
        "additionalProperties": False,
    }


def _description(declaration: Declaration) -> str:
    if not declaration.source:
        return declaration.doc
    verified = "verified" if declaration.verified else "not verified"
    return f"{declaration.doc} (source: {declaration.source}; {verified})"


def _summary(record: type[Any]) -> str:
    return (record.__doc__ or "").strip().splitlines()[0]
