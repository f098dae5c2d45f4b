# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Where the package's shared files are: message definitions, parameter files, launch files."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from roller_sim_ros.errors import RollerSimError

PACKAGE = "roller_sim_ros"


def share_directory() -> Path:
    """Return the folder that holds ``msg/``, ``config/`` and ``launch/``; ROS need not be there.

    It is looked for under the prefixes of ``AMENT_PREFIX_PATH``, then beside the package (the source
    tree), then under the prefix into which the package is installed.

    Returns
    -------
    pathlib.Path
        An existing folder.

    Raises
    ------
    RollerSimError
        If there is none: the installation is incomplete.

    Examples
    --------
    >>> (share_directory() / "msg" / "DrumAcceleration.msg").is_file()
    True
    """
    for prefix in os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep):
        marker = Path(prefix, "share", "ament_index", "resource_index", "packages", PACKAGE)
        if prefix and marker.is_file():
            return Path(prefix, "share", PACKAGE)
    module = Path(__file__).resolve()
    source_tree = module.parent.parent
    if (source_tree / "package.xml").is_file():
        return source_tree
    # An installation has the package some folders below its prefix, which need not be sys.prefix
    # (pip --user, pip --prefix, Debian's dist-packages).
    for prefix_path in (Path(sys.prefix), *module.parents):
        installed = prefix_path / "share" / PACKAGE
        if (installed / "msg").is_dir():
            return installed
    raise RollerSimError(
        f"the shared files of {PACKAGE} were found neither in AMENT_PREFIX_PATH nor beside {module.parent} "
        f"nor under {sys.prefix}/share/{PACKAGE}: install the package anew"
    )
