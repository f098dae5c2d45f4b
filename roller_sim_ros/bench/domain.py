# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A ROS domain that nobody else on this machine uses."""

from __future__ import annotations

import fcntl
import os
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from roller_sim_ros.errors import RollerSimError

DOMAINS = range(10, 100)
"""Those tried; above 101 ports run into those that Linux gives away."""


@contextmanager
def own_domain(occupied: Callable[[int], bool] = lambda _: False) -> Iterator[int]:
    """Yield the number of a domain that no other bench or test on this machine has at the same time.

    Parameters
    ----------
    occupied : callable
        Whether someone is in a domain who does not take part in this.

    Raises
    ------
    RollerSimError
        If all are in use.
    """
    folder = Path(tempfile.gettempdir())
    for number in DOMAINS:
        try:
            # Whoever was the first to make the file may be another user.
            descriptor = os.open(
                folder / f"roller_sim_domain_{number}", os.O_CREAT | os.O_RDWR, 0o666
            )
        except PermissionError:
            continue
        try:
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            os.close(descriptor)
            continue
        if occupied(number):
            os.close(descriptor)
            continue
        try:
            yield number
        finally:
            os.close(descriptor)
        return
    raise RollerSimError(
        f"all ROS domains from {DOMAINS[0]} to {DOMAINS[-1]} are in use on this machine; name one with --domain"
    )
