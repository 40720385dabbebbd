// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/leaves.h"

#include <array>
#include <bit>

#include "bvh/build_tree.h"

namespace weft {
namespace {

constexpr std::size_t rows = LEAF_ROWS;
constexpr std::size_t vertex_rows = 3;

}  // namespace

LargeVector<float> empty_leaves() {
    return LargeVector<float>(node_width);
}

std::size_t leaf_entries(std::span<const float> leaves) noexcept {
    return leaves.size() < node_width ? 0 : (leaves.size() - node_width) / rows;
}

void append_leaf(LargeVector<float>& leaves, std::span<const LeafTriangle> triangles) {
    const std::size_t count = triangles.size();
    const std::size_t first = leaf_entries(leaves) * rows;
    leaves.resize(leaves.size() + rows * count);
    for (std::size_t i = 0; i < count; ++i) {
        float* value = &leaves[first + i];
        for (const shared::float4& corner : triangles[i].corners) {
            for (const float coordinate : {corner.x, corner.y, corner.z}) {
                *value = coordinate;
                value += count;
            }
        }
        *value = std::bit_cast<float>(triangles[i].id | LEAF_ID_FLAG);
    }
}

LeafTriangle leaf_triangle(std::span<const float> leaves, std::uint32_t reference,
                           std::size_t i) noexcept {
    const std::size_t count = leaf_count(reference);
    const float* value = &leaves[leaf_first(reference) * rows + i];
    const auto row = [&](std::size_t r) { return value[r * count]; };
    LeafTriangle triangle;
    for (std::size_t k = 0; k < triangle.corners.size(); ++k)
        triangle.corners[k] = {row(vertex_rows * k), row(vertex_rows * k + 1),
                               row(vertex_rows * k + 2), 0.0F};
    triangle.id = std::bit_cast<std::uint32_t>(row(LEAF_ID_ROW)) & LEAF_ID_MASK;
    return triangle;
}

}  // namespace weft
