# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What is known of roller and ground before an estimate: from a trace, and what is given over it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from roller_sim_ros.analysis.bag import Bag, BagError
from roller_sim_ros.parameters import PARAMETERS, Configuration, ParameterError, Value

if TYPE_CHECKING:
    from roller_sim_ros.analysis.topics import Selection

MACHINE = "machine."
AMPLITUDE = "exciter.amplitude_m"

KNOWN = tuple(
    name
    for name in PARAMETERS
    if name.startswith((MACHINE, "half_space."))
    or name in ("exciter.kind", "exciter.tilt_rad", AMPLITUDE)
    or name in ("soil.density_kg_m3", "soil.poisson_ratio")
)
"""Parameters that an estimate takes as known."""


def known_of(
    bag: Bag, selection: Selection, given: Mapping[str, Value], *, machine_given: bool
) -> Configuration:
    """Return what is known: the defaults, what the trace states of its run, and over it what is given.

    A trace states its machine in its metadata or, as bags of rosbag2 do, on its topic ``machine``; half space, density
    and Poisson's ratio in its metadata. Its G and p are not looked at.

    Parameters
    ----------
    bag, selection
        The trace.
    given : mapping
        {dotted name: SI value}.
    machine_given : bool
        Whether the machine is given whole.

    Raises
    ------
    BagError
        If the machine or its amplitude is stated nowhere, or what is stated is no possible one.
    """
    facts: Mapping[str, str] = bag.parameters
    if not facts and selection.machine:
        for received in bag.messages({selection.machine}):
            facts = {item.key: item.value for item in received.message.values}
            break
    stated = {name: facts[name] for name in KNOWN if name in facts}
    machine = [name for name in PARAMETERS if name.startswith(MACHINE)]
    if not machine_given and not all(name in stated for name in machine):
        raise BagError(
            "the trace does not say which machine made it: give --machine NAME or --params FILE"
        )
    if not selection.exciter and AMPLITUDE not in stated and AMPLITUDE not in given:
        raise BagError(
            "the trace does not say the exciter's amplitude: give --amplitude-mm or --machine NAME"
        )
    try:
        values = {name: type(PARAMETERS[name][1])(text) for name, text in stated.items()}
        return Configuration().changed({**values, **given})
    except (ValueError, ParameterError) as error:
        raise BagError(f"what the trace states of its machine is of no use: {error}") from None
