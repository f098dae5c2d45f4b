# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What may keep the exciter from obeying."""

from __future__ import annotations

from typing import Protocol

from roller_sim_ros.exciter import ExciterDrive
from roller_sim_ros.session.programme import Moment


class Supervision(Protocol):
    """Told of every revolution before it is planned."""

    def begin_revolution(self, moment: Moment, drive: ExciterDrive) -> None:
        """Take notice of the revolution, and set `ExciterDrive.fault` for it.

        Parameters
        ----------
        moment : Moment
            When and where it begins.
        drive : ExciterDrive
            The drive, with what is commanded now.
        """
        ...
