# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The paper against the model: what each checkable sentence of it says, and what came out.

Where things are:

- ``study``: the paper's roller and grounds, and the motions that statements and figures are made from
- ``statement``: what a statement and a finding are
- ``ground``, ``half_spaces``, ``cases``, ``planes``, ``meter_values``: the statements, by subject
- ``registry``: all of them
- ``sensitivity``: which of them hold with which k, Q and ω0
"""
