// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Follows what pixels show in mirrors, on glossy surfaces or through glass and gaps to where it
// ends; `way_number`, WAY_* of kernels/bsdf/seen_lobes.h, says which. It begins at the first
// surface, whose share goes that way, and leads over up to MOST_DELTAS further ones to one whose
// diffuse part is chosen, or to the environment. The ends are stored as a G-buffer of their own, so
// that their light is sampled and reconstructed as that of surfaces is: albedo and emission are
// those of the end times what the way leaves of its light.
//
// At surfaces after the first, one number for all pixels of a sample chooses between what they
// reflect, transmit and scatter, with probabilities by luminance: a sample has no noise, only
// borders where the choice changes, and the mean over samples is right. The first sample takes what
// is brighter. Of rough facets neighbours see others. One work-item per pixel.
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/film/primary_rays.h"
#include "kernels/path/glossy_light.h"

#define MOST_DELTAS 8u
// Ways that leave less than this of all light are not followed.
#define FAINT_WAY 0.001953125f  // 1/512
// Widest angle of the cone of light that a pixel stands for.
#define WIDEST_CONE 0.2f

// The cone about a ray that a pixel stands for (Amanatides 1984).
typedef struct {
    float width;   // where the ray is, kernel units
    float spread;  // by which it grows, per unit of length
} PixelCone;

// A way under way.
typedef struct {
    SurfacePath path;
    PixelCone cone;
    float3 weight;    // what is left of light from the end
    float3 emission;  // of surfaces passed
    float length;
    int bent;  // 1 once it has left the line of the camera's ray
} ViewWay;

/// The radical inverse of `n` in `base`.
static inline float plain_inverse(uint base, uint n) {
    float digit = 1.0f;
    float sum = 0.0f;
    while (n > 0u) {
        digit /= (float)base;
        sum += digit * (float)(n % base);
        n /= base;
    }
    return sum;
}

/// The number in [0, 1) by which all pixels of a sample choose at the surface after `deltas`
/// others; 1/2 in the first sample.
static inline float choice_number(const RenderParams* params, uint deltas) {
    float x = 0.5f + plain_inverse(bounce_primes[deltas], params->sampling.sample);
    return x < 1.0f ? x : x - 1.0f;
}

/// The pixel's number in its square of 3 x 3 pixels.
static inline uint place_of_nine(const RenderParams* params, uint pixel) {
    return pixel % params->camera.width % 3u + pixel / params->camera.width % 3u * 3u;
}

/// The number of the pixel's sample among those of its square of GLOSSY_PATTERN x GLOSSY_PATTERN
/// pixels, from 1 on: those of 3 x 3 pixels are apart by one in each sample.
static inline uint pattern_number(const RenderParams* params, uint pixel) {
    uint x = pixel % params->camera.width;
    uint y = pixel / params->camera.width;
    uint place = place_of_nine(params, pixel) + (x / 3u % 3u + y / 3u % 3u * 3u) * 9u;
    return params->sampling.sample * (GLOSSY_PATTERN * GLOSSY_PATTERN) + place + 1u;
}

/// In each sample, neighbours see other facets: those of 3 x 3 pixels cover a lobe evenly, those of
/// GLOSSY_PATTERN x GLOSSY_PATTERN more finely, and over such squares their mean has hardly any
/// noise (filter_chains.cl).
static inline FacetChoice facet_choice(uint number) {
    FacetChoice choice = {plain_inverse(5u, number), plain_inverse(2u, number),
                          plain_inverse(3u, number), ANY_ALPHA};
    return choice;
}

/// How much the normal of a facet turns per unit of length, 1 / kernel units.
static inline float curvature_of(const RenderParams* params, const Geometry* geometry,
                                 uint triangle) {
    if (!HAS(params, FEATURE_SMOOTH_NORMALS)) return 0.0f;
    Triangle t = geometry->triangles[triangle];
    float3 a = attribute3(geometry->normals, t.v0);
    float3 b = attribute3(geometry->normals, t.v1) - a;
    float3 c = attribute3(geometry->normals, t.v2) - a;
    float3 corner = xyz(geometry->positions[t.v0]);
    float3 ab = xyz(geometry->positions[t.v1]) - corner;
    float3 ac = xyz(geometry->positions[t.v2]) - corner;
    float turn = m_max(dot3(b, b), dot3(c, c));
    float size = m_max(dot3(ab, ab), dot3(ac, ac));
    return size > 0.0f ? square_root(turn / size) : 0.0f;
}

/// How a glossy pixel, whose surface reflects that share of light and whose cone is that wide
/// there, samples lights.
static inline GlossyLighting glossy_lighting(const RenderParams* params, const Geometry* geometry,
                                             uint pixel, uint triangle, float3 share, float width) {
    GlossyLighting lighting;
    int all = luminance(share) >= FULLY_LIT ? 1 : 0;
    lighting.share = all != 0 ? 1.0f : 1.0f / 9.0f;
    // 4 has no divisor in common with 9: the pixel that takes a sample changes from one to another.
    uint turn = (place_of_nine(params, pixel) + 4u * params->sampling.sample) % 9u;
    lighting.takes = all != 0 || turn == 0u ? 1 : 0;
    spread_numbers(pattern_number(params, pixel), &lighting);
    lighting.turn = curvature_of(params, geometry, triangle) * width + params->camera.pixel_angle;
    return lighting;
}

/// Sends the way on from a surface by one of its lobes, WAY_*.
static inline void leave_mirror(const RenderParams* params, const Geometry* geometry,
                                const SurfaceTables* tables, const SeenSurface* seen, int by,
                                ViewWay* way) {
    const Surface* surface = &seen->surface;
    float offset = surface_offset(surface->position, params->scene.extent);
    int through = by == WAY_REFRACTION ? 1 : 0;
    SurfacePath* path = &way->path;
    path->ray.direction = seen->lobes.ways[by].direction;
    path->passed = 0.0f;
    path->ray.origin = surface->position + surface->normal * (through != 0 ? -offset : offset);
    if (through != 0 && seen->crossing.solid != 0)
        enclose_path(tables, seen->crossing.beyond, path);
    if (through != 0 && seen->lobes.refracts == 0) return;
    way->bent = 1;
    float turn = curvature_of(params, geometry, surface->triangle) * way->cone.width;
    way->cone.spread = m_min(way->cone.spread + (through != 0 ? turn : 2.0f * turn), WIDEST_CONE);
}

/// Stores an end, or with `instance` INVALID_INDEX only the light that was met.
static inline void store_end(const ViewWay* way, uint pixel, uint instance, uint triangle,
                             const SeenSurface* seen, float3 albedo, const PixelStore* store) {
    float4 none = f4(0.0f, 0.0f, 0.0f, 0.0f);
    store->ids[2u * pixel] = instance;
    store->ids[2u * pixel + 1u] = triangle;
    float3 emission = way->emission;
    store->emission[pixel] = f4(emission.x, emission.y, emission.z, 0.0f);
    if (instance == INVALID_INDEX) {
        store->position[pixel] = none;
        store->normal[pixel] = none;
        store->shading[pixel] = none;
        store->albedo[pixel] = none;
        return;
    }
    float3 at = seen->surface.position;
    float3 normal = seen->surface.normal;
    float3 shading = seen->shading;
    float facing = m_max(-dot3(normal, way->path.ray.direction), 0.05f);
    float lit = max_component(albedo) > 0.0f ? 1.0f : 0.0f;
    store->position[pixel] = f4(at.x, at.y, at.z, way->length);
    store->normal[pixel] = f4(normal.x, normal.y, normal.z, way->cone.width / facing);
    store->shading[pixel] = f4(shading.x, shading.y, shading.z, 0.0f);
    store->albedo[pixel] = f4(albedo.x, albedo.y, albedo.z, lit);
}

/// The camera's ray through a pixel, which meets its surface at the hit.
static inline ViewWay start_view_way(const RenderParams* params, const Geometry* geometry,
                                     uint pixel, uint triangle, float3 position, Hit* hit) {
    ViewWay way;
    float x = (float)(pixel % params->camera.width) + params->camera.jitter_x;
    float y = (float)(pixel / params->camera.width) + params->camera.jitter_y;
    way.path = start_view_chain(normalize3(camera_direction(params, x, y)));
    way.path.ray.origin = camera_origin(params, x, y);
    Triangle t = geometry->triangles[triangle];
    float3 a = xyz(geometry->positions[t.v0]);
    float3 ab = xyz(geometry->positions[t.v1]) - a;
    float3 ac = xyz(geometry->positions[t.v2]) - a;
    float3 normal = cross3(ab, ac);
    float3 from_a = position - a;
    float square = dot3(normal, normal);
    hit->triangle = triangle;
    hit->u = m_clamp(dot3(cross3(from_a, ac), normal) / square, 0.0f, 1.0f);
    hit->v = m_clamp(dot3(cross3(ab, from_a), normal) / square, 0.0f, 1.0f - hit->u);
    hit->t = length3(position - way.path.ray.origin);
    way.cone.width = pixel_width(params, hit->t);
    way.cone.spread = HAS(params, FEATURE_ORTHOGRAPHIC) ? 0.0f : params->camera.pixel_angle;
    way.weight = f3(1.0f, 1.0f, 1.0f);
    way.emission = f3(0.0f, 0.0f, 0.0f);
    way.length = hit->t;
    way.bent = 0;
    return way;
}

/// Chooses at a surface after the first; returns WAY_*, WAY_COUNT for an end, or -1 where it is
/// black. Scales the weight to the chosen lobe.
static inline int choose_lobe(const SeenLobes* lobes, float u, ViewWay* way) {
    float diffuse = luminance(lobes->diffuse);
    float before[WAY_COUNT + 1];  // sums; what is seen through comes last
    before[WAY_REFLECTION] = 0.0f;
    before[WAY_GLOSSY] = luminance(lobes->ways[WAY_REFLECTION].share);
    float mirrored = before[WAY_GLOSSY] + luminance(lobes->ways[WAY_GLOSSY].share);
    before[WAY_REFRACTION] = mirrored + diffuse;
    float sum = before[WAY_REFRACTION] + luminance(lobes->ways[WAY_REFRACTION].share);
    if (!(sum > 0.0f)) return -1;
    float at = u * sum;
    int chosen = WAY_COUNT;
    if (at < before[WAY_GLOSSY])
        chosen = WAY_REFLECTION;
    else if (at < mirrored)
        chosen = WAY_GLOSSY;
    else if (at >= before[WAY_REFRACTION])
        chosen = WAY_REFRACTION;
    if (chosen == WAY_COUNT) {
        way->weight = way->weight * (sum / diffuse);
        return chosen;
    }
    float brightness = luminance(lobes->ways[chosen].share);
    // The sum may be one rounding below what it was made of.
    if (!(brightness > 0.0f)) return -1;
    way->weight = way->weight * lobes->ways[chosen].share * (sum / brightness);
    return chosen;
}

WEFT_KERNEL(view_chains)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    SCENE_MAKE(scene);
    GEOMETRY_MAKE(geometry);
    SURFACES_MAKE(tables);
    ENVIRONMENT_MAKE(environment);
    PathScene world = {scene,       geometry,
                       lights,      emissive,
                       light_nodes, samples_lights != 0u ? params.scene.choice_lights : 0u,
                       environment, &tables};
    PixelStore store = {end_ids, end_position, end_normal, end_shading, end_albedo, end_emission};
    ViewWay way;
    way.emission = f3(0.0f, 0.0f, 0.0f);
    uint triangle = gb_ids[2u * pixel + 1u];
    SeenSurface seen;
    uint wanted = way_number == (uint)WAY_REFLECTION
                      ? SURFACE_MIRRORS
                      : (way_number == (uint)WAY_GLOSSY ? SURFACE_GLOSSY : SURFACE_LETS_THROUGH);
    if (triangle == INVALID_INDEX ||
        (tables.records[geometry.instances[gb_ids[2u * pixel]].material].flags & wanted) == 0u) {
        store_end(&way, pixel, INVALID_INDEX, INVALID_INDEX, &seen, way.emission, &store);
        if (keeps_shares != 0u) view_shares[pixel] = f4(0.0f, 0.0f, 0.0f, 0.0f);
        return;
    }
    Hit hit;
    way = start_view_way(&params, &geometry, pixel, triangle, xyz(gb_position[pixel]), &hit);
    SurfacePath* path = &way.path;
    FacetChoice facets = facet_choice(pattern_number(&params, pixel));
    float texture_share = params.camera.texture_angle / params.camera.pixel_angle;
    uint rays = 0u;
    uint deltas = 0u;
    uint gaps = 0u;
    uint instance = INVALID_INDEX;
    float3 albedo = way.emission;
    float3 first_share = way.emission;
    float alpha = 0.0f;
    while (deltas <= MOST_DELTAS && gaps < MOST_GAPS) {
        seen = see_surface(&params, &geometry, &tables, hit, way.cone.width * texture_share / hit.t,
                           facets, path);
        if (max_component(path->ray.absorption) > 0.0f)
            way.weight = way.weight * beer_transmittance(path->ray.absorption, hit.t);
        if (seen.is_there == 0) {
            pass_chain(&params, &tables, &seen, hit.t, path);
            ++gaps;
        } else {
            int chosen = (int)way_number;
            float brightest;  // of what is left of light
            if (deltas == 0u) {
                way.weight = seen.lobes.ways[chosen].share;
                first_share = way.weight;
                brightest = max_component(first_share);
                alpha = seen.lobes.ways[chosen].alpha;
                if (chosen == WAY_GLOSSY && brightest >= FAINT_WAY) {
                    GlossyLighting lighting = {0.0f, 0, 0.0f, 0.0f, 0.0f, 0.0f};
                    if (world.light_count > 0u)
                        lighting = glossy_lighting(&params, &geometry, pixel, seen.surface.triangle,
                                                   first_share, way.cone.width);
                    if (lighting.takes != 0)
                        rays += add_glossy_light(&params, &world, &seen, &lighting, &way.emission);
                    way.weight = weigh_glossy_ray(&seen, &lighting, path);
                }
                facets.widest = GLOSSY_ALPHA;
            } else {
                float weight = met_share(&params, &world, path, &seen.surface, hit.t);
                way.emission += way.weight * seen.emission * (weight * path->ray.basic);
                path->ray.kind = RAY_OF_CAMERA;
                chosen = choose_lobe(&seen.lobes, choice_number(&params, deltas - 1u), &way);
                brightest = max_component(way.weight);
            }
            if (chosen == WAY_COUNT) {
                instance = seen.surface.instance;
                albedo = way.weight * seen.lobes.diffuse * path->ray.basic;
            }
            if (chosen < 0 || chosen == WAY_COUNT || brightest < FAINT_WAY) break;
            leave_mirror(&params, &geometry, &tables, &seen, chosen, &way);
            ++deltas;
        }
        hit = trace_closest(scene, path->ray.origin, path->ray.direction, RAY_INFINITY);
        ++rays;
        if (hit.triangle == INVALID_INDEX) {
            float3 sky = f3(0.0f, 0.0f, 0.0f);
            if (way.bent == 0)
                sky = background_radiance(&params, &environment, path->ray.direction);
            else if (HAS(&params, FEATURE_ENVIRONMENT))
                sky = met_sky(&params, &world, path);
            way.emission += way.weight * sky;
            break;
        }
        way.length += hit.t;
        way.cone.width += way.cone.spread * hit.t;
    }
    store_end(&way, pixel, instance, instance == INVALID_INDEX ? INVALID_INDEX : hit.triangle,
              &seen, albedo, &store);
    if (keeps_shares != 0u)
        view_shares[pixel] = f4(first_share.x, first_share.y, first_share.z, alpha);
    count_rays(counters + range.counter, rays);
}
