# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Addresses of the page."""

from __future__ import annotations

import ipaddress
from urllib.parse import quote


def is_local(address: str) -> bool:
    """Return whether an address is one that only this machine reaches."""
    if address == "localhost":
        return True
    try:
        return ipaddress.ip_address(address).is_loopback
    except ValueError:
        return False


def url(address: str, port: int, token: str) -> str:
    """Return what to open in a browser."""
    host = f"[{address}]" if ":" in address else address
    query = f"?token={quote(token)}" if token else ""
    return f"http://{host}:{port}/{query}"
