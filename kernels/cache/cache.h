// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Irradiance records: what cache_records.cl computes for places chosen by the host, which then
// orders them in groups, and what cache_lookup.cl interpolates.
#ifndef WEFT_KERNELS_CACHE_CACHE_H
#define WEFT_KERNELS_CACHE_CACHE_H

// Planes of new records, each with a float for every slot of the pool.
#define RECORD_LIGHT 0u  // irradiance, rgb
#define RECORD_MOVE 3u   // its gradient over places: x, y, z of red, of green, of blue
#define RECORD_TURN 12u  // and over turns of the normal, likewise
#define RECORD_RADIUS 21u
#define RECORD_CLEARANCE 22u  // how far probes found nothing, by sector
#define RECORD_PLACE 30u      // x, y, z on its surface
#define RECORD_LEAST 33u      // bounds of the radius
#define RECORD_MOST 34u
#define RECORD_PLANES 35u

// Sectors about a record, from its tangent to its bitangent (make_basis) and on.
#define CACHE_SECTORS 8u
// Records ask by rays whether they see a place that they serve, unless probes of its sector found
// nothing within this many of its distances.
#define GUARD_REACH 1.2f
// Share of the distance to the nearest thing about it to which a record serves at most.
#define NEAR_SHARE 1.0f

// Least 1 - cosine of a turn of the normal that ends what a record serves: 2.6 degrees.
#define LEAST_TURN 1e-3f
// Share of its radius by which a place may lie behind a record's surface.
#define BEHIND_SHARE 0.02f

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
