# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Quality of service as the topics' table states it, and as rosbag2 writes it into a recording."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import yaml

# rmw's numbers. rosbag2 wrote numbers up to metadata version 8 and writes names since. Its older readers
# know nothing but numbers; the newer ones still take them from an MCAP file that holds a metadata record
# named rosbag2 (see traces/writer.py).
_KEEP_LAST = 1
_LIVELINESS_AUTOMATIC = 1
_RELIABILITY = {"reliable": 1, "best_effort": 2}
_DURABILITY = {"transient_local": 1, "volatile": 2}
_FOREVER = {"sec": 9223372036, "nsec": 854775807}


@dataclass(frozen=True)
class Qos:
    """A keep-last profile without deadline, lifespan or lease.

    Attributes
    ----------
    reliability : str
        ``reliable`` or ``best_effort``.
    durability : str
        ``volatile`` or ``transient_local``.
    depth : int
        Messages kept.
    """

    reliability: str
    durability: str
    depth: int

    def offered_profiles(self) -> str:
        """Return the profile as rosbag2's ``offered_qos_profiles``: YAML, a list of one profile."""
        profile = {
            "history": _KEEP_LAST,
            "depth": self.depth,
            "reliability": _RELIABILITY[self.reliability],
            "durability": _DURABILITY[self.durability],
            "deadline": dict(_FOREVER),
            "lifespan": dict(_FOREVER),
            "liveliness": _LIVELINESS_AUTOMATIC,
            "liveliness_lease_duration": dict(_FOREVER),
            "avoid_ros_namespace_conventions": False,
        }
        text: str = yaml.safe_dump([profile], sort_keys=False)
        return text

    @classmethod
    def from_offered_profiles(cls, text: str) -> Qos | None:
        """Return the profile that serves all of a recording's ``offered_qos_profiles``.

        Parameters
        ----------
        text : str
            YAML with numbers (rosbag2 up to Iron) or names (since Jazzy).

        Returns
        -------
        Qos or None
            Reliable if any was, transient-local if all were, as deep as the deepest; None when the text
            states no profile or is not understood.
        """
        try:
            profiles = yaml.safe_load(text)
            # The system's default is what ROS 2 takes where nothing is said: reliable and volatile.
            reliability = {
                _named(_RELIABILITY, item["reliability"], "reliable") for item in profiles
            }
            durability = {_named(_DURABILITY, item["durability"], "volatile") for item in profiles}
            depth = max(int(item["depth"]) for item in profiles)
        except (yaml.YAMLError, TypeError, KeyError, ValueError):
            return None
        return cls(
            reliability="reliable" if "reliable" in reliability else "best_effort",
            durability="volatile" if "volatile" in durability else "transient_local",
            depth=depth,
        )


def _named(numbers: dict[str, int], value: Any, default: str) -> str:
    for name, number in numbers.items():
        if value in (name, number):
            return name
    return default
