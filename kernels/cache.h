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
#define RECORD_CLEARANCE 22u  // how far probes found nothing
#define RECORD_PLACE 23u      // x, y, z on its surface
#define RECORD_LEAST 26u      // bounds of the radius
#define RECORD_MOST 27u
#define RECORD_PLANES 28u

// Records ask by rays whether they see what they serve, unless nothing lies within this many radii.
#define GUARD_REACH 1.2f

// Records that follow one another make a group, and so do groups.
#define CACHE_GROUP 16u

// Of records that outlast their frame, what a packet of LANES of them needs.
#define CACHE_KEEP 0u
#define CACHE_UPDATE 1u  // sums anew, after tracing what is in doubt
#define CACHE_FRESH 2u   // everything

// What has become of a VPL since the frame before.
#define VPL_MOVED 1u  // it is elsewhere, or was dark
#define VPL_RECOLOURED 2u

#endif
