// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Where samples of path tracing go through the film, and how they are added to its exact sums
// (film_sums.h).
#ifndef WEFT_KERNELS_PATH_PATH_FILM_H
#define WEFT_KERNELS_PATH_PATH_FILM_H

#include "kernels/core/guard.h"
#include "kernels/film/film_sums.h"
#include "kernels/path/path.h"

// What the film sums of a sample.
typedef struct {
    float3 emission;
    PathLight light;
    float3 albedo, normal;
    float depth;
    float alpha;  // see FilmSample
} PathSample;

/// A sample that has met nothing yet.
static inline PathSample no_path_sample(void) {
    PathSample sample;
    float3 black = f3(0.0f, 0.0f, 0.0f);
    sample.emission = black;
    sample.light.direct = black;
    sample.light.indirect = black;
    sample.albedo = black;
    sample.normal = black;
    sample.depth = 0.0f;
    sample.alpha = 1.0f;
    return sample;
}

/// The point of the image, in pixels, that the next sample of a pixel goes through: any of the
/// pixel, or its centre.
static inline void sample_film(const RenderParams* params, const PathParams* path_params,
                               uint pixel, Random* random, float* x, float* y) {
    float u = next_random(random);
    float v = next_random(random);
    if (path_params->through_centres != 0u) {
        u = 0.5f;
        v = 0.5f;
    }
    *x = u + (float)(pixel % params->camera.width);
    *y = v + (float)(pixel / params->camera.width);
}

static inline void add_plane(GLOBAL uint* sums, uint plane, float value) {
    add_to_sum(sums + plane * FILM_SUM_WORDS, FILM_SUM_WORDS, value, FILM_SUM_SHIFT);
}

static inline void add_planes(GLOBAL uint* sums, uint plane, float3 value) {
    add_plane(sums, plane, value.x);
    add_plane(sums, plane + 1u, value.y);
    add_plane(sums, plane + 2u, value.z);
}

static inline void add_square(GLOBAL uint* sums, uint channel, float value) {
    add_to_sum(sums + FILM_PLANES * FILM_SUM_WORDS + channel * FILM_SQUARE_WORDS, FILM_SQUARE_WORDS,
               value * value, FILM_SQUARE_SHIFT);
}

/// Adds a sample to the sums of its pixel, among those of all.
static inline void add_sample(float scale, GLOBAL uint* film_sums, uint pixel,
                              const PathSample* sample, GLOBAL NonfiniteCounter* nonfinite) {
    GLOBAL uint* sums = film_sums + (size_t)pixel * FILM_PIXEL_WORDS;
    // Scaled by a power of two, so that the sums' range fits the scene's light.
    float3 emission = guard(nonfinite, COMPONENT_EMISSION, pixel, sample->emission) * scale;
    float3 direct = guard(nonfinite, COMPONENT_DIRECT, pixel, sample->light.direct) * scale;
    float3 indirect = guard(nonfinite, COMPONENT_INDIRECT, pixel, sample->light.indirect) * scale;
    add_planes(sums, FILM_EMISSION, emission);
    add_planes(sums, FILM_DIRECT, direct);
    add_planes(sums, FILM_INDIRECT, indirect);
    add_planes(sums, FILM_ALBEDO, guard(nonfinite, COMPONENT_SURFACE, pixel, sample->albedo));
    add_planes(sums, FILM_NORMAL, sample->normal);
    add_plane(sums, FILM_DEPTH, sample->depth);
    add_plane(sums, FILM_ALPHA, sample->alpha);
    float3 beauty = emission + direct + indirect;
    add_square(sums, 0u, beauty.x);
    add_square(sums, 1u, beauty.y);
    add_square(sums, 2u, beauty.z);
}

#endif
