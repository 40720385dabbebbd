// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The reference for scenes with homogeneous participating media: path tracing as in path.cl, with
// free paths, scattering in media and transmittance towards lights (media_samples.h). Scenes
// without media run path.cl, those with a density grid path_grid.cl, whose code would make this
// one slower. A work-item traces PathParams::samples samples of one pixel.
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/path/media_samples.h"

INLINES_ALL WEFT_KERNEL(path_media)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    MEDIA_MAKE(through);
    through.any_grid = 0;
    ENVIRONMENT_MAKE(environment);
    PathScene world = {
        scene, geometry, lights, emissive, light_nodes, params.scene.choice_lights, environment, 0};
    uint rays =
        add_media_samples(&params, &path_params, &world, &through, pixel, film_sums, nonfinite);
    count_rays(counters + range.counter, rays);
}
