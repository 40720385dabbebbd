// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Irradiance records: what cache_records.cl computes for places chosen by the host, which then
// orders them in groups, and what cache_lookup.cl interpolates.
#ifndef WEFT_CACHE_H
#define WEFT_CACHE_H

// Planes of new records, each Params::slots floats.
#define RECORD_LIGHT 0u  // irradiance, rgb
#define RECORD_MOVE 3u   // its gradient over places: x, y, z of red, of green, of blue
#define RECORD_TURN 12u  // and over turns of the normal, likewise
#define RECORD_RADIUS 21u
#define RECORD_GUARDED 22u
#define RECORD_PLACE 23u  // x, y, z on its surface
#define RECORD_PLANES 26u

// Records that follow one another make a group, and so do groups.
#define CACHE_GROUP 16u

#endif
