// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Adds light from infinitely far away: of the environment, sampled by the set's directions, which
// of one that is no image are turned about each pixel's normal, to the sampled irradiance, and of
// directional lights to the exact irradiance, which is not filtered. One work-item per slot. It
// traces its rays one at a time, because those of the receivers of a packet have no common end
// point.
#include "kernels/adaptive/sample_sets.h"
#include "kernels/bvh/visibility.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/core/receiver_values.h"
#include "kernels/light/environment.h"
#include "kernels/light/environment_irradiance.h"
#include "kernels/media/packet_media.h"

/// Transmittance of media for light from that direction; see packet_transmittance.
static inline float3 distant_transmittance(const RenderParams* params, const Media* media,
                                           float3 position, float3 direction, uint enclosing_media,
                                           uint number) {
    if (!HAS(params, FEATURE_MEDIA)) return f3(1.0f, 1.0f, 1.0f);
    Random random = way_random(params, position, number);
    return ray_transmittance(params, media, position, direction, RAY_INFINITY, enclosing_media,
                             &random);
}

/// Irradiance of a surface that sees all samples of an image that are on its side, over all sets.
static inline float3 open_sample_irradiance(GLOBAL const Vpl* samples, uint count, float3 normal) {
    float3 sum = f3(0.0f, 0.0f, 0.0f);
    for (uint i = 0u; i < count; ++i)
        sum += xyz(samples[i].flux) * m_max(dot3(xyz(samples[i].position), normal), 0.0f);
    return sum * (1.0f / (float)count);
}

WEFT_KERNEL(distant_light)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint slot = range.first + WORK_ITEM(range);
    uint stride = slots;
    if (!(receiver_planes[RECEIVER_VALID * stride + slot] > 0.0f)) return;
    SCENE_MAKE(scene);
    MEDIA_MAKE(through);
    float3 position = receiver_vector(receiver_planes, RECEIVER_X, stride, slot);
    float3 shading = receiver_vector(receiver_planes, RECEIVER_SHADING_X, stride, slot);
    float3 normal = shading;
    if (HAS(&params, FEATURE_SMOOTH_NORMALS))
        normal = receiver_vector(receiver_planes, RECEIVER_NORMAL_X, stride, slot);
    uint enclosing_media = 0u;
    if (HAS(&params, FEATURE_MEDIA))
        enclosing_media = as_bits(receiver_planes[RECEIVER_ENCLOSING_MEDIA * stride + slot]);
    uint rays = 0u;
    if (HAS(&params, FEATURE_ENVIRONMENT)) {
        uint set = receiver_set(&params, block_set, slot);
        uint count = params.sampling.environment_samples * receiver_sets(&params);
        GLOBAL const Vpl* first = samples + list.first + set * list.stride;
        float3 open = f3(0.0f, 0.0f, 0.0f);
        int image = HAS(&params, FEATURE_IMAGE_ENVIRONMENT) ? 1 : 0;
        for (uint i = 0u; i < count; ++i) {
            float3 direction = xyz(first[i].position);
            if (image == 0) direction = to_world(direction, shading);
            float cosine = image != 0 ? dot3(direction, shading) : 1.0f;
            if (!(cosine > 0.0f && dot3(direction, normal) > 0.0f)) continue;
            ++rays;
            if (sees_infinity(scene, &params, position, direction) == 0) continue;
            float3 arrives =
                distant_transmittance(&params, &through, position, direction, enclosing_media, i);
            open += image != 0 ? arrives * xyz(first[i].flux) * cosine : arrives;
        }
        open = open * (1.0f / (float)count);
        float3 factor = xyz(params.scene.environment);
        if (image != 0) {
            // Samples find out what of the light is seen; how bright it is where all is, is known.
            float3 sampled = open_sample_irradiance(
                samples + list.first, params.sampling.sets * params.sampling.environment_samples,
                shading);
            float3 expected =
                factor * open_irradiance(environment_record, environment_irradiance, shading);
            if (max_component(sampled) > 0.0f) {
                open = open * sampling_correction(expected, sampled);
            } else {
                // No sample is on this side: the way straight up stands for all.
                ++rays;
                open = sees_infinity(scene, &params, position, shading) != 0
                           ? distant_transmittance(&params, &through, position, shading,
                                                   enclosing_media, 0u)
                           : open;
                open = open * expected;
            }
        } else {
            open = open * (factor * COSINE_IRRADIANCE);
        }
        add_irradiance(sampled_irradiance, stride, slot, open);
    }
    if (HAS(&params, FEATURE_DIRECTIONAL_LIGHTS)) {
        for (uint i = 0u; i < params.scene.directional_lights; ++i) {
            LightRecord light = lights[params.scene.directional_lights_first + i];
            float3 direction = distant_direction(light);
            float cosine = dot3(direction, shading);
            if (!(cosine > 0.0f && dot3(direction, normal) > 0.0f)) continue;
            ++rays;
            if (sees_infinity(scene, &params, position, direction) == 0) continue;
            float3 transmittance =
                distant_transmittance(&params, &through, position, direction, enclosing_media, i);
            add_irradiance(exact_irradiance, stride, slot,
                           xyz(light.power) * transmittance * cosine);
        }
    }
    count_rays(counters + range.counter, rays);
}
