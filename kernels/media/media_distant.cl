// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Adds the light from infinitely far away that media scatter into view rays to the radiance of
// media_gather.cl. Where one medium fills all space, places on a ray are sampled as light of the
// clearest channel would be scattered there, elsewhere evenly. One work-item per slot, which traces
// its rays one at a time, as in distant_light.cl.
#include "kernels/adaptive/sample_sets.h"
#include "kernels/bvh/visibility.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/core/receiver_values.h"
#include "kernels/light/environment.h"
#include "kernels/media/view_packet.h"

// A place on a ray, and 1 over its pdf.
typedef struct {
    float t, weight;
} DistantPlace;

/// Extinction by which places are spread: that of the clearest channel where one medium fills all
/// space; 0, for places spread evenly, elsewhere.
static inline float spread_extinction(const RenderParams* params, const Media* media) {
    uint outside = media->record->outside;
    // Convex media without a boundary: then the medium outside has no grid.
    if (!HAS(params, FEATURE_CONVEX_MEDIA) || media->record->boundaries != 0u ||
        outside == NO_MEDIUM)
        return 0.0f;
    return clearest_channel(xyz(media->media[outside].sigma_t));
}

static inline DistantPlace distant_place(const ViewRay* ray, float sigma, float u) {
    DistantPlace place;
    float length = ray->end - ray->begin;
    float opacity = opacity1(sigma, length);
    if (!(sigma * length > 1e-3f)) {
        place.t = ray->begin + u * length;
        place.weight = length;
        return place;
    }
    float distance = m_min(-m_log1p(-(u * opacity)) / sigma, length);
    place.t = ray->begin + distance;
    place.weight = opacity / (sigma * transmittance1(sigma, distance));
    return place;
}

/// Light of irradiance 1 from a direction that is scattered at a place, by channel.
static inline float3 scattered_from(const RenderParams* params, Scene scene, const Media* media,
                                    const ViewRay* ray, float3 from, DistantPlace at, uint number,
                                    uint* rays) {
    float3 origin = ray->origin;
    float3 place = origin + ray->direction * at.t;
    float3 none = f3(0.0f, 0.0f, 0.0f);
    ++*rays;
    if (sees_infinity(scene, params, place, from) == 0) return none;
    float3 scatters, transmittance;
    float g;
    walk_to_place(params, media, origin, ray->direction, at.t, from * RAY_INFINITY, number,
                  &scatters, &transmittance, &g);
    if (!(max_component(scatters) > 0.0f)) return none;
    return scatters * transmittance * (phase_function(g, ray->direction, from) * at.weight);
}

/// A number in [0, 1) by set and frame, such that those of all sets are evenly spread.
static inline float set_shift(const RenderParams* params, uint set) {
    float x = radical_inverse(PRIME_POSITION_U, params->sampling.sample,
                              hash_pair(params->sampling.seed, 0x3Bu)) +
              (float)set / (float)params->sampling.gather_sets;
    return x < 1.0f ? x : x - 1.0f;
}

/// The sum of what directional lights send.
static inline float3 directional_light(const RenderParams* params, Scene scene, const Media* media,
                                       const ViewRay* ray, GLOBAL const LightRecord* lights,
                                       float sigma, uint set, uint steps, uint* rays) {
    float3 sum = f3(0.0f, 0.0f, 0.0f);
    float share = 1.0f / (float)steps;
    for (uint i = 0u; i < params->scene.directional_lights; ++i) {
        LightRecord light = lights[params->scene.directional_lights_first + i];
        for (uint k = 0u; k < steps; ++k) {
            DistantPlace at =
                distant_place(ray, sigma, (set_shift(params, set) + (float)k) * share);
            sum += xyz(light.power) * scattered_from(params, scene, media, ray,
                                                     distant_direction(light), at, i * steps + k,
                                                     rays);
        }
    }
    return sum * share;
}

/// What the environment sends: from one direction for each place.
static inline float3 environment_light(const RenderParams* params, Scene scene, const Media* media,
                                       const EnvironmentImage* environment, const ViewRay* ray,
                                       float sigma, uint set, uint* rays) {
    float3 sum = f3(0.0f, 0.0f, 0.0f);
    uint count = params->sampling.environment_samples * receiver_sets(params);
    uint key = hash_pair(params->sampling.seed, 0x7Du);
    for (uint i = 0u; i < count; ++i) {
        uint index = (params->sampling.sample * params->sampling.sets + set) * count + i;
        float u = radical_inverse(PRIME_DIRECTION_U, index, key);
        float v = radical_inverse(PRIME_DIRECTION_V, index, key);
        float w = radical_inverse(PRIME_POSITION_U, index, key);
        if (HAS(params, FEATURE_IMAGE_ENVIRONMENT)) {
            EnvironmentSample from = sample_environment(params, environment, u, v);
            sum += from.radiance / (from.pdf * (float)count) *
                   scattered_from(params, scene, media, ray, from.direction,
                                  distant_place(ray, sigma, w), i, rays);
            continue;
        }
        sum += scattered_from(params, scene, media, ray, environment_direction(u, v),
                              distant_place(ray, sigma, w), i, rays);
    }
    if (HAS(params, FEATURE_IMAGE_ENVIRONMENT)) return sum;
    return xyz(params->scene.environment) * sum * (SPHERE_SOLID_ANGLE / (float)count);
}

WEFT_KERNEL(media_distant)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint slot = range.first + WORK_ITEM(range);
    ViewRay ray = view_ray(&params, end_position, end_albedo, slot_pixel[slot]);
    if (ray.valid == 0) return;
    SCENE_MAKE(scene);
    MEDIA_MAKE(through);
    ENVIRONMENT_MAKE(environment);
    uint set = receiver_set(&params, block_set, slot);
    float sigma = spread_extinction(&params, &through);
    uint rays = 0u;
    float3 sum = f3(0.0f, 0.0f, 0.0f);
    if (HAS(&params, FEATURE_DIRECTIONAL_LIGHTS))
        sum += directional_light(&params, scene, &through, &ray, lights, sigma, set, steps, &rays);
    if (HAS(&params, FEATURE_ENVIRONMENT) && params.sampling.environment_samples > 0u)
        sum += environment_light(&params, scene, &through, &environment, &ray, sigma, set, &rays);
    add_irradiance(radiance, slots, slot, sum);
    count_rays(counters + range.counter, rays);
}
