"""``python -m roller_sim_ros.commands`` does the same as ``roller-sim``."""

import sys

from roller_sim_ros.commands import main

sys.exit(main())
