// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_TRIANGLES_H
#define WEFT_SCENE_GLTF_GLTF_TRIANGLES_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/gltf/gltf_data.h"

namespace weft {

using GltfTriangles = std::vector<std::array<std::uint32_t, 3>>;

/// The triangles of a primitive in modes TRIANGLES (4), TRIANGLE_STRIP (5) and TRIANGLE_FAN (6),
/// with every index below `vertex_count`. Triangles that name a vertex twice, as strips do, are
/// left out. `triangles_read` counts those of the whole file against `limits::max_triangles`.
[[nodiscard]] GltfTriangles read_gltf_triangles(GltfData& data, const JsonValue& primitive,
                                                std::uint64_t mode, std::size_t vertex_count,
                                                std::size_t& triangles_read);

/// Renumbers `triangles` so that they use the vertices 0, 1, 2... without gaps, in the old order,
/// and returns the old number of each.
[[nodiscard]] std::vector<std::uint32_t> compact_vertices(GltfTriangles& triangles,
                                                          std::size_t vertex_count);

}  // namespace weft

#endif
