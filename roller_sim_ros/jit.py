# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Numba where it is there; plain Python, with the same results, where it is not."""

from __future__ import annotations

import hashlib
import os
from collections.abc import Callable
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., Any])

DISABLE_VARIABLE = "ROLLER_SIM_NO_JIT"
CACHE_VARIABLE = "NUMBA_CACHE_DIR"
KERNEL_FOLDERS = (
    ".",
    "exciter",
    "drum_soil",
    "half_space",
    "sensors/kernels",
    "meters/kernels",
    "sweep",
)
"""Where compiled functions may live."""

if os.environ.get(DISABLE_VARIABLE):
    JIT_ACTIVE = False
else:
    try:
        import numba

        JIT_ACTIVE = True
    except ImportError:
        JIT_ACTIVE = False


@lru_cache(maxsize=1)
def cache_directory() -> str:
    """Return where compiled kernels are kept: one folder for each state of the kernels' sources.

    Numba looks only at the file of the function itself to decide whether its cache is stale, not at those of the
    functions compiled into it; so the sources' fingerprint is part of the path. The folder is inside the
    package where that is writable (a checkout, a user's environment), else in the user's cache directory.
    """
    package = Path(__file__).resolve().parent
    digest = hashlib.sha256()
    for folder in KERNEL_FOLDERS:
        for source in sorted((package / folder).glob("*.py")):
            digest.update(source.read_bytes())
    name = f"roller-sim-{digest.hexdigest()[:16]}"
    if os.access(package, os.W_OK):
        return str(package / "__pycache__" / name)
    caches = os.environ.get("XDG_CACHE_HOME")
    return str((Path(caches) if caches else Path.home() / ".cache") / "roller_sim_ros" / name)


def _compiled(function: Function, **options: Any) -> Function:
    before = numba.config.CACHE_DIR
    if not os.environ.get(CACHE_VARIABLE):
        # The place is chosen while decorating, so other users of numba in this process keep theirs.
        numba.config.CACHE_DIR = cache_directory()
    try:
        compiled: Function = numba.njit(cache=True, error_model="numpy", nogil=True, **options)(
            function
        )
    finally:
        numba.config.CACHE_DIR = before
    return compiled


def njit(function: Function) -> Function:
    """Compile a scalar kernel with numba, cached on disk; return it as it is without numba.

    Kernels are strict IEEE code (no fast-math) that neither allocates nor raises, so that the compiled and
    the plain form give the same samples up to the contraction of multiply and add.
    """
    return _compiled(function) if JIT_ACTIVE else function


def inlined(function: Function) -> Function:
    """As `njit`, for a small piece that belongs inside the loop of its caller."""
    return _compiled(function, forceinline=True) if JIT_ACTIVE else function
