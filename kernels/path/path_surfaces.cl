// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The reference for scenes with metals, plastics and glass: path tracing as in path.cl, by the
// whole mixture of lobes that a material has (surface_path.h). Diffuse scenes run path.cl. A
// work-item traces PathParams::samples samples of one pixel.
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/film/camera.h"
#include "kernels/path/path_film.h"
#include "kernels/path/surface_path.h"

/// Follows a ray of the camera; `*rays` is raised by the number of rays.
static inline PathSample trace_surfaces(const RenderParams* params, const PathParams* path_params,
                                        const PathScene* world, const SurfaceTables* tables,
                                        uint pixel, Random* random, uint* rays) {
    PathSample sample = no_path_sample();
    float x, y;
    sample_film(params, path_params, pixel, random, &x, &y);
    SurfacePath path =
        start_surface_path(camera_origin(params, x, y), camera_direction(params, x, y));
    while (advance_surface_path(params, world, tables, &path, random, &sample, rays) != 0) continue;
    return sample;
}

WEFT_KERNEL(path_surfaces)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    SURFACES_MAKE(tables);
    ENVIRONMENT_MAKE(environment);
    PathScene world = {
        scene, geometry, lights, emissive, light_nodes, params.scene.choice_lights, environment};
    uint rays = 0u;
    for (uint i = 0u; i < path_params.samples; ++i) {
        Random random = make_random(params.sampling.seed, pixel, params.sampling.sample + i);
        PathSample sample =
            trace_surfaces(&params, &path_params, &world, &tables, pixel, &random, &rays);
        add_sample(path_params.film_scale, film_sums, pixel, &sample, nonfinite);
    }
    count_rays(counters + range.counter, rays);
}
