// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Lamps close to what they light. Samples on a lamp are bounded (connection.h), which leaves out
// light where it is closer than they are to each other. There the closed form says how much light
// an unhidden lamp sends, and samples only how much of it arrives: the ratio estimator of Heitz,
// Hill and McGuire 2018 ("Combining Analytic Direct Illumination and Stochastic Shadows", equation
// 9). From where the bound begins to twice as far off, one passes into the other.
#ifndef WEFT_KERNELS_LIGHT_NEAR_LAMP_H
#define WEFT_KERNELS_LIGHT_NEAR_LAMP_H

#include "kernels/light/near_lamp_limit.h"
#include "kernels/light/triangle_irradiance.h"

#define LAMP_MAKE(name)         \
    Lamps name;                 \
    name.lights = lights;       \
    name.emissive = emissive;   \
    name.positions = positions; \
    name.triangles = triangle_list

// Area lights and the triangles they are made of.
typedef struct {
    GLOBAL const LightRecord* lights;
    GLOBAL const EmissiveTriangle* emissive;
    GLOBAL const float4* positions;
    GLOBAL const Triangle* triangles;
} Lamps;

/// 1 where the lamp is so near that the bound on its samples can cut light off, 0 from twice as far
/// off on.
static inline WFloat nearness(const RenderParams* params, GLOBAL const LightRecord* lamp,
                              const ReceiverPacket* packet) {
    WFloat zero = WIDE(0.0f);
    float reach = square_root(lamp->area / params->sampling.lights.bound_scale);
    if (!(reach > 0.0f) || has_closed_form(params, lamp) == 0) return zero;
    float4 centre = lamp->position;
    WFloat3 to;
    to.x = packet->position.x - centre.x;
    to.y = packet->position.y - centre.y;
    to.z = packet->position.z - centre.z;
    // No point of the lamp is nearer than this.
    WFloat height = wide_dot_scalar(to, xyz(lamp->axis));
    WFloat distance = wide_square_root(wide_dot(to, to)) - centre.w;
    distance = VMAX(distance, height);
    distance = VMAX(distance, -height);
    WFloat near = WIDE(2.0f) - distance / reach;
    near = VMAX(near, zero);
    near = VMIN(near, WIDE(1.0f));
    return SELECT(packet->valid, near, zero);
}

/// Irradiance by all of an unhidden lamp of radiance 1.
static inline WFloat lamp_irradiance(const Lamps* lamps, GLOBAL const LightRecord* lamp,
                                     const ReceiverPacket* packet) {
    WFloat zero = WIDE(0.0f);
    WFloat sum = zero;
    for (uint i = 0u; i < lamp->count; ++i) {
        Triangle triangle = lamps->triangles[lamps->emissive[lamp->first + i].triangle];
        WFloat e = triangle_irradiance(
            packet->position, packet->shading, xyz(lamps->positions[triangle.v0]),
            xyz(lamps->positions[triangle.v1]), xyz(lamps->positions[triangle.v2]));
        WFloat other = lamp->both_sides != 0u ? -e : zero;
        sum = sum + VMAX(e, other);
    }
    return sum;
}

/// Sum of the geometry terms of a lamp's samples in one set, from `first` on. What is hidden by the
/// receiver's own surface counts as hidden, so here only its shading normal matters.
static inline WFloat sampled_geometry(const RenderParams* params, const ReceiverPacket* packet,
                                      GLOBAL const Vpl* first) {
    WFloat zero = WIDE(0.0f);
    ReceiverPacket shaded = *packet;
    shaded.normal = packet->shading;
    WFloat sum = zero;
    for (uint i = 0u; i < params->sampling.lights.per_light; ++i) {
        GLOBAL const Vpl* vpl = first + i;
        WMask useful;
        WFloat g = connection(&shaded, vpl, VPL_SURFACE, from_vpl(&shaded, vpl), &useful);
        sum = sum + SELECT(useful, g, zero);
    }
    return sum;
}

/// Factor for the geometry terms of lamp `number`'s samples in a set, by lane: 1 where the lamp is
/// far. Over all sets of `samples` the mean is that of an unhidden lamp.
static inline WFloat near_lamp_scale(const RenderParams* params, const Lamps* lamps, uint number,
                                     const ReceiverPacket* packet, GLOBAL const Vpl* samples,
                                     uint set) {
    WFloat zero = WIDE(0.0f);
    WFloat one = WIDE(1.0f);
    GLOBAL const LightRecord* lamp = lamps->lights + number;
    WFloat near = nearness(params, lamp, packet);
    if (!mask_any(near > zero)) return one;
    // Sets none of whose samples can send anything to the receiver add nothing; others make up for
    // them.
    WFloat sampled = zero;
    WFloat hits = zero;
    GLOBAL const Vpl* first = samples + number * params->sampling.lights.per_light;
    for (uint s = 0u; s < params->sampling.sets; ++s, first += params->sampling.lights.per_set) {
        WFloat of_set = sampled_geometry(params, packet, first);
        hits = hits + SELECT(of_set > zero, one, zero);
        if (s == set) sampled = of_set;
    }
    if (!mask_any((near > zero) & (sampled > zero))) return one;
    float share =
        lamp->area / ((float)params->sampling.lights.per_light * (float)params->sampling.sets);
    if (lamp->both_sides != 0u) share = 2.0f * share;
    WFloat ratio = lamp_irradiance(lamps, lamp, packet) / (sampled * hits * share);
    // Neither without samples nor beyond what floats hold.
    WMask known = (near > zero) & (sampled > zero) & (ratio < WIDE(1e30f));
    return SELECT(known, one + near * (ratio - one), one);
}

#endif
