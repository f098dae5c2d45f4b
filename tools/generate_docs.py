# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Writes what follows from the declarations: docs pages, config/*.yaml, README's tables (`make docs`).

``--check`` writes nothing and fails when a file is not what it would be.
"""

from __future__ import annotations

import sys
import textwrap
from collections.abc import Sequence
from decimal import Decimal
from pathlib import Path

from roller_sim_ros.faults import FAULTS
from roller_sim_ros.parameters import PARAMETERS, Configuration, Pacing, Quantity, Value
from roller_sim_ros.parameters.configuration import GROUPS
from roller_sim_ros.parameters.quantity import ParameterGroup, declared
from roller_sim_ros.score.limits import Limits
from roller_sim_ros.sensors import SENSORS
from roller_sim_ros.wire.topics import TOPICS, Direction, Topic
from tools.generated import write_or_check
from tools.markdown_table import table
from tools.sections import with_sections

ROOT = Path(__file__).resolve().parent.parent
GENERATED = "by tools/generate_docs.py (make docs) from the declarations"

SOILS = {
    "loose": ("the paper's softer ground (Figure 15): period 1 at 28 Hz, 1.6 mm", 35e6, 0.8e-3),
    "medium": ("ground between the paper's two, the default", 50e6, 0.65e-3),
    "dense": ("the paper's stiffer ground (Figure 15): double jump at 28 Hz, 1.6 mm", 80e6, 0.5e-3),
}
"""What it is, G in Pa, p in m."""

SENSORS_TEXT = """\
There is one sensor for each thing measured; the accelerometer is an ideal one where none is chosen. Truth goes
out beside them, untouched. Every error of every sensor has random numbers of its own, from the run's seed: one
switched on changes no other, and the size of the blocks changes no bit.

The accelerometer is a chain: specific force, mounting angle and cross-axis, sensitivity, bias and drift (exact
Gauss-Markov), analogue low-pass (exact for straight lines from sample to sample, also where the sample period
changes), sampling, noise (the process that the low-pass makes of white noise), faults, range, converter. It
clips, and never wraps around; what is no number has the most negative count. With a sample rate of its own the
low-passed signal is interpolated between the model's samples by a windowed sinc: what folds back is what the
low-pass lets through, what interpolation adds is below 1e-3 up to order 40. The model has 128 samples per
revolution and knows nothing beyond order 64. A sample comes once the model is 12 samples further. The built-in
meter lays samples of a fixed rate on the eccentric's angle first, so its value comes a little after the revolution."""

FAULTS_TEXT = """\
Scheduled in a scenario by time, chainage, pass or revolution, or injected and cleared while the roller runs. A
fault begins and ends where a revolution begins; all that are active are on the topic `faults`. Only faults of
the exciter change the true motion. *Unaffected* means against the true CMV, a flagged value excepted; *flagged*
means by status, NaN or silence; what is expected is of the default parameters. What cannot be is refused with
the reason; where nobody can know whether two that exclude each other will meet, the later one is held back, and
`faults` says so. What comes twice or in the wrong order are messages, so it goes by the size of the blocks."""


LIMITS_TEXT = """\
`roller-sim score` and `roller-sim bench` take them from a YAML file (`--limits`), one `name: value` a line; what it
leaves out has its default. A limit that does not matter is set so wide that it always holds. All defaults are
assumptions of this project: what a meter has to keep stands on its data sheet. The rows that they decide:
[score.md](score.md)."""


def contents() -> dict[str, str]:
    """Return {path from the root: text} of all generated files."""
    default = Configuration()
    files = {
        "docs/parameters.md": parameters_page(),
        "docs/topics.md": topics_page(),
        "docs/sensors.md": sensors_page(),
        "docs/faults.md": faults_page(),
        "docs/limits.md": limits_page(),
        "README.md": with_sections(ROOT / "README.md", readme_sections()),
        "config/paper_roller.yaml": parameter_file(
            "The paper's 10 t roller ('Roller data') at its nominal frequency and amplitude.",
            default,
            ("machine", "exciter"),
        ),
    }
    for name, (what, shear_modulus_pa, plastic_parameter_m) in SOILS.items():
        configuration = default.changed(
            {
                "soil.shear_modulus_pa": shear_modulus_pa,
                "soil.plastic_parameter_m": plastic_parameter_m,
            }
        )
        files[f"config/{name}.yaml"] = parameter_file(
            f"{what[0].upper()}{what[1:]}.", configuration, ("soil",)
        )
    return files


def readme_sections() -> dict[str, str]:
    """Return {name: text} of README's tables and examples, as the declarations and files are now."""
    pacing = Pacing()
    parameters = [
        (
            f"`{name}`",
            _value_text(default),
            quantity.unit,
            "live" if quantity.changes else "",
            quantity.doc,
        )
        for name, (quantity, default) in PARAMETERS.items()
    ]
    topics = [_topic_row(topic, pacing) for topic in TOPICS]
    sections = {
        "topics": table(("topic", "type", "rate", "QoS", "what it says"), topics),
        "parameters": table(("name", "default", "unit", "live", "what it is"), parameters),
    }
    for example in ("meter_client", "controller_client", "test_my_meter"):
        code = (ROOT / "examples" / f"{example}.py").read_text(encoding="utf-8")
        # Below the notice of copyright and licence.
        _, _, code = code.partition("\n\n")
        sections[example] = f"```python\n{code.rstrip()}\n```"
    return sections


def parameters_page() -> str:
    """Return the page of all parameters, a table for each group."""
    lines = [
        "# Parameters",
        "",
        f"Generated {GENERATED} in `roller_sim_ros/parameters/`.",
        "",
        "ROS 2 parameters and YAML files have the dotted names and SI units. **Live** ones change while the roller",
        "runs, at the next multiple of 128 samples, those of the recording between two blocks; the others are",
        "read-only while it is active. Flags of `roller-sim sim` and `roller-sim run` are in the unit that their name",
        "ends in.",
    ]
    for group, declaration in GROUPS.items():
        rows = [
            (
                f"`{name}`",
                _value_text(default),
                quantity.unit,
                _bounds(quantity, default),
                "live" if quantity.changes else "",
                f"`{quantity.flag}` ({_flag_default(quantity, default)})" if quantity.flag else "",
                quantity.doc,
            )
            for name, (quantity, default) in PARAMETERS.items()
            if name.partition(".")[0] == group
        ]
        summary = (declaration.__doc__ or "").strip().splitlines()[0]
        lines += ["", f"## {group}", "", summary, ""]
        lines.append(
            table(("name", "default", "unit", "bounds", "live", "flag", "what it is"), rows)
        )
    return "\n".join([*lines, ""])


def topics_page() -> str:
    """Return the page of all topics, a table for what the node does with them."""
    pacing = Pacing()
    lines = [
        "# Topics",
        "",
        f"Generated {GENERATED} in `roller_sim_ros/wire/topics.py`.",
        "",
        "Names are relative to the node's namespace, so that they can be remapped; those that begin with / are not.",
        "All are keep-last; depths are for the default pacing. QoS overrides are enabled (`qos_overrides.…`).",
        "Fields and their units are explained in `msg/*.msg`; x is forward, z is up.",
    ]
    titles = {
        Direction.PUBLISHED: "Published by the node",
        Direction.SUBSCRIBED: "Obeyed by the node",
        Direction.RECORDED: "Recorded beside them",
    }
    for direction, title in titles.items():
        rows = [_topic_row(topic, pacing) for topic in TOPICS if topic.direction is direction]
        lines += ["", f"## {title}", ""]
        lines.append(table(("topic", "type", "rate", "QoS", "what it says"), rows))
    return "\n".join([*lines, ""])


def sensors_page() -> str:
    """Return the page of all sensors: their parameters, and presets with the source of each value."""
    lines = [
        "# Sensors",
        "",
        f"Generated {GENERATED} in `roller_sim_ros/sensors/`.",
        "",
        SENSORS_TEXT,
        "",
    ]
    rows = [(f"`{name}`", model.slot.value, model.doc) for name, model in SENSORS.items()]
    lines.append(table(("name", "measures", "what it is"), rows))
    groups = dict.fromkeys(model.group for model in SENSORS.values())
    for group in groups:
        names = ", ".join(f"`{name}`" for name, model in SENSORS.items() if model.group is group)
        lines += ["", f"## Parameters of {names}", ""]
        lines.append(table(("name", "default", "unit", "bounds", "what it is"), _group_rows(group)))
    for name, model in SENSORS.items():
        if model.preset is not None and model.preset.stated:
            stated = [
                (f"`{key}`", f"{it.value:.6g}", it.source, "yes" if it.verified else "no")
                for key, it in model.preset.stated.items()
            ]
            lines += ["", f"## `{name}`: {model.preset.doc}", ""]
            lines.append(table(("parameter", "value", "source", "read there"), stated))
    return "\n".join([*lines, ""])


def faults_page() -> str:
    """Return the page of all faults: where they act, their parameters, what a correct meter does."""
    lines = [
        "# Faults",
        "",
        f"Generated {GENERATED} in `roller_sim_ros/faults/`.",
        "",
        FAULTS_TEXT,
        "",
    ]
    rows = [
        (
            f"`{name}`",
            fault.stage.value,
            _summary(fault),
            fault().expectation().text(),
            ", ".join(f"`{other}`" for other in fault.excludes),
        )
        for name, fault in FAULTS.items()
    ]
    lines.append(table(("id", "stage", "what it is", "a correct meter is", "excludes"), rows))
    for name, fault in FAULTS.items():
        parameters = _group_rows(fault)
        if parameters:
            lines += ["", f"## Parameters of `{name}`", ""]
            lines.append(table(("name", "default", "unit", "bounds", "what it is"), parameters))
    return "\n".join([*lines, ""])


def limits_page() -> str:
    """Return the page of all limits of the verdict on a meter."""
    lines = [
        "# Limits of the verdict",
        "",
        f"Generated {GENERATED} in `roller_sim_ros/score/limits.py`.",
        "",
        LIMITS_TEXT,
        "",
        table(("limit", "default", "unit", "bounds", "what it is"), _group_rows(Limits)),
    ]
    return "\n".join([*lines, ""])


def _group_rows(group: type[ParameterGroup]) -> list[tuple[str, ...]]:
    return [
        (
            f"`{name}`",
            _value_text(default),
            quantity.unit,
            _bounds(quantity, default),
            quantity.doc,
        )
        for name, quantity, default in declared(group)
    ]


def _summary(declaration: type) -> str:
    return (declaration.__doc__ or "").strip().splitlines()[0]


def parameter_file(title: str, configuration: Configuration, groups: Sequence[str]) -> str:
    """Return a parameter file as ROS 2 reads it, with the parameters of some groups."""
    values = configuration.flat()
    lines = [f"# {title}", "#", f"# Generated {GENERATED}. SI units.", "/**:", "  ros__parameters:"]
    for group in groups:
        lines.append(f"    {group}:")
        for name, (quantity, default) in PARAMETERS.items():
            prefix, _, short = name.partition(".")
            if prefix == group:
                comment = textwrap.wrap(f"{quantity.doc}; {_bounds(quantity, default)}", 92)
                lines += [f"      # {line}" for line in comment]
                lines.append(f"      {short}: {_value_text(values[name])}")
    return "\n".join([*lines, ""])


def _topic_row(topic: Topic, pacing: Pacing) -> tuple[str, ...]:
    qos = topic.qos(pacing)
    durability = "" if qos.durability == "volatile" else f", {qos.durability.replace('_', '-')}"
    return (
        f"`{topic.name}`",
        topic.type_name.replace("/msg/", "/"),
        topic.rate,
        f"{qos.reliability}, depth {qos.depth}{durability}",
        topic.doc,
    )


def _bounds(quantity: Quantity, default: Value) -> str:
    if isinstance(default, bool):
        return "true or false"
    if isinstance(default, str) and not quantity.choices:
        return "any text"
    return quantity.bounds_text()


def _flag_default(quantity: Quantity, default: Value) -> str:
    if isinstance(default, str):
        return default or "none"
    return f"{default / quantity.scale:g} {quantity.flag_unit}".rstrip()


def _value_text(value: Value) -> str:
    """Return a value as YAML has it, numbers without exponent: 2e-05 would be a text."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        text = f"{Decimal(repr(value)):f}"
        return text if "." in text else f"{text}.0"
    return str(value) if value != "" else '""'


def main(arguments: Sequence[str]) -> int:
    return write_or_check(ROOT, contents(), arguments, "make docs")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
