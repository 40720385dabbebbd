// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_OBJ_OBJ_POLYGON_H
#define WEFT_SCENE_OBJ_OBJ_POLYGON_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace weft {

/// Twice the area of a polygon along its normal (Newell's method); zero where it has none.
[[nodiscard]] glm::dvec3 polygon_normal(std::span<const glm::dvec3> corners);

/// Cuts polygons into triangles that keep their sense of rotation: convex ones into fans, others by
/// clipping ears in the plane of the polygon.
class PolygonCutter {
  public:
    using Triangle = std::array<std::uint32_t, 3>;

    /// The corners.size() - 2 triangles of a polygon with at least 3 finite corners, as indices
    /// into `corners`. They last until the next call.
    [[nodiscard]] std::span<const Triangle> cut(std::span<const glm::dvec3> corners);

    /// Number of concave polygons cut into fans all the same, because `limits::max_ear_tests` was
    /// used up.
    [[nodiscard]] std::size_t given_up() const noexcept { return given_up_; }

  private:
    void project(std::span<const glm::dvec3> corners, const glm::dvec3& normal);
    [[nodiscard]] bool is_convex() const;
    [[nodiscard]] double turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;
    [[nodiscard]] bool is_ear(std::uint32_t a, std::uint32_t b, std::uint32_t c);
    [[nodiscard]] bool clip_ears();
    void clip(std::uint32_t corner);
    void fan(std::size_t count);

    std::vector<glm::dvec2> points_;  // corners in the plane, counter-clockwise as a whole
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> previous_;
    std::vector<Triangle> triangles_;
    std::size_t ear_tests_ = 0;
    std::size_t given_up_ = 0;
};

}  // namespace weft

#endif
