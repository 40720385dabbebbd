// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Computes the light that VPLs leave out, by path tracing (Kollig and Keller 2004). Virtual lights
// stand for the light of surface y that falls on x, with the geometry term G(x, y) cut off at a
// bound b. The rest, max(0, G - b), is the share max(0, 1 - b / G) of what a scattered ray from x
// finds at y: of light by up to SamplingParams::bounces surfaces before x. Light by more surfaces
// has no virtual lights at all, so its share is 1. Samples on area lights have bounds of their own.
// Where `near_area` is not below 0, paths bring the light that the bounds cut off and nothing else:
// the tail of vpl_tail.cl stands for light by more surfaces. Then first segments only reach as far
// as some connection is bounded, of samples on lights those on the largest without a closed form,
// of area `near_area`.
//
// With a bound of 0 and no bounces that have virtual lights this is all of the indirect light
// (host/components/bounce_rays.cpp).
//
// A work-item adds one path to the irradiance of one receiver: to the direct part where bit 0 of
// `parts` is set, to the indirect part where bit 1 is.
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/core/receiver_values.h"
#include "kernels/light/analytic_area_light_limit.h"
#include "kernels/path/path.h"

/// Share of a connection over `distance` between surfaces at these cosines that `bound` cuts off.
static inline float share_beyond(float bound, float distance, float cosine_x, float cosine_y) {
    if (!(cosine_x > 0.0f && cosine_y > 0.0f)) return 0.0f;
    // In this order nothing overflows that is not beyond the bound anyway.
    float share = 1.0f - bound * (distance / cosine_x) * (distance / cosine_y);
    return m_max(share, 0.0f);
}

/// Share of the light of an emitting surface that samples on area lights leave out: all of it where
/// it has no samples, none where analytic_area_light.h makes up for their bound.
static inline float area_light_share(const RenderParams* params, const PathScene* world,
                                     uint instance, float distance, float cosine_x,
                                     float cosine_y) {
    uint index = world->geometry.instances[instance].light;
    if (index == INVALID_INDEX) return 1.0f;
    if (has_closed_form(params, world->lights + index) != 0) return 0.0f;
    return share_beyond(params->sampling.lights.bound_scale / world->lights[index].area, distance,
                        cosine_x, cosine_y);
}

/// How much of a path's light roulette expects to be left when it is past the surfaces that virtual
/// lights serve, where it has met `bounce` surfaces: half of it goes on from each. Where the path's
/// share is 0, only that is left to it, and most such paths end at their first surface.
static inline float late_share(const RenderParams* params, uint bounce) {
    return m_scale(1.0f, (int)bounce - (int)params->sampling.bounces - 2);
}

/// How far the first segment of a path goes whose direction is at this cosine to the normal: as far
/// as any connection is bounded where only such light is wanted.
static inline float first_reach(const RenderParams* params, uint parts, float near_area,
                                float cosine) {
    if (near_area < 0.0f) return RAY_INFINITY;
    float square = 0.0f;
    if ((parts & 2u) != 0u) square = 1.0f / params->sampling.vpl_bound;
    if ((parts & 1u) != 0u && near_area > 0.0f)
        square = m_max(square, near_area / params->sampling.lights.bound_scale);
    return m_min(square_root(square * cosine), RAY_INFINITY);
}

/// Traces a ray from the receiver to the first surface and a path from there on, and weights the
/// light that these find by the share that virtual lights leave out.
static inline PathLight trace_residual(const RenderParams* params, const PathScene* world,
                                       uint parts, float near_area, float3 position, float3 normal,
                                       float3 shading, Random* random, uint* rays) {
    PathLight sum;
    sum.direct = f3(0.0f, 0.0f, 0.0f);
    sum.indirect = sum.direct;
    float u = next_random(random);
    float v = next_random(random);
    float3 local_vector = cosine_direction(u, v);
    float3 direction = normalize3(to_world(local_vector, shading));
    if (!(dot3(direction, normal) > 0.0f)) return sum;
    Hit hit = trace_closest(world->scene, position, direction,
                            first_reach(params, parts, near_area, local_vector.z));
    ++*rays;
    if (hit.triangle == INVALID_INDEX) return sum;
    PathVertex vertex;
    vertex.bounce = 1u;
    vertex.surface = surface_at(params, &world->geometry, hit, direction, 0.0f);
    float facing = -dot3(direction, vertex.surface.normal);
    if ((parts & 1u) != 0u && max_component(vertex.surface.emission) > 0.0f)
        sum.direct =
            vertex.surface.emission *
            area_light_share(params, world, vertex.surface.instance, hit.t, local_vector.z, facing);
    if ((parts & 2u) == 0u) return sum;
    float share = share_beyond(params->sampling.vpl_bound, hit.t, local_vector.z, facing);
    int near = near_area >= 0.0f ? 1 : 0;
    if (near != 0 && !(share > 0.0f)) return sum;
    int goes_on = enter_surface(params, &vertex, f3(1.0f, 1.0f, 1.0f));
    while (goes_on != 0) {
        int has_vpls = vertex.bounce <= params->sampling.bounces + 1u ? 1 : 0;
        if (near != 0 && has_vpls == 0) break;
        float weight = near != 0 ? share : 1.0f;
        if (near == 0 && has_vpls != 0) weight = m_max(share, late_share(params, vertex.bounce));
        if (survives(&vertex, 1u, ROULETTE_LEVEL / weight, random) == 0) break;
        vertex.light_weight = has_vpls != 0 ? share : 1.0f;
        if (vertex.light_weight > 0.0f) *rays += next_event(params, world, &vertex, random, &sum);
        goes_on = scatter(params, world, &vertex, random, &sum, rays);
    }
    return sum;
}

INLINES_ALL WEFT_KERNEL(vpl_residual)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint slot = range.first + WORK_ITEM(range);
    uint stride = slots;
    if (!(receiver_planes[RECEIVER_VALID * stride + slot] > 0.0f)) return;
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    ENVIRONMENT_MAKE(environment);
    PathScene world = {
        scene, geometry, lights, emissive, light_nodes, params.scene.choice_lights, environment, 0};
    float3 position = receiver_vector(receiver_planes, RECEIVER_X, stride, slot);
    float3 shading = receiver_vector(receiver_planes, RECEIVER_SHADING_X, stride, slot);
    float3 normal = shading;
    if (HAS(&params, FEATURE_SMOOTH_NORMALS))
        normal = receiver_vector(receiver_planes, RECEIVER_NORMAL_X, stride, slot);
    uint rays = 0u;
    Random random = make_random(params.sampling.seed, slot_pixel[slot], params.sampling.sample);
    PathLight light = trace_residual(&params, &world, parts, near_area, position, normal, shading,
                                     &random, &rays);
    if ((parts & 1u) != 0u) add_irradiance(direct, stride, slot, light.direct * COSINE_IRRADIANCE);
    if ((parts & 2u) != 0u)
        add_irradiance(indirect, stride, slot, light.indirect * COSINE_IRRADIANCE);
    count_rays(counters + range.counter, rays);
}
