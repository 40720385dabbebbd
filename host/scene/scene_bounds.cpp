// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_bounds.h"

namespace weft {

SceneBounds bounds_of(const Scene& scene, BoundsOf which) {
    SceneBounds bounds;
    for (const Instance& instance : scene.instances) {
        if (!instance.present) continue;
        if (which != BoundsOf::all && instance.may_move != (which == BoundsOf::moving)) continue;
        const Mesh& mesh = scene.meshes[instance.mesh];
        for (const auto& triangle : mesh.triangles)
            for (const std::uint32_t vertex : triangle)
                bounds.add(glm::dvec3(instance.to_world *
                                      glm::dvec4(glm::dvec3(mesh.positions[vertex]), 1.0)));
    }
    return bounds;
}

}  // namespace weft
