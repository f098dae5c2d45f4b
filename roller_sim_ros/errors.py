# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Errors the package raises at its edges."""


class RollerSimError(Exception):
    """Base of all errors of this package: one clear sentence, fit to be shown to the user.

    The message names the parameter or file, the value, the bound and the way out.
    """
