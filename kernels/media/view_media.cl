// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What media do to the view ray of each pixel: what they leave of light from its end, what they
// emit towards the camera, and which boundaries are around the end. All is known, not estimated.
//
// With FEATURE_AIRLIGHT also where light may be scattered into the ray, as a G-buffer of its own
// whose surfaces are ends of view rays: what is scattered changes little from pixel to pixel
// where they are about as long. Its planes, named as in gbuffer.h:
//   position  begin and end of what scatters, and a measure of length whose differences count
//   normal    along that measure; w: how far it may differ
//   albedo    such that irradiance is radiance; w: 1 where anything scatters
//   shading   as normal, and emission none: the same for every pixel and frame (ViewMedia)
#include "kernels/bsdf/lambert.h"
#include "kernels/core/kernel.h"
#include "kernels/film/camera.h"
#include "kernels/film/gbuffer.h"
#include "kernels/media/medium_walk.h"

// Optical depth from which on nothing is scattered to the camera that could be seen.
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

/// Adds a stretch of a medium.
static inline void add_stretch(const RenderParams* params, const Media* media,
                               const MediumWalk* walk, const MediumRecord* medium,
                               Scattering* found) {
    if (found->depth >= UNSEEN_DEPTH) return;
    float begin = walk->begin;
    float end = walk->end;
    float least = clearest_channel(xyz(medium->sigma_t));
    if (has_grid(params, medium) != 0) {
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
    float3 left;  // of light from beyond
    float3 glow;  // radiance that media have added
} Passed;

/// Goes through a stretch.
static inline void pass_stretch(const RenderParams* params, const Media* media,
                                const MediumWalk* walk, const MediumRecord* medium,
                                Passed* passed) {
    if (!(max_component(passed->left) > 0.0f)) return;
    float3 sigma = xyz(medium->sigma_t);
    float depth = walk->end - walk->begin;
    if (has_grid(params, medium) != 0) {
        DensityGrid grid = grid_of(media, medium);
        depth = depth_on_way(&grid, walk->origin + walk->direction * walk->begin, walk->direction,
                             depth, M_INFINITY);
    }
    if (HAS(params, FEATURE_EMISSIVE_MEDIA))
        passed->glow += passed->left * xyz(medium->emission) *
                        f3(lit_length1(sigma.x, depth), lit_length1(sigma.y, depth),
                           lit_length1(sigma.z, depth));
    passed->left *= transmittance(sigma, depth);
}

WEFT_KERNEL(view_media)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    MEDIA_MAKE(through);
    float3 direction =
        camera_direction(&params, (float)(pixel % params.camera.width) + params.camera.jitter_x,
                         (float)(pixel / params.camera.width) + params.camera.jitter_y);
    int met = gb_ids[2u * pixel] != NO_TRIANGLE ? 1 : 0;
    float length = met != 0 ? gb_position[pixel].w * length3(direction) : RAY_INFINITY;
    MediumWalk walk = start_walk(&through, xyz(params.camera.origin), normalize3(direction),
                                 through.record->around_camera);
    Passed passed = {f3(1.0f, 1.0f, 1.0f), f3(0.0f, 0.0f, 0.0f)};
    Scattering found = {0.0f, 0.0f, 0.0f, 0};
    int meets = may_meet_media(&through, walk.origin, walk.direction, length);
    while (meets != 0 && next_stretch(&params, &through, &walk, length) != 0) {
        if (walk.medium == NO_MEDIUM) continue;
        MediumRecord medium = through.media[walk.medium];
        add_stretch(&params, &through, &walk, &medium, &found);
        pass_stretch(&params, &through, &walk, &medium, &passed);
    }
    view_left[pixel] = f4(passed.left.x, passed.left.y, passed.left.z, 0.0f);
    if (HAS(&params, FEATURE_EMISSIVE_MEDIA))
        view_glow[pixel] = f4(passed.glow.x, passed.glow.y, passed.glow.z, 0.0f);
    view_inside[pixel] = walk.inside;
    if (HAS(&params, FEATURE_AIRLIGHT)) {
        float end = m_min(found.end, VIEW_INFINITY);
        int any = found.any != 0 && end > found.begin ? 1 : 0;
        float slant = met != 0 ? LENGTH_PIXELS * gb_normal[pixel].w / length : 0.0f;
        end_ids[2u * pixel] = any != 0 ? 0u : NO_TRIANGLE;
        end_ids[2u * pixel + 1u] = end_ids[2u * pixel];
        end_position[pixel] =
            any != 0 ? f4(found.begin, end, m_log(end), end) : f4(0.0f, 0.0f, 0.0f, 0.0f);
        end_normal[pixel] = f4(0.0f, 0.0f, 1.0f, LENGTH_SHARE + slant);
        float one = LAMBERT_ALBEDO_OF_ONE;
        end_albedo[pixel] = f4(one, one, one, any != 0 ? 1.0f : 0.0f);
    }
}
