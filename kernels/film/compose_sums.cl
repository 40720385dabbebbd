// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Composes the radiance of every pixel from its surface and irradiance, as compose.cl, and adds it
// to exact sums (film_sums.h), as path tracing does. One work-item per pixel.
#include "kernels/core/kernel.h"
#include "kernels/film/film.h"
#include "kernels/path/path_film.h"

WEFT_KERNEL(compose_sums)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    IRRADIANCE_MAKE(buffers);
    SEEN_PIXELS_MAKE(seen);
    FilmSample composed = pixel_sample(&params, &seen, &buffers, nonfinite, pixel);
    PathSample sample;
    sample.emission = composed.emission;
    sample.light.direct = composed.direct;
    sample.light.indirect = composed.indirect;
    sample.albedo = composed.albedo;
    sample.normal = composed.normal;
    sample.depth = composed.depth * params.scene.unit;
    sample.alpha = composed.alpha;
    add_sample(film_scale, film_sums, pixel, &sample, nonfinite);
}
