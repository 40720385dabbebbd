// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_FLAT_SURFACES_H
#define WEFT_SCENE_FLAT_SURFACES_H

#include <cstdint>
#include <span>
#include <vector>

#include "scene/albedo_tables.h"
#include "scene/scene.h"
#include "scene/texture_statistics.h"
#include "shared/shared_types.h"

namespace weft {

struct FlatMedia;
struct FlatScene;

/// What kernels read of materials with more than Lambert's lobe (kernels/bsdf/surface_maps.h).
/// Empty in scenes without one.
struct FlatSurfaces {
    std::vector<shared::SurfaceRecord> records;  ///< by material; diffuse where not shown
    std::vector<shared::SurfaceRecord> plain;    ///< the same without what tables add to them
    std::vector<shared::SurfaceMap> maps;
    std::vector<float> coordinates;  ///< 2 a vertex, one set of a mesh after the other
    /// SURFACE_INSTANCE_WORDS by instance: what leads from a vertex to its coordinates in each set,
    /// then the numbers of the interface and of the boundary of a medium that it is, and what leads
    /// to the alpha of its vertices, each of which may be INVALID_INDEX.
    std::vector<std::uint32_t> of_instances;
    std::vector<shared::float4> tangents;  ///< by vertex; empty where nothing asks for them
    std::vector<shared::InterfaceRecord> interfaces;
    std::vector<float> values;  ///< of tables of albedos
    AlbedoTables tables;

    /// By instance: whether previews let light pass straight through it.
    std::vector<bool> passes_light;
    bool see_through = false;  ///< some let light pass straight on
    // What previews follow anywhere (kernels/bsdf/seen_lobes.h).
    bool mirrors = false;       ///< SURFACE_MIRRORS
    bool glossy = false;        ///< SURFACE_GLOSSY
    bool lets_through = false;  ///< SURFACE_LETS_THROUGH
    bool rough_glass = false;   ///< SURFACE_ROUGH_GLASS

    [[nodiscard]] bool present() const noexcept { return !records.empty(); }
};

/// Places the tangents of one instance of a scene, where there is room for them.
void place_tangents(const Scene& scene, std::size_t instance, std::size_t first_vertex,
                    FlatSurfaces& surfaces);

/// Tells surfaces which boundaries of media they are.
void link_boundaries(const Scene& scene, const FlatMedia& media, FlatSurfaces& surfaces);

/// The surfaces of a scene whose instances have been flattened to `flat`.
[[nodiscard]] FlatSurfaces flatten_surfaces(const Scene& scene, const FlatScene& flat);

/// Brings records and tables up to date with the materials of a scene, whose colours and roughness
/// may have changed, but nothing else. `textures` are by texture of the scene.
void update_surfaces(const Scene& scene, std::span<const TextureStatistics> textures,
                     FlatSurfaces& surfaces);

}  // namespace weft

#endif
