// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Computes irradiance records from the cells of their hemispheres (hemisphere_rays.cl): irradiance
// E, its gradients move E over place and turn E over turns of the normal (Ward and Heckbert 1992),
// and the radius. With the radiance L and distance r of the cells (j, k), theta from t_j = asin
// sqrt(j / M) to t_(j+1), phi from p_k = 2 pi k / N on, u_k and v_k the directions of a cell's
// middle azimuth and of that plus pi / 2, and w_k that of p_k plus pi / 2,
//   E      = pi / (M N)   sum of L
//   turn E = sin(pi / N)  sum of v_k (F(t_(j+1)) - F(t_j)) L,  F(t) = t - sin t cos t
//   move E = 2 sin(pi / N) sum of u_k sin t_j cos^2 t_j (L - L of (j - 1, k)) / r'
//          + sum of w_k (sin t_(j+1) - sin t_j) (L - L of (j, k - 1)) / r'
// where r' is the smaller distance of the two cells: what lies nearer moves before what lies behind
// it. Ward and Heckbert have tangents, sines and 2 pi / N at the middle of a cell; these are their
// means over cells, so that all three are exact where radiance is the same all over each cell. The
// turn goes with n x n'. Directions below the record's own surface border on nothing that moves.
//
// The radius is SamplingParams::record_error times the harmonic mean distance (Ward et al. 1988)
// or, where that is less, times the distance at which light would have fallen to nothing at its
// slope (Krivanek et al. 2006); it is bounded by pixel sizes. Where it would be less than the
// least, the gradient over place is scaled down by the same share, since what lies so near is not
// known well enough. One work-item per record.
#include "kernels/bvh/triangle.h"
#include "kernels/cache/cache.h"
#include "kernels/cache/record_place.h"
#include "kernels/core/kernel.h"
#include "kernels/core/receiver_values.h"
#include "kernels/core/sampling.h"
#include "kernels/film/gbuffer.h"

// A change per unit along each axis, of red, green and blue.
typedef struct {
    float3 red, green, blue;
} Gradient;

// What the rays of a record have found.
typedef struct {
    float3 light;  // irradiance
    Gradient move, turn;
    float distance;  // harmonic mean; RAY_INFINITY where nothing was hit
} Hemisphere;

// Sums over the cells of one azimuth, rgb; see above.
typedef struct {
    float3 light, along, across, turn;
    float closeness;  // of reciprocal distances
    uint traced;
} Azimuth;

static inline Gradient no_gradient(void) {
    Gradient none;
    none.red = f3(0.0f, 0.0f, 0.0f);
    none.green = none.red;
    none.blue = none.red;
    return none;
}

/// Adds a change, rgb, by steps along a direction.
static inline void add_gradient(float3 way, float3 change, Gradient* sum) {
    sum->red += way * change.x;
    sum->green += way * change.y;
    sum->blue += way * change.z;
}

/// Parallax between two neighbouring cells: the difference of their radiance over the smaller of
/// their distances.
static inline float3 parallax(float4 cell, float4 neighbour) {
    float nearest = m_min(cell.w, neighbour.w);
    if (!(nearest > 0.0f)) return f3(0.0f, 0.0f, 0.0f);
    return (xyz(cell) - xyz(neighbour)) / nearest;
}

/// F of the angle whose squared sine is given.
static inline float turn_integral(float square) {
    float sine = square_root(square);
    return m_asin(sine) - sine * square_root(m_max(0.0f, 1.0f - square));
}

/// The cells of an azimuth; `before` are those of the one before it.
static inline Azimuth azimuth_sums(GLOBAL const float4* cells, GLOBAL const float4* before,
                                   uint elevations) {
    Azimuth sums;
    sums.light = f3(0.0f, 0.0f, 0.0f);
    sums.along = sums.light;
    sums.across = sums.light;
    sums.turn = sums.light;
    sums.closeness = 0.0f;
    sums.traced = 0u;
    float square = 0.0f;
    float sine = 0.0f;
    float turn = 0.0f;
    for (uint j = 0u; j < elevations; ++j) {
        float4 cell = cells[j];
        float next_square = (float)(j + 1u) / (float)elevations;
        float next_sine = square_root(next_square);
        float next_turn = turn_integral(next_square);
        sums.light += xyz(cell);
        sums.turn += xyz(cell) * (next_turn - turn);
        sums.across += parallax(cell, before[j]) * (next_sine - sine);
        if (j > 0u) sums.along += parallax(cell, cells[j - 1u]) * (sine * (1.0f - square));
        if (cell.w > 0.0f) ++sums.traced;
        if (cell.w > 0.0f && cell.w < RAY_INFINITY) sums.closeness += 1.0f / cell.w;
        square = next_square;
        sine = next_sine;
        turn = next_turn;
    }
    return sums;
}

/// All cells of a record, whose shading normal is `normal`.
static inline Hemisphere hemisphere_of(GLOBAL const float4* cells, uint elevations, uint azimuths,
                                       float3 normal) {
    Hemisphere all;
    all.light = f3(0.0f, 0.0f, 0.0f);
    all.move = no_gradient();
    all.turn = no_gradient();
    float3 tangent;
    float3 bitangent;
    make_basis(normal, &tangent, &bitangent);
    float step = M_TWO_PI / (float)azimuths;
    float sine;
    float cosine;
    m_sincos(0.5f * step, &sine, &cosine);
    float chord = 2.0f * sine;
    float closeness = 0.0f;
    uint traced = 0u;
    for (uint k = 0u; k < azimuths; ++k) {
        uint before = (k == 0u ? azimuths : k) - 1u;
        Azimuth sums =
            azimuth_sums(cells + k * elevations, cells + before * elevations, elevations);
        all.light += sums.light;
        closeness += sums.closeness;
        traced += sums.traced;
        m_sincos(step * ((float)k + 0.5f), &sine, &cosine);
        float3 ahead = tangent * cosine + bitangent * sine;
        float3 aside = bitangent * cosine - tangent * sine;
        add_gradient(ahead, sums.along * chord, &all.move);
        add_gradient(aside, sums.turn * (0.5f * chord), &all.turn);
        m_sincos(step * (float)k, &sine, &cosine);
        add_gradient(bitangent * cosine - tangent * sine, sums.across, &all.move);
    }
    all.light = all.light * (COSINE_IRRADIANCE / (float)(elevations * azimuths));
    all.distance = closeness > 0.0f ? (float)traced / closeness : RAY_INFINITY;
    return all;
}

/// Radius of the record by an allowed error, before pixel sizes bound it.
static inline float hemisphere_reach(const Hemisphere* all, float error) {
    float slope =
        length3(all->move.red * 0.2126f + all->move.green * 0.7152f + all->move.blue * 0.0722f);
    float reach = all->distance;
    if (slope > 0.0f) reach = m_min(reach, luminance(all->light) / slope);
    return error * reach;
}

static inline void store_row(float3 v, uint plane, uint stride, GLOBAL float* record) {
    record[plane * stride] = v.x;
    record[(plane + 1u) * stride] = v.y;
    record[(plane + 2u) * stride] = v.z;
}

static inline void store_gradient(const Gradient* gradient, float scale, uint plane, uint stride,
                                  GLOBAL float* record) {
    store_row(gradient->red * scale, plane, stride, record);
    store_row(gradient->green * scale, plane + 3u, stride, record);
    store_row(gradient->blue * scale, plane + 6u, stride, record);
}

WEFT_KERNEL(hemisphere_records)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint item = range.first + WORK_ITEM(range);
    uint slot = grid.first + item;
    uint stride = slots;
    if (!(receiver_planes[RECEIVER_VALID * stride + slot] > 0.0f)) return;
    uint elevations = grid.elevations;
    uint azimuths = grid.azimuths;
    float3 shading = receiver_vector(receiver_planes, RECEIVER_SHADING_X, stride, slot);
    Hemisphere all =
        hemisphere_of(cells + item * (elevations * azimuths), elevations, azimuths, shading);
    GLOBAL float* record = records + slot;
    store_place(&params, gb_position, gb_normal, slot_pixel[slot], stride, record);
    float least = record[RECORD_LEAST * stride];
    float most = record[RECORD_MOST * stride];
    float reach = hemisphere_reach(&all, params.sampling.record_error);
    // m_min returns its second argument for the NaN that a least of 0 may give.
    float share = m_min(reach / least, 1.0f);
    store_row(all.light, RECORD_LIGHT, stride, record);
    store_gradient(&all.move, share, RECORD_MOVE, stride, record);
    store_gradient(&all.turn, 1.0f, RECORD_TURN, stride, record);
    record[RECORD_RADIUS * stride] = m_clamp(reach, least, most);
    // More clearance than lookups can need: for records of hemispheres they trace no rays.
    for (uint sector = 0u; sector < CACHE_SECTORS; ++sector)
        record[(RECORD_CLEARANCE + sector) * stride] = 2.0f * GUARD_REACH * most;
}
