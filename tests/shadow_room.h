// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_SHADOW_ROOM_H
#define WEFT_TESTS_SHADOW_ROOM_H

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "shaft_cases.h"

namespace weft::test {

using Polygon = std::vector<glm::dvec2>;

/// Whether the convex hulls of two sets of points in the plane are apart. Exact but for rounding:
/// of the lines through two points of one set, one parts them if any line does.
inline bool hulls_apart(const Polygon& first, const Polygon& second) {
    const auto parted = [&](const glm::dvec2& n) {
        double first_high = -INFINITY;
        double second_low = INFINITY;
        for (const glm::dvec2& p : first) first_high = std::max(first_high, glm::dot(n, p));
        for (const glm::dvec2& p : second) second_low = std::min(second_low, glm::dot(n, p));
        return first_high < second_low;
    };
    for (const Polygon* const set : {&first, &second})
        for (const glm::dvec2& p : *set)
            for (const glm::dvec2& q : *set) {
                const glm::dvec2 n{p.y - q.y, q.x - p.x};
                if (parted(n) || parted(-n)) return true;
            }
    return false;
}

/// A room over [-1, 1]^3 with a square lamp just below its ceiling that shines down, and a block
/// on its floor, turned about the vertical axis.
class ShadowRoom {
  public:
    RayGeometry geometry;

    explicit ShadowRoom(double angle) {
        add_box({-1.0, -1.0, -1.0}, {1.0, 1.0, 1.0}, 0.0);
        add_box({-half_block, -1.0, -half_block}, {half_block, block_top, half_block}, angle);
        add_quad({-half_lamp, lamp_height, -half_lamp}, {half_lamp, lamp_height, -half_lamp},
                 {half_lamp, lamp_height, half_lamp}, {-half_lamp, lamp_height, half_lamp});
        for (const auto& [x, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
            block_.push_back(turned({half_block * x, half_block * z}, angle));
    }

    /// Tile (x, z) of a floor of n x n, but for its border of a hundredth: what is seen of a tile
    /// are points inside it.
    static std::pair<glm::dvec2, glm::dvec2> tile(int x, int z, int n) {
        const double size = 2.0 / n;
        const glm::dvec2 at{-1.0 + size * x, -1.0 + size * z};
        return {at + 0.01 * size, at + 0.99 * size};
    }

    /// The shaft between a part of the floor and the lamp.
    [[nodiscard]] ShaftRecord record(const glm::dvec2& low, const glm::dvec2& high) const {
        return {as_float4({low.x, -1.0, low.y}),
                as_float4({high.x, -1.0, high.y}),
                as_float4({-half_lamp, lamp_height, -half_lamp}),
                as_float4({half_lamp, lamp_height, half_lamp}),
                {0.0F, 1.0F, 0.0F, -1.0F},
                {0.0F, -1.0F, 0.0F, -static_cast<float>(lamp_height)}};
    }

    /// Whether the block hides some of the lamp from some point of this part of the floor. Seen
    /// from above, segments that climb to the block's top sweep the hull of the part and of the
    /// part moved toward the lamp by the block's share of its height.
    [[nodiscard]] bool shadowed(const glm::dvec2& low, const glm::dvec2& high) const {
        const double share = (block_top + 1.0) / (lamp_height + 1.0);
        Polygon swept;
        for (const glm::dvec2& p :
             {low, high, glm::dvec2(low.x, high.y), glm::dvec2(high.x, low.y)}) {
            swept.push_back(p);
            for (const auto& [x, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
                swept.push_back((1.0 - share) * p + share * half_lamp * glm::dvec2(x, z));
        }
        return !hulls_apart(swept, block_);
    }

  private:
    static constexpr double half_lamp = 0.25;
    static constexpr double lamp_height = 0.98;
    static constexpr double half_block = 0.2;
    static constexpr double block_top = -0.5;

    static glm::dvec2 turned(const glm::dvec2& p, double angle) {
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        return {c * p.x - s * p.y, s * p.x + c * p.y};
    }

    void add_quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                  const glm::dvec3& d) {
        const auto first = static_cast<std::uint32_t>(geometry.positions.size());
        for (const glm::dvec3& p : {a, b, c, d}) geometry.positions.push_back(as_float4(p));
        geometry.triangles.push_back({first, first + 1, first + 2, 0});
        geometry.triangles.push_back({first, first + 2, first + 3, 0});
    }

    void add_box(const glm::dvec3& low, const glm::dvec3& high, double angle) {
        std::array<glm::dvec3, 8> corner{};
        for (std::size_t i = 0; i < 8; ++i) {
            const glm::dvec2 xz =
                turned({(i & 1U) != 0 ? high.x : low.x, (i & 4U) != 0 ? high.z : low.z}, angle);
            corner[i] = {xz.x, (i & 2U) != 0 ? high.y : low.y, xz.y};
        }
        constexpr std::array<std::array<std::size_t, 4>, 6> faces{
            {{0, 1, 3, 2}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 3, 7, 5}}};
        for (const auto& f : faces)
            add_quad(corner[f[0]], corner[f[1]], corner[f[2]], corner[f[3]]);
    }

    Polygon block_;
};

}  // namespace weft::test

#endif
