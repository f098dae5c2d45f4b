# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The whole state of an emulator as bytes: a restored one goes on bit by bit as the saved one does."""

from __future__ import annotations

import hashlib
import json
from typing import Any

# Imported for their classes, which a state may hold.
import roller_sim_ros.scenario  # noqa: F401
from roller_sim_ros import __version__
from roller_sim_ros.emulation import graph, soundness
from roller_sim_ros.emulation.emulator import Emulator
from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.parameters import ParameterError

MAGIC = b"roller_sim_ros state 1\n"
"""What a saved state begins with; the number is that of the form."""
_LONGEST_HEADER = 1000


class SnapshotError(RollerSimError):
    """A state cannot be saved, or what is given is no state that can be restored."""


def save(emulator: Emulator) -> bytes:
    """Return the whole state: samples to come, messages to come, random numbers, what was commanded.

    Parameters
    ----------
    emulator : Emulator
        Between two blocks, as it is; nothing in it changes.

    Raises
    ------
    SnapshotError
        If site or programme are not of this package.

    Examples
    --------
    >>> from roller_sim_ros.parameters import Configuration
    >>> emulator = Emulator(Configuration(), start_ns=0)
    >>> _ = emulator.advance(16)
    >>> other = restore(save(emulator))
    >>> other.advance(16) == emulator.advance(16)
    True
    """
    with emulator.held():
        try:
            nodes, data = graph.write(emulator)
        except graph.GraphError as error:
            raise SnapshotError(f"the state cannot be saved: it holds {error}") from None
    text = json.dumps(nodes, separators=(",", ":")).encode()
    body = text + data
    header = {
        "version": __version__,
        "text_bytes": len(text),
        "bytes": len(body),
        "sha256": hashlib.sha256(body).hexdigest(),
    }
    return MAGIC + json.dumps(header).encode() + b"\n" + body


def restore(data: bytes, *, told: bool = False) -> Emulator:
    """Return an emulator that goes on where `save` left it.

    Parameters
    ----------
    data : bytes
        As `save` returned it, in this or in another process. Nothing that it says is run, whoever wrote it.
    told : bool
        Let ``inputs`` say so, with the state, as a trace needs that goes on with it or begins with it. All other
        messages are the same either way.

    Raises
    ------
    SnapshotError
        If it is no saved state, of another version, or damaged.
    """
    header, body = _opened(data)
    length = header["text_bytes"]
    try:
        emulator = graph.read(json.loads(body[:length]), body[length:], soundness.check)
    except (
        *(graph.GraphError, soundness.UnsoundError, ParameterError),
        *(ValueError, RecursionError),
    ) as error:
        raise SnapshotError(f"the saved state is damaged: {error}") from None
    if not isinstance(emulator, Emulator):
        raise SnapshotError("the saved state is damaged: it is not that of an emulator")
    if told:
        emulator.note_restored(data)
    return emulator


def _opened(data: bytes) -> tuple[dict[str, Any], bytes]:
    """Return header and body of a saved state, checked."""
    if not data.startswith(MAGIC):
        begins = MAGIC.split(b" ")[0]
        what = "of another form" if data.startswith(begins) else "no saved state"
        raise SnapshotError(f"what is to be restored is {what}: save one with this version")
    end = data.find(b"\n", len(MAGIC), len(MAGIC) + _LONGEST_HEADER)
    try:
        header = json.loads(data[len(MAGIC) : end])
        version, size, checksum = header["version"], header["bytes"], header["sha256"]
    except (ValueError, KeyError, TypeError, RecursionError):
        raise SnapshotError("the saved state is damaged: its header is not understood") from None
    if version != __version__:
        raise SnapshotError(
            f"the saved state is of version {version!s:.20}, this is {__version__}: restore it with that one"
        )
    body = data[end + 1 :]
    if size != len(body):
        raise SnapshotError(f"the saved state is damaged: {len(body)} bytes of {size!s:.20}")
    if hashlib.sha256(body).hexdigest() != checksum:
        raise SnapshotError("the saved state is damaged: its checksum is another one")
    if not isinstance(header.get("text_bytes"), int):
        raise SnapshotError("the saved state is damaged: its header is not understood")
    return header, body
