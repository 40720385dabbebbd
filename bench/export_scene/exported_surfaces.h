// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_EXPORT_SCENE_EXPORTED_SURFACES_H
#define WEFT_BENCH_EXPORT_SCENE_EXPORTED_SURFACES_H

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "scene/scene.h"

namespace weft::bench {

/// Which texture coordinates the maps of a surface have, and what is applied to them. Exported
/// meshes have one set, to which it has been applied.
struct SurfaceCoordinates {
    std::uint32_t uv_set = 0;
    glm::dmat3 to_uv{1.0};
};

/// Whether a material is described as more than Lambert's law.
[[nodiscard]] bool has_described_surface(const Material& material);

/// The coordinates of a described surface: those of its maps, or of its tangents where it has a
/// direction; none where nothing asks for them. Where maps differ, those of the first, and
/// `exported_surface` says so.
[[nodiscard]] std::optional<SurfaceCoordinates> surface_coordinates(const Material& material);

/// A described surface as other renderers are told of it, by the names of glTF; docs/benchmarks.md
/// lists them. Null for Lambertian ones.
[[nodiscard]] nlohmann::json exported_surface(const Material& material);

}  // namespace weft::bench

#endif
