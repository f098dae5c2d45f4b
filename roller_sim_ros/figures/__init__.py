# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The paper's figures, redrawn, and two of its kind: where meters mislead, and what k, Q and ω0 change.

A figure is one file with one function, ``drawing(study) -> Drawing``, and one line in ``registry``. ``drawing`` says
what a drawing is, ``style`` how it looks, ``output`` how it becomes PNG, SVG and CSV.
"""
