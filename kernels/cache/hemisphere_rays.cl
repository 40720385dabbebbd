// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Traces rays from irradiance records into the hemispheres above them (Ward, Rubinstein and Clear
// 1988): finds the radiance that each brings but for emission, which is direct light, and how far
// it goes. The hemisphere above a shading normal is parted into M elevations times N azimuths of
// equal projected solid angle; cell (j, k), number k M + j, has the directions with sin^2 theta in
// [j, j + 1) / M and phi in 2 pi [k, k + 1) / N. One ray goes through a random point of each. What
// it hits reflects light as a surface of path.cl does, by all orders: next-event estimation,
// scattered rays, roulette.
//
// A work-item traces one cell; the cells of the records from slot HemisphereGrid::first on follow
// one another. Of each cell the radiance, rgb, and the distance are stored: RAY_INFINITY where
// nothing is hit, 0 below the record's own surface.
#include "kernels/core/counters.h"
#include "kernels/core/guard.h"
#include "kernels/core/kernel.h"
#include "kernels/core/receiver_values.h"
#include "kernels/path/path.h"

/// The point (u, v) of a cell, as a unit direction about `axis`.
static inline float3 cell_direction(uint elevations, uint azimuths, uint cell, float u, float v,
                                    float3 axis) {
    float square = ((float)(cell % elevations) + u) / (float)elevations;
    float turn = ((float)(cell / elevations) + v) / (float)azimuths;
    float sine;
    float cosine;
    m_sincos(M_TWO_PI * turn, &sine, &cosine);
    float across = square_root(square);
    float3 local_vector =
        f3(cosine * across, sine * across, square_root(m_max(0.0f, 1.0f - square)));
    return normalize3(to_world(local_vector, axis));
}

/// Radiance along a ray from a point off a surface, rgb, without emission; w: how far the ray goes.
static inline float4 trace_cell(const RenderParams* params, const PathScene* world, float3 position,
                                float3 normal, float3 direction, Random* random, uint* rays) {
    if (!(dot3(direction, normal) > 0.0f)) return f4(0.0f, 0.0f, 0.0f, 0.0f);
    Hit hit = trace_closest(world->scene, position, direction, RAY_INFINITY);
    ++*rays;
    if (hit.triangle == INVALID_INDEX) return f4(0.0f, 0.0f, 0.0f, RAY_INFINITY);
    PathLight sum;
    sum.direct = f3(0.0f, 0.0f, 0.0f);
    sum.indirect = sum.direct;
    PathVertex vertex;
    vertex.bounce = 1u;
    vertex.light_weight = 1.0f;
    vertex.surface = surface_at(params, &world->geometry, hit, direction, 0.0f);
    int goes_on = enter_surface(params, &vertex, f3(1.0f, 1.0f, 1.0f));
    while (goes_on != 0) {
        *rays += next_event(params, world, &vertex, random, &sum);
        goes_on = scatter(params, world, &vertex, random, &sum, rays);
        if (goes_on != 0) goes_on = survives(&vertex, ROULETTE_START, 1.0f, random);
    }
    // Nearer than rays start off their surfaces is rounding, and its reciprocal might overflow.
    float distance = m_max(hit.t, surface_offset(position, params->scene.extent));
    return f4(sum.indirect.x, sum.indirect.y, sum.indirect.z, distance);
}

WEFT_KERNEL(hemisphere_rays)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint item = range.first + WORK_ITEM(range);
    uint elevations = grid.elevations;
    uint azimuths = grid.azimuths;
    uint cell = item % (elevations * azimuths);
    uint slot = grid.first + item / (elevations * azimuths);
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
    uint pixel = slot_pixel[slot];
    Random random = make_random(params.sampling.seed, pixel,
                                params.sampling.sample * (elevations * azimuths) + cell);
    float u = next_random(&random);
    float v = next_random(&random);
    uint rays = 0u;
    float4 found =
        trace_cell(&params, &world, position, normal,
                   cell_direction(elevations, azimuths, cell, u, v, shading), &random, &rays);
    float3 light = guard(nonfinite, COMPONENT_INDIRECT, pixel, xyz(found));
    cells[item] = f4(light.x, light.y, light.z, found.w);
    count_rays(counters + range.counter, rays);
}
