// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Every pixel's surface and irradiance to the film, but for edge pixels, which edge_samples.cl adds
// where the frame has edge samples.
#include "edges.h"
#include "film.h"

WEFT_KERNEL(compose)
(PARAMS, GBUFFER_ARGS, IRRADIANCE_ARGS, GLOBAL float* film_high, GLOBAL float* film_low,
 GLOBAL NonfiniteCounter* nonfinite, GLOBAL const uint* edge_masks) {
    if (GLOBAL_ID >= params.count) return;
    uint pixel = params.first + GLOBAL_ID;
    if (params.edge_samples != 0u && is_edge_pixel(&params, edge_masks, pixel) != 0) return;
    IRRADIANCE_MAKE(buffers);
    SEEN_PIXELS_MAKE(seen);
    FilmSample sample = pixel_sample(&params, &seen, &buffers, nonfinite, pixel);
    add_film_sample(&params, film_high, film_low, pixel, &sample);
}
