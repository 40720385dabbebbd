// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SCENE_EDITS_H
#define WEFT_SCENE_SCENE_EDITS_H

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "scene/scene.h"

namespace weft {

/// Moves an object by a vector of the world, scene units.
struct ObjectMove {
    glm::dvec3 by{0.0};
};

/// Turns an object about an axis of the world.
struct ObjectTurn {
    glm::dvec3 axis{0.0, 1.0, 0.0};   ///< unit
    double angle = 0.0;               ///< radians, counter-clockwise seen against the axis
    std::optional<glm::dvec3> about;  ///< a point of the axis; default: the present origin of the
                                      ///< object's first instance
};

/// Scales an object about its own origin and along its own axes.
struct ObjectScale {
    glm::dvec3 factor{1.0};  ///< above 0
};

/// Adds an object, whose instances are in the scene already, or removes it.
struct ObjectPresence {
    bool present = true;
};

/// Changes a light without area.
struct LightChange {
    double factor = 1.0;   ///< of the intensity, not negative
    glm::dvec3 move{0.0};  ///< scene units
};

/// Changes a material, wherever it is used.
struct MaterialChange {
    std::optional<glm::vec3> albedo;    ///< new value, [0,1]
    std::optional<glm::vec3> emission;  ///< new value before `emission_factor`, W/(m^2 sr)
    double emission_factor = 1.0;       ///< not negative
    std::optional<double> roughness;    ///< new value, perceived, [0,1]
};

/// A change of a scene: a part of it at every frame from `frame` to `until`, all of it from then
/// on.
struct SceneEdit {
    std::string place;  ///< `file#/json/pointer`, for messages
    std::uint32_t frame = 0;
    std::uint32_t until = 0;             ///< equals `frame` where the change is immediate
    std::vector<std::uint32_t> targets;  ///< indices of instances, or of one light or material
    std::variant<ObjectMove, ObjectTurn, ObjectScale, ObjectPresence, LightChange, MaterialChange>
        change;

    /// Whether `targets` are of Scene::instances.
    [[nodiscard]] bool is_of_object() const noexcept { return change.index() < 4; }

    /// The share of the change that is applied at frame `at`, [0,1].
    [[nodiscard]] double share_at(std::uint32_t at) const noexcept;
};

/// The edits of a scene over the frames to be made.
struct EditTimeline {
    std::vector<SceneEdit> edits;  ///< by frame; those of one frame in the order of the file
};

/// Reads a file of edits and resolves its names in `scene`, which must be valid. Marks the
/// instances that an edit moves, turns, scales or removes with Instance::may_move, and appends
/// those that edits add: not present, and marked as well. Throws Error (exit code 2) where the file
/// or a value of it is wrong; `scene` is then as before.
[[nodiscard]] EditTimeline read_scene_edits(const std::filesystem::path& file, Scene& scene);

/// The same for edits that are read already, from what messages call `place`.
[[nodiscard]] EditTimeline read_scene_edits(const nlohmann::json& json, const std::string& place,
                                            Scene& scene);

/// What makes a transform to the world unusable, as `a transform that ...`, or null.
[[nodiscard]] const char* transform_flaw(const glm::dmat4& to_world);

/// Applies the edits up to `frame`, in order, to `scene`, which is at that frame without edits. It
/// must have the instances, lights and materials of the scene that the timeline was read for.
/// Throws Error (exit code 2) with the place of the edit that makes a transform singular, a number
/// not finite, or puts something too far from the origin; `scene` is then partly edited and must
/// not be used.
void apply_edits(const EditTimeline& timeline, std::uint32_t frame, Scene& scene);

}  // namespace weft

#endif
