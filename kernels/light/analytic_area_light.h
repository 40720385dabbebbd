// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Light of area lights at receivers close to them. The bound on an area light's samples
// (connection.h) leaves out light where a receiver is closer to the light than samples are to each
// other. There the closed form gives the light that the area light would send were it unhidden, and
// samples only decide how much of that arrives: the ratio estimator of Heitz, Hill and McGuire 2018
// ("Combining Analytic Direct Illumination and Stochastic Shadows", equation 9). From where the
// bound begins to twice as far off, the estimator fades into the samples alone.
#ifndef WEFT_KERNELS_LIGHT_ANALYTIC_AREA_LIGHT_H
#define WEFT_KERNELS_LIGHT_ANALYTIC_AREA_LIGHT_H

#include "kernels/light/analytic_area_light_limit.h"
#include "kernels/light/triangle_irradiance.h"

#define AREA_LIGHTS_MAKE(name)  \
    AreaLights name;            \
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
} AreaLights;

// The light is that near up to so many times the distance at which the bound on its samples begins:
// few samples of such a light lie where most of its light comes from, whether they are bounded or
// not.
#define NEAR_REACH 2.0f

/// 1 where the area light is near, 0 from twice as far off on.
static inline WFloat nearness(const RenderParams* params, GLOBAL const LightRecord* area_light,
                              const ReceiverPacket* packet) {
    WFloat zero = WIDE(0.0f);
    float reach = NEAR_REACH * square_root(area_light->area / params->sampling.lights.bound_scale);
    if (!(reach > 0.0f) || has_closed_form(params, area_light) == 0) return zero;
    float4 centre = area_light->position;
    WFloat3 to;
    to.x = packet->position.x - centre.x;
    to.y = packet->position.y - centre.y;
    to.z = packet->position.z - centre.z;
    // No point of the area light is nearer than this.
    WFloat height = wide_dot_scalar(to, xyz(area_light->axis));
    WFloat distance = wide_square_root(wide_dot(to, to)) - centre.w;
    distance = VMAX(distance, height);
    distance = VMAX(distance, -height);
    WFloat near = WIDE(2.0f) - distance / reach;
    near = VMAX(near, zero);
    near = VMIN(near, WIDE(1.0f));
    return SELECT(packet->valid, near, zero);
}

/// Irradiance by all of an unhidden area light of radiance 1.
static inline WFloat area_light_irradiance(const AreaLights* area_lights,
                                           GLOBAL const LightRecord* area_light,
                                           const ReceiverPacket* packet) {
    WFloat zero = WIDE(0.0f);
    WFloat sum = zero;
    for (uint i = 0u; i < area_light->count; ++i) {
        Triangle triangle =
            area_lights->triangles[area_lights->emissive[area_light->first + i].triangle];
        WFloat e = triangle_irradiance(
            packet->position, packet->shading, xyz(area_lights->positions[triangle.v0]),
            xyz(area_lights->positions[triangle.v1]), xyz(area_lights->positions[triangle.v2]));
        WFloat other = area_light->both_sides != 0u ? -e : zero;
        sum = sum + VMAX(e, other);
    }
    return sum;
}

/// Sum of the geometry terms of an area light's samples in one set, from `first` on, by the shading
/// normal alone: the closed form includes samples below the receiver's geometric surface, which
/// count as hidden later.
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

/// Factor for the geometry terms of area light `number`'s samples in a set, by lane: 1 where the
/// area light is far. With it, the mean over all sets of `samples` is the closed form where the
/// light is near and unhidden.
static inline WFloat analytic_scale(const RenderParams* params, const AreaLights* area_lights,
                                    uint number, const ReceiverPacket* packet,
                                    GLOBAL const Vpl* samples, uint set) {
    WFloat zero = WIDE(0.0f);
    WFloat one = WIDE(1.0f);
    GLOBAL const LightRecord* area_light = area_lights->lights + number;
    WFloat near = nearness(params, area_light, packet);
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
    float share = area_light->area /
                  ((float)params->sampling.lights.per_light * (float)params->sampling.sets);
    if (area_light->both_sides != 0u) share = 2.0f * share;
    WFloat ratio =
        area_light_irradiance(area_lights, area_light, packet) / (sampled * hits * share);
    // No factor where the set has no useful sample, or where the ratio is beyond what floats hold.
    WMask known = (near > zero) & (sampled > zero) & (ratio < WIDE(1e30f));
    return SELECT(known, one + near * (ratio - one), one);
}

#endif
