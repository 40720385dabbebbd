// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The reference for scenes where some medium has a density grid: path_media.cl with the code for
// those (path_grid.h). A work-item traces PathParams::samples samples of one pixel.
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/path/media_samples.h"

WEFT_KERNEL(path_grid)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    MEDIA_MAKE(through);
    through.coloured = 1;
    ENVIRONMENT_MAKE(environment);
    PathScene world = {
        scene, geometry, lights, emissive, light_nodes, params.scene.choice_lights, environment, 0};
    uint rays =
        add_media_samples(&params, &path_params, &world, &through, pixel, film_sums, nonfinite);
    count_rays(counters + range.counter, rays);
}
