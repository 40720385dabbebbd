// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_ATTRIBUTE_H
#define WEFT_SCENE_GLTF_GLTF_ATTRIBUTE_H

#include <cstddef>
#include <glm/glm.hpp>
#include <string>

#include "scene/gltf/gltf_data.h"

namespace weft {

/// The accessor of a vertex attribute, or null where there is none. Throws Error (exit code 2)
/// unless it has `min_width` to `max_width` components and as many elements as there are vertices.
[[nodiscard]] const GltfAccessor* find_gltf_attribute(GltfData& data, const JsonValue& attributes,
                                                      const std::string& name,
                                                      std::size_t vertex_count,
                                                      std::size_t min_width, std::size_t max_width);

/// The first three components of an element, as far as it has them, else 0. The accessor is of
/// vectors.
[[nodiscard]] glm::vec3 read_gltf_vector(const GltfAccessor& accessor, std::size_t index);

}  // namespace weft

#endif
