# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""``python -m roller_sim_ros.commands`` does the same as ``roller-sim``."""

import sys

from roller_sim_ros.commands import main

sys.exit(main())
