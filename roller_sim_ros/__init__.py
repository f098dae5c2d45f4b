# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""A vibratory soil-compaction roller for ROS 2: its sensors, emulated by a physical drum/soil model.

Everything but `roller_sim_ros.node` and the commands ``sim`` and ``play`` works where ROS 2 is absent.
"""

from pkgutil import extend_path

# The generated messages (roller_sim_ros.msg) may be installed in another folder than these modules,
# as they are when the modules run from the source tree.
__path__ = extend_path(__path__, __name__)

__version__ = "0.1.0"
