// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// View rays of LANES pixels through media, and places on them.
#ifndef WEFT_KERNELS_MEDIA_VIEW_PACKET_H
#define WEFT_KERNELS_MEDIA_VIEW_PACKET_H

#include "kernels/film/camera.h"
#include "kernels/media/packet_media.h"

// View rays of LANES pixels.
typedef struct {
    WFloat3 origin;
    WFloat3 direction;  // unit
    WFloat begin, end;  // between which something scatters
    WMask valid;
} ViewPacket;

/// The part of a pixel's view ray that scatters; see view_media.cl for the buffers.
typedef struct {
    float3 origin, direction;
    float begin, end;
    int valid;
} ViewRay;

static inline ViewRay view_ray(const RenderParams* params, GLOBAL const float4* end_position,
                               GLOBAL const float4* end_albedo, uint pixel) {
    ViewRay ray;
    ray.origin = xyz(params->camera.origin);
    ray.direction = f3(0.0f, 0.0f, 1.0f);
    ray.begin = 0.0f;
    ray.end = 1.0f;
    ray.valid = 0;
    if (pixel == INVALID_INDEX || !(end_albedo[pixel].w > 0.0f)) return ray;
    float x = (float)(pixel % params->camera.width) + params->camera.jitter_x;
    float y = (float)(pixel / params->camera.width) + params->camera.jitter_y;
    ray.origin = camera_origin(params, x, y);
    ray.direction = normalize3(camera_direction(params, x, y));
    ray.begin = end_position[pixel].x;
    ray.end = end_position[pixel].y;
    ray.valid = 1;
    return ray;
}

static inline ViewPacket load_views(const RenderParams* params, GLOBAL const uint* slot_pixel,
                                    GLOBAL const float4* end_position,
                                    GLOBAL const float4* end_albedo, uint slot) {
    LaneVectors origins, directions;
    float begin[LANES], end[LANES];
    uint valid = 0u;
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        ViewRay ray = view_ray(params, end_position, end_albedo, slot_pixel[slot + lane]);
        set_lane(&origins, lane, ray.origin);
        set_lane(&directions, lane, ray.direction);
        begin[lane] = ray.begin;
        end[lane] = ray.end;
        valid |= (uint)ray.valid << lane;
    }
    ViewPacket packet;
    packet.origin = wide_of(&origins);
    packet.direction = wide_of(&directions);
    packet.begin = wide_load(begin, 0);
    packet.end = wide_load(end, 0);
    packet.valid = mask_of(valid);
    return packet;
}

// Places on view rays at which they connect to a light, and the weight of each for its whole ray.
typedef struct {
    WFloat t;
    WFloat3 d;        // from the light to the place
    WFloat distance;  // its length
    WFloat square;    // of the distance that the weight is for
    WFloat nearer;    // `square` over that of `distance`, finite
    WFloat weight;    // 1 / (pdf of the place times `square`)
} ViewPlaces;

/// Samples the places at which view rays connect to a light: about evenly over the angles under
/// which it sees the rays (equi-angular sampling, Kulla and Fajardo 2012), so that the square of
/// the distance cancels. With the tangent s of half the angle, evenly spread in place of the angle
/// itself, no trigonometry is needed, and weights differ by a factor of two at most. A light on a
/// ray is taken to be a little beside it (ANGULAR_LEAST).
///
/// If 1 / square of a light is bounded, little light comes from places closer than the bound
/// begins, and the light of other places would have weights like 1 / (the light's distance from the
/// ray). Angles are then those under which a point `apart` from the ray would see it; weights
/// correct for that.
static inline ViewPlaces places_seen_from(const ViewPacket* view, float3 light, float extent,
                                          float apart, float u) {
    WFloat3 to = wide_vector(WIDE(light.x) - view->origin.x, WIDE(light.y) - view->origin.y,
                             WIDE(light.z) - view->origin.z);
    WFloat3 v = view->direction;
    WFloat x = v.y * to.z - v.z * to.y;
    WFloat y = v.z * to.x - v.x * to.z;
    WFloat z = v.x * to.y - v.y * to.x;
    WFloat least =
        wide_square_root(wide_dot(to, to)) * ANGULAR_LEAST + WIDE(5.9604645e-8f * extent);
    WFloat beside = wide_square_root(x * x + y * y + z * z);
    beside = VMAX(beside, least);
    WMask moved = beside < WIDE(apart);
    beside = VMAX(beside, WIDE(apart));
    WFloat along = wide_dot(v, to);
    WFloat from = view->begin - along;
    WFloat until = view->end - along;
    WFloat square = beside * beside;
    WFloat first = from / (wide_square_root(from * from + square) + beside);
    WFloat last = until / (wide_square_root(until * until + square) + beside);
    WFloat s = first + (last - first) * u;
    WFloat one = WIDE(1.0f);
    WFloat offset = (beside * s * 2.0f) / (one - s * s);
    // Where s has been rounded to 1, the offset is infinite.
    offset = VMAX(offset, from);
    offset = VMIN(offset, until);
    ViewPlaces places;
    places.t = along + offset;
    places.t = VMIN(VMAX(places.t, view->begin), view->end);
    places.d.x = v.x * places.t - to.x;
    places.d.y = v.y * places.t - to.y;
    places.d.z = v.z * places.t - to.z;
    places.distance = wide_square_root(wide_dot(places.d, places.d));
    places.square = offset * offset + square;
    WFloat zero = WIDE(0.0f);
    WFloat distance = places.distance;
    WFloat nearer = places.square / SELECT(distance > zero, distance * distance, one);
    places.nearer = SELECT(moved, VMIN(nearer, WIDE(1.0e30f)), one);
    places.weight = ((last - first) * 2.0f) / ((one + s * s) * beside);
    return places;
}

// Media at places on view rays.
typedef struct {
    WFloat3 scatters;       // scattering coefficient
    WFloat3 transmittance;  // from the light to the place, and from there to the camera
    WFloat g;
} PlaceMedia;

/// Media at the place of one lane: the scattering coefficient and g there, and the transmittance
/// from the light, which is `way` beyond, to the place and from there to the camera.
static inline void walk_to_place(const RenderParams* params, const Media* media, float3 origin,
                                 float3 direction, float t, float3 way, uint number,
                                 float3* scatters, float3* transmittance, float* g) {
    *scatters = f3(0.0f, 0.0f, 0.0f);
    *transmittance = f3(1.0f, 1.0f, 1.0f);
    *g = 0.0f;
    float3 place = origin + direction * t;
    Random random = way_random(params, place, number);
    MediumWalk walk = start_walk(media, origin, direction, media->record->around_camera);
    while (next_segment(params, media, &walk, RAY_INFINITY) != 0) {
        int last = t <= walk.end ? 1 : 0;
        float end = m_min(t, walk.end);
        if (walk.medium != NO_MEDIUM) {
            MediumRecord medium = media->media[walk.medium];
            float3 sigma = xyz(medium.sigma_t);
            if (has_grid(params, media, &medium) != 0) {
                DensityGrid grid = grid_of(media, &medium);
                *transmittance *= tracked_transmittance(&grid, sigma, origin, direction, walk.begin,
                                                        end, &random);
                if (last != 0) sigma = sigma * density_at_place(&grid, place);
            } else {
                *transmittance *= beer_transmittance(sigma, end - walk.begin);
            }
            if (last != 0) {
                *scatters = sigma * xyz(medium.albedo);
                *g = medium.anisotropy;
            }
        }
        if (last != 0 || !(max_component(*transmittance) > 0.0f)) break;
    }
    if (!(max_component(*scatters * *transmittance) > 0.0f)) return;
    *transmittance *= ray_transmittance(params, media, place, normalize3(way), length3(way),
                                        walk.enclosing_media, &random);
}

/// What the innermost medium about each place scatters there; with grids, for a density of 1.
static inline void scatters_at(const Media* media, uint index, WMask here, PlaceMedia* found) {
    float3 scatters = f3(0.0f, 0.0f, 0.0f);
    float g = 0.0f;
    if (index != NO_MEDIUM) {
        MediumRecord medium = media->media[index];
        scatters = xyz(medium.sigma_t) * xyz(medium.albedo);
        g = medium.anisotropy;
    }
    found->scatters.x = SELECT(here, WIDE(scatters.x), found->scatters.x);
    found->scatters.y = SELECT(here, WIDE(scatters.y), found->scatters.y);
    found->scatters.z = SELECT(here, WIDE(scatters.z), found->scatters.z);
    found->g = SELECT(here, WIDE(g), found->g);
}

/// Multiplies what scatters by the density of the grid inside of a boundary, in the lanes of
/// `bits`.
static inline void scale_by_density(const RenderParams* params, const Media* media, uint boundary,
                                    WFloat3 positions, uint bits, PlaceMedia* found) {
    DensityGrid grid;
    float3 sigma;
    if (bits == 0u || grid_within(params, media, boundary, &grid, &sigma) == 0) return;
    LaneVectors at = lanes_of(positions);
    LaneVectors scatters = lanes_of(found->scatters);
    for (uint lane = 0u; lane < (uint)LANES; ++lane)
        if ((bits >> lane & 1u) != 0u)
            set_lane(
                &scatters, lane,
                lane_vector(&scatters, lane) * density_at_place(&grid, lane_vector(&at, lane)));
    found->scatters = wide_of(&scatters);
}

/// Multiplies the transmittance by that of grids on the ways from places to the camera and to the
/// light.
static inline void track_grids(const RenderParams* params, const Media* media,
                               const ViewPacket* view, const ViewPlaces* places, WFloat3 positions,
                               uint number, WMask wanted, PlaceMedia* found) {
    WFloat one = WIDE(1.0f);
    WFloat3 back = wide_vector(-(view->direction.x * places->t), -(view->direction.y * places->t),
                               -(view->direction.z * places->t));
    WFloat3 way = wide_vector(-places->d.x, -places->d.y, -places->d.z);
    LaneVectors at = lanes_of(positions);
    LaneVectors backs = lanes_of(back);
    LaneVectors ways = lanes_of(way);
    LaneVectors transmittance = lanes_of(found->transmittance);
    Random random[LANES];
    for (uint lane = 0u; lane < (uint)LANES; ++lane)
        random[lane] = way_random(params, lane_vector(&at, lane), number);
    uint bits = mask_bits(wanted);
    for (uint k = 0u; k < media->record->boundaries; ++k) {
        track_grid(params, media, k, &at, &backs, segment_within(media, k, positions, back, one),
                   bits, random, &transmittance);
        track_grid(params, media, k, &at, &ways, segment_within(media, k, positions, way, one),
                   bits, random, &transmittance);
    }
    found->transmittance = wide_of(&transmittance);
}

/// media_at where boundaries are convex.
static inline PlaceMedia convex_media_at(const RenderParams* params, const Media* media,
                                         const ViewPacket* view, const ViewPlaces* places,
                                         uint number, WMask wanted) {
    PlaceMedia found;
    found.scatters = wide_same(0.0f);
    found.g = WIDE(0.0f);
    scatters_at(media, media->record->outside, view->valid, &found);
    WFloat one = WIDE(1.0f);
    WFloat3 place = wide_vector(view->direction.x * places->t + view->origin.x,
                                view->direction.y * places->t + view->origin.y,
                                view->direction.z * places->t + view->origin.z);
    WFloat3 way = wide_vector(-places->d.x, -places->d.y, -places->d.z);
    WideLengths seen = no_lengths(media, places->t);
    WideLengths lit = no_lengths(media, one);
    // The last to say what is about a place is the innermost.
    for (uint k = media->record->boundaries; k-- > 0u;) {
        WideSegment segment = segment_within(media, k, view->origin, view->direction, places->t);
        WMask here = (segment.end >= places->t) & (segment.end > segment.begin);
        scatters_at(media, media->record->interior[k], here, &found);
        if (HAS(params, FEATURE_DENSITY_GRIDS))
            scale_by_density(params, media, k, place, mask_bits(wanted & here), &found);
        add_length(media, k, segment.end - segment.begin, &seen);
        segment = segment_within(media, k, place, way, one);
        add_length(media, k, segment.end - segment.begin, &lit);
    }
    WFloat3 depth = depth_of(params, media, &seen, one);
    WFloat3 beyond = depth_of(params, media, &lit, places->distance);
    found.transmittance =
        wide_transmittance(wide_vector(depth.x + beyond.x, depth.y + beyond.y, depth.z + beyond.z));
    if (HAS(params, FEATURE_DENSITY_GRIDS))
        track_grids(params, media, view, places, place, number, wanted, &found);
    return found;
}

/// The media at the places of the lanes of `wanted`; see packet_transmittance.
static inline PlaceMedia media_at(const RenderParams* params, const Media* media,
                                  const ViewPacket* view, const ViewPlaces* places, uint number,
                                  WMask wanted) {
    if (HAS(params, FEATURE_CONVEX_MEDIA))
        return convex_media_at(params, media, view, places, number, wanted);
    WFloat zero = WIDE(0.0f);
    LaneVectors scatters = lanes_of(wide_same(0.0f));
    LaneVectors transmittance = scatters;
    LaneVectors origins = lanes_of(view->origin);
    LaneVectors directions = lanes_of(view->direction);
    LaneVectors ways = lanes_of(places->d);
    float t[LANES], g[LANES];
    wide_store(places->t, t, 0);
    wide_store(zero, g, 0);
    uint bits = mask_bits(wanted);
    for (uint lane = 0u; lane < (uint)LANES; ++lane) {
        if ((bits >> lane & 1u) == 0u) continue;
        float3 scatters_here, transmittance_here;
        walk_to_place(params, media, lane_vector(&origins, lane), lane_vector(&directions, lane),
                      t[lane], -lane_vector(&ways, lane), number, &scatters_here,
                      &transmittance_here, g + lane);
        set_lane(&scatters, lane, scatters_here);
        set_lane(&transmittance, lane, transmittance_here);
    }
    PlaceMedia found;
    found.scatters = wide_of(&scatters);
    found.transmittance = wide_of(&transmittance);
    found.g = wide_load(g, 0);
    return found;
}

#endif
