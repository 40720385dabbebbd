// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_MORPH_H
#define WEFT_SCENE_GLTF_GLTF_MORPH_H

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/warning_collector.h"
#include "scene/deformation.h"
#include "scene/gltf/gltf_data.h"

namespace weft {

/// How many morph targets a mesh has: those of its first primitive. Throws Error (exit code 2)
/// above `limits::max_morph_targets`.
[[nodiscard]] std::size_t count_gltf_targets(const JsonValue& mesh);

/// The `weights` of a mesh or a node, or nothing where it gives none. Throws Error (exit code 2)
/// where they are not as many as the targets.
[[nodiscard]] std::optional<std::vector<double>> read_gltf_weights(const JsonValue& value,
                                                                   std::size_t targets);

/// The morph targets of a primitive, for the given ones of its `vertex_count` vertices; normals
/// only where requested. `deltas_read` counts displacements of the whole file against
/// `limits::max_morph_deltas`. Displacements that are not finite become 0, with a warning. Throws
/// Error (exit code 2).
[[nodiscard]] std::vector<MorphTarget> read_gltf_targets(GltfData& data, const JsonValue& primitive,
                                                         std::size_t vertex_count,
                                                         const std::vector<std::uint32_t>& vertices,
                                                         bool with_normals,
                                                         WarningCollector& report,
                                                         std::size_t& deltas_read);

}  // namespace weft

#endif
