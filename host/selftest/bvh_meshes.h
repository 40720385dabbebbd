// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_BVH_MESHES_H
#define WEFT_SELFTEST_BVH_MESHES_H

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <vector>

#include "shared/shared_types.h"

namespace weft::selftest {

/// A triangle soup or mesh to build BVHs from.
struct BvhMesh {
    std::vector<shared::float4> positions;
    std::vector<shared::Triangle> triangles;

    void add(std::array<float, 3> a, std::array<float, 3> b, std::array<float, 3> c) {
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const auto& p : {a, b, c}) positions.push_back({p[0], p[1], p[2], 0.0F});
        triangles.push_back({first, first + 1, first + 2, 0});
    }
};

/// Uniform random numbers that are the same with every standard library, unlike those of the
/// distributions of <random>.
class Uniform {
  public:
    explicit Uniform(std::uint32_t seed) : engine_(seed) {}
    float operator()(float low, float high) {
        return low + (high - low) * (static_cast<float>(engine_() >> 8) * 0x1p-24F);
    }

  private:
    std::mt19937 engine_;
};

/// A point whose coordinates are uniform between both bounds.
inline glm::vec3 random_point(Uniform& uniform, float low, float high) {
    const float x = uniform(low, high);
    const float y = uniform(low, high);
    return {x, y, uniform(low, high)};
}

/// One of 0 to count - 1, which is at least 1, each as likely as another.
inline std::size_t random_index(Uniform& uniform, std::size_t count) {
    return std::min(count - 1,
                    static_cast<std::size_t>(uniform(0.0F, 1.0F) * static_cast<float>(count)));
}

/// Triangles of about `size` in the unit cube.
inline BvhMesh random_soup(std::size_t count, float size, std::uint32_t seed) {
    BvhMesh mesh;
    Uniform uniform(seed);
    for (std::size_t i = 0; i < count; ++i) {
        std::array<std::array<float, 3>, 3> v{};
        for (std::size_t k = 0; k < 3; ++k) {
            v[0][k] = uniform(0.0F, 1.0F);
            v[1][k] = v[0][k] + uniform(-size, size);
            v[2][k] = v[0][k] + uniform(-size, size);
        }
        mesh.add(v[0], v[1], v[2]);
    }
    return mesh;
}

/// n x n squares of two triangles in the plane z = 0.5 over the unit square.
inline BvhMesh flat_grid(std::uint32_t n) {
    BvhMesh mesh;
    for (std::uint32_t y = 0; y <= n; ++y)
        for (std::uint32_t x = 0; x <= n; ++x)
            mesh.positions.push_back({static_cast<float>(x) / static_cast<float>(n),
                                      static_cast<float>(y) / static_cast<float>(n), 0.5F, 0.0F});
    for (std::uint32_t y = 0; y < n; ++y) {
        for (std::uint32_t x = 0; x < n; ++x) {
            const std::uint32_t v = y * (n + 1) + x;
            mesh.triangles.push_back({v, v + 1, v + n + 2, 0});
            mesh.triangles.push_back({v, v + n + 2, v + n + 1, 0});
        }
    }
    return mesh;
}

/// Thin, nearly parallel triangles along the diagonal of the unit cube: their boxes are nearly
/// empty and overlap each other, so that only spatial splits can separate them.
inline BvhMesh diagonal_needles(std::size_t count, std::uint32_t seed) {
    BvhMesh mesh;
    Uniform uniform(seed);
    for (std::size_t i = 0; i < count; ++i) {
        std::array<float, 3> a{};
        std::array<float, 3> b{};
        for (std::size_t k = 0; k < 3; ++k) {
            a[k] = uniform(-0.1F, 0.1F);
            b[k] = a[k] + uniform(0.99F, 1.01F);
        }
        mesh.add(a, b, {b[0] + 0.002F, b[1], b[2] - 0.001F});
    }
    return mesh;
}

}  // namespace weft::selftest

#endif
