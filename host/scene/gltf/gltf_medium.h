// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_MEDIUM_H
#define WEFT_SCENE_GLTF_GLTF_MEDIUM_H

#include <optional>
#include <string>

#include "scene/gltf/gltf_density.h"
#include "scene/gltf/gltf_document.h"
#include "scene/scene.h"

namespace weft {

/// The medium of a material or scene with the extension WEFT_medium: its scattering, absorption,
/// emission and density, and the absorption of KHR_materials_volume. Throws Error (exit code 2) for
/// coefficients that are negative or too large, an anisotropy outside (-1, 1), and what
/// GltfDensities refuses.
[[nodiscard]] std::optional<Medium> read_gltf_medium(const JsonValue& value,
                                                     const std::string& name,
                                                     GltfDensities& densities);

/// The medium that fills the space of the scene that is rendered.
[[nodiscard]] std::optional<Medium> read_gltf_outer_medium(const JsonValue& root,
                                                           GltfDensities& densities);

}  // namespace weft

#endif
