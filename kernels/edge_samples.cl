// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Anti-aliasing of edge pixels: further primary rays, whose surfaces take the irradiance that is
// there already, from a pixel close by that shows the same surface. One work-item per edge pixel.
#include "camera.h"
#include "counters.h"
#include "film.h"
#include "sampling.h"
#include "surface.h"
#include "trace.h"

// Pixels about the sample in which irradiance is looked for: first 3 x 3, then 5 x 5.
#define NEAR_RADIUS 1
#define FAR_RADIUS 2

/// Where in a pixel sample `k` of `count` lies, from its centre, in [-1/2, 1/2]. An odd number of
/// points of a lattice about the centre, which is the last one: the projections to both axes are
/// evenly spaced, and the mean is 0. Pixels choose between the lattice and its mirror image.
static inline void sample_offset(uint k, uint count, int mirrored, float* x, float* y) {
    int half_count = (int)(count / 2u);
    int column = (int)(k / 2u) + 1;
    int row = count > 3u ? 2 * column : column;
    if (row > half_count) row -= (int)count;
    if (k % 2u != 0u) {
        column = -column;
        row = -row;
    }
    *x = (float)column / (float)count;
    *y = (float)(mirrored != 0 ? -row : row) / (float)count;
}

/// The surface of a hit as pixels are held against it; see gbuffer.cl for its footprint.
static inline PixelSurface hit_surface(const Params* params, const Surface* hit_point, Hit hit,
                                       float3 direction) {
    PixelSurface surface;
    float distance = hit.t * length3(direction);
    float facing = -dot3(hit_point->normal, direction) / length3(direction);
    surface.position = hit_point->position;
    surface.normal = hit_point->normal;
    surface.shading = hit_point->shading;
    surface.reach = params->filter_planes * (distance * params->pixel_angle / m_max(facing, 0.05f));
    surface.cosine = params->filter_cosine;
    return surface;
}

/// The pixel within `radius` about (`x`, `y`), a point of the film in pixels, that lies on the
/// surface and is nearest to the point; NO_TRIANGLE where none does.
static inline uint nearest_on_surface(const Params* params, const SeenPixels* seen,
                                      const PixelSurface* surface, uint pixel, float x, float y,
                                      int radius) {
    int column = (int)(pixel % params->width);
    int row = (int)(pixel / params->width);
    uint nearest = NO_TRIANGLE;
    float least = RAY_INFINITY;
    for (int j = row - radius; j <= row + radius; ++j) {
        for (int i = column - radius; i <= column + radius; ++i) {
            if (i < 0 || j < 0 || i >= (int)params->width || j >= (int)params->height) continue;
            float across = (float)i + params->jitter_x - x;
            float down = (float)j + params->jitter_y - y;
            float square = across * across + down * down;
            if (!(square < least)) continue;
            uint other = (uint)j * params->width + (uint)i;
            if (pixel_is_lit(seen->ids, seen->albedo, other) == 0) continue;
            if (on_surface(surface, seen->position, seen->shading, other) == 0) continue;
            least = square;
            nearest = other;
        }
    }
    return nearest;
}

/// The pixel within FAR_RADIUS most like a surface that none of them shows: of its instance if
/// there is one, then the closest by normal; `pixel` itself where nothing about it is lit.
static inline uint most_similar(const Params* params, const SeenPixels* seen,
                                const Surface* surface, uint pixel) {
    int column = (int)(pixel % params->width);
    int row = (int)(pixel / params->width);
    uint best = pixel;
    float most = -RAY_INFINITY;
    for (int j = row - FAR_RADIUS; j <= row + FAR_RADIUS; ++j) {
        for (int i = column - FAR_RADIUS; i <= column + FAR_RADIUS; ++i) {
            if (i < 0 || j < 0 || i >= (int)params->width || j >= (int)params->height) continue;
            uint other = (uint)j * params->width + (uint)i;
            if (pixel_is_lit(seen->ids, seen->albedo, other) == 0) continue;
            // No two cosines are further apart than 2.
            float likeness = dot3(surface->shading, xyz(seen->shading[other])) +
                             (seen->ids[2u * other] == surface->instance ? 3.0f : 0.0f);
            if (!(likeness > most)) continue;
            most = likeness;
            best = other;
        }
    }
    return best;
}

/// The pixel whose irradiance a hit seen through the point (`x`, `y`) of `pixel` takes. Adds to
/// `misses` where it is that of another surface.
static inline uint irradiance_source(const Params* params, const SeenPixels* seen,
                                     const Surface* surface, Hit hit, float3 direction, uint pixel,
                                     float x, float y, uint* misses) {
    PixelSurface about = hit_surface(params, surface, hit, direction);
    uint from = nearest_on_surface(params, seen, &about, pixel, x, y, NEAR_RADIUS);
    if (from == NO_TRIANGLE)
        from = nearest_on_surface(params, seen, &about, pixel, x, y, FAR_RADIUS);
    if (from != NO_TRIANGLE) return from;
    ++*misses;
    return most_similar(params, seen, surface, pixel);
}

/// What is seen through the point (`x`, `y`) of `pixel`.
static inline FilmSample trace_sample(const Params* params, Scene scene, const Geometry* geometry,
                                      const SeenPixels* seen, const IrradianceBuffers* buffers,
                                      GLOBAL NonfiniteCounter* nonfinite, uint pixel, float x,
                                      float y, uint* misses) {
    float3 direction = camera_direction(params, x, y);
    Hit hit = trace_closest(scene, xyz(params->camera_origin), direction, RAY_INFINITY);
    float3 none = f3(0.0f, 0.0f, 0.0f);
    Irradiance e = no_irradiance();
    if (hit.triangle == NO_TRIANGLE) {
        float3 emission = HAS(params, FEATURE_ENVIRONMENT) ? xyz(params->environment) : none;
        return film_sample(params, nonfinite, pixel, emission, none, e, none, 0.0f);
    }
    Surface surface = surface_at(params, geometry, hit, direction, params->texture_angle);
    if (max_component(surface.albedo) > 0.0f) {
        uint from = irradiance_source(params, seen, &surface, hit, direction, pixel, x, y, misses);
        e = pixel_irradiance(params, buffers, from, pixel_is_lit(seen->ids, seen->albedo, from));
    }
    return film_sample(params, nonfinite, pixel, surface.emission, surface.albedo, e,
                       surface.shading, hit.t);
}

/// Adds a share of a sample; shares come first, so that no sum of finite values overflows.
static inline void add_share(FilmSample* sum, const FilmSample* sample, float share) {
    sum->emission += sample->emission * share;
    sum->direct += sample->direct * share;
    sum->indirect += sample->indirect * share;
    sum->albedo += sample->albedo * share;
    sum->normal += sample->normal * share;
    sum->depth += sample->depth * share;
}

WEFT_KERNEL(edge_samples)
(PARAMS, SCENE_ARGS, GEOMETRY_ARGS, GBUFFER_ARGS, IRRADIANCE_ARGS, GLOBAL const uint* edge_pixels,
 GLOBAL float* film_high, GLOBAL float* film_low, GLOBAL NonfiniteCounter* nonfinite,
 GLOBAL RayCounter* counters) {
    if (GLOBAL_ID >= params.count) return;
    uint pixel = edge_pixels[params.first + GLOBAL_ID];
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    IRRADIANCE_MAKE(buffers);
    SEEN_PIXELS_MAKE(seen);
    uint count = params.edge_samples + 1u;
    uint misses = 0u;
    int mirrored = (int)(hash_pair(params.seed, pixel) & 1u);
    float share = 1.0f / (float)count;
    FilmSample sum = {f3(0.0f, 0.0f, 0.0f), f3(0.0f, 0.0f, 0.0f), f3(0.0f, 0.0f, 0.0f),
                      f3(0.0f, 0.0f, 0.0f), f3(0.0f, 0.0f, 0.0f), 0.0f};
    FilmSample centre = pixel_sample(&params, &seen, &buffers, nonfinite, pixel);
    add_share(&sum, &centre, share);
    for (uint k = 0u; k < params.edge_samples; ++k) {
        float x;
        float y;
        sample_offset(k, count, mirrored, &x, &y);
        x += (float)(pixel % params.width) + params.jitter_x;
        y += (float)(pixel / params.width) + params.jitter_y;
        FilmSample sample = trace_sample(&params, scene, &geometry, &seen, &buffers, nonfinite,
                                         pixel, x, y, &misses);
        add_share(&sum, &sample, share);
    }
    add_film_sample(&params, film_high, film_low, pixel, &sum);
    count_rays(counters + params.counter, params.edge_samples);
    if (misses > 0u) atomic_add_uint(&counters[params.counter].misses, misses);
}
