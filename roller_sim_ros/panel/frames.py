# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What goes to the page twenty times a second: a few numbers as JSON and arrays of single precision, in one message.

====================  =======================================================================
4 bytes               length of the JSON text, little endian
JSON text             the numbers; under ``arrays`` [name, length] of each array, in their order
0 to 3 bytes          zeros, so that the arrays begin at a multiple of 4
arrays                float32, little endian
====================  =======================================================================
"""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray


def text(values: Mapping[str, Any]) -> str:
    """Return JSON as browsers read it: what is no finite number is null."""
    return json.dumps(_finite(values), allow_nan=False, ensure_ascii=False, separators=(",", ":"))


def packed(values: Mapping[str, Any], arrays: Mapping[str, NDArray[Any]]) -> bytes:
    """Return the message of some values and arrays.

    Parameters
    ----------
    values : mapping
        What becomes JSON; has no ``arrays``.
    arrays : mapping
        {name: array, shape (n,)}.
    """
    lengths = [[name, len(array)] for name, array in arrays.items()]
    head = text({**values, "arrays": lengths}).encode()
    padding = bytes(-(4 + len(head)) % 4)
    # What single precision cannot hold becomes infinite, which the page does not draw.
    with np.errstate(over="ignore"):
        body = [np.ascontiguousarray(array, dtype="<f4").tobytes() for array in arrays.values()]
    return b"".join([struct.pack("<I", len(head)), head, padding, *body])


def unpacked(message: bytes) -> tuple[dict[str, Any], dict[str, NDArray[np.float32]]]:
    """Return values and arrays of a message, as the page reads them."""
    (length,) = struct.unpack_from("<I", message)
    values: dict[str, Any] = json.loads(message[4 : 4 + length])
    offset = -(-(4 + length) // 4) * 4
    arrays = {}
    for name, count in values.pop("arrays"):
        arrays[name] = np.frombuffer(message, "<f4", count, offset)
        offset += 4 * count
    return values, arrays


def _finite(value: Any) -> Any:
    if isinstance(value, float):
        return value if math.isfinite(value) else None
    if isinstance(value, Mapping):
        return {name: _finite(item) for name, item in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(item) for item in value]
    return value
