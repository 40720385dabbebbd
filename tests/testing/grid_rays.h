// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Rays through density grids, for tests that include the kernels' headers in namespace `native`
// beforehand.
#ifndef WEFT_TESTS_TESTING_GRID_RAYS_H
#define WEFT_TESTS_TESTING_GRID_RAYS_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <random>
#include <vector>

namespace weft {

constexpr float infinity = std::numeric_limits<float>::infinity();

inline float uniform(std::mt19937& random, float low, float high) {
    return low + (high - low) * (static_cast<float>(random() >> 8) * 5.9604645e-8F);
}

inline native::float3 uniform3(std::mt19937& random, float low, float high) {
    const float x = uniform(random, low, high);
    const float y = uniform(random, low, high);
    return native::f3(x, y, uniform(random, low, high));
}

inline glm::dvec3 to_double(native::float3 v) {
    return {v.x, v.y, v.z};
}

/// What is left of [first, last] inside the unit cube, in double.
inline std::array<double, 2> clip(const glm::dvec3& o, const glm::dvec3& d, double first,
                                  double last) {
    for (int axis = 0; axis < 3; ++axis) {
        if (d[axis] == 0.0) {
            if (o[axis] < 0.0 || o[axis] > 1.0) return {0.0, 0.0};
            continue;
        }
        const double a = -o[axis] / d[axis];
        const double b = (1.0 - o[axis]) / d[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return {first, std::max(first, last)};
}

struct TestRay {
    native::float3 origin, direction;
    float first = 0.0F, last = infinity;
};

/// Rays in general position, along axes and diagonals, from inside, from faces, edges and corners
/// of the cube and of voxels, and from far away.
inline std::vector<TestRay> test_rays() {
    std::mt19937 random(5);
    std::vector<TestRay> rays;
    const float places[] = {0.0F, 0.25F, 0.5F, 1.0F, 0.125F, 0.3F, 2.0F, -1.0F};
    const float slopes[] = {0.0F, -0.0F, 1.0F, -1.0F, 0.5F, 0.3F, -0.7F, 1e-30F, 1e-42F, -1e-20F};
    for (int n = 0; n < 6000; ++n) {
        TestRay ray;
        if (n % 3 == 0) {
            ray.origin = uniform3(random, -1.0F, 2.0F);
            ray.direction = uniform3(random, 0.0F, 1.0F) - ray.origin;
        } else {
            ray.origin =
                native::f3(places[random() % 8], places[random() % 8], places[random() % 8]);
            ray.direction =
                native::f3(slopes[random() % 10], slopes[random() % 10], slopes[random() % 10]);
        }
        if (n % 4 == 1) ray.last = uniform(random, 0.0F, 2.0F);
        if (n % 8 == 3) ray.first = uniform(random, 0.0F, 0.5F);
        rays.push_back(ray);
    }
    return rays;
}

}  // namespace weft

#endif
