// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_MOVING_MESH_H
#define WEFT_TESTS_TESTING_MOVING_MESH_H

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/testing/bvh_meshes.h"

// Triangles some of which move.
namespace weft::test {

/// Where moving triangles are: scaled about the middle of the unit cube, then moved. Of those
/// that are not present nothing but a point is left.
struct Pose {
    std::array<float, 3> move{};
    float scale = 1.0F;
    float present = 1.0F;  ///< share of them, the first ones
};

/// They move, grow, shrink, come and go, and end where they were.
inline constexpr std::array poses{Pose{{}, 1.0F, 1.0F},
                                  Pose{{0.5F, 0.25F, -0.3F}, 1.0F, 1.0F},
                                  Pose{{-0.1F, 0.0F, 0.2F}, 2.5F, 1.0F},
                                  Pose{{0.0F, 0.1F, 0.0F}, 0.05F, 0.5F},
                                  Pose{{}, 1.0F, 0.0F},
                                  Pose{{0.2F, 0.2F, 0.2F}, 1.0F, 0.1F},
                                  Pose{{0.0F, -0.4F, 0.0F}, 1.5F, 1.0F},
                                  Pose{{}, 1.0F, 1.0F}};

/// Triangles of vertices of their own, of which those from `first_moving` on can be posed.
struct MovingMesh {
    BvhMesh mesh;
    std::size_t first_moving = 0;
    std::vector<shared::float4> home = mesh.positions;

    void pose(const Pose& to) {
        const std::size_t moving = mesh.triangles.size() - first_moving;
        const auto present =
            static_cast<std::size_t>(std::ceil(to.present * static_cast<float>(moving)));
        for (std::size_t i = first_moving; i < mesh.triangles.size(); ++i) {
            const shared::Triangle& t = mesh.triangles[i];
            for (const std::uint32_t v : {t.v0, t.v1, t.v2}) {
                const shared::float4& from = i - first_moving < present ? home[v] : home[t.v0];
                const auto moved = [&](float x, std::size_t axis) {
                    return x * to.scale + (0.5F - 0.5F * to.scale + to.move[axis]);
                };
                mesh.positions[v] = {moved(from.x, 0), moved(from.y, 1), moved(from.z, 2), 0.0F};
            }
        }
    }
};

/// `moving` small triangles among `resting` others.
inline MovingMesh moving_soup(std::size_t resting, std::size_t moving, std::uint32_t seed) {
    return {random_soup(resting + moving, 0.15F, seed), resting};
}

/// The resting ones are needles that spatial splits part.
inline MovingMesh needles_and_moving_soup(std::size_t resting, std::size_t moving,
                                          std::uint32_t seed) {
    MovingMesh made{diagonal_needles(resting, seed), resting};
    const BvhMesh others = random_soup(moving, 0.15F, seed + 1);
    const auto first = static_cast<std::uint32_t>(made.mesh.positions.size());
    made.mesh.positions.insert(made.mesh.positions.end(), others.positions.begin(),
                               others.positions.end());
    for (const shared::Triangle& t : others.triangles)
        made.mesh.triangles.push_back({first + t.v0, first + t.v1, first + t.v2, 0});
    made.home = made.mesh.positions;
    return made;
}

}  // namespace weft::test

#endif
