// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Walks the view ray of each pixel through media: computes its transmittance, what media emit along
// it towards the camera, and which boundaries enclose its end. All of it is exact, in grids as
// well. One work-item per pixel.
//
// With FEATURE_AIRLIGHT it also stores where light may be scattered into the ray, as a G-buffer of
// its own whose "surfaces" are ends of view rays: what is scattered changes little from pixel to
// pixel where these are about as long. Its planes, named as in gbuffer.h:
//   position  begin and end of what scatters, and a measure of length whose differences count
//   normal    along that measure; w: how far it may differ
//   albedo    such that irradiance is radiance; w: 1 where anything scatters
//   shading   as normal, and emission none: the same for every pixel and frame (ViewMedia)
#include "kernels/bsdf/lambert.h"
#include "kernels/core/kernel.h"
#include "kernels/film/camera.h"
#include "kernels/film/gbuffer.h"
#include "kernels/media/medium_walk.h"

// Optical depth beyond which light that is scattered to the camera is too faint to be visible.
#define UNSEEN_DEPTH 14.0f
// Length of a ray without end, kernel units: far beyond any scene, and its square is a float.
#define VIEW_INFINITY 1e9f
// Share of their length by which neighbouring rays may differ, times FilterParams::planes, beside
// what a surface seen at an angle makes of it over some pixels.
#define LENGTH_SHARE 0.05f
#define LENGTH_PIXELS 8.0f

// What scatters on a view ray.
typedef struct {
    float begin, end;
    float depth;  // optical, of the clearest channel that is not clear, up to `end`
    int any;
} Scattering;

/// Extends the range that scatters by a segment of a medium.
static inline void add_segment(const RenderParams* params, const Media* media,
                               const MediumWalk* walk, const MediumRecord* medium,
                               Scattering* found) {
    if (found->depth >= UNSEEN_DEPTH) return;
    float begin = walk->begin;
    float end = walk->end;
    float least = clearest_channel(xyz(medium->sigma_t));
    if (has_grid(params, media, medium) != 0) {
        DensityGrid grid = grid_of(media, medium);
        CubeRay ray = ray_in_cube(&grid, walk->origin, walk->direction);
        GridRay inside;
        if (enter_grid(&grid, ray.origin, ray.direction, begin, end, &inside) == 0) return;
        begin = inside.first;
        end = begin + inside.length;
    } else if (least > 0.0f) {
        float room = (UNSEEN_DEPTH - found->depth) / least;
        found->depth += (end - begin) * least;
        if (!(end - begin < room)) end = begin + room;
    }
    if (!(max_component(xyz(medium->sigma_t) * xyz(medium->albedo)) > 0.0f)) return;
    if (found->any == 0) found->begin = begin;
    found->any = 1;
    found->end = end;
}

/// What a view ray has gone through so far.
typedef struct {
    float3 transmittance;  // of light from beyond
    float3 emission;       // radiance that media have added
} Passed;

/// Adds the emission of a segment, and multiplies in its transmittance.
static inline void pass_segment(const RenderParams* params, const Media* media,
                                const MediumWalk* walk, const MediumRecord* medium,
                                Passed* passed) {
    if (!(max_component(passed->transmittance) > 0.0f)) return;
    float3 sigma = xyz(medium->sigma_t);
    float depth = walk->end - walk->begin;
    if (has_grid(params, media, medium) != 0) {
        DensityGrid grid = grid_of(media, medium);
        depth = depth_on_way(&grid, walk->origin + walk->direction * walk->begin, walk->direction,
                             depth, M_INFINITY);
    }
    if (HAS(params, FEATURE_EMISSIVE_MEDIA))
        passed->emission += passed->transmittance * xyz(medium->emission) *
                            f3(lit_length1(sigma.x, depth), lit_length1(sigma.y, depth),
                               lit_length1(sigma.z, depth));
    passed->transmittance *= beer_transmittance(sigma, depth);
}

WEFT_KERNEL(view_media)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    MEDIA_MAKE(through);
    float x = (float)(pixel % params.camera.width) + params.camera.jitter_x;
    float y = (float)(pixel / params.camera.width) + params.camera.jitter_y;
    float3 direction = camera_direction(&params, x, y);
    int met = gb_ids[2u * pixel] != INVALID_INDEX ? 1 : 0;
    float length = met != 0 ? gb_position[pixel].w * length3(direction) : RAY_INFINITY;
    MediumWalk walk = start_walk(&through, camera_origin(&params, x, y), normalize3(direction),
                                 through.record->around_camera);
    Passed passed = {f3(1.0f, 1.0f, 1.0f), f3(0.0f, 0.0f, 0.0f)};
    Scattering found = {0.0f, 0.0f, 0.0f, 0};
    int meets = may_meet_media(&through, walk.origin, walk.direction, length);
    while (meets != 0 && next_segment(&params, &through, &walk, length) != 0) {
        if (walk.medium == NO_MEDIUM) continue;
        MediumRecord medium = through.media[walk.medium];
        add_segment(&params, &through, &walk, &medium, &found);
        pass_segment(&params, &through, &walk, &medium, &passed);
    }
    view_transmittance[pixel] =
        f4(passed.transmittance.x, passed.transmittance.y, passed.transmittance.z, 0.0f);
    if (HAS(&params, FEATURE_EMISSIVE_MEDIA))
        view_emission[pixel] = f4(passed.emission.x, passed.emission.y, passed.emission.z, 0.0f);
    view_enclosing_media[pixel] = walk.enclosing_media;
    if (HAS(&params, FEATURE_AIRLIGHT)) {
        float end = m_min(found.end, VIEW_INFINITY);
        int any = found.any != 0 && end > found.begin ? 1 : 0;
        float slant = met != 0 ? LENGTH_PIXELS * gb_normal[pixel].w / length : 0.0f;
        end_ids[2u * pixel] = any != 0 ? 0u : INVALID_INDEX;
        end_ids[2u * pixel + 1u] = end_ids[2u * pixel];
        end_position[pixel] =
            any != 0 ? f4(found.begin, end, m_log(end), end) : f4(0.0f, 0.0f, 0.0f, 0.0f);
        end_normal[pixel] = f4(0.0f, 0.0f, 1.0f, LENGTH_SHARE + slant);
        float one = LAMBERT_ALBEDO_OF_ONE;
        end_albedo[pixel] = f4(one, one, one, any != 0 ? 1.0f : 0.0f);
    }
}
