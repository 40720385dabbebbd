// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_RAY_FANS_H
#define WEFT_TESTS_TESTING_RAY_FANS_H

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "tests/testing/bvh_meshes.h"
#include "tests/testing/ray_batch.h"
#include "tests/testing/ray_oracle.h"

// Rays that start at common points, and triangles to trace them in.
namespace weft::test {

/// Small triangles all over the unit cube.
inline RayGeometry soup() {
    const BvhMesh mesh = random_soup(150, 0.15F, 21);
    return {mesh.positions, mesh.triangles};
}

/// Segments that start at one point, a multiple of PACKET_BLOCK.
struct Fan {
    glm::vec3 origin{0.0F};
    std::vector<glm::vec3> ends;  // minus the origin
};

/// Coherent, all around, straddling axes, and with components that are zero or next to it.
inline std::vector<Fan> fans(std::size_t count, std::uint32_t seed) {
    constexpr std::array small{
        0.0F, -0.0F, 1e-30F, -1e-30F, std::numeric_limits<float>::denorm_min(), -1e-40F};
    Uniform uniform(seed);
    std::vector<Fan> all(count);
    for (std::size_t f = 0; f < count; ++f) {
        Fan& fan = all[f];
        fan.origin = random_point(uniform, -0.2F, 1.2F);
        const glm::vec3 middle = random_point(uniform, 0.0F, 1.0F) - fan.origin;
        const int axis = static_cast<int>(f % 3);
        for (std::size_t i = 0; i < std::size_t{4} * PACKET_BLOCK; ++i) {
            glm::vec3 d = random_point(uniform, -1.5F, 1.5F);
            if (f % 4 == 0) d = middle + 0.1F * d;
            if (f % 4 == 1) {  // about an axis
                d *= 0.02F;
                d[axis] = uniform(0.5F, 1.5F);
            }
            if (f % 4 == 2) {
                d[axis] = small.at(random_index(uniform, small.size()));
                if (i % 3 == 0) d[(axis + 1) % 3] = small.at(random_index(uniform, small.size()));
            }
            fan.ends.push_back(d);
        }
    }
    return all;
}

}  // namespace weft::test

#endif
