# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
"""The cathedral's main dimensions in metres. The nave runs along z, its middle at z = 0; the choir
and the apse are at -z."""

BAY, BAYS = 4.4, 5
HALF_BAY = 0.5 * BAY
HALF_LENGTH = 0.5 * BAY * BAYS
BAY_CENTRES = tuple(BAY * (k - (BAYS - 1) / 2) for k in range(BAYS))

# The walls between nave and aisles, from below: arcade, triforium, clerestory.
COLUMN_X = 4.15
ARCADE_IN, ARCADE_OUT = 3.7, 4.6
SPRINGING = 4.6
ARCH_HALF, ARCH_RADIUS = 1.72, 2.4
SHAFT_Y = SPRINGING + 0.55  # where the shafts before the wall begin
TRIFORIUM_Y, PARAPET_Y, TRIFORIUM_SPRINGING = 8.0, 8.75, 9.9
TRIFORIUM_IN, TRIFORIUM_OUT = 3.86, 4.2
SMALL_ARCHES, SMALL_PITCH, SMALL_RADIUS = 4, 1.0, 0.41
CLERESTORY_Y, CLERESTORY_IN, CLERESTORY_OUT = 10.9, 3.74, 4.7
WALL_TOP = 17.2
SILL_Y, WINDOW_SPRINGING, WINDOW_HALF, WINDOW_RADIUS = 11.75, 13.3, 0.8, 1.2
WINDOW_TOP = 14.5
PANE_X = 4.55

# Vaults: half of their width, height where they spring, rise.
VAULT_HALF, VAULT_Y, VAULT_RISE = 3.9, 11.9, 4.3
AISLE_X, AISLE_HALF, AISLE_VAULT_Y, AISLE_RISE = 6.45, 1.93, 4.9, 2.4
AISLE_WALL = 8.3

# The choir, a square below a dome.
STEPS, RISER, TREAD = 5, 0.16, 0.36
CHOIR_Y = STEPS * RISER
STEPS_Z = -9.1
CHOIR_HALF = 4.1
CHOIR_Z = -15.75
PENDENTIVE_Y = 9.45
DOME_Y, OCULUS, LANTERN_Y = 13.5, 1.9, 17.6
CHANCEL_HALF, CHANCEL_SPRINGING, CHANCEL_RADIUS = 3.3, 8.4, 4.4
APSE_Z, APSE_RADIUS, APSE_SPRINGING, APSE_ARCH = -20.5, 3.1, 6.6, 2.85
ALTAR_Z = -15.2
