// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Textures at points of triangles, which barycentric coordinates u and v give as hits have them.
#ifndef WEFT_KERNELS_BSDF_TRIANGLE_TEXTURE_H
#define WEFT_KERNELS_BSDF_TRIANGLE_TEXTURE_H

#include "kernels/bsdf/texture.h"
#include "kernels/bvh/geometry.h"

/// Colour of a texture at a point of a triangle. `footprint` is the square root of the share of the
/// triangle's doubled area that is to be averaged; 0 asks for full detail.
static inline float3 texture_at(const Geometry* geometry, uint texture, Triangle triangle, float u,
                                float v, float footprint) {
    TextureRecord record = geometry->textures[texture];
    GLOBAL const float* uv = geometry->texture_coordinates;
    float s0 = uv[2u * triangle.v0];
    float t0 = uv[2u * triangle.v0 + 1u];
    float s1 = uv[2u * triangle.v1] - s0;
    float t1 = uv[2u * triangle.v1 + 1u] - t0;
    float s2 = uv[2u * triangle.v2] - s0;
    float t2 = uv[2u * triangle.v2 + 1u] - t0;
    float texels = absolute(s1 * t2 - s2 * t1) * (float)record.width * (float)record.height;
    return sample_texture(record, geometry->texels, geometry->srgb_table, s0 + s1 * u + s2 * v,
                          t0 + t1 * u + t2 * v, footprint * square_root(texels));
}

/// The same by the texture coordinates that the triangle's instance has for emission.
static inline float3 emission_texture_at(const Geometry* geometry, uint texture, Triangle triangle,
                                         float u, float v, float footprint) {
    uint shift = geometry->instances[triangle.instance].emission_uv;
    triangle.v0 += shift;
    triangle.v1 += shift;
    triangle.v2 += shift;
    return texture_at(geometry, texture, triangle, u, v, footprint);
}

#endif
