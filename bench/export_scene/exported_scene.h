// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_EXPORT_SCENE_EXPORTED_SCENE_H
#define WEFT_BENCH_EXPORT_SCENE_EXPORTED_SCENE_H

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "scene/flat_scene.h"

namespace weft::bench {

/// The triangles of one material, in world space at rest, as other renderers take them. Attribute
/// arrays are empty or as long as the positions.
struct ExportedMesh {
    std::uint32_t material = 0;
    std::vector<float> positions;          ///< 3 a vertex, scene units
    std::vector<float> normals;            ///< 3 a vertex, unit; empty: surfaces are flat
    std::vector<float> uvs;                ///< 2 a vertex; v = 0 on the top edge of a texture
    std::vector<float> colours;            ///< 3 a vertex, linear, multiplied with the reflectance
    std::vector<std::uint32_t> triangles;  ///< 3 a triangle, counter-clockwise seen from outside
};

/// The surfaces of a scene by material, those with and those without vertex normals apart.
/// Triangles without area, which no ray meets, are left out.
[[nodiscard]] std::vector<ExportedMesh> exported_meshes(const Scene& scene, const FlatScene& flat);

/// The boundaries of media in the order of their numbers, as meshes without material.
[[nodiscard]] std::vector<ExportedMesh> exported_boundaries(const FlatScene& flat);

/// Writes a scene into a folder, which is made: arrays as little-endian binary files, textures as
/// their RGBA bytes, then `scene.json`, which names them and holds all else; docs/benchmarks.md
/// describes it. Colours are linear Rec.709, radiances W/(m^2 sr). Throws Error (exit code 5).
void write_exported_scene(const std::filesystem::path& folder, const Scene& scene,
                          const FlatScene& flat, const Camera& camera, const FilmSize& size);

}  // namespace weft::bench

#endif
