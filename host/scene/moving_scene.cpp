// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/moving_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"
#include "scene/pose_scene.h"
#include "scene/validate_scene.h"

namespace weft {
namespace {

/// Whether a mesh lies where floats in kernel units reach, whose squares count as well.
bool is_in_reach(const Mesh& mesh, const glm::dmat4& to_world, const KernelUnits& units) {
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
        return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
            const glm::dvec3 size = glm::abs(units.point(
                glm::dvec3(to_world * glm::dvec4(glm::dvec3(mesh.positions[corner]), 1.0))));
            return std::max({size.x, size.y, size.z}) <= limits::max_coordinate;
        });
    });
}

/// The units are those of the scene at rest, which may be much smaller than what becomes of it.
void check_reach(const Scene& scene, const KernelUnits& units, const std::string& when) {
    for (const Instance& instance : scene.instances)
        if (instance.may_move && instance.present &&
            !is_in_reach(scene.meshes[instance.mesh], instance.to_world, units))
            throw input_error(scene.source, "instance " + quote(instance.name) + " " + when +
                                                " lies too far from the scene at rest");
}

}  // namespace

MovingScene::MovingScene(Scene scene, EditTimeline edits, double frame_rate)
    : rest_(std::move(scene)),
      edits_(std::move(edits)),
      frame_rate_(frame_rate),
      moves_(!edits_.edits.empty() || is_animated(rest_)),
      flat_(flatten(rest_)) {
    if (moves_) posed_ = rest_;
}

void MovingScene::pose(std::uint32_t frame) {
    pose_scene(rest_, frame / frame_rate_, posed_);
    apply_edits(edits_, frame, posed_);
    const std::string when = fmt::format("in frame {}", frame);
    validate_pose(posed_, when);
    check_reach(posed_, flat_.units, when);
}

void MovingScene::check_frame(std::uint32_t frame) {
    if (moves_) pose(frame);
}

void MovingScene::set_frame(std::uint32_t frame) {
    if (!moves_) return;
    pose(frame);
    update_flat(posed_, flat_);
}

}  // namespace weft
