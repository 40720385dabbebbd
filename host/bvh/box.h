// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_BOX_H
#define WEFT_BVH_BOX_H

#include <algorithm>
#include <array>
#include <cfloat>
#include <cmath>
#include <cstddef>

namespace weft {

/// A closed axis-aligned box; empty where a lower plane lies above its upper plane.
struct Box {
    std::array<float, 3> lower{FLT_MAX, FLT_MAX, FLT_MAX};
    std::array<float, 3> upper{-FLT_MAX, -FLT_MAX, -FLT_MAX};

    /// Grows to hold `other` as well.
    void extend(const Box& other) noexcept {
        for (std::size_t a = 0; a < 3; ++a) {
            lower[a] = std::min(lower[a], other.lower[a]);
            upper[a] = std::max(upper[a], other.upper[a]);
        }
    }

    [[nodiscard]] bool empty() const noexcept {
        return lower[0] > upper[0] || lower[1] > upper[1] || lower[2] > upper[2];
    }

    /// The part that lies in `other` as well; empty where there is none.
    [[nodiscard]] Box common(const Box& other) const noexcept {
        Box result;
        for (std::size_t a = 0; a < 3; ++a) {
            result.lower[a] = std::max(lower[a], other.lower[a]);
            result.upper[a] = std::min(upper[a], other.upper[a]);
        }
        return result.empty() ? Box{} : result;
    }

    [[nodiscard]] bool contains(const Box& other) const noexcept {
        for (std::size_t a = 0; a < 3; ++a)
            if (!(lower[a] <= other.lower[a] && other.upper[a] <= upper[a])) return false;
        return true;
    }

    /// Half of the surface area; 0 for an empty box. In double: squares of floats overflow.
    [[nodiscard]] double half_area() const noexcept {
        if (empty()) return 0.0;
        std::array<double, 3> size{};
        for (std::size_t a = 0; a < 3; ++a) size[a] = double{upper[a]} - double{lower[a]};
        return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
    }

    /// The box grown by `padding` and then by at least one float on every side; stays finite.
    [[nodiscard]] Box grown(float padding) const noexcept {
        Box result;
        for (std::size_t a = 0; a < 3; ++a) {
            result.lower[a] = std::max(-FLT_MAX, std::nextafter(lower[a] - padding, -INFINITY));
            result.upper[a] = std::min(FLT_MAX, std::nextafter(upper[a] + padding, INFINITY));
        }
        return result;
    }
};

}  // namespace weft

#endif
