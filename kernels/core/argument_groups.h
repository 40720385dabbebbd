// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Buffers that many kernels take together: GROUP_<name>(X) is a list of X(mode, kind, name); see
// signatures.h.
#ifndef WEFT_KERNELS_CORE_ARGUMENT_GROUPS_H
#define WEFT_KERNELS_CORE_ARGUMENT_GROUPS_H

// clang-format off

#define GROUP_Geometry(X)                              \
    X(READS, VertexPositions, positions)               \
    X(READS, Triangles, triangle_list)                 \
    X(READS, Instances, instances)                     \
    X(READS, Materials, materials)                     \
    X(READS, VertexNormals, normals)                   \
    X(READS, TextureCoordinates, texture_coordinates)  \
    X(READS, VertexColours, vertex_colours)            \
    X(READS, Textures, textures)                       \
    X(READS, Texels, texels)                           \
    X(READS, SrgbTable, srgb_table)

#define GROUP_LightTable(X)                            \
    X(READS, Lights, lights)                           \
    X(READS, EmissiveTriangles, emissive)

// Of FEATURE_IMAGE_ENVIRONMENT.
#define GROUP_EnvironmentImage(X)                      \
    X(MAY_READ, EnvironmentRecords, environment_record)\
    X(MAY_READ, EnvironmentTexels, environment_texels) \
    X(MAY_READ, EnvironmentSums, environment_sums)

#define GROUP_SurfaceTables(X)                         \
    X(READS, SurfaceRecords, surface_records)          \
    X(MAY_READ, SurfaceMaps, surface_maps)             \
    X(MAY_READ, SurfaceCoordinates, surface_coordinates) \
    X(READS, SurfaceInstances, surface_instances)      \
    X(MAY_READ, Tangents, tangents)                    \
    X(MAY_READ, Interfaces, interfaces)                \
    X(MAY_READ, SurfaceValues, surface_values)

#define GROUP_AreaLights(X)                            \
    X(READS, Lights, lights)                           \
    X(READS, EmissiveTriangles, emissive)              \
    X(READS, VertexPositions, positions)               \
    X(READS, Triangles, triangle_list)

#define GROUP_MediaTables(X)                           \
    X(MAY_READ, BoundaryNodes, boundary_nodes)         \
    X(MAY_READ, BoundaryLeaves, boundary_leaves)       \
    X(MAY_READ, BoundaryNormals, boundary_normals)     \
    X(MAY_READ, Mediums, media)                        \
    X(MAY_READ, MediaSpace, media_record)              \
    X(MAY_READ, DensityGrids, grids)                   \
    X(MAY_READ, Densities, densities)                  \
    X(MAY_READ, DensityBounds, density_bounds)

#define GROUP_SeenSurfaces(X)                          \
    X(READS, SurfaceIds, gb_ids)                       \
    X(READS, SurfacePositions, gb_position)            \
    X(READS, SurfaceNormals, gb_normal)                \
    X(READS, SurfaceShadingNormals, gb_shading)        \
    X(READS, SurfaceAlbedo, gb_albedo)                 \
    X(READS, SurfaceEmission, gb_emission)

// Light as the components leave it; what a frame does not have is never read.
#define GROUP_ComposedLight(X)                         \
    X(READS, PixelSlots, pixel_slot)                   \
    X(MAY_READ, ReconstructedLight, direct)            \
    X(MAY_READ, SlotLight, exact_irradiance)           \
    X(MAY_READ, ReconstructedLight, indirect)          \
    X(MAY_READ, Transmittances, view_transmittance)    \
    X(MAY_READ, MediaEmission, view_emission)          \
    X(MAY_READ, ReconstructedLight, media_light)       \
    X(MAY_READ, ReconstructedLight, reflection_light)  \
    X(MAY_READ, ReconstructedLight, refraction_light)  \
    X(MAY_READ, ReconstructedLight, glossy_light)

// clang-format on

#endif
