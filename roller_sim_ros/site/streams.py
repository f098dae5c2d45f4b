# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Random numbers: one stream for each purpose, so that using one changes no other."""

from __future__ import annotations

import zlib

from numpy.random import PCG64, Generator, SeedSequence


def stream(seed: int, purpose: str) -> Generator:
    """Return the random numbers of a purpose.

    Parameters
    ----------
    seed : int
        Of the run, not negative.
    purpose : str
        Name, as in ``site/random_field/0``.
    """
    key = zlib.crc32(purpose.encode("utf-8"))
    return Generator(PCG64(SeedSequence(seed, spawn_key=(key,))))
