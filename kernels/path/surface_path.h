// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// A path over surfaces with any material. It carries basic radiance, the radiance over the square
// of the index where it is, so that boundaries of glass need no factor; what is found within the
// index n counts by (n of the camera / n)^2.
//
// Smooth parts have no value for light samples. What a ray meets after one of them has the weight
// 1, and counts as seen by the point before it: light that is seen in a mirror is emission.
#ifndef WEFT_KERNELS_PATH_SURFACE_PATH_H
#define WEFT_KERNELS_PATH_SURFACE_PATH_H

#include "kernels/bsdf/scattering.h"
#include "kernels/film/film.h"
#include "kernels/media/medium.h"
#include "kernels/path/interfaces.h"
#include "kernels/path/path.h"
#include "kernels/path/path_film.h"

// A path under way.
typedef struct {
    float3 origin, direction;
    float3 throughput;
    InterfaceSet around;  // the origin
    uint bounce;          // scattered so far, by parts that are not smooth
    uint length;          // surfaces so far
    float passed;         // how far the ray has come, of which `origin` is a later point
    float pdf;            // of the direction; 0 after the camera and smooth parts
    LitPoint left;        // where it was scattered last
} SurfacePath;

static inline SurfacePath start_surface_path(float3 origin, float3 direction) {
    SurfacePath path;
    path.origin = origin;
    path.direction = direction;
    path.throughput = f3(1.0f, 1.0f, 1.0f);
    path.around = no_interfaces();
    path.bounce = 0u;
    path.length = 0u;
    path.passed = 0.0f;
    path.pdf = 0.0f;
    path.left.position = origin;
    path.left.normal = direction;
    path.left.shading = direction;
    path.left.any_side = 0;
    return path;
}

/// Adds light that arrives after `bounce` scatterings.
static inline void add_arriving(const RenderParams* params, PathSample* sample, uint bounce,
                                float3 light) {
    if (bounce == 0u)
        sample->emission += light;
    else if (bounce > 1u)
        sample->light.indirect += light;
    else if (HAS(params, FEATURE_SAMPLED_DIRECT))
        sample->light.direct += light;
}

/// Adds light that the path has found, which came through what these interfaces enclose.
static inline void add_found(const RenderParams* params, const SurfaceTables* tables,
                             const SurfacePath* path, InterfaceSet around, uint bounce,
                             float3 light, PathSample* sample) {
    float index = index_within(tables->interfaces, around);
    add_arriving(params, sample, bounce, path->throughput * light * (1.0f / (index * index)));
}

// What lies on both sides of a boundary of a solid dielectric.
typedef struct {
    int solid;            // 0 where the surface is none
    IndexRatio ratio;     // beyond over before
    InterfaceSet beyond;  // around what is transmitted
    int absent;           // 1 where another that counts more is around on both sides
} Crossing;

/// `front` tells whether the path comes from outside. Corrects the set of the path.
static inline Crossing crossing_at(const SurfaceTables* tables, const SurfaceRecord* record,
                                   uint instance, int front, SurfacePath* path) {
    Crossing crossing;
    uint number = tables->of_instances[instance * SURFACE_INSTANCE_WORDS + SURFACE_INTERFACE];
    crossing.solid = number != INVALID_INDEX ? 1 : 0;
    crossing.absent = 0;
    crossing.beyond = path->around;
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

// Most surfaces that a shadow ray looks through.
#define MOST_SEEN_THROUGH 64

/// Share of the light that comes along a shadow ray from a point off a surface to the end of
/// `towards`, or from infinity: what passes straight through surfaces. Solid glass blocks it.
static inline float3 light_passing(const RenderParams* params, const PathScene* world,
                                   const SurfaceTables* tables, float3 origin, float3 towards,
                                   int distant, uint* rays) {
    float3 passes = f3(1.0f, 1.0f, 1.0f);
    float3 none = f3(0.0f, 0.0f, 0.0f);
    if (!HAS(params, FEATURE_SEE_THROUGH)) {
        ++*rays;
        int seen = distant != 0 ? sees_infinity(world->scene, params, origin, towards)
                                : sees_point(world->scene, params, origin, towards);
        return seen != 0 ? passes : none;
    }
    const Geometry* geometry = &world->geometry;
    float3 viewer = normalize3(-towards);
    for (int i = 0; i < MOST_SEEN_THROUGH; ++i) {
        float near = 4.0f * surface_offset(origin, params->scene.extent);
        float3 ahead = towards * (near / length3(towards));
        float3 way = distant != 0 ? towards : towards - ahead;
        ++*rays;
        Hit hit = trace_closest(world->scene, origin + ahead, way,
                                distant != 0 ? RAY_INFINITY : SHADOW_END);
        if (hit.triangle == INVALID_INDEX) return passes;
        Surface surface = surface_at(params, geometry, hit, way, 0.0f);
        SurfaceRecord record = tables->records[geometry->instances[surface.instance].material];
        if ((record.flags & (SURFACE_THIN | SURFACE_MASK | SURFACE_BLEND)) == 0u) return none;
        IndexRatio ratio;
        ratio.eta = record.eta.x;
        ratio.step = record.k.x;
        SurfaceScattering met =
            scattering_at(params, geometry, tables, &surface, hit, 0.0f, viewer, ratio);
        passes = passes * met.straight;
        if (!(max_component(passes) > 0.0f)) return none;
        float3 behind = surface.position -
                        surface.normal * surface_offset(surface.position, params->scene.extent);
        if (distant == 0) {
            towards = origin + towards - behind;
            if (!(dot3(towards, way) > 0.0f)) return passes;
        }
        origin = behind;
    }
    return none;
}

/// Next-event estimation: adds what one chosen light sends to the surface, and that scatters into
/// the path. Returns the number of shadow rays.
static inline uint light_surface(const RenderParams* params, const PathScene* world,
                                 const SurfaceTables* tables, const SurfacePath* path,
                                 const Surface* surface, const SurfaceScattering* scattering,
                                 const LitPoint* lit, InterfaceSet beyond, Random* random,
                                 PathSample* sample) {
    float choice = next_random(random);
    float u = next_random(random);
    float v = next_random(random);
    if (world->light_count == 0u) return 0u;
    float probability;
    uint chosen = choose_light_for(params, world, lit, choice, &probability);
    if (!(probability > 0.0f)) return 0u;
    // Cosines are in the values of materials.
    LitPoint all = *lit;
    all.any_side = 1;
    LightSample light =
        light_at_surface(params, &world->geometry, world->lights[chosen], world->emissive,
                         &world->environment, &all, surface->position, probability, u, v);
    float3 irradiance = light.power * light.share;
    float3 in = normalize3(light.towards);
    LayeredValue value = scattering_value(scattering, in);
    if (light.pdf > 0.0f)
        irradiance = light.power * (power_heuristic(light.pdf, value.pdf) / light.pdf);
    float3 arrives = irradiance * value.value;
    if (!(max_component(arrives) > 0.0f)) return 0u;
    // The shadow ray starts on the side of the light.
    float offset = surface_offset(surface->position, params->scene.extent);
    int above = dot3(in, surface->normal) > 0.0f ? 1 : 0;
    float3 origin = surface->position + surface->normal * (above != 0 ? offset : -offset);
    InterfaceSet around = above != 0 ? path->around : beyond;
    float3 towards =
        light.distant != 0 ? light.towards : light.towards - (origin - surface->position);
    uint rays = 0u;
    arrives = arrives * light_passing(params, world, tables, origin, towards, light.distant, &rays);
    if (!(max_component(arrives) > 0.0f)) return rays;
    float3 sigma = absorption_within(tables->interfaces, around);
    if (light.distant == 0 && max_component(sigma) > 0.0f)
        arrives = arrives * beer_transmittance(sigma, length3(light.towards));
    add_found(params, tables, path, around, path->bounce + 1u, arrives, sample);
    return rays;
}

/// Adds the emission of a surface that the path has met after `t`.
static inline void meet_emission(const RenderParams* params, const PathScene* world,
                                 const SurfaceTables* tables, const SurfacePath* path,
                                 const Surface* surface, float t, PathSample* sample) {
    if (!(max_component(surface->emission) > 0.0f)) return;
    float weight = 1.0f;
    if (path->pdf > 0.0f)
        weight =
            emission_weight(params, world, &path->left, surface, path->direction, t, path->pdf);
    add_found(params, tables, path, path->around, path->bounce, surface->emission * weight, sample);
}

/// Adds the light of the surroundings, which the path has met.
static inline void meet_surroundings(const RenderParams* params, const PathScene* world,
                                     const SurfaceTables* tables, const SurfacePath* path,
                                     PathSample* sample) {
    if (path->length == 0u) {
        sample->emission +=
            path->throughput * background_radiance(params, &world->environment, path->direction);
        sample->alpha = background_alpha(params, path->throughput);
        return;
    }
    if (!HAS(params, FEATURE_ENVIRONMENT)) return;
    float3 radiance =
        path->pdf > 0.0f
            ? weighted_environment(params, world, &path->left, path->direction, path->pdf)
            : environment_radiance(params, &world->environment, path->direction);
    add_found(params, tables, path, path->around, path->bounce, radiance, sample);
}

/// Goes on beyond or before the surface in direction `in`.
static inline void leave_surface(const RenderParams* params, const Surface* surface, float3 in,
                                 SurfacePath* path) {
    float offset = surface_offset(surface->position, params->scene.extent);
    float side = dot3(in, surface->normal) > 0.0f ? offset : -offset;
    path->origin = surface->position + surface->normal * side;
    path->direction = in;
    path->passed = 0.0f;
}

/// Lets the ray go on behind a surface.
static inline void pass_surface(const RenderParams* params, const Surface* surface, float t,
                                SurfacePath* path) {
    path->passed += t;
    path->origin = surface->position -
                   surface->normal * surface_offset(surface->position, params->scene.extent);
}

/// Roulette by what the path carries, from the third surface on. Returns 0 where it ends.
static inline int surface_path_survives(SurfacePath* path, Random* random) {
    float draw = next_random(random);
    if (path->length < ROULETTE_START) return 1;
    float q =
        m_clamp(max_component(path->throughput) / ROULETTE_LEVEL, ROULETTE_LEAST, ROULETTE_MOST);
    if (draw >= q) return 0;
    path->throughput = path->throughput * (1.0f / q);
    return 1;
}

/// Follows the path to the next surface and scatters it there. Returns 0 where it ends.
static inline int advance_surface_path(const RenderParams* params, const PathScene* world,
                                       const SurfaceTables* tables, SurfacePath* path,
                                       Random* random, PathSample* sample, uint* rays) {
    Hit hit = trace_closest(world->scene, path->origin, path->direction, RAY_INFINITY);
    ++*rays;
    if (hit.triangle == INVALID_INDEX) {
        meet_surroundings(params, world, tables, path, sample);
        return 0;
    }
    const Geometry* geometry = &world->geometry;
    float angle =
        path->length == 0u ? seen_texture_angle(params, params->camera.texture_angle, hit.t) : 0.0f;
    Facet facet = facet_of(geometry, hit.triangle);
    Surface surface = surface_on(params, geometry, &facet, hit, path->direction, angle);
    SurfaceRecord record = tables->records[geometry->instances[surface.instance].material];
    Crossing crossing = crossing_at(tables, &record, surface.instance, surface.front, path);
    float3 sigma = absorption_within(tables->interfaces, path->around);
    if (max_component(sigma) > 0.0f)
        path->throughput =
            path->throughput * beer_transmittance(sigma, hit.t * length3(path->direction));
    if (crossing.absent != 0) {
        path->around = crossing.beyond;
        pass_surface(params, &surface, hit.t, path);
        return 1;
    }
    float3 viewer = normalize3(-path->direction);
    float footprint = texture_footprint(&facet, hit, path->direction, angle);
    int first = path->length == 0u ? 1 : 0;
    if (record.model == SURFACE_UNLIT) {
        meet_emission(params, world, tables, path, &surface, path->passed + hit.t, sample);
        SurfacePoint at = {facet.triangle, hit.u, hit.v, footprint};
        float3 colour = mapped_colour(geometry, tables, &record, MAP_BASE, &at, xyz(record.base));
        if (path->bounce == 0u) add_found(params, tables, path, path->around, 0u, colour, sample);
        if (first != 0) sample->albedo = colour;
        return 0;
    }
    // The back of a one-sided material is black, but for what it emits.
    if (surface.front == 0 && crossing.solid == 0 && (record.flags & SURFACE_THIN) == 0u &&
        HAS(params, FEATURE_ONE_SIDED) && (facet.material.flags & MATERIAL_TWO_SIDED) == 0u) {
        meet_emission(params, world, tables, path, &surface, path->passed + hit.t, sample);
        return 0;
    }
    SurfaceScattering scattering =
        scattering_at(params, geometry, tables, &surface, hit, footprint, viewer, crossing.ratio);
    if (max_component(scattering.straight) > 0.0f) {
        // The ray goes on as it is, so that it meets lights with the pdf that it had.
        float chance = m_min(max_component(scattering.straight), 1.0f);
        if (next_random(random) < chance) {
            path->throughput = path->throughput * scattering.straight * (1.0f / chance);
            pass_surface(params, &surface, hit.t, path);
            return 1;
        }
        path->throughput = path->throughput * (scattering.coverage / (1.0f - chance));
    }
    meet_emission(params, world, tables, path, &surface, path->passed + hit.t, sample);
    if (first != 0) {
        sample->albedo = scattering.albedo;
        sample->normal = surface.shading;
        sample->depth = camera_depth(params, path->passed + hit.t);
    }
    if (path->length >= params->sampling.most_bounces) return 0;
    ++path->length;
    if (!HAS(params, FEATURE_INDIRECT) && path->bounce > 0u) return 0;
    LitPoint lit = lit_point(&surface);
    lit.any_side = (scattering.sides & SCATTERS_BELOW) != 0u ? 1 : 0;
    if (scattering.sides != 0u)
        *rays += light_surface(params, world, tables, path, &surface, &scattering, &lit,
                               crossing.beyond, random, sample);
    float choice = next_random(random);
    float u = next_random(random);
    float v = next_random(random);
    BsdfSample scattered = scattering_sample(&scattering, choice, u, v);
    if (!(max_component(scattered.weight) > 0.0f)) return 0;
    path->throughput = path->throughput * scattered.weight;
    int beyond = dot3(scattered.in, surface.normal) < 0.0f ? 1 : 0;
    if (beyond != 0 && crossing.solid != 0) path->around = crossing.beyond;
    leave_surface(params, &surface, scattered.in, path);
    path->pdf = scattered.pdf;
    path->left = lit;
    if ((scattered.flags & BSDF_DELTA) == 0u) ++path->bounce;
    return surface_path_survives(path, random);
}

#endif
