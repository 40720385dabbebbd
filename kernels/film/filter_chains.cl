// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Averages what pixels show in mirrors that are not smooth, or through such glass: of the pixels of
// a square each has seen another facet (view_chains.cl). The square is as wide as a lobe allows: up
// to GLOSSY_PATTERN pixels, but no wider than what they show turns by a share of the lobe. Each
// pixel counts by what it shows over the share of its own surface, so that textures stay sharp.
// Other pixels keep what they show. One work-item per pixel.
#include "kernels/core/kernel.h"
#include "kernels/film/discontinuity.h"

// Share of a lobe's width, alpha, by which mirrored directions may differ over the square.
#define LOBE_SHARE 1.0f

/// `radiance` over the share of the surface, by channel; 0 where that is 0.
static inline float3 without_share(float3 radiance, float3 share) {
    return f3(share.x > 0.0f ? radiance.x / share.x : 0.0f,
              share.y > 0.0f ? radiance.y / share.y : 0.0f,
              share.z > 0.0f ? radiance.z / share.z : 0.0f);
}

/// Pixels on each side of the one in the middle, for facets of that alpha.
static inline int square_radius(const RenderParams* params, float alpha) {
    // Neighbouring pixels of a flat mirror see directions that differ by a pixel's angle.
    float angle = HAS(params, FEATURE_ORTHOGRAPHIC) ? 0.0f : params->camera.pixel_angle;
    float most = (float)(GLOSSY_PATTERN / 2u);
    return (int)m_clamp(LOBE_SHARE * alpha / m_max(angle, 1e-6f), 1.0f, most);
}

WEFT_KERNEL(filter_chains)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint pixel = range.first + WORK_ITEM(range);
    float4 own = view_shares[pixel];
    if (!(own.w > 0.0f)) {
        shown[pixel] = radiance[pixel];
        return;
    }
    int radius = square_radius(&params, own.w);
    int width = (int)params.camera.width;
    int height = (int)params.camera.height;
    int column = (int)(pixel % params.camera.width);
    int row = (int)(pixel / params.camera.width);
    PixelSurface surface = pixel_surface(&params, gb_position, gb_normal, gb_shading, pixel, 1.0f);
    // Mirrored directions turn twice as far as normals: 1 - cos(a) is a^2 / 2.
    float turn = 0.5f * LOBE_SHARE * own.w;
    surface.cosine = 1.0f - m_max(0.5f * turn * turn, 1e-6f);
    uint instance = gb_ids[2u * pixel];
    float3 sum = f3(0.0f, 0.0f, 0.0f);
    float weight = 0.0f;
    for (int y = row - radius; y <= row + radius; ++y) {
        for (int x = column - radius; x <= column + radius; ++x) {
            if (x < 0 || y < 0 || x >= width || y >= height) continue;
            uint other = (uint)y * params.camera.width + (uint)x;
            if (other != pixel) {
                if (gb_ids[2u * other] != instance || !(view_shares[other].w > 0.0f)) continue;
                // Next to each other all count whose surface is the same.
                float cosine = surface.cosine;
                if (x >= column - 1 && x <= column + 1 && y >= row - 1 && y <= row + 1)
                    surface.cosine = m_min(cosine, params.filter.cosine);
                int same = on_surface(&surface, gb_position, gb_shading, other);
                surface.cosine = cosine;
                if (same == 0) continue;
            }
            sum += without_share(xyz(radiance[other]), xyz(view_shares[other]));
            weight += 1.0f;
        }
    }
    float3 mean = sum * xyz(own) * (1.0f / weight);
    shown[pixel] = f4(mean.x, mean.y, mean.z, 1.0f);
}
