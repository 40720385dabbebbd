// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What lights send to the eye by glossy facets of the first surface of a view ray. The ray that a
// facet mirrors finds large lights, samples of lights find small ones, and those without size;
// both are weighted by the power heuristic (Veach and Guibas 1995).
#ifndef WEFT_KERNELS_PATH_GLOSSY_LIGHT_H
#define WEFT_KERNELS_PATH_GLOSSY_LIGHT_H

#include "kernels/path/light_passing.h"
#include "kernels/path/view_chain.h"

// Surfaces that reflect less have a sample of a light in one pixel of nine, which counts for all.
#define FULLY_LIT 0.125f
// How many times as bright as its mean over a lobe light by way of further mirrors may show in a
// pixel: the mean over the least square of pixels is of nine.
#define MOST_SPECKLED 9.0f

// How a glossy pixel samples lights.
typedef struct {
    float share;  // of such pixels that take a sample, in (0, 1]; 0 where lights are not sampled
    int takes;    // 1 where this one does
    float choice, u, v;  // numbers in [0, 1)
    float turn;          // by which the surface's normal turns over a pixel, radians
} GlossyLighting;

/// Numbers in [0, 1), spread evenly over any run of `number` (Roberts 2018, R3).
static inline void spread_numbers(uint number, GlossyLighting* lighting) {
    lighting->choice = (float)(number * 3518319155u >> 8) * 0x1p-24f;
    lighting->u = (float)(number * 2882110345u >> 8) * 0x1p-24f;
    lighting->v = (float)(number * 2360945575u >> 8) * 0x1p-24f;
}

/// Adds the sample of a light to `sum`, as radiance. Returns the number of shadow rays.
static inline uint add_glossy_light(const RenderParams* params, const PathScene* world,
                                    const SeenSurface* seen, const GlossyLighting* lighting,
                                    float3* sum) {
    const Surface* surface = &seen->surface;
    LitPoint lit = lit_point(surface);
    float probability;
    uint chosen = choose_light_for(params, world, &lit, lighting->choice, &probability);
    if (!(probability > 0.0f)) return 0u;
    lit.any_side = 1;  // cosines are in the values of facets
    LightSample light = light_at_surface(params, &world->geometry, world->lights[chosen],
                                         world->emissive, &world->environment, &lit,
                                         surface->position, probability, lighting->u, lighting->v);
    float3 in = light.distant != 0 ? light.towards : normalize3(light.towards);
    if (!(dot3(in, surface->normal) > 0.0f)) return 0u;
    float3 irradiance = light.power * light.share;
    LayeredValue value;
    if (light.pdf > 0.0f) {
        value = glossy_value(&seen->scattering, &seen->lobes, in, 0.0f);
        float pdf = light.pdf * lighting->share;
        irradiance = light.power * (power_heuristic(pdf, value.pdf) / light.pdf);
    } else {
        // No ray meets such a light: its image is as wide as what the pixel sees of facets.
        value = glossy_value(&seen->scattering, &seen->lobes, in, 0.5f * lighting->turn);
    }
    float3 arrives = irradiance * value.value;
    if (!(max_component(arrives) > 0.0f)) return 0u;
    float3 offset = surface->normal * surface_offset(surface->position, params->scene.extent);
    float3 origin = surface->position + offset;
    float3 towards = light.distant != 0 ? light.towards : light.towards - offset;
    uint rays = 0u;
    float3 passes =
        light_passing(params, world, world->tables, origin, towards, light.distant, &rays);
    *sum += arrives * passes * (1.0f / lighting->share);
    return rays;
}

/// Share that counts of light that a ray meets after facets with the pdf `facet` and further
/// mirrors or glass, if samples of the light had the pdf `light`: where fewer than one in so many
/// rays of facets meets it, it would show as specks. No sample of a light finds it there.
static inline float found_share(float facet, float light) {
    return light > MOST_SPECKLED * facet ? MOST_SPECKLED * facet / light : 1.0f;
}

/// Sets the weight of what comes along the ray in the way's direction, and prepares the path for
/// the weights of lights that the ray meets.
static inline float3 weigh_glossy_ray(const SeenSurface* seen, const GlossyLighting* lighting,
                                      SurfacePath* path) {
    const SeenWay* glossy = &seen->lobes.ways[WAY_GLOSSY];
    LayeredValue value = glossy_value(&seen->scattering, &seen->lobes, glossy->direction, 0.0f);
    if (glossy->missed != 0 || !(value.pdf > 0.0f)) return f3(0.0f, 0.0f, 0.0f);
    if (lighting->share > 0.0f) {
        path->ray.kind = RAY_OF_SURFACE;
        // Weights depend on the ratio of pdfs, and light samples are fewer by their share.
        path->ray.pdf = value.pdf / lighting->share;
        path->ray.left = lit_point(&seen->surface);
    }
    return value.value / value.pdf;
}

/// The share that counts of the emission of a surface that the ray meets after `t`. Of a ray that
/// glossy facets have sent on, `ray.pdf` is theirs, else 0.
static inline float met_share(const RenderParams* params, const PathScene* world,
                              const SurfacePath* path, const Surface* surface, float t) {
    const MediaPath* ray = &path->ray;
    if (!(max_component(surface->emission) > 0.0f)) return 1.0f;
    if (ray->kind == RAY_OF_SURFACE)
        return met_weight(params, world, ray, surface, path->passed + t);
    if (!(ray->pdf > 0.0f)) return 1.0f;
    return found_share(
        ray->pdf,
        met_light_pdf(params, &world->geometry, world->lights, world->emissive, surface->triangle,
                      surface->instance, surface->normal, ray->direction, path->passed + t));
}

/// What counts of the environment's radiance where the ray meets nothing; likewise.
static inline float3 met_sky(const RenderParams* params, const PathScene* world,
                             const SurfacePath* path) {
    const MediaPath* ray = &path->ray;
    if (ray->kind == RAY_OF_SURFACE) return met_environment(params, world, ray);
    float pdf;
    float3 radiance = environment_met(params, &world->environment, ray->direction, &pdf);
    return ray->pdf > 0.0f ? radiance * found_share(ray->pdf, pdf) : radiance;
}

#endif
