// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/moving_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <variant>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"
#include "scene/pose_scene.h"
#include "scene/validate_scene.h"

namespace weft {
namespace {

/// Whether coordinates of a mesh and their squares are finite floats in kernel units.
bool is_in_reach(const Mesh& mesh, const glm::dmat4& to_world, const KernelUnits& units) {
    return std::all_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const auto& triangle) {
        return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t corner) {
            const glm::dvec3 size = glm::abs(units.point(
                glm::dvec3(to_world * glm::dvec4(glm::dvec3(mesh.positions[corner]), 1.0))));
            return std::max({size.x, size.y, size.z}) <= limits::max_coordinate;
        });
    });
}

/// Refuses meshes that are out of reach of the kernel units: these are those of the scene at rest,
/// which may be much smaller than the scene at another time.
void check_reach(const Scene& scene, const KernelUnits& units, const std::string& when) {
    for (const Instance& instance : scene.instances)
        if (instance.may_move && instance.present &&
            !is_in_reach(scene.meshes[instance.mesh], instance.to_world, units))
            throw input_error(scene.source, "instance " + quote(instance.name) + " " + when +
                                                " lies too far from the scene at rest");
}

/// Checks that the targets of edits, which are indices, still exist.
void check_targets(const EditTimeline& timeline, const Scene& scene) {
    for (const SceneEdit& edit : timeline.edits) {
        const std::size_t count = edit.is_of_object() ? scene.instances.size()
                                  : std::holds_alternative<LightChange>(edit.change)
                                      ? scene.lights.size()
                                      : scene.materials.size();
        if (std::any_of(edit.targets.begin(), edit.targets.end(),
                        [&](std::uint32_t target) { return target >= count; }))
            throw input_error(edit.place, "changes what is no longer in the scene");
    }
}

bool same_attachment(const Attachment& a, const Attachment& b) {
    return a.node == b.node && a.to_node == b.to_node;
}

/// Whether both are flattened alike, wherever those are that may move.
bool flattens_alike(const Instance& a, const Instance& b) {
    return a.mesh == b.mesh && a.material == b.material && a.may_move == b.may_move &&
           a.deformation == b.deformation && same_attachment(a.motion, b.motion);
}

/// Whether update_flat can follow the changes of instances: only those that may move are elsewhere.
/// Marks others that have moved as instances that may move from now on.
bool let_moved_move(const std::vector<Instance>& before, std::vector<Instance>& now) {
    if (before.size() != now.size()) return false;
    bool can_follow = true;
    for (std::size_t i = 0; i < now.size(); ++i) {
        const Instance& old = before[i];
        Instance& instance = now[i];
        const bool is_elsewhere = old.to_world != instance.to_world ||
                                  old.flip_normals != instance.flip_normals ||
                                  old.present != instance.present;
        if (is_elsewhere && !instance.may_move) instance.may_move = true;
        can_follow = can_follow && flattens_alike(old, instance);
    }
    return can_follow;
}

/// Whether materials differ by colours alone.
bool same_materials(const std::vector<Material>& before, const std::vector<Material>& now) {
    return std::equal(before.begin(), before.end(), now.begin(), now.end(),
                      [](const Material& a, const Material& b) {
                          return lobe_of(a) == lobe_of(b) &&
                                 albedo_texture(a) == albedo_texture(b) &&
                                 a.two_sided == b.two_sided;
                      });
}

/// Whether both have as many lights of the same kinds, carried by the same nodes.
bool same_lights(const std::vector<PunctualLight>& before, const std::vector<PunctualLight>& now) {
    return std::equal(before.begin(), before.end(), now.begin(), now.end(),
                      [](const PunctualLight& a, const PunctualLight& b) {
                          return a.type == b.type && same_attachment(a.motion, b.motion);
                      });
}

/// Whether both are there or not, with the same image at the same place.
bool same_environments(const std::optional<Environment>& before,
                       const std::optional<Environment>& now) {
    if (!before || !now) return before.has_value() == now.has_value();
    return before->image == now->image && (!now->image || before->to_world == now->to_world);
}

}  // namespace

MovingScene::MovingScene(Scene scene, EditTimeline edits, double frame_rate)
    : rest_(std::move(scene)),
      edits_(std::move(edits)),
      frame_rate_(frame_rate),
      moves_(!edits_.edits.empty() || is_animated(rest_)),
      flat_(flatten(rest_)),
      first_powers_(flat_.first_powers) {
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

SceneBounds MovingScene::bounds(std::uint32_t first, std::uint32_t end) {
    if (!moves_) return bounds_of(rest_);
    constexpr std::uint64_t most = 64;
    const std::uint64_t last = end - first - 1;
    const std::uint64_t count = std::min(most, last + 1);
    SceneBounds bounds = bounds_of(rest_, BoundsOf::still);
    for (std::uint64_t i = 0; i < count; ++i) {
        pose(first + static_cast<std::uint32_t>(i * last / std::max<std::uint64_t>(1, count - 1)));
        bounds.add(bounds_of(posed_, BoundsOf::moving));
    }
    return bounds;
}

void MovingScene::set_frame(std::uint32_t frame) {
    if (!moves_) return;
    pose(frame);
    update_flat(posed_, flat_);
    frame_ = frame;
    posed_once_ = true;
}

void MovingScene::flatten_anew() {
    validate_scene(rest_);
    check_targets(edits_, rest_);
    FlatScene flat = flatten(rest_);
    std::swap(flat, flat_);
    std::vector<double> powers = std::exchange(first_powers_, flat_.first_powers);
    const bool moves = std::exchange(moves_, !edits_.edits.empty() || is_animated(rest_));
    Scene posed = std::exchange(posed_, moves_ ? rest_ : Scene{});
    try {
        if (posed_once_) set_frame(frame_);
    } catch (...) {
        std::swap(flat, flat_);
        first_powers_ = std::move(powers);
        moves_ = moves;
        posed_ = std::move(posed);
        throw;
    }
}

void MovingScene::update_in_place() {
    if (moves_ && posed_once_) {
        set_frame(frame_);
        return;
    }
    const std::string when = "after an edit";
    validate_pose(rest_, when);
    check_reach(rest_, flat_.units, when);
    update_flat(rest_, flat_);
}

bool MovingScene::edit(const std::function<void(const SceneParts&)>& change) {
    const std::vector<Instance> instances = rest_.instances;
    const std::vector<Material> materials = rest_.materials;
    const std::vector<PunctualLight> lights = rest_.lights;
    const std::optional<Environment> environment = rest_.environment;
    unedited_.reset();
    try {
        change({rest_.instances, rest_.materials, rest_.lights, rest_.environment});
        const bool moved_all_may = let_moved_move(instances, rest_.instances);
        const bool in_place = moved_all_may && same_materials(materials, rest_.materials) &&
                              same_lights(lights, rest_.lights) &&
                              same_environments(environment, rest_.environment);
        if (in_place)
            update_in_place();
        else
            flatten_anew();
        return in_place;
    } catch (...) {
        rest_.instances = instances;
        rest_.materials = materials;
        rest_.lights = lights;
        rest_.environment = environment;
        throw;
    }
}

bool MovingScene::set_edits(const std::function<EditTimeline(Scene&)>& read, std::uint32_t frame) {
    if (!unedited_) unedited_ = rest_.instances;
    std::vector<Instance> instances = std::exchange(rest_.instances, *unedited_);
    EditTimeline edits = std::exchange(edits_, {});
    const std::uint32_t old_frame = std::exchange(frame_, frame);
    const bool posed = posed_once_;
    const bool moved = moves_;
    try {
        edits_ = read(rest_);
        const bool moves = !edits_.edits.empty() || is_animated(rest_);
        const bool in_place =
            std::equal(instances.begin(), instances.end(), rest_.instances.begin(),
                       rest_.instances.end(), flattens_alike);
        posed_once_ = moves;
        if (!in_place) {
            flatten_anew();
            return false;
        }
        if (moves && !moves_) posed_ = rest_;
        moves_ = moves;
        if (moves) pose(frame);
        // A light that some earlier edit made shine did so in no frame of these edits.
        flat_.first_powers = first_powers_;
        update_flat(now(), flat_);
        if (!moves) posed_ = Scene{};
        return true;
    } catch (...) {
        rest_.instances = std::move(instances);
        edits_ = std::move(edits);
        frame_ = old_frame;
        posed_once_ = posed;
        moves_ = moved;
        throw;
    }
}

void MovingScene::rebuild(const std::function<void(Scene&)>& change) {
    unedited_.reset();
    Scene before = rest_;
    try {
        change(rest_);
        flatten_anew();
    } catch (...) {
        rest_ = std::move(before);
        throw;
    }
}

}  // namespace weft
