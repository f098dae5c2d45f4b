"""Numba where it is there; plain Python, with the same results, where it is not."""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any, TypeVar

Function = TypeVar("Function", bound=Callable[..., Any])

DISABLE_VARIABLE = "ROLLER_SIM_NO_JIT"


def _identity(function: Function) -> Function:
    return function


if os.environ.get(DISABLE_VARIABLE):
    JIT_ACTIVE = False
else:
    try:
        import numba

        JIT_ACTIVE = True
    except ImportError:
        JIT_ACTIVE = False


def njit(function: Function) -> Function:
    """Compile a scalar kernel with numba, cached on disk; return it as it is without numba.

    Kernels are strict IEEE code (no fast-math) that neither allocates nor raises, so that the compiled and
    the plain form give the same samples up to the contraction of multiply and add.
    """
    if not JIT_ACTIVE:
        return _identity(function)
    compiled: Function = numba.njit(cache=True, error_model="numpy", nogil=True)(function)
    return compiled


def inlined(function: Function) -> Function:
    """As `njit`, for a small piece that belongs inside the loop of its caller."""
    if not JIT_ACTIVE:
        return _identity(function)
    compiled: Function = numba.njit(
        cache=True, error_model="numpy", nogil=True, forceinline=True
    )(function)
    return compiled
