// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Layout and limits of irradiance records, which cache_records.cl or hemisphere_records.cl compute
// at places that the host chooses, and which cache_lookup.cl interpolates after the host has
// ordered them in groups.
#ifndef WEFT_KERNELS_CACHE_CACHE_H
#define WEFT_KERNELS_CACHE_CACHE_H

// Planes of new records, each with a float for every slot of the pool.
#define RECORD_LIGHT 0u  // irradiance, rgb
#define RECORD_MOVE 3u   // its gradient over places: x, y, z of red, of green, of blue
#define RECORD_TURN 12u  // and over turns of the normal, likewise
#define RECORD_RADIUS 21u
#define RECORD_CLEARANCE 22u  // how far clearance rays found nothing, by sector
#define RECORD_PLACE 30u      // x, y, z on its surface
#define RECORD_LEAST 33u      // bounds of the radius
#define RECORD_MOST 34u
#define RECORD_PLANES 35u

// Sectors about a record, from its tangent to its bitangent (make_basis) and on.
#define CACHE_SECTORS 8u
// A lookup traces a ray between a record and a place that it serves, unless the record's clearance
// in that sector is at least this many times their distance.
#define GUARD_REACH 1.2f
// Largest radius of a record, as a share of the distance to the nearest thing about it.
#define NEAR_SHARE 1.0f

// Least 1 - cosine of a turn of the normal at which the weight of a record may reach 0: 2.6
// degrees.
#define LEAST_TURN 1e-3f
// Share of its radius by which a place may lie behind a record's surface.
#define BEHIND_SHARE 0.02f

// So many consecutive records make a group with a box of its own, and so many groups a larger one.
#define CACHE_GROUP 16u

// What a packet of LANES records of the temporal record cache needs in a frame.
#define CACHE_KEEP 0u
#define CACHE_UPDATE 1u  // sums anew, after tracing its invalid connections
#define CACHE_FRESH 2u   // everything: it is new

// How a VPL has changed since the frame before.
#define VPL_MOVED 1u  // it is elsewhere, or was dark
#define VPL_RECOLOURED 2u

#endif
