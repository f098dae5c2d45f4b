# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Decoding of CDR messages with definitions taken from a bag."""

from __future__ import annotations

from collections.abc import Mapping
from textwrap import shorten
from typing import Any

from rosbags.typesys import (
    Stores,
    TypesysError,
    get_types_from_idl,
    get_types_from_msg,
    get_typestore,
)

from roller_sim_ros.analysis.bag import BagError
from roller_sim_ros.share import PACKAGE, share_directory

_IDL_SEPARATOR = "=" * 80 + "\nIDL: "


class Decoder:
    """Decodes messages of the types that were added.

    rosbags decodes arrays as numpy arrays, some twenty times as fast as mcap-ros2-support does; that is
    what makes hours of trace bearable.
    """

    def __init__(self) -> None:
        self._store = get_typestore(Stores.EMPTY)

    @property
    def definitions(self) -> Mapping[str, Any]:
        """Fields of the types that were added, as rosbags' type stores have them."""
        return self._store.fielddefs

    def add(self, name: str, definition: str, *, idl: bool = False) -> None:
        """Add a type by its definition, with those it is made of, as a schema holds it.

        Raises
        ------
        BagError
            If the definition cannot be parsed.
        """
        if name in self._store.types:
            return
        try:
            if not idl:
                self._store.register(get_types_from_msg(definition, name))
                return
            for part in definition.split(_IDL_SEPARATOR):
                # After a separator, the rest of its line is the name of the type.
                text = part if part is definition else part.partition("\n")[2]
                self._store.register(get_types_from_idl(text))
        except (TypesysError, ValueError, KeyError) as error:
            # The parser's reason holds all the text that it did not understand.
            reason = shorten(f"the definition of {name} in the bag cannot be parsed: {error}", 300)
            raise BagError(reason) from None

    def add_installed(self, name: str) -> None:
        """Add a type that a bag holds without definition, as SQLite bags before ROS 2 Iron do.

        Raises
        ------
        BagError
            If it is none of ROS 2's own and none of this package.
        """
        own = share_directory() / "msg" / f"{name.rpartition('/')[2]}.msg"
        standard = get_typestore(Stores.ROS2_HUMBLE)
        if name in standard.types:
            self._store.register({key: standard.fielddefs[key] for key in standard.types})
        elif name.startswith(f"{PACKAGE}/") and own.is_file():
            self._store.register({key: standard.fielddefs[key] for key in standard.types})
            self.add(name, own.read_text(encoding="utf-8"))
        else:
            raise BagError(f"the bag holds no definition of {name}")

    def decode(self, data: bytes, name: str) -> Any:
        """Return the message; its fields are attributes.

        Raises
        ------
        BagError
            If the bytes are no message of that type.
        """
        try:
            return self._store.deserialize_cdr(data, name)
        except Exception as error:  # noqa: BLE001 generated code fails in as many ways as there are fields
            raise BagError(f"a message of type {name} cannot be decoded: {error!r}") from None
