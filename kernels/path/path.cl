// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The reference: path tracing without a bound on geometry terms and without a longest path
// (path.h). A work-item traces PathParams::samples samples of one pixel and adds them to the film's
// exact sums.
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/film/camera.h"
#include "kernels/path/path.h"
#include "kernels/path/path_film.h"

static inline PathSample trace_path(const RenderParams* params, const PathParams* path_params,
                                    const PathScene* world, uint pixel, Random* random,
                                    uint* rays) {
    PathSample sample = no_path_sample();
    float x, y;
    sample_film(params, path_params, pixel, random, &x, &y);
    float3 direction = camera_direction(params, x, y);
    Hit hit = trace_closest(world->scene, camera_origin(params, x, y), direction, RAY_INFINITY);
    ++*rays;
    if (hit.triangle == INVALID_INDEX) {
        sample.emission = background_radiance(params, &world->environment, direction);
        sample.alpha = background_alpha(params, f3(1.0f, 1.0f, 1.0f));
        return sample;
    }
    PathVertex vertex;
    vertex.bounce = 0u;
    vertex.light_weight = 1.0f;
    vertex.surface = surface_at(params, &world->geometry, hit, direction,
                                seen_texture_angle(params, params->camera.texture_angle, hit.t));
    sample.emission = vertex.surface.emission;
    sample.albedo = bsdf_diffuse_albedo(&vertex.surface.bsdf);
    sample.normal = vertex.surface.shading;
    sample.depth = camera_depth(params, hit.t);
    int goes_on = enter_surface(params, &vertex, f3(1.0f, 1.0f, 1.0f));
    while (goes_on != 0 && vertex.bounce <= params->sampling.most_bounces) {
        *rays += next_event(params, world, &vertex, random, &sample.light);
        goes_on = scatter(params, world, &vertex, random, &sample.light, rays);
        if (!HAS(params, FEATURE_INDIRECT)) break;
        if (goes_on != 0) goes_on = survives(&vertex, ROULETTE_START, ROULETTE_LEVEL, random);
    }
    return sample;
}

INLINES_ALL WEFT_KERNEL(path)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    ENVIRONMENT_MAKE(environment);
    PathScene world = {
        scene, geometry, lights, emissive, light_nodes, params.scene.choice_lights, environment, 0};
    uint rays = 0u;
    for (uint i = 0u; i < path_params.samples; ++i) {
        Random random = make_random(params.sampling.seed, pixel, params.sampling.sample + i);
        PathSample sample = trace_path(&params, &path_params, &world, pixel, &random, &rays);
        add_sample(path_params.film_scale, film_sums, pixel, &sample, nonfinite);
    }
    count_rays(counters + range.counter, rays);
}
