// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Quasi-random numbers with fixed indices, and maps from the unit square.
#ifndef WEFT_KERNELS_CORE_SAMPLING_H
#define WEFT_KERNELS_CORE_SAMPLING_H

#include "kernels/core/maths.h"
#include "kernels/core/port.h"
#include "kernels/core/types.h"
#include "kernels/core/vector.h"

// Primes of the dimensions of a light path; see light_path.h.
#define PRIME_LIGHT 7u
#define PRIME_POSITION_U 2u
#define PRIME_POSITION_V 3u
#define PRIME_DIRECTION_U 5u
#define PRIME_DIRECTION_V 11u
CONSTANT_TABLE uint bounce_primes[2 * (MAX_BOUNCES - 1)] = {13u, 17u, 19u, 23u, 29u, 31u, 37u,
                                                            41u, 43u, 47u, 53u, 59u, 61u, 67u};

/// A hash in which every input bit moves every output bit.
static inline uint hash_bits(uint x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    x ^= x >> 16;
    return x;
}

static inline uint hash_pair(uint a, uint b) {
    return hash_bits(a ^ hash_bits(b + 0x9e3779b9u));
}

/// Radical inverse of `index` in a prime base, in [0, 1), with nested random linear scrambling of
/// the digits (Matousek 1998; Owen 1995 for the nesting): every digit d becomes a d + b mod base,
/// where a and b depend on `key` and on all digits before it. Keeps the stratification of the
/// Halton sequence and breaks the correlation between its higher dimensions.
static inline float radical_inverse(uint base, uint index, uint key) {
    uint reversed = 0u;
    uint scale = 1u;
    uint state = hash_pair(key, base);
    // As many digits as 32 bits hold.
    for (uint room = 0xFFFFFFFFu; room >= base; room /= base) {
        uint digit = index % base;
        uint draw = hash_bits(state);
        uint factor = 1u + (draw & 0xFFFFu) % (base - 1u);
        digit = (factor * digit + (draw >> 16)) % base;
        index /= base;
        reversed = reversed * base + digit;
        scale *= base;
        state = hash_pair(state, digit);
    }
    float value = (float)reversed / (float)scale;
    return m_min(value, 0.99999994f);
}

/// First of `count` entries whose inclusive sum of probabilities exceeds `u`, else the last. The
/// sums are `stride` floats apart.
static inline uint find_entry(GLOBAL const float* sums, uint stride, uint count, float u) {
    // Halves what is left in either case: where `u` is random, no processor foresees a branch.
    uint low = 0u;
    uint left = count - 1u;
    while (left > 0u) {
        uint half_left = (left + 1u) / 2u;
        uint exceeds = sums[(low + half_left - 1u) * stride] > u ? 1u : 0u;
        low += half_left & (exceeds - 1u);
        left -= half_left;
    }
    return low;
}

/// Rescales a random number that chose an entry to [0, 1) over that entry, for reuse: `before` is
/// the sum of the probabilities before the entry.
static inline float rescale_number(float u, float before, float probability) {
    return m_clamp((u - before) / probability, 0.0f, 0.99999994f);
}

/// Point of the unit disk, area-preserving and with low distortion (Shirley and Chiu 1997).
static inline void concentric_disk(float u, float v, float* x, float* y) {
    float a = 2.0f * u - 1.0f;
    float b = 2.0f * v - 1.0f;
    int by_x = absolute(a) > absolute(b) ? 1 : 0;
    float radius = by_x != 0 ? a : b;
    if (radius == 0.0f) {
        *x = 0.0f;
        *y = 0.0f;
        return;
    }
    // The angle from the nearer axis is at most pi / 4.
    float along, across;
    m_sincos_octant(M_QUARTER_PI * ((by_x != 0 ? b : a) / radius), &across, &along);
    *x = radius * (by_x != 0 ? along : across);
    *y = radius * (by_x != 0 ? across : along);
}

/// Unit direction about +z with pdf cos / pi.
static inline float3 cosine_direction(float u, float v) {
    float x, y;
    concentric_disk(u, v, &x, &y);
    return f3(x, y, square_root(m_max(0.0f, 1.0f - x * x - y * y)));
}

/// Pdf of cosine_direction, 1/sr.
static inline float cosine_pdf(float cosine) {
    return cosine * M_INV_PI;
}

/// Irradiance by radiance 1 from a direction of cosine_direction: the cosine over its pdf.
#define COSINE_IRRADIANCE M_ONE_PI

/// Unit direction within the cone cos >= `cos_limit` about +z, uniform over solid angle; the whole
/// sphere for -1.
static inline float3 cone_direction(float u, float v, float cos_limit) {
    float z = 1.0f - u * (1.0f - cos_limit);
    float radius = square_root(m_max(0.0f, (1.0f - z) * (1.0f + z)));
    float s, c;
    m_sincos(6.28318531f * v, &s, &c);
    return f3(radius * c, radius * s, z);
}

/// A direction, of any length, in the frame in which the unit vector `axis` is +z.
static inline float3 local_direction(float3 direction, float3 axis) {
    float3 tangent, bitangent;
    make_basis(axis, &tangent, &bitangent);
    return f3(dot3(direction, tangent), dot3(direction, bitangent), dot3(direction, axis));
}

/// The inverse of local_direction: a vector given in that frame, in the space of `axis`.
static inline float3 to_world(float3 local_vector, float3 axis) {
    float3 tangent, bitangent;
    make_basis(axis, &tangent, &bitangent);
    return tangent * local_vector.x + bitangent * local_vector.y + axis * local_vector.z;
}

#endif
