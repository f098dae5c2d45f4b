# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Message classes by the names of their types."""

from __future__ import annotations

import importlib
from typing import Any

from roller_sim_ros.wire.types import TypeUnknownError


def message_type(type_name: str) -> Any:
    """Return the generated class of ``package/msg/Name``.

    Raises
    ------
    TypeUnknownError
        If its package is not installed.
    """
    package, _, short = type_name.partition("/msg/")
    try:
        return getattr(importlib.import_module(f"{package}.msg"), short)
    except (ImportError, AttributeError) as error:
        raise TypeUnknownError(type_name, "its Python module is not installed") from error
