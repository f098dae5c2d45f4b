# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Two rollers on one network, in two namespaces, have nothing to do with each other."""

from __future__ import annotations

from itertools import pairwise

from diagnostic_msgs.msg import DiagnosticArray

from roller_sim_ros.msg import CompactionMeter, DrumAcceleration, ExciterState
from tests.integration.harness import Client


def test_two_namespaces_do_not_disturb_each_other(start, own_domain):
    first = start("--namespace", "roller_1", "--shear-modulus-mpa", "35")
    second = start("--namespace", "/roller_2", "--shear-modulus-mpa", "80")
    with Client(own_domain, "/roller_1") as one, Client(own_domain, "/roller_2") as two:
        heard = {}
        for client in (one, two):
            heard[client] = {
                "blocks": client.listen("drum/acceleration", DrumAcceleration),
                "meter": client.listen("meter", CompactionMeter),
                "states": client.listen("exciter/state", ExciterState),
            }
            client.spin_until(lambda client=client: heard[client]["states"])
        diagnostics = one.listen("/diagnostics", DiagnosticArray)

        one.command(frequency=20.0, amplitude=0.8e-3)
        assert two.set_parameter("soil.plastic_parameter_m", 0.5e-3).successful
        states = heard[one]["states"]
        one.spin_until(lambda: states[-1].commanded_frequency == 20.0)
        one.spin_until(lambda: states[-1].frequency == 20.0)
        two.spin_for(0.5)
        assert {item.commanded_frequency for item in heard[two]["states"]} == {28.0}
        assert one.get_parameter("soil.plastic_parameter_m") == 0.65e-3
        assert one.get_parameter("soil.shear_modulus_pa") == 35e6
        assert two.get_parameter("soil.shear_modulus_pa") == 80e6
        for client in (one, two):
            blocks = heard[client]["blocks"]
            assert all(b.sequence == a.sequence + 16 for a, b in pairwise(blocks))
        # The diagnostics are one topic; who speaks is told by the name.
        names = {"/roller_1/roller_sim: pacing", "/roller_2/roller_sim: pacing"}
        one.spin_until(
            lambda: names <= {item.name for message in diagnostics for item in message.status}
        )

        assert first.end() == 0
        blocks = heard[two]["blocks"]
        two.spin_for(0.3)
        count = len(blocks)
        two.spin_until(lambda: len(blocks) > count + 50)
    assert second.end() == 0
    assert first.complaints == second.complaints == []
