// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Textures of a surface's parameters (SurfaceMap). Which of its parameters have one is a mask in
// its record, and those that it has follow one another in the list of all maps.
#ifndef WEFT_KERNELS_BSDF_SURFACE_MAPS_H
#define WEFT_KERNELS_BSDF_SURFACE_MAPS_H

#include "kernels/bsdf/triangle_texture.h"

#define SURFACES_MAKE(name)                 \
    SurfaceTables name;                     \
    name.records = surface_records;         \
    name.maps = surface_maps;               \
    name.coordinates = surface_coordinates; \
    name.of_instances = surface_instances;  \
    name.tangents = tangents;               \
    name.interfaces = interfaces;           \
    name.tables = surface_values

// What materials with more than Lambert's lobe are made of.
typedef struct {
    GLOBAL const SurfaceRecord* records;  // by material
    GLOBAL const SurfaceMap* maps;
    GLOBAL const float* coordinates;  // 2 a vertex, one set of a mesh after the other
    GLOBAL const uint* of_instances;  // SURFACE_INSTANCE_WORDS each
    GLOBAL const float4* tangents;    // by vertex; w: the sign of the bitangent, 0 without tangent
    GLOBAL const InterfaceRecord* interfaces;
    GLOBAL const float* tables;  // of albedos, where records say
} SurfaceTables;

// A point of a triangle, as hits have it.
typedef struct {
    Triangle triangle;
    float u, v;
    float footprint;  // see texture_at
} SurfacePoint;

/// The colour of the map for a parameter, MAP_*, which the record has.
static inline float3 map_colour(const Geometry* geometry, const SurfaceTables* tables,
                                GLOBAL const SurfaceRecord* record, uint parameter,
                                const SurfacePoint* at) {
    uint before = (uint)bit_count(record->maps & (parameter - 1u));
    SurfaceMap map = tables->maps[record->first_map + before];
    TextureRecord texture = geometry->textures[map.texture];
    if (map.channel == CHANNEL_ALPHA)
        texture.flags = (texture.flags & ~TEXTURE_SRGB) | TEXTURE_ALPHA;
    uint shift = tables->of_instances[at->triangle.instance * SURFACE_INSTANCE_WORDS + map.uv_set];
    GLOBAL const float* uv = tables->coordinates;
    uint a = 2u * (at->triangle.v0 + shift);
    uint b = 2u * (at->triangle.v1 + shift);
    uint c = 2u * (at->triangle.v2 + shift);
    float s1 = uv[b] - uv[a];
    float t1 = uv[b + 1u] - uv[a + 1u];
    float s2 = uv[c] - uv[a];
    float t2 = uv[c + 1u] - uv[a + 1u];
    float s = uv[a] + s1 * at->u + s2 * at->v;
    float t = uv[a + 1u] + t1 * at->u + t2 * at->v;
    float scale = map.to_s.x * map.to_t.y - map.to_s.y * map.to_t.x;
    float texels =
        absolute((s1 * t2 - s2 * t1) * scale) * (float)texture.width * (float)texture.height;
    return sample_texture(texture, geometry->texels, geometry->srgb_table,
                          map.to_s.x * s + map.to_s.y * t + map.to_s.z,
                          map.to_t.x * s + map.to_t.y * t + map.to_t.z,
                          at->footprint * square_root(texels));
}

/// The alpha of vertices at a point; 1 where the mesh has none.
static inline float vertex_alpha(const SurfaceTables* tables, const SurfacePoint* at) {
    uint shift =
        tables->of_instances[at->triangle.instance * SURFACE_INSTANCE_WORDS + SURFACE_VERTEX_ALPHA];
    if (shift == INVALID_INDEX) return 1.0f;
    GLOBAL const float* alphas = tables->coordinates;
    return alphas[2u * (at->triangle.v0 + shift)] * (1.0f - at->u - at->v) +
           alphas[2u * (at->triangle.v1 + shift)] * at->u +
           alphas[2u * (at->triangle.v2 + shift)] * at->v;
}

/// A colour times its map, if it has one.
static inline float3 mapped_colour(const Geometry* geometry, const SurfaceTables* tables,
                                   GLOBAL const SurfaceRecord* record, uint parameter,
                                   const SurfacePoint* at, float3 factor) {
    if ((record->maps & parameter) == 0u) return factor;
    return factor * map_colour(geometry, tables, record, parameter, at);
}

/// A number times the channel of its map, if it has one.
static inline float mapped_number(const Geometry* geometry, const SurfaceTables* tables,
                                  GLOBAL const SurfaceRecord* record, uint parameter,
                                  const SurfacePoint* at, float factor) {
    if ((record->maps & parameter) == 0u) return factor;
    uint before = (uint)bit_count(record->maps & (parameter - 1u));
    uint channel = tables->maps[record->first_map + before].channel;
    float3 colour = map_colour(geometry, tables, record, parameter, at);
    switch (channel) {
        case CHANNEL_GREEN:
            return factor * colour.y;
        case CHANNEL_BLUE:
            return factor * colour.z;
        case CHANNEL_LUMINANCE:
            return factor * luminance(colour);
        case CHANNEL_RED:
        default:
            return factor * colour.x;
    }
}

#endif
