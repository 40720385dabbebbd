// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_MEDIA_BUILDER_H
#define WEFT_SELFTEST_MEDIA_BUILDER_H

#include <cstdint>
#include <glm/glm.hpp>
#include <utility>

#include "selftest/scene_builder.h"

namespace weft::selftest {

/// A homogeneous medium.
inline Medium medium_of(const glm::vec3& sigma_t, const glm::vec3& albedo, float g = 0.0F) {
    Medium medium;
    medium.name = "fog";
    medium.type = "homogeneous";
    medium.sigma_t = sigma_t;
    medium.albedo = albedo;
    medium.anisotropy = g;
    return medium;
}

/// Adds a mesh as the boundary of a medium, or of clear air.
inline void add_boundary(Scene& scene, Mesh mesh, const glm::dmat4& to_world, int interior,
                         int exterior = -1) {
    MediumBoundary boundary;
    boundary.mesh = static_cast<std::uint32_t>(scene.meshes.size());
    boundary.to_world = to_world;
    boundary.interior = interior;
    boundary.exterior = exterior;
    scene.meshes.push_back(std::move(mesh));
    scene.medium_boundaries.push_back(boundary);
}

/// The cube [-1,1]^3 with normals outwards.
inline Mesh cube_mesh() {
    Mesh cube = room_mesh();
    for (auto& t : cube.triangles) std::swap(t[1], t[2]);
    return cube;
}

/// Adds two boundaries of clear air that intersect each other, far from everything. Segments of
/// rays then do not follow from planes, so that kernels walk through all boundaries hit by hit.
inline void add_far_overlap(Scene& scene) {
    for (const double shift : {0.0, 0.5}) {
        glm::dmat4 far(1.0);
        far[3] = {30.0 + shift, 30.0, 30.0, 1.0};
        add_boundary(scene, cube_mesh(), far, -1);
    }
}

/// Gives a medium of the scene a density grid in the cube [-1,1]^3, placed.
inline void add_grid(Scene& scene, std::size_t medium, DensityGrid grid,
                     const glm::dmat4& to_world = glm::dmat4(1.0)) {
    glm::dmat4 cube(2.0);
    cube[3] = {-1.0, -1.0, -1.0, 1.0};
    scene.media[medium].type = "heterogeneous";
    scene.media[medium].grid = static_cast<int>(scene.grids.size());
    scene.media[medium].grid_to_world = to_world * cube;
    scene.grids.push_back(std::move(grid));
}

}  // namespace weft::selftest

#endif
