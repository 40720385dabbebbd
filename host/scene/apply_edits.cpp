// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <variant>

#include "base/error.h"
#include "base/finite.h"
#include "base/limits.h"
#include "scene/mesh_edit.h"
#include "scene/scene_edits.h"
#include "scene/transform.h"

namespace weft {
namespace {

/// Interpolates from `a` to `b`, exactly at both ends and where they are the same.
template <typename T>
T blend(const T& a, const T& b, double share) {
    return a == b ? b : a * (1.0 - share) + b * share;
}

/// Numbers as floats, which the scene keeps.
glm::vec3 as_floats(const glm::dvec3& value, const SceneEdit& edit) {
    for (int i = 0; i < 3; ++i)
        if (!(std::abs(value[i]) <= static_cast<double>(std::numeric_limits<float>::max())))
            throw input_error(edit.place, "makes a value that is not finite as a float");
    return glm::vec3(value);
}

[[noreturn]] void refuse_place(const SceneEdit& edit) {
    throw input_error(edit.place, "puts something too far from the origin");
}

/// Applies a share of one edit to its targets.
struct Change {
    const SceneEdit& edit;
    double share;
    Scene& scene;

    void operator()(const ObjectMove& move) const {
        glm::dmat4 motion(1.0);
        motion[3] = glm::dvec4(move.by * share, 1.0);
        transform([&](const glm::dmat4& to_world) { return motion * to_world; });
    }

    void operator()(const ObjectTurn& turn) const {
        const double half = 0.5 * turn.angle * share;
        Pose pose;
        pose.rotation = glm::dvec4(turn.axis * std::sin(half), std::cos(half));
        glm::dmat4 motion = matrix_of(pose);
        const glm::dvec3 origin(scene.instances[edit.targets.front()].to_world[3]);
        const glm::dvec3 centre = turn.about.value_or(origin);
        motion[3] = glm::dvec4(centre - glm::dmat3(motion) * centre, 1.0);
        transform([&](const glm::dmat4& to_world) { return motion * to_world; });
    }

    void operator()(const ObjectScale& scale) const {
        glm::dmat4 motion(1.0);
        for (int i = 0; i < 3; ++i) motion[i][i] = std::pow(scale.factor[i], share);
        transform([&](const glm::dmat4& to_world) { return to_world * motion; });
    }

    void operator()(const ObjectPresence& presence) const {
        for (const std::uint32_t index : edit.targets)
            scene.instances[index].present = presence.present;
    }

    void operator()(const LightChange& change) const {
        for (const std::uint32_t index : edit.targets) {
            PunctualLight& light = scene.lights[index];
            light.intensity =
                as_floats(glm::dvec3(light.intensity) * blend(1.0, change.factor, share), edit);
            light.position += change.move * share;
            const glm::dvec3 size = glm::abs(light.position);
            // Also false for NaN.
            if (!(std::max({size.x, size.y, size.z}) <= limits::max_coordinate)) refuse_place(edit);
        }
    }

    void operator()(const MaterialChange& change) const {
        for (const std::uint32_t index : edit.targets) {
            Material& material = scene.materials[index];
            if (change.albedo) {
                glm::vec3 albedo = diffuse_albedo(material);
                fade(albedo, glm::dvec3(*change.albedo));
                set_diffuse_albedo(material, albedo);
            }
            fade(material.emission.radiance,
                 glm::dvec3(change.emission.value_or(material.emission.radiance)) *
                     change.emission_factor);
            if (change.roughness) fade_roughness(material, *change.roughness, share);
        }
    }

  private:
    void fade(glm::vec3& value, const glm::dvec3& goal) const {
        value = as_floats(blend(glm::dvec3(value), goal, share), edit);
    }

    template <typename Map>
    void transform(const Map& map) const {
        for (const std::uint32_t index : edit.targets) {
            glm::dmat4& to_world = scene.instances[index].to_world;
            to_world = map(to_world);
            if (const char* flaw = transform_flaw(to_world))
                throw input_error(edit.place, std::string("makes ") + flaw);
        }
    }
};

}  // namespace

const char* transform_flaw(const glm::dmat4& to_world) {
    const double determinant = glm::determinant(glm::dmat3(to_world));
    if (!is_finite(to_world) || !std::isfinite(determinant))
        return "a transform that is not finite";
    if (is_singular(to_world) || !std::isfinite(1.0 / determinant))
        return "a transform that cannot be inverted";
    return nullptr;
}

double SceneEdit::share_at(std::uint32_t at) const noexcept {
    if (at < frame) return 0.0;
    if (at >= until) return 1.0;
    return (static_cast<double>(at - frame) + 1.0) / (static_cast<double>(until - frame) + 1.0);
}

void apply_edits(const EditTimeline& timeline, std::uint32_t frame, Scene& scene) {
    std::map<std::uint32_t, const SceneEdit*> moved;  // instances, with the last edit of each
    for (const SceneEdit& edit : timeline.edits) {
        if (edit.frame > frame) break;
        std::visit(Change{edit, edit.share_at(frame), scene}, edit.change);
        if (!edit.is_of_object()) continue;
        for (const std::uint32_t index : edit.targets) moved[index] = &edit;
    }
    // Only the result of all edits is checked, since steps on the way are never rendered.
    for (const auto& [index, edit] : moved) {
        const Instance& instance = scene.instances[index];
        if (!instance.present) continue;
        if (!is_within_limits(scene.meshes[instance.mesh], instance.to_world)) refuse_place(*edit);
    }
}

}  // namespace weft
