# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Parameters: declarations, checks, the flat form, parameter files."""

from __future__ import annotations

import math
import re
from dataclasses import FrozenInstanceError
from pathlib import Path

import pytest

from roller_sim_ros.parameters import (
    PARAMETERS,
    Configuration,
    Exciter,
    Machine,
    Meter,
    Pacing,
    ParameterError,
    Quantity,
    Soil,
    covarying_plastic_parameter,
    lookup,
)
from roller_sim_ros.parameters.file import ParameterFileError, read_parameters
from roller_sim_ros.parameters.quantity import check

# What a name ends in, and the unit that it stands for.
SUFFIXES = {
    "_hz_per_s": "Hz/s",
    "_m_per_s": "m/s",
    "_kg_m3": "kg/m³",
    "_m_s2": "m/s²",
    "_hz": "Hz",
    "_kg": "kg",
    "_pa": "Pa",
    "_rad": "rad",
    "_m": "m",
    "_s": "s",
}


def unit_by_name(name: str) -> str:
    return next((unit for suffix, unit in SUFFIXES.items() if name.endswith(suffix)), "")


@pytest.mark.parametrize("name", PARAMETERS)
def test_declarations_are_sound(name: str) -> None:
    quantity, default = PARAMETERS[name]
    assert check(name, quantity, default, default) == default
    assert quantity.unit == unit_by_name(name)
    assert quantity.doc
    assert not quantity.doc.endswith(".")
    if not isinstance(default, bool | str):
        assert quantity.minimum is not None, "a number without bound"
        assert quantity.maximum is not None
    if quantity.flag:
        assert quantity.flag.startswith("--")
        assert quantity.scale > 0.0
        assert bool(quantity.flag_unit) == bool(quantity.unit)


def test_flags_are_unique() -> None:
    flags = [quantity.flag for quantity, _ in PARAMETERS.values() if quantity.flag]
    assert len(set(flags)) == len(flags)


@pytest.mark.parametrize("name", PARAMETERS)
def test_bounds_are_inclusive_and_what_lies_beyond_is_refused(name: str) -> None:
    quantity, default = PARAMETERS[name]
    if isinstance(default, bool | str):
        return
    for bound, outward in ((quantity.minimum, -1), (quantity.maximum, 1)):
        assert bound is not None
        inside = int(bound) if isinstance(default, int) else bound
        assert check(name, quantity, default, inside) == inside
        step = 1.0 if isinstance(default, int) else abs(bound) * 1e-9 + 1e-12
        with pytest.raises(ParameterError, match=rf"{re.escape(name)} = .*must be at ") as caught:
            check(name, quantity, default, bound + outward * step)
        assert f"{bound:g} {quantity.unit}".strip() in str(caught.value)
        assert caught.value.name == name


@pytest.mark.parametrize(
    ("default", "value", "expected"),
    [
        (1.0, 2, 2.0),
        (1, 2.0, 2),
        (True, False, False),
        ("a", "b", "b"),
    ],
)
def test_values_take_the_type_of_the_default(
    default: object, value: object, expected: object
) -> None:
    found = check("x", Quantity("", "doc"), default, value)  # type: ignore[arg-type]
    assert found == expected
    assert type(found) is type(default)


@pytest.mark.parametrize(
    ("default", "value", "reason"),
    [
        (1.0, "2", "must be a number of kg"),
        (1.0, True, "must be a number"),
        (1.0, None, "must be a number"),
        (1.0, [1.0], "must be a number"),
        (1.0, math.nan, "must be finite"),
        (1.0, math.inf, "must be finite"),
        (1, 1.5, "must be a whole number"),
        (1, math.nan, "must be a whole number"),
        (True, 1, "must be true or false"),
        (True, "true", "must be true or false"),
        ("a", 1, "must be a text"),
        ("a", "c", "must be one of a, b"),
    ],
)
def test_values_of_another_kind_are_refused(default: object, value: object, reason: str) -> None:
    choices = ("a", "b") if default == "a" else ()
    unit = "" if isinstance(default, bool | str) else "kg"
    with pytest.raises(ParameterError, match=re.escape(f"x = {value!r}: {reason}")):
        check("x", Quantity(unit, "doc", choices=choices), default, value)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("quantity", "text"),
    [
        (Quantity("Pa", "", 1.0, 2.0), "1 … 2 Pa"),
        (Quantity("", "", 1.0, 2.0), "1 … 2"),
        (Quantity("m", "", 0.5), "at least 0.5 m"),
        (Quantity("m", "", None, 0.5), "at most 0.5 m"),
        (Quantity("", "", choices=("a", "b")), "a | b"),
        (Quantity("m", ""), "any"),
    ],
)
def test_bounds_text(quantity: Quantity, text: str) -> None:
    assert quantity.bounds_text() == text


def test_groups_are_checked_on_construction_and_frozen() -> None:
    with pytest.raises(ParameterError, match=r"soil\.shear_modulus_pa = 80\.0: must be at least"):
        Soil(shear_modulus_pa=80.0)
    soil = Soil(shear_modulus_pa=80_000_000)
    assert isinstance(soil.shear_modulus_pa, float)
    with pytest.raises(FrozenInstanceError):
        soil.shear_modulus_pa = 1e7  # type: ignore[misc]


def test_rules_beyond_bounds() -> None:
    with pytest.raises(ParameterError, match="window_revolutions = 15: must be an even number"):
        Meter(window_revolutions=15)
    with pytest.raises(ParameterError, match="samples_per_message = 48: must be a divisor of 128"):
        Pacing(samples_per_message=48)


def test_flat_form_holds_every_parameter_and_makes_the_same_configuration() -> None:
    changed = Configuration().changed(
        {"soil.shear_modulus_pa": 80e6, "exciter.kind": "directed", "meter.window_revolutions": 8}
    )
    assert list(changed.flat()) == list(PARAMETERS)
    assert Configuration().changed(changed.flat()) == changed
    assert {name for name, value in changed.flat().items() if value != PARAMETERS[name][1]} == {
        "soil.shear_modulus_pa",
        "exciter.kind",
        "meter.window_revolutions",
    }


def test_changed_leaves_the_original_alone_and_takes_all_or_nothing() -> None:
    original = Configuration()
    with pytest.raises(ParameterError, match="plastic_parameter_m"):
        original.changed({"soil.shear_modulus_pa": 80e6, "soil.plastic_parameter_m": 1.0})
    assert original.changed({"soil.shear_modulus_pa": 80e6}) is not original
    assert original == Configuration()


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("soil.shear_modulus_mpa", "; did you mean soil.shear_modulus_pa?"),
        ("exciter.frequency", "; did you mean exciter.frequency_hz?"),
        ("zzz", ""),
    ],
)
def test_unknown_names_are_refused_with_the_nearest(name: str, hint: str) -> None:
    with pytest.raises(ParameterError) as caught:
        lookup(name, 35)
    assert str(caught.value) == f"{name} = 35: there is no such parameter{hint}"


def test_the_paper_s_machine_and_soils() -> None:
    machine, exciter = Machine(), Exciter()
    assert machine.static_load_n == pytest.approx(54.9e3, rel=1e-3)
    force = machine.drum_mass_kg * exciter.amplitude_m * (2 * math.pi * exciter.frequency_hz) ** 2
    assert force == pytest.approx(158.5e3, rel=1e-3)
    assert covarying_plastic_parameter(35e6) == pytest.approx(0.8e-3, rel=1e-12)
    assert covarying_plastic_parameter(80e6) == pytest.approx(0.5e-3, rel=1e-3)


GOOD_FILES = {
    "ros": "/**:\n  ros__parameters:\n    soil: {shear_modulus_pa: 35.0e+6}\n",
    "node": "roller_sim:\n  ros__parameters:\n    soil:\n      shear_modulus_pa: 35000000.0\n",
    "namespace": "/roller_1/roller_sim:\n  ros__parameters:\n    soil.shear_modulus_pa: 35e6\n",
    "nested namespace": "a:\n  roller_sim:\n    ros__parameters: {soil: {shear_modulus_pa: 3.5e7}}\n",
    "plain": "soil:\n  shear_modulus_pa: 35_000_000\n",
    "dotted": "soil.shear_modulus_pa: 35.e6\n",
    "beside others": (
        "my_meter:\n  ros__parameters: {window: 3}\n"
        "/**:\n  ros__parameters: {use_sim_time: true, soil: {shear_modulus_pa: 35e+6}}\n"
    ),
}


@pytest.mark.parametrize("text", GOOD_FILES.values(), ids=GOOD_FILES)
def test_parameter_files_are_read(text: str, tmp_path: Path) -> None:
    path = tmp_path / "soil.yaml"
    path.write_text(text, encoding="utf-8")
    assert read_parameters(path) == {"soil.shear_modulus_pa": 35e6}


BAD_FILES = {
    "wrong key": (
        b"soil: {shear_modulus_mpa: 35}",
        "soil.shear_modulus_mpa = 35: there is no such parameter; did you mean soil.shear_modulus_pa?",
    ),
    "wrong group": (
        b"/**: {ros__parameters: {ground: {density_kg_m3: 1}}}",
        "ground.density_kg_m3 = 1: there is no such parameter; did you mean soil.density_kg_m3?",
    ),
    "wrong unit": (
        b"soil: {shear_modulus_pa: 35}",
        "soil.shear_modulus_pa = 35: must be at least 2e+06 Pa",
    ),
    "unit in value": (
        b"soil: {shear_modulus_pa: 35 MPa}",
        "soil.shear_modulus_pa = '35 MPa': must be a number of Pa",
    ),
    "rule": (
        b"meter: {window_revolutions: 15}",
        "meter.window_revolutions = 15: must be an even number",
    ),
    "use_sim_time outside ROS": (
        b"use_sim_time: true",
        "use_sim_time = True: there is no such parameter",
    ),
    "group without content": (b"soil:", "soil = None: there is no such parameter"),
    "list": (b"- 1\n- 2\n", "holds no parameters, as in soil: {shear_modulus_pa: 50.0e+6}"),
    "empty": (b"", "holds no parameters"),
    "other node": (
        b"my_meter: {ros__parameters: {x: 1}}",
        "holds no parameters for roller_sim or /**, only for /my_meter",
    ),
    "no YAML": (b"soil: {\n", "is no YAML in line 2: "),
    "no text": (b"soil: \xff", "is no text in UTF-8"),
}


@pytest.mark.parametrize(("data", "reason"), BAD_FILES.values(), ids=BAD_FILES)
def test_bad_parameter_files_are_refused_in_one_line(
    data: bytes, reason: str, tmp_path: Path
) -> None:
    path = tmp_path / "soil.yaml"
    path.write_bytes(data)
    with pytest.raises(ParameterFileError) as caught:
        read_parameters(path)
    message = str(caught.value)
    assert message.startswith(f"{path}: {reason}")
    assert "\n" not in message


def test_a_missing_parameter_file_is_named(tmp_path: Path) -> None:
    path = tmp_path / "soil.yaml"
    with pytest.raises(ParameterFileError, match="cannot be read: No such file or directory"):
        read_parameters(path)
