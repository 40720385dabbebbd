// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Samples of a pixel in scenes with materials, by paths as surface_path.h follows them.
#ifndef WEFT_KERNELS_PATH_SURFACE_SAMPLES_H
#define WEFT_KERNELS_PATH_SURFACE_SAMPLES_H

#include "kernels/path/path_film.h"
#include "kernels/path/surface_path.h"

/// Traces the samples of a pixel and adds them to the film's exact sums. `media` is 0 in scenes
/// without. Returns the number of rays.
static inline uint add_surface_samples(const RenderParams* params, const PathParams* path_params,
                                       const PathScene* world, const Media* media, uint pixel,
                                       GLOBAL uint* film_sums, GLOBAL NonfiniteCounter* nonfinite) {
    uint rays = 0u;
    for (uint i = 0u; i < path_params->samples; ++i) {
        Random random = make_random(params->sampling.seed, pixel, params->sampling.sample + i);
        PathSample sample = no_path_sample();
        SurfacePath path = start_surface_path(
            params, path_params, media != 0 ? media->record->around_camera : 0u, pixel, &random);
        while (advance_surface_path(params, world, world->tables, media, &path, &random, &sample,
                                    &rays) != 0)
            continue;
        add_sample(path_params->film_scale, film_sums, pixel, &sample, nonfinite);
    }
    return rays;
}

#endif
