// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_DENSITY_GRID_REFERENCE_H
#define WEFT_TESTS_TESTING_DENSITY_GRID_REFERENCE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>

#include "scene/density_grid.h"

namespace weft {

/// The density at a point of the unit cube by the definition, in double: the sum over all eight
/// voxels about it of their densities, weighted by the distances from the others. Slow and plain.
inline double density_by_definition(const DensityGrid& grid, const glm::dvec3& p) {
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1.0;
        std::size_t index = 0;
        for (int axis = 2; axis >= 0; --axis) {
            if (!(p[axis] >= 0.0 && p[axis] <= 1.0)) return 0.0;
            const double last = grid.size[static_cast<std::size_t>(axis)] - 1.0;
            const double x = p[axis] * (last + 1.0) - 0.5;
            const bool upper = (corner >> axis & 1) != 0;
            const double voxel = std::floor(x) + (upper ? 1.0 : 0.0);
            weight *= upper ? x - std::floor(x) : 1.0 - (x - std::floor(x));
            index = index * static_cast<std::size_t>(last + 1.0) +
                    static_cast<std::size_t>(std::clamp(voxel, 0.0, last));
        }
        sum += weight * grid.densities[index];
    }
    return sum;
}

/// A grid of densities that `value` gives for the voxels (i, j, k).
template <typename Value>
DensityGrid make_grid(const GridSize& size, const Value& value) {
    DensityGrid grid;
    grid.size = size;
    for (std::uint32_t k = 0; k < size[2]; ++k)
        for (std::uint32_t j = 0; j < size[1]; ++j)
            for (std::uint32_t i = 0; i < size[0]; ++i)
                grid.densities.push_back(static_cast<float>(value(i, j, k)));
    return grid;
}

/// A grid of independent densities, most of them small and a few up to 1.
inline DensityGrid make_random_grid(const GridSize& size, std::uint32_t seed) {
    std::mt19937 random(seed);
    return make_grid(size, [&](std::uint32_t, std::uint32_t, std::uint32_t) {
        return std::pow(static_cast<double>(random()) / 4294967295.0, 8.0);
    });
}

}  // namespace weft

#endif
