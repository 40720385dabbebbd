// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_attribute.h"

#include <array>
#include <optional>

namespace weft {

const GltfAccessor* find_gltf_attribute(GltfData& data, const JsonValue& attributes,
                                        const std::string& name, std::size_t vertex_count,
                                        std::size_t min_width, std::size_t max_width) {
    const std::optional<JsonValue> reference = attributes.find(name.c_str());
    if (!reference) return nullptr;
    const GltfAccessor& accessor = data.accessor(*reference);
    if (accessor.width() < min_width || accessor.width() > max_width)
        throw reference->error("has " + std::to_string(accessor.width()) +
                               " components, expected " + std::to_string(min_width) +
                               (max_width > min_width ? " or " + std::to_string(max_width) : ""));
    if (accessor.count() != vertex_count)
        throw reference->error("has " + std::to_string(accessor.count()) +
                               " elements, expected as many as POSITION, " +
                               std::to_string(vertex_count));
    return &accessor;
}

glm::vec3 read_gltf_vector(const GltfAccessor& accessor, std::size_t index) {
    std::array<float, 4> values{};
    accessor.read(index, values);
    return {values[0], values[1], values[2]};
}

}  // namespace weft
