// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_triangles.h"

#include <algorithm>
#include <optional>
#include <string>

#include "base/limits.h"

namespace weft {
namespace {

/// Vertex numbers of a primitive in drawing order.
class IndexList {
  public:
    IndexList(GltfData& data, const JsonValue& primitive, std::size_t vertex_count)
        : vertex_count_(vertex_count), reference_(primitive.find("indices")) {
        if (!reference_) return;
        accessor_ = &data.accessor(*reference_);
        const GltfComponent type = accessor_->component();
        if (accessor_->width() != 1 || accessor_->normalized() ||
            (type != GltfComponent::uint8 && type != GltfComponent::uint16 &&
             type != GltfComponent::uint32))
            throw reference_->error("is not an accessor of SCALAR unsigned integers");
    }

    [[nodiscard]] std::size_t size() const {
        return accessor_ != nullptr ? accessor_->count() : vertex_count_;
    }

    [[nodiscard]] std::uint32_t operator[](std::size_t i) const {
        if (accessor_ == nullptr) return static_cast<std::uint32_t>(i);
        const std::uint32_t index = accessor_->read_index(i);
        if (index >= vertex_count_)
            throw reference_->error("index " + std::to_string(index) + " of element " +
                                    std::to_string(i) + " is out of range, expected below " +
                                    std::to_string(vertex_count_));
        return index;
    }

  private:
    std::size_t vertex_count_;
    std::optional<JsonValue> reference_;
    const GltfAccessor* accessor_ = nullptr;
};

/// Positions in the index list of the corners of triangle `i`, by glTF 2.0 section 3.7.2.1.
std::array<std::size_t, 3> corners(std::uint64_t mode, std::size_t i) {
    if (mode == 5) return {i, i + 1 + i % 2, i + 2 - i % 2};
    if (mode == 6) return {i + 1, i + 2, 0};
    return {3 * i, 3 * i + 1, 3 * i + 2};
}

}  // namespace

GltfTriangles read_gltf_triangles(GltfData& data, const JsonValue& primitive, std::uint64_t mode,
                                  std::size_t vertex_count, std::size_t& triangles_read) {
    const IndexList indices(data, primitive, vertex_count);
    const std::size_t size = indices.size();
    if (mode == 4 && size % 3 != 0)
        throw primitive.error("has " + std::to_string(size) +
                              " vertices to draw, expected a multiple of 3");
    const std::size_t count = mode == 4 ? size / 3 : (size < 3 ? 0 : size - 2);
    if (count > limits::max_triangles - triangles_read)
        throw primitive.error("brings the file above the limit of " +
                              std::to_string(limits::max_triangles) + " triangles");
    triangles_read += count;
    GltfTriangles triangles;
    triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::array<std::size_t, 3> at = corners(mode, i);
        const std::uint32_t a = indices[at[0]];
        const std::uint32_t b = indices[at[1]];
        const std::uint32_t c = indices[at[2]];
        if (a != b && b != c && c != a) triangles.push_back({a, b, c});
    }
    return triangles;
}

std::vector<std::uint32_t> compact_vertices(GltfTriangles& triangles, std::size_t vertex_count) {
    std::vector<std::uint32_t> used;
    // A table of all vertices is faster, but many small primitives may share one huge accessor.
    if (vertex_count / 8 <= triangles.size() + 128) {
        std::vector<std::uint32_t> renumbered(vertex_count, 0);
        for (const auto& triangle : triangles)
            for (const std::uint32_t corner : triangle) renumbered[corner] = 1;
        for (std::uint32_t i = 0; i < vertex_count; ++i) {
            if (renumbered[i] == 0) continue;
            renumbered[i] = static_cast<std::uint32_t>(used.size());
            used.push_back(i);
        }
        for (auto& triangle : triangles)
            for (std::uint32_t& corner : triangle) corner = renumbered[corner];
        return used;
    }
    used.reserve(3 * triangles.size());
    for (const auto& triangle : triangles)
        used.insert(used.end(), triangle.begin(), triangle.end());
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (auto& triangle : triangles)
        for (std::uint32_t& corner : triangle)
            corner = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) -
                                                used.begin());
    return used;
}

}  // namespace weft
