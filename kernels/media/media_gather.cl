// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Gathers the radiance that media scatter into view rays from a set's virtual lights, in packets:
// LANES pixels of one set connect to one VPL at a time, each from a place on its own view ray,
// whose random number depends on the VPL and the set alone. So the pixels of a filter footprint
// connect to it from as many places as there are sets, times `steps`. Serves indirect VPLs, points
// on area lights and punctual lights, with the roulette of vpl_gather.cl. One work-item for LANES
// pixels.
#include "kernels/adaptive/sample_sets.h"
#include "kernels/core/counters.h"
#include "kernels/core/kernel.h"
#include "kernels/media/view_packet.h"

/// The fractional part of x >= 0.
static inline float fraction(float x) {
    return x - (float)(int)x;
}

/// What a light of flux 1 sends to places in media, times their weights, before transmittance and
/// scattering; 0 in lanes that it does not shine on.
static inline WFloat light_on_places(const ViewPlaces* places, GLOBAL const Vpl* vpl, uint kind) {
    WFloat zero = WIDE(0.0f);
    if (kind == VPL_POINT) return places->weight;
    WFloat along = wide_dot_scalar(places->d, xyz(vpl->normal));
    WFloat cosine = along / places->distance;
    // 0 / 0 where a place is that of the light.
    cosine = SELECT(places->distance > zero, cosine, zero);
    if (kind == VPL_SPOT) return places->weight * wide_spot(vpl, places->d, along, cosine);
    WFloat bound = places->square * vpl->position.w;
    if (kind == VPL_SURFACE) {
        WFloat share = cosine * places->nearer;
        return places->weight * VMAX(VMIN(share, bound), zero);
    }
    // As in connection.h.
    bound = LAMBERT_REFLECTANCE(bound);
    WFloat phase = wide_phase(WIDE(vpl->cone.x), cosine) * places->nearer;
    return places->weight * VMIN(phase, bound);
}

/// Least distance from view rays that a light is taken to have when places are sampled: half the
/// distance at which its bound begins, 0 for lights without a bound.
static inline float least_apart(GLOBAL const Vpl* vpl) {
    uint kind = as_bits(vpl->normal.w);
    if (kind == VPL_POINT || kind == VPL_SPOT || !(vpl->position.w > 0.0f)) return 0.0f;
    return 0.5f / square_root(vpl->position.w);
}

/// Phase functions of places for light from the VPL to the camera.
static inline WFloat phase_to_camera(const ViewPacket* view, const ViewPlaces* places, WFloat g) {
    WFloat cosine = (-wide_dot(places->d, view->direction)) / places->distance;
    cosine = SELECT(places->distance > WIDE(0.0f), cosine, WIDE(1.0f));
    return wide_phase(g, cosine);
}

/// The level below which roulette decides, for every lane; see roulette_level. It ignores what
/// media absorb and scatter.
static inline WFloat media_roulette_level(const RenderParams* params, float roulette,
                                          const ViewPacket* view, GLOBAL const Vpl* vpl,
                                          uint count) {
    WFloat sum = WIDE(0.0f);
    for (uint i = 0u; i < count; ++i, ++vpl) {
        float weight = luminance(xyz(vpl->flux));
        if (!(weight > 0.0f)) continue;
        ViewPlaces places = places_seen_from(view, xyz(vpl->position), params->scene.extent,
                                             least_apart(vpl), vpl->cone.w);
        sum = sum + light_on_places(&places, vpl, as_bits(vpl->normal.w)) * weight;
    }
    return sum * (roulette / (float)count);
}

// Radiance of LANES pixels.
typedef struct {
    WideLight sum;
    uint rays;
} MediaLight;

/// Adds the light of a VPL that is scattered at one place of each ray.
static inline void add_place(const RenderParams* params, Scene scene, const Media* media,
                             const ViewPacket* view, GLOBAL const Vpl* vpl, uint number, float u,
                             float roulette, WFloat level, MediaLight* light) {
    WFloat zero = WIDE(0.0f);
    float4 flux = vpl->flux;
    ViewPlaces places =
        places_seen_from(view, xyz(vpl->position), params->scene.extent, least_apart(vpl), u);
    WFloat value = light_on_places(&places, vpl, as_bits(vpl->normal.w));
    WMask useful = view->valid & (value > zero);
    if (roulette > 0.0f) {
        WFloat least = level / luminance(xyz(flux));
        useful = useful & (value >= least * flux.w);
        value = VMAX(value, least);
    }
    if (!mask_any(useful)) return;
    light->rays += mask_count(useful);
    useful = useful & mask_not(trace_any_packet(scene, xyz(vpl->position), places.d, useful));
    if (!mask_any(useful)) return;
    PlaceMedia found = media_at(params, media, view, &places, number, useful);
    value = SELECT(useful, value * phase_to_camera(view, &places, found.g), zero);
    light->sum.red = light->sum.red + value * flux.x * found.scatters.x * found.transmittance.x;
    light->sum.green = light->sum.green + value * flux.y * found.scatters.y * found.transmittance.y;
    light->sum.blue = light->sum.blue + value * flux.z * found.scatters.z * found.transmittance.z;
}

WEFT_KERNEL(media_gather)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint slot = (range.first + WORK_ITEM(range)) * (uint)LANES;
    SCENE_MAKE(scene);
    MEDIA_MAKE(through);
    ViewPacket view = load_views(&params, slot_pixel, end_position, end_albedo, slot);
    uint set = receiver_set(&params, block_set, slot);
    GLOBAL const Vpl* vpl = vpls + list.first + set * list.stride;
    MediaLight light;
    light.sum = no_light();
    light.rays = 0u;
    uint count = mask_any(view.valid) ? list.length : 0u;
    WFloat level = WIDE(0.0f);
    if (roulette > 0.0f && count > 0u)
        level = media_roulette_level(&params, roulette, &view, vpl, count);
    // Lights that all sets share have their places shifted from set to set.
    float shift = list.stride == 0u ? (float)set / (float)params.sampling.gather_sets : 0.0f;
    for (uint i = 0u; i < count; ++i, ++vpl) {
        if (!(max_component(xyz(vpl->flux)) > 0.0f)) continue;
        for (uint k = 0u; k < steps; ++k)
            add_place(&params, scene, &through, &view, vpl, i * steps + k,
                      (fraction(vpl->cone.w + shift) + (float)k) / (float)steps, roulette, level,
                      &light);
    }
    float scale = params.sampling.gather_scale / (float)steps;
    if (adds != 0u)
        add_stored_light(&light.sum, scale, slots, slot, radiance);
    else
        store_light(&light.sum, scale, slots, slot, radiance);
    count_rays(counters + range.counter, light.rays);
}
