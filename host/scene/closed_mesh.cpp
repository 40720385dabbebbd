// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/closed_mesh.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

namespace weft {
namespace {

/// By vertex, the number of its position among the different ones.
std::vector<std::uint32_t> welded_vertices(const Mesh& mesh) {
    const std::vector<glm::vec3>& at = mesh.positions;
    const auto key = [&](std::uint32_t vertex) {
        return std::tie(at[vertex].x, at[vertex].y, at[vertex].z);
    };
    std::vector<std::uint32_t> order(at.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    std::vector<std::uint32_t> welded(at.size());
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (i > 0 && key(order[i]) != key(order[i - 1])) ++number;
        welded[order[i]] = number;
    }
    return welded;
}

struct Edge {
    std::uint32_t low, high;
    int way;  // 1: from low to high, -1: back
};

}  // namespace

bool is_closed(const Mesh& mesh) {
    const std::vector<std::uint32_t> welded = welded_vertices(mesh);
    std::vector<Edge> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const auto& triangle : mesh.triangles) {
        const std::array<std::uint32_t, 3> v{welded[triangle[0]], welded[triangle[1]],
                                             welded[triangle[2]]};
        if (v[0] == v[1] || v[1] == v[2] || v[2] == v[0]) continue;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t from = v[i];
            const std::uint32_t to = v[(i + 1) % 3];
            edges.push_back({std::min(from, to), std::max(from, to), from < to ? 1 : -1});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return std::tie(a.low, a.high) < std::tie(b.low, b.high);
    });
    for (std::size_t i = 0; i < edges.size();) {
        int sum = 0;
        const std::size_t first = i;
        for (; i < edges.size() && edges[i].low == edges[first].low &&
               edges[i].high == edges[first].high;
             ++i)
            sum += edges[i].way;
        if (sum != 0) return false;
    }
    return !edges.empty();
}

}  // namespace weft
