# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""The gallery's main dimensions in metres. The nave runs along z; its far end is at -z."""

BAY, BAYS = 4.0, 6
HALF_LENGTH = 0.5 * BAY * BAYS
COLUMN_X = 4.0
ARCADE_IN, ARCADE_OUT = 3.65, 4.35
SPRINGING = 3.97
WALL_TOP = 6.6
VAULT_Y, VAULT_R = 6.5, 3.6
SLOT = 5.4  # half length of the skylight

AISLE_X = 7.0
AISLE_Y = 5.9

STEPS, RISER, TREAD = 8, 0.15, 0.32
PODIUM_Y = STEPS * RISER
PODIUM_Z = -6.9
PODIUM_HALF, STAIR_HALF = 3.3, 1.7
RAIL_X, RAIL_Z = 3.12, -7.08
