// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Light from infinitely far away: the environment, sampled by the set's directions turned about
// each pixel's normal (added to the sampled irradiance), and directional lights (added to the exact
// irradiance, which is not filtered). One ray at a time: the rays of a pixel share no end point.
#include "counters.h"
#include "receiver_values.h"
#include "sampling.h"
#include "visibility.h"

WEFT_KERNEL(distant_light)
(PARAMS, SCENE_ARGS, GLOBAL const float* receiver_planes, GLOBAL const uint* block_set,
 GLOBAL const LightRecord* lights, GLOBAL const Vpl* samples, GLOBAL float* sampled_irradiance,
 GLOBAL float* exact_irradiance, GLOBAL RayCounter* counters) {
    if (GLOBAL_ID >= params.count) return;
    uint slot = params.first + GLOBAL_ID;
    uint stride = params.slots;
    if (!(receiver_planes[RECEIVER_VALID * stride + slot] > 0.0f)) return;
    SCENE_MAKE(scene);
    float3 position = receiver_vector(receiver_planes, RECEIVER_X, stride, slot);
    float3 shading = receiver_vector(receiver_planes, RECEIVER_SHADING_X, stride, slot);
    float3 normal = shading;
    if (HAS(&params, FEATURE_SMOOTH_NORMALS))
        normal = receiver_vector(receiver_planes, RECEIVER_NORMAL_X, stride, slot);
    uint rays = 0u;
    if (HAS(&params, FEATURE_ENVIRONMENT)) {
        uint set = (block_set[slot / PACKET_BLOCK] + params.set_rotation) % params.gather_sets;
        uint count = params.gather_sets == 1u ? params.environment_samples * params.sets
                                              : params.environment_samples;
        GLOBAL const Vpl* first = samples + params.list_first + set * params.list_stride;
        uint open = 0u;
        for (uint i = 0u; i < count; ++i) {
            float3 direction = turn_to(xyz(first[i].position), shading);
            if (!(dot3(direction, normal) > 0.0f)) continue;
            ++rays;
            open += (uint)sees_infinity(scene, &params, position, direction);
        }
        float share = 3.14159265f * (float)open / (float)count;
        add_irradiance(sampled_irradiance, stride, slot, xyz(params.environment) * share);
    }
    if (HAS(&params, FEATURE_DIRECTIONAL_LIGHTS)) {
        for (uint i = 0u; i < params.directional_lights; ++i) {
            LightRecord light = lights[params.directional_lights_first + i];
            float3 direction = -xyz(light.axis);
            float cosine = dot3(direction, shading);
            if (!(cosine > 0.0f && dot3(direction, normal) > 0.0f)) continue;
            ++rays;
            if (sees_infinity(scene, &params, position, direction) == 0) continue;
            add_irradiance(exact_irradiance, stride, slot, xyz(light.power) * cosine);
        }
    }
    count_rays(counters + params.counter, rays);
}
