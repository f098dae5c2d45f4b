# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Indices of the flat arrays that the kernels work on: physical state, constants, output rows."""

# Physical state of drum and soil at a sample. Depths and their rates are positive down (−z).
DEPTH = 0
"""Depth d of the drum's lowest point below the untouched surface at the start, m."""
VELOCITY = 1
"""Its rate, m/s."""
FORCE = 2
"""Soil force F_s ≥ 0, N."""
SURFACE = 3
"""Elastic depth e of the half space's surface, m."""
SURFACE_VELOCITY = 4
"""Its rate, m/s."""
PLASTIC = 5
"""Plastic depth q since the last renewal, m."""
DATUM = 6
"""Depth D of the surface that the drum meets, m; in contact d = e + q + D."""
PHASE = 7
"""Contact state: LOADING, UNLOADING or AIR."""
UNSETTLED_STEPS = 8
"""Count of steps whose phase changes did not settle within the allowed number of splits."""
STATE_SIZE = 9

# Constants of one revolution.
STEP = 0
"""Sample period h, s."""
OMEGA = 1
"""Angular frequency of the eccentric, rad/s."""
MASS = 2
"""Drum mass m_d, kg."""
STATIC_LOAD = 3
"""F_stat, N."""
PLASTIC_COMPLIANCE = 4
"""p/F_stat, m/N."""
STATIC_COMPLIANCE = 5
"""H0, m/N."""
START_ACCELERATION = 6
"""Exciter acceleration F_e/m_d at the revolution's first sample, m/s²."""
ACCELERATION_RATE = 7
"""Its rate across the revolution, m/s³."""
HORIZONTAL_SINE = 8
HORIZONTAL_COSINE = 9
"""Share of it that acts horizontally, in phase with sin φ and cos φ."""
VERTICAL_SINE = 12
"""Share of it that acts vertically, in phase with sin φ."""
NATURAL_FREQUENCY = 10
"""Two-pole only: ω0, rad/s."""
QUALITY = 11
"""Two-pole only: Q."""
CONSTANTS_SIZE = 13

# Rows of the output array (rows, samples).
OUT_VERTICAL = 0
OUT_HORIZONTAL = 1
OUT_FORCE = 2
OUT_DEPTH = 3
OUT_SURFACE = 4
OUT_PLASTIC = 5
OUT_DATUM = 6
OUT_PHASE = 7
OUT_ROWS = 8

# Contact states (paper, Figure 13).
LOADING = 0
UNLOADING = 1
AIR = 2

MAX_SPLITS = 24
"""Phase changes followed inside one step before the step is finished as it stands and counted."""

# Kinds of half space that `contact` knows.
FINITE_MEMORY = 0
TWO_POLE = 1
MODES = 2

# Below these a change of phase is rounding noise of a roller at rest.
STILL_VELOCITY = 1e-12
"""m/s."""
STILL_SLOPE = 1.0
"""N/s: a force that changes by less than F_stat in hours."""
