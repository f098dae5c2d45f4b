# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The message types: how their bytes are made, and the text that a recording carries of them.

Messages are serialised by rosbags, which needs no ROS; the node publishes the bytes that the trace holds.
"""

from __future__ import annotations

import os
import sys
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from roller_sim_ros.errors import RollerSimError
from roller_sim_ros.share import PACKAGE, share_directory
from roller_sim_ros.wire.packing import Packer

# The oldest ROS 2 that the package supports; the types that it uses have not changed since.
BASE = Stores.ROS2_HUMBLE

_SEPARATOR = "=" * 80


class TypeUnknownError(RollerSimError):
    """A message type is known neither here nor to the ROS installation.

    Attributes
    ----------
    type_name : str
        As in ``package/msg/Name``.
    """

    def __init__(self, type_name: str, reason: str = "") -> None:
        super().__init__(
            f"message type {type_name}: {reason or 'no definition was found'}; "
            "source the workspace that has it"
        )
        self.type_name = type_name


@dataclass(frozen=True)
class Schema:
    """What a recording keeps of a message type.

    Attributes
    ----------
    name : str
        As in ``package/msg/Name``.
    text : str
        Definition in the encoding ``ros2msg``: the type's own, then all that it refers to, each after a
        line of 80 ``=`` and a line ``MSG: package/Name``.
    type_hash : str
        ``RIHS01_…``, as ROS 2 (Iron and later) computes it.
    """

    name: str
    text: str
    type_hash: str


@cache
def typestore() -> Typestore:
    """Return the store of all types that this package publishes or reads."""
    store = get_typestore(BASE)
    own = {}
    for path in sorted((share_directory() / "msg").glob("*.msg")):
        own.update(get_types_from_msg(path.read_text("utf-8"), f"{PACKAGE}/msg/{path.stem}"))
    store.register(own)
    return store


@cache
def message_class(type_name: str) -> Any:
    """Return the class of a message type of the store: fields are given in order or by name."""
    return typestore().types[type_name]


def encode(message: object, type_name: str) -> bytes:
    """Return a message object as little-endian CDR with its four header bytes."""
    pack = _packer(type_name)
    if pack is not None:
        return pack(message)
    return bytes(typestore().serialize_cdr(message, type_name, little_endian=True))


@cache
def _packer(type_name: str) -> Packer | None:
    try:
        return Packer(type_name, typestore().fielddefs)
    except ValueError:
        return None


def decode(data: bytes, type_name: str) -> Any:
    """Return the message object of CDR bytes; arrays are numpy arrays."""
    return typestore().deserialize_cdr(data, type_name)


@cache
def schema(type_name: str) -> Schema:
    """Return the schema of any message type: of this package, of the ROS installation, or of the base store.

    Raises
    ------
    TypeUnknownError
        If its definition, or that of a type it refers to, is not found or not understood.
    """
    texts: dict[str, str] = {}
    store = get_typestore(Stores.EMPTY)
    _collect(type_name, texts, store)
    own, *others = texts
    parts = [texts[own]]
    for name in others:
        package, _, short = name.partition("/msg/")
        parts.append(f"{_SEPARATOR}\nMSG: {package}/{short}\n{texts[name]}")
    return Schema(type_name, "\n".join(parts), store.hash_rihs01(type_name))


def _collect(type_name: str, texts: dict[str, str], store: Typestore) -> None:
    """Add the definition of a type, and of all it refers to, to `texts` and `store`."""
    if type_name in texts:
        return
    texts[type_name] = text = _definition(type_name)
    try:
        types = get_types_from_msg(text, type_name)
    except Exception as error:  # rosbags' parser raises whatever the text provokes
        raise TypeUnknownError(type_name, f"its definition is not understood ({error})") from error
    store.register(types)
    for _, description in store.fielddefs[type_name][1]:
        referred = _referred(description)
        if referred:
            _collect(referred, texts, store)


def _referred(description: Any) -> str | None:
    """Return the name of the message type in a field's description, None for a basic type."""
    _, what = description
    while isinstance(what, tuple) and isinstance(what[0], tuple):
        _, what = what[0]
    return what if isinstance(what, str) else None


def _definition(type_name: str) -> str:
    """Return the ``.msg`` text of one type, without those it refers to."""
    package, _, short = type_name.partition("/msg/")
    for folder in _share_folders(package):
        path = folder / "msg" / f"{short}.msg"
        if path.is_file():
            return path.read_text("utf-8").rstrip("\n") + "\n"
    base = get_typestore(BASE)
    if type_name not in base.fielddefs:
        raise TypeUnknownError(type_name)
    text, _ = base.generate_msgdef(type_name, ros_version=2)
    return text.split(f"{_SEPARATOR}\n", 1)[0]


def _share_folders(package: str) -> list[Path]:
    if package == PACKAGE:
        return [share_directory()]
    prefixes = [item for item in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep) if item]
    return [Path(prefix, "share", package) for prefix in (*prefixes, sys.prefix)]
