// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Samples the light sources: computes the points on lights that all pixels of a set share, as VPLs.
// The buffer holds the samples on area lights of every set, then the punctual lights, then per set
// the directions towards the environment: local unit vectors about +z with pdf cos / pi or, of an
// image, directions chosen by its brightness with their radiance over their pdf. One work-item per
// entry.
#include "kernels/core/kernel.h"
#include "kernels/light/light.h"

/// Random number of the sample's place on view rays through media; see Vpl::cone.
static inline float view_number(const RenderParams* params, uint prime, uint index, uint key) {
    return HAS(params, FEATURE_AIRLIGHT) ? radical_inverse(prime, index, key) : 0.0f;
}

static inline void store_area_sample(const RenderParams* params, const LightSampling* sampling,
                                     const Geometry* geometry, GLOBAL const LightRecord* lights,
                                     GLOBAL const EmissiveTriangle* emissive, uint set, uint item,
                                     GLOBAL Vpl* vpl) {
    uint chosen, count, index;
    float probability = 1.0f;
    if (sampling->per_light > 0u) {
        count = sampling->per_light;
        chosen = item / count;
        index = (params->sampling.sample * params->sampling.sets + set) * count + item % count;
    } else {
        count = sampling->per_set;
        index = (params->sampling.sample * params->sampling.sets + set) * count + item;
        float choice = radical_inverse(PRIME_LIGHT, index, params->sampling.seed);
        chosen = choose_area_light(lights, params->scene.area_lights, choice);
        probability = lights[chosen].area_probability;
    }
    LightRecord light = lights[chosen];
    uint key = hash_pair(params->sampling.seed, chosen + 1u);
    float u = radical_inverse(PRIME_POSITION_U, index, key);
    float v = radical_inverse(PRIME_POSITION_V, index, key);
    float side = light.both_sides != 0u ? radical_inverse(PRIME_DIRECTION_U, index, key) : 0.0f;
    AreaExit leaves = leave_area(params, geometry, light, emissive, u, v, side);
    float weight =
        leaves.area / (probability * (float)count * (float)params->sampling.sets) * leaves.sides;
    float3 origin = leaves.origin;
    float3 normal = leaves.normal;
    float3 flux = leaves.radiance * weight;
    vpl->position = f4(origin.x, origin.y, origin.z, sampling->bound_scale / light.area);
    vpl->normal = f4(normal.x, normal.y, normal.z, from_bits(VPL_SURFACE));
    vpl->flux = f4(flux.x, flux.y, flux.z, 0.0f);
    vpl->cone = f4(0.0f, 0.0f, 0.0f, view_number(params, PRIME_LIGHT, index, key));
}

static inline void store_punctual(const RenderParams* params, LightRecord light, float sets,
                                  GLOBAL Vpl* vpl) {
    uint kind = light.kind == EMITTER_SPOT ? VPL_SPOT : VPL_POINT;
    float3 flux = xyz(light.power) * (1.0f / sets);
    vpl->position = f4(light.position.x, light.position.y, light.position.z, 0.0f);
    vpl->normal = f4(light.axis.x, light.axis.y, light.axis.z, from_bits(kind));
    vpl->flux = f4(flux.x, flux.y, flux.z, 0.0f);
    int linear = kind == VPL_SPOT && light.position.w > 0.0f ? 1 : 0;
    vpl->cone =
        f4(linear != 0 ? light.axis.w : light.cos_inner, light.cos_outer,
           linear != 0 ? light.position.w : 0.0f,
           view_number(params, PRIME_POSITION_U, params->sampling.sample, params->sampling.seed));
}

WEFT_KERNEL(light_samples)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint item = range.first + WORK_ITEM(range);
    GEOMETRY_MAKE(geometry);
    uint area_samples = params.sampling.sets * light_sampling.per_set;
    if (item < area_samples) {
        store_area_sample(&params, &light_sampling, &geometry, lights, emissive,
                          item / light_sampling.per_set, item % light_sampling.per_set,
                          samples + item);
        return;
    }
    uint punctual = item - area_samples;
    if (punctual < params.scene.delta_lights) {
        store_punctual(&params, lights[params.scene.delta_lights_first + punctual],
                       params.sampling.gather_scale, samples + item);
        return;
    }
    uint direction = punctual - params.scene.delta_lights;
    uint index =
        params.sampling.sample * params.sampling.sets * params.sampling.environment_samples +
        direction;
    uint key = hash_pair(params.sampling.seed, 0u);
    float u = radical_inverse(PRIME_POSITION_U, index, key);
    float v = radical_inverse(PRIME_POSITION_V, index, key);
    if (HAS(&params, FEATURE_IMAGE_ENVIRONMENT)) {
        ENVIRONMENT_MAKE(environment);
        EnvironmentSample from = sample_environment(&params, &environment, u, v);
        float3 light = from.radiance / from.pdf;
        samples[item].position = f4(from.direction.x, from.direction.y, from.direction.z, 0.0f);
        samples[item].flux = f4(light.x, light.y, light.z, 0.0f);
        return;
    }
    float3 local_vector = environment_local_direction(u, v);
    samples[item].position = f4(local_vector.x, local_vector.y, local_vector.z, 0.0f);
}
