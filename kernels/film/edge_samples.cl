// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Smooths edge pixels by further primary rays. The surfaces that these meet take the irradiance
// that is there already, from a pixel close by that shows the same surface. One work-item for as
// many edge pixels as fill a packet of rays.
#include "kernels/bsdf/surface.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/core/sampling.h"
#include "kernels/film/camera_rays.h"
#include "kernels/film/film.h"
#include "kernels/light/environment.h"

// Pixels about the sample that are searched for irradiance: first 3 x 3, then 5 x 5.
#define NEAR_RADIUS 1
#define FAR_RADIUS 2

/// Where sample `k` of `count` lies from the pixel's own point, in [-1/2, 1/2]. An odd number of
/// points of a lattice about that, which is the last one: the projections to both axes are
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

/// A place of the lattice about the sample's jitter in the pixel, [0, 1]: what leaves it at one
/// side comes in at the other, so that the points of all samples together fill it evenly.
static inline float inside_pixel(float place) {
    if (place > 1.0f) return place - 1.0f;
    return place < 0.0f ? place + 1.0f : place;
}

/// The surface of a hit, which pixels are tested against; see gbuffer.cl for its footprint.
static inline PixelSurface hit_surface(const RenderParams* params, const Surface* hit_point,
                                       Hit hit, float3 direction) {
    PixelSurface surface;
    float distance = hit.t * length3(direction);
    float facing = -dot3(hit_point->normal, direction) / length3(direction);
    surface.position = hit_point->position;
    surface.normal = hit_point->normal;
    surface.shading = hit_point->shading;
    surface.reach = params->filter.planes * (pixel_width(params, distance) / m_max(facing, 0.05f));
    surface.cosine = params->filter.cosine;
    return surface;
}

/// The pixel within `radius` about `pixel` that lies on the surface and is nearest to (`x`, `y`), a
/// point of the film inside of `pixel`, in pixels; INVALID_INDEX where none does.
static inline uint nearest_on_surface(const RenderParams* params, const SeenPixels* seen,
                                      const PixelSurface* surface, uint pixel, float x, float y,
                                      int radius) {
    int column = (int)(pixel % params->camera.width);
    int row = (int)(pixel / params->camera.width);
    uint nearest = INVALID_INDEX;
    float least = RAY_INFINITY;
    // No other pixel's point is nearer than one that is half a pixel away at most.
    float own_across = absolute((float)column + params->camera.jitter_x - x);
    float own_down = absolute((float)row + params->camera.jitter_y - y);
    if (own_across <= 0.5f && own_down <= 0.5f &&
        pixel_is_lit(seen->ids, seen->albedo, pixel) != 0 &&
        on_surface(surface, seen->position, seen->shading, pixel) != 0)
        return pixel;
    for (int j = row - radius; j <= row + radius; ++j) {
        for (int i = column - radius; i <= column + radius; ++i) {
            if (i < 0 || j < 0 || i >= (int)params->camera.width || j >= (int)params->camera.height)
                continue;
            float across = (float)i + params->camera.jitter_x - x;
            float down = (float)j + params->camera.jitter_y - y;
            float square = across * across + down * down;
            if (!(square < least)) continue;
            uint other = (uint)j * params->camera.width + (uint)i;
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
static inline uint most_similar(const RenderParams* params, const SeenPixels* seen,
                                const Surface* surface, uint pixel) {
    int column = (int)(pixel % params->camera.width);
    int row = (int)(pixel / params->camera.width);
    uint best = pixel;
    float most = -RAY_INFINITY;
    for (int j = row - FAR_RADIUS; j <= row + FAR_RADIUS; ++j) {
        for (int i = column - FAR_RADIUS; i <= column + FAR_RADIUS; ++i) {
            if (i < 0 || j < 0 || i >= (int)params->camera.width || j >= (int)params->camera.height)
                continue;
            uint other = (uint)j * params->camera.width + (uint)i;
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
static inline uint irradiance_source(const RenderParams* params, const SeenPixels* seen,
                                     const Surface* surface, Hit hit, float3 direction, uint pixel,
                                     float x, float y, uint* misses) {
    PixelSurface about = hit_surface(params, surface, hit, direction);
    uint from = nearest_on_surface(params, seen, &about, pixel, x, y, NEAR_RADIUS);
    if (from == INVALID_INDEX)
        from = nearest_on_surface(params, seen, &about, pixel, x, y, FAR_RADIUS);
    if (from != INVALID_INDEX) return from;
    ++*misses;
    return most_similar(params, seen, surface, pixel);
}

/// The pixel within NEAR_RADIUS of `pixel` that shows this instance, or the background where that
/// is INVALID_INDEX; `pixel` itself where none does.
static inline uint pixel_of_instance(const RenderParams* params, const SeenPixels* seen,
                                     uint instance, uint pixel) {
    if (seen->ids[2u * pixel] == instance) return pixel;
    int column = (int)(pixel % params->camera.width);
    int row = (int)(pixel / params->camera.width);
    for (int j = row - NEAR_RADIUS; j <= row + NEAR_RADIUS; ++j) {
        for (int i = column - NEAR_RADIUS; i <= column + NEAR_RADIUS; ++i) {
            if (i < 0 || j < 0 || i >= (int)params->camera.width || j >= (int)params->camera.height)
                continue;
            uint other = (uint)j * params->camera.width + (uint)i;
            if (seen->ids[2u * other] == instance) return other;
        }
    }
    return pixel;
}

/// Of a surface that may be more than diffuse, sets the albedo to that of a pixel of its instance
/// about `pixel`, and fills in what that shows in mirrors and through the surface. Where there is
/// none, the albedo remains the mean over all directions.
static inline void show_material(const RenderParams* params, const SeenPixels* seen,
                                 const IrradianceBuffers* buffers, uint instance, uint pixel,
                                 float3* albedo, PixelLight* light) {
    uint of = pixel_of_instance(params, seen, instance, pixel);
    if (seen->ids[2u * of] != instance) return;
    *albedo = xyz(seen->albedo[of]);
    add_view_chains(params, buffers, of, light);
}

/// What a ray through the point (`x`, `y`) of `pixel` in that direction shows.
static inline FilmSample hit_sample(const RenderParams* params, const Geometry* geometry,
                                    const EnvironmentImage* environment, const SeenPixels* seen,
                                    const IrradianceBuffers* buffers,
                                    GLOBAL NonfiniteCounter* nonfinite, uint pixel, float x,
                                    float y, float3 direction, Hit hit, float texture_angle,
                                    uint* misses) {
    float3 none = f3(0.0f, 0.0f, 0.0f);
    PixelLight light = no_pixel_light();
    if (hit.triangle == INVALID_INDEX) {
        float3 emission = background_radiance(params, environment, direction);
        if (HAS(params, FEATURE_MEDIA))
            add_view_media(params, buffers, pixel_of_instance(params, seen, INVALID_INDEX, pixel),
                           &light);
        return film_sample(params, nonfinite, pixel, 0, emission, none, light, none, 0.0f);
    }
    Surface surface = surface_at(params, geometry, hit, direction,
                                 seen_texture_angle(params, texture_angle, hit.t));
    float3 albedo = bsdf_diffuse_albedo(&surface.bsdf);
    uint from = pixel;
    if (max_component(albedo) > 0.0f) {
        from = irradiance_source(params, seen, &surface, hit, direction, pixel, x, y, misses);
        light = pixel_light(params, buffers, from, pixel_is_lit(seen->ids, seen->albedo, from));
    } else if (HAS(params, FEATURE_MEDIA)) {
        add_view_media(params, buffers, pixel_of_instance(params, seen, surface.instance, pixel),
                       &light);
    }
    if (HAS(params, FEATURE_MATERIALS))
        show_material(params, seen, buffers, surface.instance, from, &albedo, &light);
    return film_sample(params, nonfinite, pixel, 1, surface.emission, albedo, light,
                       surface.shading, hit.t);
}

/// Adds a share of a sample, but for alpha all of it. Shares come first, so that no sum of finite
/// values overflows; of alpha they come last, so that all of a pixel is exactly 1.
static inline void add_share(FilmSample* sum, const FilmSample* sample, float share) {
    sum->emission += sample->emission * share;
    sum->direct += sample->direct * share;
    sum->indirect += sample->indirect * share;
    sum->media += sample->media * share;
    sum->reflection += sample->reflection * share;
    sum->refraction += sample->refraction * share;
    sum->glossy += sample->glossy * share;
    sum->albedo += sample->albedo * share;
    sum->normal += sample->normal * share;
    sum->depth += sample->depth * share;
    sum->alpha += sample->alpha;
}

// The rays of a work-item, sample by sample of its pixels.
#define MAX_ITEM_RAYS (LANES > MAX_EDGE_SAMPLES ? LANES : MAX_EDGE_SAMPLES)

typedef struct {
    float x[MAX_ITEM_RAYS], y[MAX_ITEM_RAYS];  // points of the film
    float3 directions[MAX_ITEM_RAYS];
    Hit hits[MAX_ITEM_RAYS];
    uint count;
} EdgeRays;

/// The rays of edge pixels [first, end) of the list.
static inline void make_edge_rays(const RenderParams* params, GLOBAL const uint* edge_pixels,
                                  uint first, uint end, EdgeRays* rays) {
    rays->count = 0u;
    for (uint at = first; at < end; ++at) {
        uint pixel = edge_pixels[at];
        int mirrored = (int)(hash_pair(params->sampling.seed, pixel) & 1u);
        for (uint k = 0u; k < params->sampling.edge_samples; ++k) {
            uint ray = rays->count++;
            float x;
            float y;
            sample_offset(k, params->sampling.edge_samples + 1u, mirrored, &x, &y);
            rays->x[ray] =
                (float)(pixel % params->camera.width) + inside_pixel(x + params->camera.jitter_x);
            rays->y[ray] =
                (float)(pixel / params->camera.width) + inside_pixel(y + params->camera.jitter_y);
            rays->directions[ray] = camera_direction(params, rays->x[ray], rays->y[ray]);
        }
    }
}

static inline void trace_edge_rays(const RenderParams* params, Scene scene, EdgeRays* rays) {
    for (uint first = 0u; first < rays->count; first += LANES) {
        uint count = rays->count - first < LANES ? rays->count - first : LANES;
        CameraPacket packet;
        Hit hits[LANES];
        for (uint lane = 0u; lane < LANES; ++lane) {
            // Lanes that are not in use repeat a ray.
            uint ray = first + (lane < count ? lane : 0u);
            set_camera_ray(params, &packet, lane, rays->x[ray], rays->y[ray]);
        }
        uint active = 0xFFFFFFFFu >> (32u - count);
        trace_camera_packet(params, scene, &packet, active, hits);
        for (uint lane = 0u; lane < count; ++lane) rays->hits[first + lane] = hits[lane];
    }
}

WEFT_KERNEL(edge_samples)
{
    if (WORK_ITEM(range) >= range.count) return;
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    ENVIRONMENT_MAKE(environment);
    IRRADIANCE_MAKE(buffers);
    SEEN_PIXELS_MAKE(seen);
    uint pixels = edge_pixels_of_item((uint)LANES, params.sampling.edge_samples);
    uint first = (range.first + WORK_ITEM(range)) * pixels;
    uint end = first + pixels < edge_pixel_count ? first + pixels : edge_pixel_count;
    EdgeRays rays;
    make_edge_rays(&params, edge_pixels, first, end, &rays);
    trace_edge_rays(&params, scene, &rays);
    float share = 1.0f / (float)(params.sampling.edge_samples + 1u);
    uint misses = 0u;
    uint ray = 0u;
    for (uint at = first; at < end; ++at) {
        uint pixel = edge_pixels[at];
        FilmSample sum = no_film_sample();
        FilmSample centre = pixel_sample(&params, &seen, &buffers, nonfinite, pixel);
        add_share(&sum, &centre, share);
        for (uint k = 0u; k < params.sampling.edge_samples; ++k, ++ray) {
            FilmSample sample = hit_sample(
                &params, &geometry, &environment, &seen, &buffers, nonfinite, pixel, rays.x[ray],
                rays.y[ray], rays.directions[ray], rays.hits[ray], texture_angle, &misses);
            add_share(&sum, &sample, share);
        }
        sum.alpha *= share;
        add_film_sample(&params, film_high, film_low, pixel, &sum);
    }
    count_rays(counters + range.counter, rays.count);
    if (misses > 0u) atomic_add_uint(&counters[range.counter].misses, misses);
}
