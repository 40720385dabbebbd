// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The arguments of every kernel, declared once: ARGUMENTS_<kernel>(X) is a list of
// X(mode, kind, name). From it come the kernel's definition (WEFT_KERNEL of kernel.h), the typed
// struct that the host fills in (host/device/launch.h) and the checks of both backends. Modes:
//
//   READS, WRITES          a buffer of a kind of buffers.def; WRITES may read as well
//   MAY_READ, MAY_WRITE    the same, which a launch without some feature leaves unused
//   VALUE                  a struct of types.h, or a scalar
//   GROUP                  the buffers of GROUP_<kind>, which many kernels share
//   TRACES                 the scene in which the kernel traces rays
//
// Every kernel also has `params`, what all kernels of a sample share, and `range`, its work-items.
// All arguments of a kernel together fit 1024 bytes, which any OpenCL device offers.
#ifndef WEFT_KERNELS_CORE_SIGNATURES_H
#define WEFT_KERNELS_CORE_SIGNATURES_H

#include "kernels/core/argument_groups.h"

// clang-format off

#define ARGUMENTS_gbuffer(X)                           \
    X(TRACES, Scene, scene)                            \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, EnvironmentImage, environment)            \
    X(WRITES, SurfaceIds, gb_ids)                      \
    X(WRITES, SurfacePositions, gb_position)           \
    X(WRITES, SurfaceNormals, gb_normal)               \
    X(WRITES, SurfaceShadingNormals, gb_shading)       \
    X(WRITES, SurfaceAlbedo, gb_albedo)                \
    X(WRITES, SurfaceEmission, gb_emission)

#define ARGUMENTS_gbuffer_surfaces(X)                  \
    X(TRACES, Scene, scene)                            \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, SurfaceTables, surfaces)                  \
    X(GROUP, EnvironmentImage, environment)            \
    X(WRITES, SurfaceIds, gb_ids)                      \
    X(WRITES, SurfacePositions, gb_position)           \
    X(WRITES, SurfaceNormals, gb_normal)               \
    X(WRITES, SurfaceShadingNormals, gb_shading)       \
    X(WRITES, SurfaceAlbedo, gb_albedo)                \
    X(WRITES, SurfaceEmission, gb_emission)

#define ARGUMENTS_view_chains(X)                       \
    X(TRACES, Scene, scene)                            \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, SurfaceTables, surfaces)                  \
    X(GROUP, LightTable, light_table)                  \
    X(MAY_READ, LightNodes, light_nodes)               \
    X(GROUP, EnvironmentImage, environment)            \
    X(VALUE, uint, way_number)                         \
    X(VALUE, uint, samples_lights)                     \
    X(VALUE, uint, keeps_shares)                       \
    X(READS, SurfaceIds, gb_ids)                       \
    X(READS, SurfacePositions, gb_position)            \
    X(WRITES, SurfaceIds, end_ids)                     \
    X(WRITES, SurfacePositions, end_position)          \
    X(WRITES, SurfaceNormals, end_normal)              \
    X(WRITES, SurfaceShadingNormals, end_shading)      \
    X(WRITES, SurfaceAlbedo, end_albedo)               \
    X(WRITES, SurfaceEmission, end_emission)           \
    X(MAY_WRITE, ViewShares, view_shares)              \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_view_media(X)                        \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(GROUP, MediaTables, media_tables)                \
    X(WRITES, Transmittances, view_transmittance)      \
    X(MAY_WRITE, MediaEmission, view_emission)         \
    X(WRITES, EnclosingMedia, view_enclosing_media)    \
    X(MAY_WRITE, SurfaceIds, end_ids)                  \
    X(MAY_WRITE, SurfacePositions, end_position)       \
    X(MAY_WRITE, SurfaceNormals, end_normal)           \
    X(MAY_WRITE, SurfaceAlbedo, end_albedo)

#define ARGUMENTS_receivers(X)                         \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(VALUE, uint, slots)                              \
    X(READS, SlotPixels, slot_pixel)                   \
    X(MAY_READ, EnclosingMedia, view_enclosing_media)  \
    X(WRITES, ReceiverPlanes, receiver_planes)         \
    X(WRITES, PixelSlots, pixel_slot)

#define ARGUMENTS_light_samples(X)                     \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, LightTable, light_table)                  \
    X(GROUP, EnvironmentImage, environment)            \
    X(VALUE, LightSampling, light_sampling)            \
    X(WRITES, VirtualLights, samples)

#define ARGUMENTS_vpl_walk(X)                          \
    X(TRACES, Scene, scene)                            \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, LightTable, light_table)                  \
    X(GROUP, EnvironmentImage, environment)            \
    X(GROUP, MediaTables, media_tables)                \
    X(MAY_READ, PathsKnown, known_segments)            \
    X(MAY_WRITE, PathCache, light_path_cache)          \
    X(MAY_WRITE, VplChanges, vpl_changes)              \
    X(WRITES, VirtualLights, vpls)                     \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_vpl_invalidation(X)                  \
    X(TRACES, Scene, scene)                            \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, LightTable, light_table)                  \
    X(GROUP, EnvironmentImage, environment)            \
    X(GROUP, MediaTables, media_tables)                \
    X(READS, PathCache, light_path_cache)              \
    X(WRITES, PathsKnown, known_segments)              \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_vpl_tail(X)                          \
    X(WRITES, VirtualLights, vpls)

#define ARGUMENTS_vpl_contribution(X)                  \
    X(TRACES, Scene, scene)                            \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(VALUE, uint, points)                             \
    X(VALUE, float, scale)                             \
    X(READS, SlotPixels, view_points)                  \
    X(READS, VirtualLights, vpls)                      \
    X(WRITES, VplContributions, contributions)         \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_vpl_bounds(X)                        \
    X(VALUE, uint, vpl_count)                          \
    X(VALUE, float, scale)                             \
    X(WRITES, VirtualLights, vpls)

#define ARGUMENTS_vpl_roulette(X)                      \
    X(VALUE, SetList, list)                            \
    X(VALUE, float, roulette)                          \
    X(VALUE, float, scale)                             \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, BlockSets, block_set)                     \
    X(READS, VirtualLights, vpls)                      \
    X(WRITES, VplSurvival, survival)

#define ARGUMENTS_vpl_gather(X)                        \
    X(TRACES, Scene, scene)                            \
    X(GROUP, MediaTables, media_tables)                \
    X(VALUE, SetList, list)                            \
    X(VALUE, uint, by_chance)                          \
    X(VALUE, uint, adds)                               \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, BlockSets, block_set)                     \
    X(READS, VirtualLights, vpls)                      \
    X(MAY_READ, VplSurvival, survival)                 \
    X(WRITES, SlotLight, irradiance)                   \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_vpl_shortlist(X)                     \
    X(VALUE, uint, vpl_count)                          \
    X(VALUE, uint, region_slots)                       \
    X(VALUE, uint, list_length)                        \
    X(VALUE, float, scale)                             \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, VirtualLights, vpls)                      \
    X(WRITES, VirtualLights, shortlists)

#define ARGUMENTS_vpl_choice(X)                        \
    X(TRACES, Scene, scene)                            \
    X(VALUE, uint, region_slots)                       \
    X(VALUE, uint, list_length)                        \
    X(VALUE, uint, choices)                            \
    X(VALUE, float, scale)                             \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, VirtualLights, shortlists)                \
    X(WRITES, SlotLight, irradiance)                   \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_area_lights(X)                       \
    X(TRACES, Scene, scene)                            \
    X(GROUP, MediaTables, media_tables)                \
    X(GROUP, AreaLights, area_lights)                  \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, BlockSets, block_set)                     \
    X(READS, VirtualLights, samples)                   \
    X(WRITES, SlotLight, irradiance)                   \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_distant_light(X)                     \
    X(TRACES, Scene, scene)                            \
    X(GROUP, MediaTables, media_tables)                \
    X(VALUE, SetList, list)                            \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, BlockSets, block_set)                     \
    X(READS, Lights, lights)                           \
    X(MAY_READ, EnvironmentRecords, environment_record)\
    X(MAY_READ, EnvironmentIrradiance, environment_irradiance) \
    X(MAY_READ, VirtualLights, samples)                \
    X(MAY_WRITE, SlotLight, sampled_irradiance)        \
    X(MAY_WRITE, SlotLight, exact_irradiance)          \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_media_gather(X)                      \
    X(TRACES, Scene, scene)                            \
    X(GROUP, MediaTables, media_tables)                \
    X(VALUE, SetList, list)                            \
    X(VALUE, float, roulette)                          \
    X(VALUE, uint, steps)                              \
    X(VALUE, uint, adds)                               \
    X(VALUE, uint, slots)                              \
    X(READS, SurfacePositions, end_position)           \
    X(READS, SurfaceAlbedo, end_albedo)                \
    X(READS, SlotPixels, slot_pixel)                   \
    X(READS, BlockSets, block_set)                     \
    X(MAY_READ, VirtualLights, vpls)                   \
    X(WRITES, SlotLight, radiance)                     \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_media_distant(X)                     \
    X(TRACES, Scene, scene)                            \
    X(GROUP, MediaTables, media_tables)                \
    X(GROUP, EnvironmentImage, environment)            \
    X(VALUE, uint, steps)                              \
    X(VALUE, uint, slots)                              \
    X(READS, Lights, lights)                           \
    X(READS, SurfacePositions, end_position)           \
    X(READS, SurfaceAlbedo, end_albedo)                \
    X(READS, SlotPixels, slot_pixel)                   \
    X(READS, BlockSets, block_set)                     \
    X(WRITES, SlotLight, radiance)                     \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_reconstruct(X)                       \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(VALUE, uint, slots)                              \
    X(READS, PixelSlots, pixel_slot)                   \
    X(READS, SlotLight, irradiance)                    \
    X(WRITES, ReconstructedLight, filtered)

#define ARGUMENTS_tile_geometry(X)                     \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(WRITES, Tiles, tiles)

#define ARGUMENTS_shadow_probes(X)                     \
    X(TRACES, Scene, scene)                            \
    X(GROUP, MediaTables, media_tables)                \
    X(GROUP, AreaLights, area_lights)                  \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, BlockSets, block_set)                     \
    X(READS, SlotPixels, slot_pixel)                   \
    X(READS, VirtualLights, samples)                   \
    X(WRITES, SlotLight, irradiance)                   \
    X(WRITES, PixelShadows, pixel_shadows)             \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_shadow_edges(X)                      \
    X(READS, PixelShadows, pixel_shadows)              \
    X(WRITES, ShadowEdges, shadow_edges)

#define ARGUMENTS_soft_shadows(X)                      \
    X(TRACES, Scene, scene)                            \
    X(GROUP, MediaTables, media_tables)                \
    X(GROUP, AreaLights, area_lights)                  \
    X(VALUE, float, shadow_step)                       \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, PixelSlots, pixel_slot)                   \
    X(READS, VirtualLights, samples)                   \
    X(READS, PixelShadows, pixel_shadows)              \
    X(READS, ShadowEdges, shadow_edges)                \
    X(READS, BrightnessSlopes, slopes)                 \
    X(READS, SurfaceAlbedo, gb_albedo)                 \
    X(WRITES, SlotLight, irradiance)                   \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_cache_records(X)                     \
    X(TRACES, Scene, scene)                            \
    X(GROUP, MediaTables, media_tables)                \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(VALUE, RecordUpdate, update)                     \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, SlotPixels, slot_pixel)                   \
    X(READS, VirtualLights, vpls)                      \
    X(MAY_READ, MovedBounds, moved_boxes)              \
    X(READS, PacketStates, states)                     \
    X(READS, InvalidConnections, invalid)              \
    X(WRITES, VisibleConnections, seen)                \
    X(WRITES, RecordPlanes, records)                   \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_record_invalidation(X)               \
    X(TRACES, Scene, scene)                            \
    X(VALUE, RecordUpdate, update)                     \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, RecordPlanes, records)                    \
    X(READS, VirtualLights, vpls)                      \
    X(READS, VplChanges, vpl_changes)                  \
    X(READS, MovedBounds, moved_boxes)                 \
    X(WRITES, InvalidConnections, invalid)             \
    X(WRITES, PacketStates, states)                    \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_cache_tiles(X)                       \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(WRITES, TileBounds, tile_boxes)                  \
    X(WRITES, ReconstructedLight, filtered)            \
    X(WRITES, MissingPixels, missing)

#define ARGUMENTS_cache_lookup(X)                      \
    X(TRACES, Scene, scene)                            \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(VALUE, uint, record_count)                       \
    X(READS, TileBounds, tile_boxes)                   \
    X(READS, Records, records)                         \
    X(READS, RecordBounds, boxes)                      \
    X(WRITES, RecordsUsed, used)                       \
    X(WRITES, ReconstructedLight, filtered)            \
    X(WRITES, MissingPixels, missing)                  \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_hemisphere_rays(X)                   \
    X(TRACES, Scene, scene)                            \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, LightTable, light_table)                  \
    X(MAY_READ, LightNodes, light_nodes)               \
    X(GROUP, EnvironmentImage, environment)            \
    X(VALUE, HemisphereGrid, grid)                     \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, SlotPixels, slot_pixel)                   \
    X(WRITES, HemisphereCells, cells)                  \
    X(WRITES, RayCounters, counters)                   \
    X(WRITES, NonfiniteCounters, nonfinite)

#define ARGUMENTS_hemisphere_records(X)                \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(VALUE, HemisphereGrid, grid)                     \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, SlotPixels, slot_pixel)                   \
    X(READS, HemisphereCells, cells)                   \
    X(WRITES, RecordPlanes, records)

#define ARGUMENTS_lattice_signal(X)                    \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(VALUE, uint, lattice_stride)                     \
    X(VALUE, uint, slots)                              \
    X(READS, PixelSlots, pixel_slot)                   \
    X(READS, SlotLight, irradiance)                    \
    X(VALUE, uint, beneath_slots)                      \
    X(MAY_READ, SurfaceAlbedo, beneath_albedo)         \
    X(MAY_READ, SurfaceEmission, beneath_emission)     \
    X(MAY_READ, PixelSlots, beneath_pixel_slot)        \
    X(MAY_READ, SlotLight, beneath_irradiance)         \
    X(WRITES, LatticeSignals, signal)

#define ARGUMENTS_reconstruct_tiles(X)                 \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(VALUE, uint, slots)                              \
    X(READS, Tiles, tiles)                             \
    X(READS, TileLevels, tile_height)                  \
    X(READS, PixelSlots, pixel_slot)                   \
    X(READS, SlotLight, irradiance)                    \
    X(WRITES, ReconstructedLight, filtered)

#define ARGUMENTS_edge_masks(X)                        \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(READS, Instances, instances)                     \
    X(WRITES, EdgeMasks, masks)

#define ARGUMENTS_compose(X)                           \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(GROUP, ComposedLight, composed)                  \
    X(VALUE, uint, slots)                              \
    X(WRITES, FilmHigh, film_high)                     \
    X(WRITES, FilmLow, film_low)                       \
    X(WRITES, NonfiniteCounters, nonfinite)            \
    X(MAY_READ, EdgeMasks, edge_masks)

#define ARGUMENTS_filter_chains(X)                     \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(READS, ViewShares, view_shares)                  \
    X(READS, ReconstructedLight, radiance)             \
    X(WRITES, ReconstructedLight, shown)

#define ARGUMENTS_chain_radiance(X)                    \
    X(READS, SurfaceAlbedo, end_albedo)                \
    X(READS, SurfaceEmission, end_emission)            \
    X(WRITES, ReconstructedLight, light)

#define ARGUMENTS_compose_sums(X)                      \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(GROUP, ComposedLight, composed)                  \
    X(VALUE, uint, slots)                              \
    X(VALUE, float, film_scale)                        \
    X(WRITES, FilmSums, film_sums)                     \
    X(WRITES, NonfiniteCounters, nonfinite)

#define ARGUMENTS_edge_samples(X)                      \
    X(TRACES, Scene, scene)                            \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, EnvironmentImage, environment)            \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(GROUP, ComposedLight, composed)                  \
    X(VALUE, uint, edge_pixel_count)                   \
    X(VALUE, float, texture_angle)                     \
    X(VALUE, uint, slots)                              \
    X(READS, EdgePixels, edge_pixels)                  \
    X(WRITES, FilmHigh, film_high)                     \
    X(WRITES, FilmLow, film_low)                       \
    X(WRITES, NonfiniteCounters, nonfinite)            \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_vpl_residual(X)                      \
    X(TRACES, Scene, scene)                            \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, LightTable, light_table)                  \
    X(MAY_READ, LightNodes, light_nodes)               \
    X(GROUP, EnvironmentImage, environment)            \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, SlotPixels, slot_pixel)                   \
    X(VALUE, uint, parts)                              \
    X(VALUE, float, near_area)                         \
    X(MAY_WRITE, SlotLight, direct)                    \
    X(MAY_WRITE, SlotLight, indirect)                  \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_widen_residual(X)                    \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(VALUE, uint, spacing)                            \
    X(VALUE, float, most)                              \
    X(VALUE, uint, slots)                              \
    X(READS, PixelSlots, pixel_slot)                   \
    X(READS, SlotLight, irradiance)                    \
    X(MAY_READ, ReconstructedLight, direct)            \
    X(MAY_READ, ReconstructedLight, indirect)          \
    X(WRITES, SlotLight, widened)

#define ARGUMENTS_filter_residual(X)                   \
    X(GROUP, SeenSurfaces, surfaces)                   \
    X(VALUE, uint, slots)                              \
    X(READS, PixelSlots, pixel_slot)                   \
    X(READS, SlotLight, irradiance)                    \
    X(WRITES, ReconstructedLight, filtered)

#define ARGUMENTS_ambient_occlusion(X)                 \
    X(TRACES, Scene, scene)                            \
    X(VALUE, SetList, list)                            \
    X(VALUE, uint, slots)                              \
    X(READS, ReceiverPlanes, receiver_planes)          \
    X(READS, BlockSets, block_set)                     \
    X(READS, OcclusionDirections, directions)          \
    X(WRITES, SlotLight, irradiance)                   \
    X(WRITES, RayCounters, counters)

#define ARGUMENTS_path(X)                              \
    X(TRACES, Scene, scene)                            \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, LightTable, light_table)                  \
    X(MAY_READ, LightNodes, light_nodes)               \
    X(GROUP, EnvironmentImage, environment)            \
    X(VALUE, PathParams, path_params)                  \
    X(WRITES, FilmSums, film_sums)                     \
    X(WRITES, RayCounters, counters)                   \
    X(WRITES, NonfiniteCounters, nonfinite)

#define ARGUMENTS_path_surfaces(X)                     \
    X(TRACES, Scene, scene)                            \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, LightTable, light_table)                  \
    X(MAY_READ, LightNodes, light_nodes)               \
    X(GROUP, EnvironmentImage, environment)            \
    X(GROUP, SurfaceTables, surface_tables)            \
    X(VALUE, PathParams, path_params)                  \
    X(WRITES, FilmSums, film_sums)                     \
    X(WRITES, RayCounters, counters)                   \
    X(WRITES, NonfiniteCounters, nonfinite)

#define ARGUMENTS_path_media(X)                        \
    X(TRACES, Scene, scene)                            \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, LightTable, light_table)                  \
    X(MAY_READ, LightNodes, light_nodes)               \
    X(GROUP, EnvironmentImage, environment)            \
    X(GROUP, MediaTables, media_tables)                \
    X(VALUE, PathParams, path_params)                  \
    X(WRITES, FilmSums, film_sums)                     \
    X(WRITES, RayCounters, counters)                   \
    X(WRITES, NonfiniteCounters, nonfinite)

#define ARGUMENTS_path_grid(X) ARGUMENTS_path_media(X)

#define ARGUMENTS_path_media_surfaces(X)               \
    X(TRACES, Scene, scene)                            \
    X(GROUP, Geometry, geometry)                       \
    X(GROUP, LightTable, light_table)                  \
    X(MAY_READ, LightNodes, light_nodes)               \
    X(GROUP, EnvironmentImage, environment)            \
    X(GROUP, SurfaceTables, surface_tables)            \
    X(GROUP, MediaTables, media_tables)                \
    X(VALUE, PathParams, path_params)                  \
    X(WRITES, FilmSums, film_sums)                     \
    X(WRITES, RayCounters, counters)                   \
    X(WRITES, NonfiniteCounters, nonfinite)

#define ARGUMENTS_resolve_display(X)                   \
    X(VALUE, uint, samples)                            \
    X(VALUE, float, exposure)                          \
    X(VALUE, uint, tone)                               \
    X(READS, FilmHigh, film_high)                      \
    X(READS, FilmLow, film_low)                        \
    X(WRITES, DisplayColours, colours)

#define ARGUMENTS_resolve_display_sums(X)              \
    X(VALUE, float, exposure)                          \
    X(VALUE, uint, tone)                               \
    X(READS, FilmSums, film_sums)                      \
    X(WRITES, DisplayColours, colours)

#define ARGUMENTS_query_closest(X)                     \
    X(TRACES, Scene, scene)                            \
    X(READS, RayOrigins, ray_origin)                   \
    X(READS, RayDirections, ray_direction)             \
    X(WRITES, RayHits, hits)

#define ARGUMENTS_query_any(X)                         \
    X(TRACES, Scene, scene)                            \
    X(READS, RayOrigins, ray_origin)                   \
    X(READS, RayDirections, ray_direction)             \
    X(WRITES, RaysBlocked, blocked)

#define ARGUMENTS_query_closest_packet(X) ARGUMENTS_query_closest(X)

#define ARGUMENTS_query_packet(X)                      \
    X(TRACES, Scene, scene)                            \
    X(VALUE, uint, slots)                              \
    X(READS, BlockOrigins, block_origin)               \
    X(READS, PacketRays, rays)                         \
    X(WRITES, PacketBlocked, blocked)

// clang-format on

#endif
