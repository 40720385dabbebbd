// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_SMOKY_ROOM_H
#define WEFT_TESTS_TESTING_SMOKY_ROOM_H

#include <cstdint>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/testing/density_grid_reference.h"
#include "tests/testing/media_builder.h"
#include "tests/testing/path_fixture.h"

// Rooms with fog, and with smoke in a density grid.
namespace weft::test {

/// Voxels of many densities in a few places, and nothing in between.
inline DensityGrid patchy_grid() {
    DensityGrid grid = make_random_grid({20, 24, 16}, 5);
    for (std::uint32_t k = 0; k < 16; ++k)
        for (std::uint32_t j = 0; j < 24; ++j)
            for (std::uint32_t i = 0; i < 20; ++i)
                if ((i / 6 + j / 6 + k / 6) % 2 == 1)
                    grid.densities[(std::size_t{k} * 24 + j) * 20 + i] = 0.0F;
    return grid;
}

inline glm::dmat4 turned(double size, const glm::dvec3& move) {
    return glm::rotate(glm::translate(glm::dmat4(1.0), move), 0.7, glm::dvec3(1.0, 2.0, -0.5)) *
           glm::scale(glm::dmat4(1.0), glm::dvec3(size, 0.8 * size, -1.2 * size));
}

/// A room with an area light, and fog in a box with a point light inside.
inline SceneBuilder foggy_room() {
    SceneBuilder builder;
    builder.add(room_mesh(), builder.material({0.7F, 0.5F, 0.3F}));
    builder.add(quad_mesh({-0.2F, 0.9F, -0.2F}, {0.4F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.4F}),
                builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    PunctualLight light;
    light.position = {0.4, 0.1, -0.3};
    light.intensity = glm::vec3(0.3F);
    builder.scene.lights.push_back(light);
    builder.scene.media.push_back(medium_of({0.3F, 1.0F, 2.0F}, {0.9F, 0.8F, 0.7F}, 0.5F));
    return builder;
}

inline const glm::dvec3 room_eye(0.1, 0.2, 0.9);

inline Camera room_camera() {
    return look_at(room_eye, {0.0, -0.2, 0.0}, 1.2);
}

/// A room with smoke and a box of even fog in it.
inline Scene smoky_room() {
    SceneBuilder builder = foggy_room();
    add_grid(builder.scene, 0, patchy_grid(), turned(0.6, {0.0, 0.1, 0.0}));
    builder.scene.media[0].scale = 5.0F;
    builder.scene.outer_medium = 0;
    builder.scene.media.push_back(medium_of({1.0F, 0.5F, 0.2F}, glm::vec3(0.8F)));
    add_boundary(builder.scene, cube_mesh(), placement(0.3, {0.3, -0.4, 0.0}), 1);
    return builder.scene;
}

}  // namespace weft::test

#endif
