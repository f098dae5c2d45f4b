# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What runs in the unit: pythonfmu loads this module and calls its class."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from types import MappingProxyType
from typing import Any
from xml.etree.ElementTree import Element, SubElement

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

from roller_sim_ros.fmu.build import CONFIGURATION
from roller_sim_ros.fmu.stepped import INPUTS, Outputs, SteppedRoller
from roller_sim_ros.parameters import PARAMETERS, Configuration

OUTPUTS = {
    "acceleration_vertical": "m/s2, drum axle, positive up",
    "acceleration_horizontal": "m/s2, drum axle, positive forward",
    "soil_force": "N, of the soil on the drum, positive up, never negative",
    "cmv": "compaction meter value of the last complete revolution, dimensionless; 0 while there is none",
}


class Roller(Fmi2Slave):  # type: ignore[misc]  # pythonfmu has no types
    """A vibratory roller: inputs act from the next revolution of the eccentric on."""

    description = "vibratory soil-compaction roller (Sandström 1994): drum, eccentric, soil"
    license = "Apache-2.0"

    def __init__(self, **facts: Any) -> None:
        super().__init__(**facts)
        path = Path(self.resources) / CONFIGURATION
        values = json.loads(path.read_text(encoding="utf-8"))
        self._roller = SteppedRoller(Configuration().changed(values))
        for name in INPUTS:
            quantity, _ = PARAMETERS[name]
            self.register_variable(
                Real(
                    name,
                    causality=Fmi2Causality.input,
                    variability=Fmi2Variability.discrete,
                    description=f"{quantity.doc}; {quantity.bounds_text()}",
                    getter=lambda name=name: self._roller.inputs[name],
                    setter=lambda value, name=name: self._roller.inputs.update({name: value}),
                ),
                nested=False,
            )
        for name in vars(Outputs()):
            self.register_variable(
                Real(
                    name,
                    causality=Fmi2Causality.output,
                    variability=Fmi2Variability.continuous,
                    description=OUTPUTS[name],
                    getter=lambda name=name: getattr(self._roller.outputs, name),
                ),
                nested=False,
            )

    def to_xml(self, model_options: Mapping[str, str] = MappingProxyType({})) -> Element:
        """Return the model description; FMI wants outputs named once more among the initial unknowns."""
        root: Element = super().to_xml(model_options)
        (structure,) = root.iter("ModelStructure")
        unknowns = SubElement(structure, "InitialUnknowns")
        for output in structure.findall("Outputs/Unknown"):
            SubElement(unknowns, "Unknown", attrib=output.attrib)
        return root

    def exit_initialization_mode(self) -> None:
        """Show the first sample."""
        self._roller.advance_to(0.0)

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Advance by a communication step; an input that cannot be ends the run, pythonfmu logs the reason."""
        self._roller.advance_to(current_time + step_size)
        return True
