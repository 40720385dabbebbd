// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// A path over surfaces with any material. It carries basic radiance, the radiance over the square
// of the index where it is, so that boundaries of glass need no factor; what is found within the
// index n counts by (n of the camera / n)^2.
//
// In scenes with media a ray goes through them as in media_samples.h. A medium inside of glass has
// its boundary where the glass has its own (host/scene/flat_media.h): what is refracted crosses
// both.
//
// Smooth parts have no value for light samples. What a ray meets after one of them has the weight
// 1, and counts as seen by the point before it: light that is seen in a mirror is emission.
#ifndef WEFT_KERNELS_PATH_SURFACE_PATH_H
#define WEFT_KERNELS_PATH_SURFACE_PATH_H

#include "kernels/path/interfaces.h"
#include "kernels/path/media_samples.h"

// A path under way.
typedef struct {
    MediaPath ray;        // its `surface` is not used
    InterfaceSet around;  // the ray's origin
    float passed;         // how far the ray has come, of which its origin is a later point
} SurfacePath;

/// Sets what the ray is in.
static inline void enclose_path(const SurfaceTables* tables, InterfaceSet around,
                                SurfacePath* path) {
    float index = index_within(tables->interfaces, around);
    path->around = around;
    path->ray.basic = 1.0f / (index * index);
    path->ray.absorption = absorption_within(tables->interfaces, around);
}

/// The start of a path of the camera, inside of these boundaries of media.
static inline SurfacePath start_surface_path(const RenderParams* params,
                                             const PathParams* path_params, uint enclosing_media,
                                             uint pixel, Random* random) {
    SurfacePath path;
    path.ray = camera_path(params, path_params, enclosing_media, pixel, random);
    path.around = no_interfaces();
    path.passed = 0.0f;
    return path;
}

/// Surfaces and media that the path has been scattered by.
static inline uint path_length(const SurfacePath* path) {
    return path->ray.bounce + path->ray.smooth;
}

/// Adds light that arrives after `bounce` scatterings.
static inline void add_arriving(const RenderParams* params, uint bounce, float3 light,
                                PathSample* sample) {
    if (bounce == 0u)
        sample->emission += light;
    else
        add_scattered(params, &sample->light, bounce, light);
}

// What lies on both sides of a boundary of a solid dielectric.
typedef struct {
    int solid;            // 0 where the surface is none
    IndexRatio ratio;     // beyond over before
    InterfaceSet beyond;  // around what is transmitted
    int absent;           // 1 where another that counts more is around on both sides
    uint media_beyond;    // boundaries of media around what is transmitted
} Crossing;

/// Sets which boundaries of media are around a surface that is such a boundary itself, on both of
/// its sides.
static inline void cross_boundary(const SurfaceTables* tables, uint instance, int front,
                                  SurfacePath* path, Crossing* crossing) {
    uint number = tables->of_instances[instance * SURFACE_INSTANCE_WORDS + SURFACE_BOUNDARY];
    crossing->media_beyond = path->ray.enclosing_media;
    if (number == INVALID_INDEX) return;
    uint bit = 1u << (number & ~SURFACE_BOUNDARY_INWARDS);
    int outside = (number & SURFACE_BOUNDARY_INWARDS) != 0u ? 1 - front : front;
    uint without = path->ray.enclosing_media & ~bit;
    path->ray.enclosing_media = outside != 0 ? without : without | bit;
    crossing->media_beyond = outside != 0 ? without | bit : without;
}

/// `front` tells whether the path comes from outside. Corrects the set of the path.
static inline Crossing crossing_at(const SurfaceTables* tables, GLOBAL const SurfaceRecord* record,
                                   uint instance, int front, SurfacePath* path) {
    Crossing crossing;
    uint number = tables->of_instances[instance * SURFACE_INSTANCE_WORDS + SURFACE_INTERFACE];
    crossing.solid = number != INVALID_INDEX ? 1 : 0;
    crossing.absent = 0;
    crossing.beyond = path->around;
    crossing.media_beyond = path->ray.enclosing_media;
    crossing.ratio.eta = front != 0 ? record->eta.x : 1.0f / record->eta.x;
    crossing.ratio.step = front != 0 ? record->k.x : record->k.y;
    if (crossing.solid == 0) {
        // A wall without thickness is seen from outside on both of its sides.
        crossing.ratio.eta = record->eta.x;
        crossing.ratio.step = record->k.x;
        return crossing;
    }
    path->around =
        front != 0 ? leave_interface(path->around, number) : enter_interface(path->around, number);
    crossing.beyond =
        front != 0 ? enter_interface(path->around, number) : leave_interface(path->around, number);
    if ((record->flags & SURFACE_LOCAL_INDEX) != 0u) return crossing;
    uint before = path->around.number[0];
    uint beyond = crossing.beyond.number[0];
    crossing.absent = before == beyond ? 1 : 0;
    // Between air and one dielectric the record has the ratio, made of doubles.
    if (before == NO_INTERFACE || beyond == NO_INTERFACE) return crossing;
    float a = index_within(tables->interfaces, path->around);
    float b = index_within(tables->interfaces, crossing.beyond);
    crossing.ratio.eta = b / a;
    crossing.ratio.step = (b - a) * (b + a) / (a * a);
    return crossing;
}

// A surface that the path has met.
typedef struct {
    Surface surface;
    SurfaceScattering scattering;
    LitPoint lit;
    Crossing crossing;
} MetSurface;

/// Next-event estimation: adds what one chosen light sends to the surface, and that scatters into
/// the path. `media` is 0 in scenes without. Returns the number of shadow rays.
static inline uint light_surface(const RenderParams* params, const PathScene* world,
                                 const SurfaceTables* tables, const Media* media,
                                 const SurfacePath* path, const MetSurface* met, Random* random,
                                 PathSample* sample) {
    float choice = next_random(random);
    float u = next_random(random);
    float v = next_random(random);
    if (world->light_count == 0u) return 0u;
    float probability;
    uint chosen = choose_light_for(params, world, &met->lit, choice, &probability);
    if (!(probability > 0.0f)) return 0u;
    const Surface* surface = &met->surface;
    // Cosines are in the values of materials.
    LitPoint all = met->lit;
    all.any_side = 1;
    LightSample light =
        light_at_surface(params, &world->geometry, world->lights[chosen], world->emissive,
                         &world->environment, &all, surface->position, probability, u, v);
    float3 irradiance = light.power * light.share;
    float3 in = light.distant != 0 ? light.towards : normalize3(light.towards);
    LayeredValue value = scattering_value(&met->scattering, in);
    if (light.pdf > 0.0f)
        irradiance = light.power * (power_heuristic(light.pdf, value.pdf) / light.pdf);
    float3 arrives = irradiance * value.value;
    if (!(max_component(arrives) > 0.0f)) return 0u;
    // The shadow ray starts on the side of the light.
    float offset = surface_offset(surface->position, params->scene.extent);
    int above = dot3(in, surface->normal) > 0.0f ? 1 : 0;
    float3 origin = surface->position + surface->normal * (above != 0 ? offset : -offset);
    float3 towards =
        light.distant != 0 ? light.towards : light.towards - (origin - surface->position);
    uint rays = 0u;
    arrives = arrives * light_passing(params, world, tables, origin, towards, light.distant, &rays);
    if (!(max_component(arrives) > 0.0f)) return rays;
    float3 sigma = path->ray.absorption;
    float basic = path->ray.basic;
    if (above == 0) {
        sigma = absorption_within(tables->interfaces, met->crossing.beyond);
        float index = index_within(tables->interfaces, met->crossing.beyond);
        basic = 1.0f / (index * index);
    }
    if (light.distant == 0 && max_component(sigma) > 0.0f)
        arrives = arrives * beer_transmittance(sigma, length3(light.towards));
    if (media != 0)
        arrives = arrives * ray_transmittance(
                                params, media, origin, normalize3(towards),
                                light.distant != 0 ? RAY_INFINITY : length3(towards),
                                above != 0 ? path->ray.enclosing_media : met->crossing.media_beyond,
                                random);
    add_arriving(params, path->ray.bounce + 1u,
                 path->ray.throughput * path->ray.ratio * arrives * basic, sample);
    return rays;
}

/// Adds the emission of a surface that the path has met after `t`.
static inline void meet_emission(const RenderParams* params, const PathScene* world,
                                 const SurfacePath* path, const Surface* surface, float t,
                                 PathSample* sample) {
    if (!(max_component(surface->emission) > 0.0f)) return;
    float weight = met_weight(params, world, &path->ray, surface, path->passed + t);
    add_met(params, &path->ray, surface->emission * weight, sample);
}

/// Adds the light of the surroundings, which the path has met.
static inline void meet_surroundings(const RenderParams* params, const PathScene* world,
                                     const SurfacePath* path, PathSample* sample) {
    const MediaPath* ray = &path->ray;
    if (path_length(path) == 0u) {
        add_met(params, ray, background_radiance(params, &world->environment, ray->direction),
                sample);
        // Its mean over paths, those that end before included, is by what reaches the camera.
        sample->alpha = background_alpha(params, ray->throughput * ray->ratio);
        return;
    }
    if (!HAS(params, FEATURE_ENVIRONMENT)) return;
    float3 radiance = ray->kind == RAY_OF_CAMERA
                          ? environment_radiance(params, &world->environment, ray->direction)
                          : met_environment(params, world, ray);
    add_met(params, ray, radiance, sample);
}

/// Lets the ray go on behind a surface.
static inline void pass_surface(const RenderParams* params, const Surface* surface, float t,
                                uint media_beyond, SurfacePath* path) {
    path->passed += t;
    path->ray.enclosing_media = media_beyond;
    path->ray.origin = surface->position -
                       surface->normal * surface_offset(surface->position, params->scene.extent);
}

/// Scatters the path on the surface. Returns 0 where it ends.
static inline int leave_surface(const RenderParams* params, const SurfaceTables* tables,
                                const MetSurface* met, Random* random, SurfacePath* path) {
    float choice = next_random(random);
    float u = next_random(random);
    float v = next_random(random);
    BsdfSample scattered = scattering_sample(&met->scattering, choice, u, v);
    if (!(max_component(scattered.weight) > 0.0f)) return 0;
    const Surface* surface = &met->surface;
    float offset = surface_offset(surface->position, params->scene.extent);
    int beyond = dot3(scattered.in, surface->normal) < 0.0f ? 1 : 0;
    MediaPath* ray = &path->ray;
    ray->throughput = ray->throughput * scattered.weight;
    ray->origin = surface->position + surface->normal * (beyond != 0 ? -offset : offset);
    ray->direction = scattered.in;
    ray->pdf = scattered.pdf;
    ray->left = met->lit;
    path->passed = 0.0f;
    if (beyond != 0) ray->enclosing_media = met->crossing.media_beyond;
    if (beyond != 0 && met->crossing.solid != 0) enclose_path(tables, met->crossing.beyond, path);
    if ((scattered.flags & BSDF_DELTA) != 0u) {
        ray->kind = RAY_OF_CAMERA;
        ++ray->smooth;
    } else {
        ray->kind = RAY_OF_SURFACE;
        ++ray->bounce;
    }
    return path_survives(ray, ROULETTE_MOST, random);
}

/// Goes through the media and the glass that are before what the ray meets after `t`. Returns 1
/// where a medium scatters the path, -1 where it ends.
static inline int cross_segments(const RenderParams* params, const PathScene* world,
                                 const Media* media, float t, SurfacePath* path, Random* random,
                                 PathSample* sample, uint* rays) {
    MediaPath* ray = &path->ray;
    if (media != 0) {
        int scattered = cross_media(params, world, media, ray, t, random, sample, rays);
        if (scattered > 0) path->passed = 0.0f;
        if (scattered != 0) return scattered;
    }
    if (t < RAY_INFINITY && max_component(ray->absorption) > 0.0f)
        ray->throughput = ray->throughput * beer_transmittance(ray->absorption, t);
    return 0;
}

/// Roulette after a medium has scattered the path.
static inline int medium_path_survives(SurfacePath* path, Random* random) {
    return path_survives(
        &path->ray, path->ray.enclosing_media != 0u ? MEDIUM_ROULETTE_MOST : OUTER_ROULETTE_MOST,
        random);
}

/// What the film shows of the first surface, which the camera sees at that depth.
static inline void show_surface(const MetSurface* met, float depth, PathSample* sample) {
    sample->albedo = scattering_albedo(&met->scattering);
    sample->normal = met->surface.shading;
    sample->depth = depth;
}

/// Follows the path to the next surface, or to where a medium scatters it. `media` is 0 in scenes
/// without. Returns 0 where it ends.
static inline int advance_surface_path(const RenderParams* params, const PathScene* world,
                                       const SurfaceTables* tables, const Media* media,
                                       SurfacePath* path, Random* random, PathSample* sample,
                                       uint* rays) {
    MediaPath* ray = &path->ray;
    Hit hit = trace_closest(world->scene, ray->origin, ray->direction, RAY_INFINITY);
    ++*rays;
    if (hit.triangle == INVALID_INDEX) {
        int scattered =
            cross_segments(params, world, media, RAY_INFINITY, path, random, sample, rays);
        if (scattered > 0) return medium_path_survives(path, random);
        if (scattered == 0) meet_surroundings(params, world, path, sample);
        return 0;
    }
    const Geometry* geometry = &world->geometry;
    int first = path_length(path) == 0u ? 1 : 0;
    float angle =
        first != 0 ? seen_texture_angle(params, params->camera.texture_angle, hit.t) : 0.0f;
    Facet facet = facet_of(geometry, hit.triangle);
    float3 viewer = -ray->direction;
    float footprint = texture_footprint(&facet, hit, ray->direction, angle);
    float depth = camera_depth(
        params, (path->passed + hit.t) * dot3(ray->direction, xyz(params->camera.forward)));
    MetSurface met;
    met.surface = surface_on(params, geometry, &facet, hit, ray->direction, angle);
    const Surface* surface = &met.surface;
    GLOBAL const SurfaceRecord* record = record_of(geometry, tables, surface);
    met.crossing = crossing_at(tables, record, surface->instance, surface->front, path);
    if (met.crossing.solid != 0) enclose_path(tables, path->around, path);
    int scattered = cross_segments(params, world, media, hit.t, path, random, sample, rays);
    if (scattered < 0) return 0;
    if (scattered > 0) {
        if (first != 0 && met.crossing.absent == 0 && record->model != SURFACE_UNLIT) {
            met.scattering = scattering_at(params, geometry, tables, surface, hit, footprint,
                                           viewer, met.crossing.ratio);
            show_surface(&met, depth, sample);
        }
        return medium_path_survives(path, random);
    }
    cross_boundary(tables, surface->instance, surface->front, path, &met.crossing);
    if (met.crossing.absent != 0) {
        // Shadow rays do not know which boundaries are absent, so that what lies behind one is
        // found by scattered rays alone.
        ray->kind = RAY_OF_CAMERA;
        enclose_path(tables, met.crossing.beyond, path);
        pass_surface(params, surface, hit.t, met.crossing.media_beyond, path);
        return 1;
    }
    met.scattering = scattering_at(params, geometry, tables, surface, hit, footprint, viewer,
                                   met.crossing.ratio);
    if (max_component(met.scattering.straight) > 0.0f) {
        // The ray goes on as it is, so that it meets lights with the pdf that it had.
        float chance = m_min(max_component(met.scattering.straight), 1.0f);
        if (next_random(random) < chance) {
            ray->throughput = ray->throughput * met.scattering.straight * (1.0f / chance);
            pass_surface(params, surface, hit.t, met.crossing.media_beyond, path);
            return 1;
        }
        ray->throughput = ray->throughput * (met.scattering.coverage / (1.0f - chance));
    }
    meet_emission(params, world, path, surface, hit.t, sample);
    // The back of a one-sided material is black, but for what it emits.
    int black = surface->front == 0 && met.crossing.solid == 0 &&
                        (record->flags & SURFACE_THIN) == 0u && HAS(params, FEATURE_ONE_SIDED) &&
                        (facet.material.flags & MATERIAL_TWO_SIDED) == 0u
                    ? 1
                    : 0;
    int unlit = record->model == SURFACE_UNLIT ? 1 : 0;
    if (first != 0) show_surface(&met, depth, sample);
    if (first != 0 && black != 0) sample->albedo = f3(0.0f, 0.0f, 0.0f);
    if (unlit != 0 && black == 0 && ray->bounce == 0u)
        add_met(params, ray, met.scattering.albedo, sample);
    if (black != 0 || unlit != 0) return 0;
    // As many scatterings as are wanted, or light that is not.
    if (path_length(path) >= params->sampling.most_bounces) return 0;
    if (!HAS(params, FEATURE_INDIRECT) && ray->bounce > 0u) return 0;
    met.lit = lit_point(surface);
    met.lit.any_side = (met.scattering.sides & SCATTERS_BELOW) != 0u ? 1 : 0;
    if (met.scattering.sides != 0u)
        *rays += light_surface(params, world, tables, media, path, &met, random, sample);
    return leave_surface(params, tables, &met, random, path);
}

#endif
