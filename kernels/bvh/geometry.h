// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The scene's triangles and what belongs to them, as kernels get them.
#ifndef WEFT_KERNELS_BVH_GEOMETRY_H
#define WEFT_KERNELS_BVH_GEOMETRY_H

#include "kernels/bvh/triangle.h"

#define GEOMETRY_MAKE(name)                         \
    Geometry name;                                  \
    name.positions = positions;                     \
    name.triangles = triangle_list;                 \
    name.instances = instances;                     \
    name.materials = materials;                     \
    name.normals = normals;                         \
    name.texture_coordinates = texture_coordinates; \
    name.vertex_colours = vertex_colours;           \
    name.textures = textures;                       \
    name.texels = texels;                           \
    name.srgb_table = srgb_table

// The scene's buffers. Attributes a scene does not have are never read.
typedef struct {
    GLOBAL const float4* positions;
    GLOBAL const Triangle* triangles;
    GLOBAL const InstanceRecord* instances;
    GLOBAL const MaterialRecord* materials;
    GLOBAL const float* normals;              // 3 a vertex
    GLOBAL const float* texture_coordinates;  // 2 a vertex; then those for emission that differ
    GLOBAL const float* vertex_colours;       // 3 a vertex
    GLOBAL const TextureRecord* textures;
    GLOBAL const uint* texels;
    GLOBAL const float* srgb_table;
} Geometry;

#endif
