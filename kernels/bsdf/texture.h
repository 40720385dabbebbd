// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Texture look-up: texture coordinate v = 0 is the top edge of the image's first row.
#ifndef WEFT_KERNELS_BSDF_TEXTURE_H
#define WEFT_KERNELS_BSDF_TEXTURE_H

#include "kernels/core/maths.h"
#include "kernels/core/port.h"
#include "kernels/core/types.h"

/// Texel coordinate of `x` for a wrap mode (0 repeat, 1 clamp, 2 mirror): in [0, size), or for
/// bilinear neighbours one step outside. Coordinates that are not finite count as 0.
static inline float wrap_coordinate(float x, uint mode) {
    if (!(absolute(x) < 1.0e9f)) return 0.0f;
    if (mode == 1u) return m_clamp(x, 0.0f, 1.0f);
    if (mode == 2u) {
        float half_period = x * 0.5f;
        float folded = 2.0f * (half_period - m_floor(half_period));
        return folded > 1.0f ? 2.0f - folded : folded;
    }
    return x - m_floor(x);
}

static inline uint wrap_texel(int i, uint size, uint mode) {
    int last = (int)size - 1;
    if (mode == 0u) return (uint)(i < 0 ? last : (i > last ? 0 : i));
    return (uint)(i < 0 ? 0 : (i > last ? last : i));
}

static inline float3 decode_texel(uint texel, uint flags, GLOBAL const float* srgb_table) {
    uint r = texel & 255u;
    uint g = (texel >> 8) & 255u;
    uint b = (texel >> 16) & 255u;
    if ((flags & TEXTURE_SRGB) != 0u) return f3(srgb_table[r], srgb_table[g], srgb_table[b]);
    if ((flags & TEXTURE_ALPHA) != 0u) r = g = b = texel >> 24;
    return f3((float)r, (float)g, (float)b) * (1.0f / 255.0f);
}

/// Linear colour of one level, bilinear, at coordinates wrapped to [0, 1].
static inline float3 sample_level(TextureRecord level, GLOBAL const uint* texels,
                                  GLOBAL const float* srgb_table, float u, float v) {
    uint mode_u = (level.flags >> TEXTURE_WRAP_U_SHIFT) & 3u;
    uint mode_v = (level.flags >> TEXTURE_WRAP_V_SHIFT) & 3u;
    GLOBAL const uint* first = texels + level.offset;
    float x = u * (float)level.width - 0.5f;
    float y = v * (float)level.height - 0.5f;
    float left = m_floor(x);
    float top = m_floor(y);
    float fx = x - left;
    float fy = y - top;
    uint x0 = wrap_texel((int)left, level.width, mode_u);
    uint x1 = wrap_texel((int)left + 1, level.width, mode_u);
    uint y0 = wrap_texel((int)top, level.height, mode_v) * level.width;
    uint y1 = wrap_texel((int)top + 1, level.height, mode_v) * level.width;
    float3 a = decode_texel(first[y0 + x0], level.flags, srgb_table);
    float3 b = decode_texel(first[y0 + x1], level.flags, srgb_table);
    float3 c = decode_texel(first[y1 + x0], level.flags, srgb_table);
    float3 d = decode_texel(first[y1 + x1], level.flags, srgb_table);
    return (a * (1.0f - fx) + b * fx) * (1.0f - fy) + (c * (1.0f - fx) + d * fx) * fy;
}

static inline TextureRecord next_level(TextureRecord level) {
    level.offset += level.width * level.height;
    level.width = level.width > 1u ? level.width / 2u : 1u;
    level.height = level.height > 1u ? level.height / 2u : 1u;
    return level;
}

/// Linear colour of the texture at (s, t): nearest texel, or bilinear within the two mip levels
/// whose texels are nearest in size to a footprint of `width` texels of level 0.
static inline float3 sample_texture(TextureRecord texture, GLOBAL const uint* texels,
                                    GLOBAL const float* srgb_table, float s, float t, float width) {
    float u = wrap_coordinate(s, (texture.flags >> TEXTURE_WRAP_U_SHIFT) & 3u);
    float v = wrap_coordinate(t, (texture.flags >> TEXTURE_WRAP_V_SHIFT) & 3u);
    if ((texture.flags & TEXTURE_NEAREST) != 0u) {
        uint column = wrap_texel((int)(u * (float)texture.width), texture.width, 1u);
        uint row = wrap_texel((int)(v * (float)texture.height), texture.height, 1u);
        return decode_texel(texels[texture.offset + row * texture.width + column], texture.flags,
                            srgb_table);
    }
    while (width >= 2.0f && (texture.width > 1u || texture.height > 1u)) {
        texture = next_level(texture);
        width *= 0.5f;
    }
    float3 fine = sample_level(texture, texels, srgb_table, u, v);
    if (!(width > 1.0f) || (texture.width == 1u && texture.height == 1u)) return fine;
    float coarse_share = m_min(width - 1.0f, 1.0f);
    float3 coarse = sample_level(next_level(texture), texels, srgb_table, u, v);
    return fine * (1.0f - coarse_share) + coarse * coarse_share;
}

#endif
