// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_DIVIDED_SCENE_H
#define WEFT_TESTS_TESTING_DIVIDED_SCENE_H

#include <array>
#include <cstdint>
#include <string>

#include "scene/flat_scene.h"
#include "scene/load/load_scene.h"
#include "scene/scene.h"

namespace weft::test {

/// Puts four triangles in the place of each, so many times; only positions are kept.
inline void divide(Mesh& mesh, int times) {
    for (int i = 0; i < times; ++i) {
        Mesh fine;
        for (const auto& [a, b, c] : mesh.triangles) {
            const glm::vec3 p = mesh.positions.at(a);
            const glm::vec3 q = mesh.positions.at(b);
            const glm::vec3 r = mesh.positions.at(c);
            const auto first = static_cast<std::uint32_t>(fine.positions.size());
            for (const glm::vec3& corner :
                 {p, q, r, 0.5F * (p + q), 0.5F * (q + r), 0.5F * (r + p)})
                fine.positions.push_back(corner);
            for (const std::array<std::uint32_t, 3>& t :
                 {std::array<std::uint32_t, 3>{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}})
                fine.triangles.push_back({first + t[0], first + t[1], first + t[2]});
        }
        mesh = fine;
    }
}

/// Divides the meshes of all area lights.
inline void divide_area_lights(Scene& scene, int times) {
    for (const Instance& instance : scene.instances)
        if (scene.materials.at(instance.material).emission.radiance != glm::vec3(0.0F))
            divide(scene.meshes.at(instance.mesh), times);
}

/// A scene that comes with Weft, with area lights of more triangles than are known in closed form
/// (host/scene/area_light_bounds.h).
struct DividedScene {
    Camera camera;
    FlatScene flat;

    explicit DividedScene(const std::string& file) {
        Diagnostics diagnostics;
        Scene scene = load_scene(WEFT_SOURCE_DIR "/scenes/" + file, diagnostics);
        divide_area_lights(scene, 2);
        camera = scene.cameras.at(0);
        flat = flatten(scene);
    }
};

struct DividedBox : DividedScene {
    DividedBox() : DividedScene("cornell-box.gltf") {}
};

}  // namespace weft::test

#endif
