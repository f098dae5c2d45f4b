# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a hostile sender sends: values at and beyond every edge, names that are nearly right, broken bytes."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from functools import cache
from typing import Any

import yaml
from hypothesis import strategies as st

from roller_sim_ros.faults.catalogue import FAULTS
from roller_sim_ros.parameters import PARAMETERS
from roller_sim_ros.parameters.quantity import declared
from roller_sim_ros.scenario import Scenario
from roller_sim_ros.scenario.shipped import shipped_scenarios
from roller_sim_ros.session import ExciterCommand
from roller_sim_ros.site.declaration import members
from roller_sim_ros.wire import messages

EDGES = (
    0.0,
    -0.0,
    math.nan,
    math.inf,
    -math.inf,
    5e-324,
    -5e-324,
    1.7976931348623157e308,
    -1.7976931348623157e308,
    1e-308,
)
INTEGERS = (0, 1, -1, 2**31, 2**63 - 1, -(2**63), 2**64, 10**400, -(10**400))

floats = st.sampled_from(EDGES) | st.floats() | st.floats(-1.0, 100.0) | st.floats(0.0, 0.005)
names = st.sampled_from(sorted(PARAMETERS))
odd_texts = st.sampled_from(["", ".", "soil.", "\0", "a\nb", "ü" * 300, "../../etc", "__class__"])
texts = odd_texts | st.text(max_size=12)
values = (
    floats
    | st.sampled_from(INTEGERS)
    | st.booleans()
    | texts
    | st.integers()
    | st.none()
    | st.lists(st.floats(), max_size=2)
)
"""Of a parameter whose sender does not know its type."""


def mistyped(text: str) -> st.SearchStrategy[str]:
    """Return texts that are nearly the given one."""
    return st.integers(0, max(0, len(text) - 1)).map(lambda at: text[:at] + text[at + 1 :])


@cache
def fitting(name: str) -> st.SearchStrategy[Any]:
    """Return values of a parameter within its bounds, at their edges above all."""
    return within(*PARAMETERS[name])


def within(quantity: Any, default: Any) -> st.SearchStrategy[Any]:
    """Return values within the bounds of a declaration."""
    if isinstance(default, bool):
        return st.booleans()
    if isinstance(default, str):
        return st.sampled_from(quantity.choices or ("",))
    low = -1e300 if quantity.minimum is None else quantity.minimum
    high = 1e300 if quantity.maximum is None else quantity.maximum
    if isinstance(default, int):
        low, high = math.ceil(max(low, -(2**40))), math.floor(min(high, 2**40))
        return st.sampled_from([low, default, high]) | st.integers(low, high)
    return st.sampled_from([low, default, high]) | st.floats(low, high)


@dataclass(frozen=True)
class Command:
    """A command to the exciter."""

    vibrate: bool
    frequency_hz: float
    amplitude_m: float


@dataclass(frozen=True)
class Travel:
    """A command to the travel."""

    speed_m_s: float


@dataclass(frozen=True)
class Change:
    """A set of parameters that is to change as a whole."""

    values: dict[str, Any]


@dataclass(frozen=True)
class Injection:
    """A fault that is to begin."""

    fault_id: str
    parameters: dict[str, Any]
    span: dict[str, Any]


@dataclass(frozen=True)
class Clearing:
    """A fault that is to end."""

    handle: int | None


commands = st.builds(Command, st.booleans(), floats, floats)
travels = st.builds(Travel, floats | st.floats(-3.0, 3.0))
parameter_sets = st.one_of(
    st.dictionaries(names, values, min_size=1, max_size=4),
    st.dictionaries(names.flatmap(mistyped) | texts, values, min_size=1, max_size=3),
    st.lists(names, min_size=1, max_size=6, unique=True).flatmap(
        lambda some: st.fixed_dictionaries({name: fitting(name) for name in some})
    ),
)
changes = st.builds(Change, parameter_sets)


@st.composite
def injections(draw: st.DrawFn) -> Injection:
    """Draw a fault request: known and unknown ids, parameters and spans."""
    fault_id = draw(st.sampled_from(sorted(FAULTS)))
    known = {name: (quantity, default) for name, quantity, default in declared(FAULTS[fault_id])}
    parameters = draw(
        st.dictionaries(
            st.sampled_from(sorted(known)) | texts if known else texts, values, max_size=3
        )
        | st.fixed_dictionaries({}, optional={name: within(*it) for name, it in known.items()})
    )
    span = draw(
        st.fixed_dictionaries(
            {},
            optional={
                "duration_s": floats,
                "revolutions": st.integers(-2, 5) | st.sampled_from(INTEGERS),
                "distance_m": floats,
            },
        )
    )
    if draw(st.integers(0, 4)) == 0:
        fault_id = draw(mistyped(fault_id) | texts)
    return Injection(fault_id, parameters, span)


clearings = st.builds(Clearing, st.none() | st.integers(0, 6) | st.sampled_from(INTEGERS))
fault_requests = injections() | clearings

SCENARIOS = tuple(path.read_text(encoding="utf-8") for path in shipped_scenarios().values())
WORDS = sorted({word for text in SCENARIOS for word in re.findall(r"[a-z_0-9.]+", text)})
scalars = st.none() | st.booleans() | st.integers(-3, 50) | floats | st.sampled_from(WORDS) | texts
trees = st.recursive(
    scalars,
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(st.sampled_from(WORDS) | texts, inner, max_size=4)
    ),
    max_leaves=12,
)


@st.composite
def edited_scenarios(draw: st.DrawFn) -> str:
    """Draw a scenario of the package in which pieces are replaced."""
    text = draw(st.sampled_from(SCENARIOS))
    for _ in range(draw(st.integers(1, 3))):
        place = draw(st.integers(0, len(text)))
        length = draw(st.integers(0, 12))
        put = draw(st.sampled_from(WORDS) | texts | floats.map(str) | st.integers().map(str))
        text = text[:place] + put + text[place + length :]
    return text


scenario_texts = st.one_of(
    st.text(max_size=60),
    st.text(alphabet="abcdelnth_m0123456789.:-[]{}&*!|>'\"#%@,?~ \n\t", max_size=80),
    st.dictionaries(
        st.sampled_from([member.name for member in members(Scenario)]), trees, max_size=5
    ).map(lambda tree: yaml.safe_dump({"lane": {"length_m": 5.0}, **tree}, allow_unicode=True)),
    edited_scenarios(),
)


@st.composite
def parameter_texts(draw: st.DrawFn) -> str:
    """Draw the text of a parameter file."""
    kind = draw(st.integers(0, 2))
    if kind == 0:
        return draw(
            st.text(max_size=60)
            | st.text(alphabet="soil.:{}[]&*!<>0123456789eE-+ \n/", max_size=80)
        )
    content: Any = draw(
        st.dictionaries(
            names | st.sampled_from(["soil", "machine", "/**", "roller_sim"]), trees, max_size=3
        )
        | parameter_sets
    )
    if kind == 2:
        content = {"/**": {"ros__parameters": content}}
    return yaml.safe_dump(content, allow_unicode=True)


COMMAND = messages.exciter_command(ExciterCommand(True, 28.0, 1.6e-3), 0)


@st.composite
def broken(draw: st.DrawFn, whole: bytes, holes: int = 6) -> bytes:
    """Draw bytes that were whole before bytes of them were changed, cut off, put in or repeated."""
    data = bytearray(whole)
    for _ in range(draw(st.integers(1, holes))):
        at = draw(st.integers(0, len(data)))
        act = draw(st.integers(0, 3))
        if act == 0 and at < len(data):
            data[at] = draw(st.integers(0, 255))
        elif act == 1:
            data[at : at + draw(st.integers(1, 8))] = draw(st.binary(max_size=8))
        elif act == 2:
            data[at:at] = data[at : at + draw(st.integers(1, 64))]
        elif draw(st.integers(0, 3)) == 0:
            del data[at:]
    return bytes(data)


command_bytes = st.binary(max_size=80) | broken(COMMAND.data)
