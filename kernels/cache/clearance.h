// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Clearance of irradiance records: how far about a record there is nothing, so that lookups need no
// ray to tell whether it sees a place. It is known by sectors of an eighth of a turn, from the
// tangent (make_basis) to the bitangent and on.
#ifndef WEFT_KERNELS_CACHE_CLEARANCE_H
#define WEFT_KERNELS_CACHE_CLEARANCE_H

#include "kernels/bvh/trace.h"
#include "kernels/cache/cache.h"
#include "kernels/core/sampling.h"

// Clearance rays of a record: a ring near the surface and one above it; a multiple of LANES.
#define RING_PROBES (2u * CACHE_SECTORS)
#define PROBES (2u * RING_PROBES)

// Least sine of the angle between a clearance ray and the facet that it starts from.
#define PROBE_RISE 0.1f

/// Unit direction of clearance ray `i` about a shading normal, lifted off the facet, whose normal
/// is `facet`.
static inline float3 probe_way(uint i, float3 t, float3 b, float3 normal, float3 facet) {
    int upper = i >= RING_PROBES ? 1 : 0;
    float angle = 0.39269908f * ((float)(i % RING_PROBES) + (upper != 0 ? 0.5f : 0.0f));
    float height = upper != 0 ? 0.6f : 0.1f;
    float across = square_root(1.0f - height * height);
    float sine;
    float cosine;
    m_sincos(angle, &sine, &cosine);
    float3 way = (t * cosine + b * sine) * across + normal * height;
    float rise = dot3(way, facet);
    if (rise < PROBE_RISE) way = way + facet * (PROBE_RISE - rise);
    return way * (1.0f / length3(way));
}

/// Stores the clearance of a place on the lit side of its surface, `normal` being its shading
/// normal and `facet` that of its triangle: for each sector the distance to the nearest hit of its
/// rays and of the next beside it, at most `reach`. CACHE_SECTORS numbers, `stride` floats apart.
static inline void store_clearances(Scene scene, float3 position, float3 normal, float3 facet,
                                    float reach, uint stride, GLOBAL float* clearances) {
    float3 t;
    float3 b;
    make_basis(normal, &t, &b);
    float found[PROBES];
    for (uint first = 0u; first < PROBES; first += (uint)LANES) {
        PacketDirections ways;
        Hit hits[LANES];
        for (uint lane = 0u; lane < (uint)LANES; ++lane) {
            float3 way = probe_way(first + lane, t, b, normal, facet);
            ways.x[lane] = way.x;
            ways.y[lane] = way.y;
            ways.z[lane] = way.z;
        }
        trace_closest_packet(scene, position, &ways, ALL_LANES, reach, hits);
        for (uint lane = 0u; lane < (uint)LANES; ++lane)
            found[first + lane] =
                hits[lane].triangle != INVALID_INDEX ? m_min(hits[lane].t, reach) : reach;
    }
    for (uint i = 0u; i < CACHE_SECTORS; ++i) {
        float nearest = reach;
        // The rays within the sector, and the next beside it.
        for (uint k = 0u; k < 5u; ++k) {
            uint probe = (2u * i + k + RING_PROBES - 1u) % RING_PROBES;
            nearest = m_min(nearest, found[probe]);
            if (k < 4u) nearest = m_min(nearest, found[RING_PROBES + probe]);
        }
        clearances[i * stride] = nearest;
    }
}

/// The least clearance of a record's sectors.
static inline float least_clearance(uint stride, GLOBAL const float* clearances) {
    float least = clearances[0];
    for (uint i = 1u; i < CACHE_SECTORS; ++i) least = m_min(least, clearances[i * stride]);
    return least;
}

#endif
