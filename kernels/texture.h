// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Texture look-up: texture coordinate v = 0 is the top edge of the picture's first row.
#ifndef WEFT_TEXTURE_H
#define WEFT_TEXTURE_H

#include "port.h"
#include "types.h"
#include "maths.h"

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
    return f3((float)r, (float)g, (float)b) * (1.0f / 255.0f);
}

/// Linear colour of the texture at (s, t), bilinear or nearest.
static inline float3 sample_texture(TextureRecord texture, GLOBAL const uint* texels,
                                    GLOBAL const float* srgb_table, float s, float t) {
    uint mode_u = (texture.flags >> TEXTURE_WRAP_U_SHIFT) & 3u;
    uint mode_v = (texture.flags >> TEXTURE_WRAP_V_SHIFT) & 3u;
    float x = wrap_coordinate(s, mode_u) * (float)texture.width;
    float y = wrap_coordinate(t, mode_v) * (float)texture.height;
    GLOBAL const uint* first = texels + texture.offset;
    if ((texture.flags & TEXTURE_NEAREST) != 0u) {
        uint column = wrap_texel((int)x, texture.width, 1u);
        uint row = wrap_texel((int)y, texture.height, 1u);
        return decode_texel(first[row * texture.width + column], texture.flags, srgb_table);
    }
    float left = m_floor(x - 0.5f);
    float top = m_floor(y - 0.5f);
    float fx = x - 0.5f - left;
    float fy = y - 0.5f - top;
    uint x0 = wrap_texel((int)left, texture.width, mode_u);
    uint x1 = wrap_texel((int)left + 1, texture.width, mode_u);
    uint y0 = wrap_texel((int)top, texture.height, mode_v) * texture.width;
    uint y1 = wrap_texel((int)top + 1, texture.height, mode_v) * texture.width;
    float3 a = decode_texel(first[y0 + x0], texture.flags, srgb_table);
    float3 b = decode_texel(first[y0 + x1], texture.flags, srgb_table);
    float3 c = decode_texel(first[y1 + x0], texture.flags, srgb_table);
    float3 d = decode_texel(first[y1 + x1], texture.flags, srgb_table);
    return (a * (1.0f - fx) + b * fx) * (1.0f - fy) + (c * (1.0f - fx) + d * fx) * fy;
}

#endif
