# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""The verdict on a compaction meter under test: its values beside the truth of the same trace."""
