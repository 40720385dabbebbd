// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The reference for scenes with metals, plastics and glass: path tracing as in path.cl, by the
// whole mixture of lobes that a material has (surface_path.h). Diffuse scenes run path.cl, those
// with media path_media_surfaces.cl. A work-item traces PathParams::samples samples of one pixel.
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/path/surface_samples.h"

WEFT_KERNEL(path_surfaces)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    SURFACES_MAKE(tables);
    ENVIRONMENT_MAKE(environment);
    PathScene world = {scene,       geometry,    lights,
                       emissive,    light_nodes, params.scene.choice_lights,
                       environment, &tables};
    uint rays = add_surface_samples(&params, &path_params, &world, 0, pixel, film_sums, nonfinite);
    count_rays(counters + range.counter, rays);
}
