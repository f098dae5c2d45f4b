# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What a meter under test may do: the limits of the verdict, and the file that says them."""

from __future__ import annotations

from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path
from typing import ClassVar

from yaml.nodes import MappingNode, ScalarNode

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import ParameterError, ParameterGroup, Value
from roller_sim_ros.parameters.quantity import declared, parameter
from roller_sim_ros.scenario.nodes import compose, entries, line_of, load_text, scalar


class LimitsError(RollerSimError):
    """A file of limits cannot be read, or something in it is wrong."""


@dataclass(frozen=True)
class Limits(ParameterGroup):
    """The limits; all are assumptions of this project, to be replaced by those of the meter's data sheet.

    Raises
    ------
    ParameterError
        If a value breaks its declaration.
    """

    group: ClassVar[str] = "limits"

    least_values: int = parameter(
        32, "", "values that have to be compared for a verdict at all", minimum=1, maximum=10**9
    )
    bias_percent: float = parameter(
        3.0, "%", "mean deviation from the true CMV, over its mean", minimum=0.0, maximum=1e6
    )
    rms_percent: float = parameter(
        6.0, "%", "root mean square deviation, over that of the true CMV", minimum=0.0, maximum=1e6
    )
    rms_in_double_jump_percent: float = parameter(
        10.0, "%", "the same over the revolutions in which the drum jumps", minimum=0.0, maximum=1e6
    )
    latency_s: float = parameter(
        0.5,
        "s",
        "by how much the values as they arrive lag the true CMV of the same window",
        minimum=0.0,
        maximum=60.0,
    )
    ceiling_percent: float = parameter(
        1.0,
        "%",
        "values that stand at the greatest one while the true CMV there differs by more than 5 %",
        minimum=0.0,
        maximum=100.0,
    )
    first_value_s: float = parameter(
        5.0, "s", "from the first true CMV to the meter's first value", minimum=0.0, maximum=1e6
    )
    availability_percent: float = parameter(
        98.0,
        "%",
        "revolutions with a value, of those with a true one, faults aside",
        minimum=0.0,
        maximum=100.0,
    )
    gap_s: float = parameter(
        1.0, "s", "longest time without a value, faults aside", minimum=0.0, maximum=1e6
    )
    standing_percent: float = parameter(
        0.0,
        "%",
        "revolutions with a value while the eccentric stands",
        minimum=0.0,
        maximum=100.0,
    )
    alarm_rmv: float = parameter(
        20.0,
        "",
        "RMV above which the drum is said to double-jump; the meter's own where it gives an RMV",
        minimum=0.1,
        maximum=1e4,
    )
    alarm_band_percent: float = parameter(
        25.0,
        "%",
        "band of the true RMV around alarm_rmv in which either answer is right",
        minimum=0.0,
        maximum=99.0,
    )
    alarm_delay_revolutions: int = parameter(
        20,
        "",
        "revolutions after a change of the true state in which either answer is right",
        minimum=0,
        maximum=10**6,
    )
    wrong_alarms_percent: float = parameter(
        1.0, "%", "alarms where the drum does not jump", minimum=0.0, maximum=100.0
    )
    missing_alarms_percent: float = parameter(
        1.0, "%", "no alarm where the drum jumps", minimum=0.0, maximum=100.0
    )
    fault_margin_percent: float = parameter(
        0.5,
        "%",
        "added to the deviation that a fault allows, for what the meter scatters without it",
        minimum=0.0,
        maximum=1e6,
    )
    flagged_value_percent: float = parameter(
        15.0,
        "%",
        "deviation up to which a value under a fault that has to be flagged need not be",
        minimum=0.0,
        maximum=1e6,
    )
    settle_revolutions: int = parameter(
        20,
        "",
        "revolutions after a fault in which the meter's window may still hold some of it",
        minimum=0,
        maximum=10**6,
    )


def read_limits(path: Path) -> Limits:
    """Return the limits of a YAML file, ``name: value`` in each line; what it leaves out has its default.

    Raises
    ------
    LimitsError
        If anything is wrong; the message begins with file and line.
    """
    try:
        root = compose(path, load_text(path))
        if not isinstance(root, MappingNode):
            raise LimitsError(f"{path}:{line_of(root)}: holds no limits, as in bias_percent: 3")
        known = [name for name, _, _ in declared(Limits)]
        values: dict[str, Value] = {}
        lines: dict[str, int] = {}
        for key, key_node, value_node in entries(path, root):
            lines[f"{Limits.group}.{key}"] = line = line_of(key_node)
            if key not in known:
                near = get_close_matches(key, known, n=1, cutoff=0.5)
                offer = f"did you mean {near[0]}?" if near else f"there are {', '.join(known)}"
                raise LimitsError(f"{path}:{line}: unknown limit {key!r}; {offer}")
            value = scalar(path, value_node) if isinstance(value_node, ScalarNode) else None
            if value is None:
                raise LimitsError(f"{path}:{line}: {key}: must be a single number")
            values[key] = value
    except LimitsError:
        raise
    except RollerSimError as error:
        raise LimitsError(str(error)) from None
    try:
        return Limits(**values)  # type: ignore[arg-type]
    except ParameterError as error:
        short = error.name.rpartition(".")[2]
        line = lines[error.name]
        raise LimitsError(f"{path}:{line}: {short} = {error.value!r}: {error.reason}") from None
