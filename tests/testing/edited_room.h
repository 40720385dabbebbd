// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_EDITED_ROOM_H
#define WEFT_TESTS_TESTING_EDITED_ROOM_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "scene/scene_edits.h"
#include "tests/testing/scene_builder.h"
#include "tests/testing/temporary_folder.h"

namespace weft::test {

/// "Box", scaled by 2 at (1, 2, 3); "Wall" of two parts at the origin; an area light, a sun and two
/// lights of one name; materials "Red" and "Emissive", and two that share a name.
inline Scene room() {
    SceneBuilder builder;
    const auto material = [&](const char* name, const glm::vec3& albedo,
                              const glm::vec3& emission) {
        const std::uint32_t index = builder.material(albedo, emission);
        builder.scene.materials[index].name = name;
        return index;
    };
    const std::uint32_t red = material("Red", {0.8F, 0.25F, 0.0F}, glm::vec3(0.0F));
    const std::uint32_t emissive = material("Emissive", glm::vec3(0.5F), {4.0F, 2.0F, 1.0F});
    material("Same", glm::vec3(0.5F), glm::vec3(0.0F));
    material("Same", glm::vec3(0.5F), glm::vec3(0.0F));
    const Mesh quad = quad_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    builder.add(quad, red, placement(2.0, {1, 2, 3}));
    builder.add(quad, red);
    builder.add(quad, emissive);
    builder.add(quad, red, placement(1.0, {9, 9, 9}));
    builder.light(LightType::point, {0, 5, 0}, {8, 4, 2}).name = "Bulb";
    builder.light(LightType::directional, {}, glm::vec3(1.0F)).name = "Sun";
    for (int i = 0; i < 3; ++i) builder.light(LightType::point, {}, {}).name = "Spot";
    Scene scene = builder.scene;
    for (std::size_t i = 0; i < 3; ++i) scene.instances[i].name = i == 0 ? "Box" : "Wall";
    return scene;
}

inline EditTimeline read_text(std::string_view text, Scene& scene) {
    const TemporaryFolder folder;
    return read_scene_edits(folder.write("edits.json", text), scene);
}

/// `{"edits": [...]}` about a room, and what it becomes.
struct Edited {
    Scene rest = room();
    EditTimeline timeline;

    explicit Edited(const std::string& edits)
        : timeline(read_text("{\"edits\": [" + edits + "]}", rest)) {}

    [[nodiscard]] Scene at(std::uint32_t frame) const {
        Scene scene = rest;
        apply_edits(timeline, frame, scene);
        return scene;
    }
    [[nodiscard]] glm::dmat4 box_at(std::uint32_t frame) const {
        return at(frame).instances.at(0).to_world;
    }
};

}  // namespace weft::test

#endif
