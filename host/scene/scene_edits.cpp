// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_edits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/json_file.h"
#include "base/json_value.h"
#include "base/limits.h"
#include "base/quote.h"
#include "scene/mesh_edit.h"
#include "scene/pose_json.h"

namespace weft {
namespace {

using Json = nlohmann::json;
using Keys = std::initializer_list<const char*>;
using Names = std::map<std::string, std::vector<std::uint32_t>>;

/// The one key of `keys` that an object has.
std::string only_key(const JsonValue& value, Keys keys) {
    std::string found;
    for (const char* key : keys) {
        if (!value.find(key)) continue;
        if (!found.empty())
            throw value.error("has both '" + found + "' and '" + key + "', expected one of them");
        found = key;
    }
    if (found.empty()) throw value.error("has none of " + list_of(keys) + ", expected one of them");
    return found;
}

glm::dvec3 vector_of(const JsonValue& value, const char* key) {
    (void)value.at(key);
    const std::array<double, 3> v = value.numbers_or<3>(key, {});
    return {v[0], v[1], v[2]};
}

double factor_of(const JsonValue& value) {
    const double factor = value.as_number();
    if (factor < 0.0) throw value.error("is negative, expected a factor from 0 on");
    return factor;
}

std::optional<glm::vec3> colour_of(const JsonValue& value, const char* key, double largest,
                                   const char* expected) {
    const std::optional<JsonValue> member = value.find(key);
    if (!member) return std::nullopt;
    const glm::dvec3 colour = vector_of(value, key);
    for (int i = 0; i < 3; ++i)
        if (!(colour[i] >= 0.0 && colour[i] <= largest))
            throw member->element(static_cast<std::size_t>(i)).error(expected);
    return glm::vec3(colour);
}

std::uint32_t frame_of(const JsonValue& value) {
    constexpr std::uint64_t largest = (std::uint64_t{1} << 31) - 1;
    const std::uint64_t frame = value.as_integer();
    if (frame > largest)
        throw value.error("is " + std::to_string(frame) + ", expected a frame up to " +
                          std::to_string(largest));
    return static_cast<std::uint32_t>(frame);
}

ObjectTurn read_turn(const JsonValue& value, const Json& json) {
    ObjectTurn turn;
    turn.axis = vector_of(value, "axis");
    check_keys(value, json, {"axis", "degrees", "about"});
    turn.angle = value.at("degrees").as_number() * (std::numbers::pi / 180.0);
    if (value.find("about")) turn.about = vector_of(value, "about");
    // Divided by the largest component first, so that squares neither overflow nor underflow.
    const glm::dvec3 size = glm::abs(turn.axis);
    const double largest = std::max({size.x, size.y, size.z});
    if (!(largest > 0.0)) throw value.at("axis").error("is of length 0, expected a direction");
    turn.axis = glm::normalize(turn.axis / largest);
    return turn;
}

ObjectScale read_scale(const JsonValue& value, const Json& json) {
    const JsonValue scale = value.at("scale");
    const glm::dvec3 factor =
        json.at("scale").is_array() ? vector_of(value, "scale") : glm::dvec3(scale.as_number());
    if (!(factor.x > 0.0 && factor.y > 0.0 && factor.z > 0.0))
        throw scale.error("has a factor that is 0 or negative, expected factors above 0");
    return {factor};
}

glm::dmat4 read_placement(const JsonValue& value) {
    const glm::dmat4 to_world = matrix_of(read_pose(value));
    if (const char* flaw = transform_flaw(to_world))
        throw value.error(std::string("gives ") + flaw);
    return to_world;
}

template <typename Things>
Names names_of(const Things& things) {
    Names names;
    for (std::size_t i = 0; i < things.size(); ++i)
        if (!things[i].name.empty()) names[things[i].name].push_back(static_cast<std::uint32_t>(i));
    return names;
}

const std::vector<std::uint32_t>& look_up(const Names& names, const JsonValue& name,
                                          const char* kind) {
    const auto found = names.find(name.as_string());
    if (found == names.end())
        throw name.error(std::string("is ") + quote(name.as_string()) + ", but no " + kind +
                         " has that name");
    return found->second;
}

/// The only light or material of a name.
std::uint32_t look_up_one(const Names& names, const JsonValue& name, const char* kind) {
    const std::vector<std::uint32_t>& found = look_up(names, name, kind);
    if (found.size() > 1)
        throw name.error(std::string("is ") + quote(name.as_string()) + ", but " +
                         std::to_string(found.size()) + " " + kind +
                         "s have that name, expected one");
    return found.front();
}

/// Reads a file into a timeline and the instances that it adds, in the order of time: an object has
/// a name from when it is added until it is removed.
class EditReader {
  public:
    explicit EditReader(const Scene& scene)
        : scene_(scene),
          objects_(names_of(scene.instances)),
          lights_(names_of(scene.lights)),
          materials_(names_of(scene.materials)) {
        for (const Instance& placed : scene.instances) count(placed);
    }

    EditTimeline timeline;
    std::vector<Instance> added;

    void read(const JsonValue& root, const Json& json) {
        const JsonValue list = root.at("edits");
        check_keys(root, json, {"edits"});
        const std::size_t count = list.size();
        if (count > limits::max_scene_edits)
            throw list.error("has " + std::to_string(count) + " elements, expected at most " +
                             std::to_string(limits::max_scene_edits));
        std::vector<std::pair<std::uint32_t, std::size_t>> order;
        for (std::size_t i = 0; i < count; ++i)
            order.emplace_back(frame_of(list.element(i).at("frame")), i);
        std::sort(order.begin(), order.end());
        for (const auto& [frame, index] : order)
            timeline.edits.push_back(read_edit(list.element(index), json.at("edits")[index]));
    }

  private:
    SceneEdit read_edit(const JsonValue& value, const Json& json) {
        const std::string target = only_key(value, {"object", "light", "material"});
        SceneEdit edit;
        edit.place = value.place();
        edit.frame = frame_of(value.at("frame"));
        edit.until = edit.frame;
        if (const std::optional<JsonValue> until = value.find("until")) {
            edit.until = frame_of(*until);
            if (edit.until <= edit.frame)
                throw until->error("is " + std::to_string(edit.until) +
                                   ", expected a frame after " + std::to_string(edit.frame));
        }
        if (target == "object") read_object_edit(value, json, edit);
        if (target == "light") read_light_edit(value, json, edit);
        if (target == "material") read_material_edit(value, json, edit);
        return edit;
    }

    void read_object_edit(const JsonValue& value, const Json& json, SceneEdit& edit) {
        check_keys(value, json,
                   {"frame", "until", "object", "move", "rotate", "scale", "remove", "add"});
        const std::string kind = only_key(value, {"move", "rotate", "scale", "remove", "add"});
        const JsonValue name = value.at("object");
        const JsonValue change = value.at(kind.c_str());
        edit.place = change.place();
        const std::vector<std::uint32_t>& instances = look_up(objects_, name, "object");
        if (instances.size() > limits::max_edit_targets - targets_)
            throw value.error("brings the file above the limit of " +
                              std::to_string(limits::max_edit_targets) +
                              " changes of placed meshes");
        targets_ += instances.size();
        edit.targets = instances;
        const auto removed = removed_.find(name.as_string());
        // A removed object may still be copied.
        if (kind != "add" && removed != removed_.end())
            throw name.error("is " + quote(name.as_string()) + ", which is removed at frame " +
                             std::to_string(removed->second));
        if ((kind == "remove" || kind == "add") && edit.until != edit.frame)
            throw value.at("until").error("has no meaning, '" + kind + "' happens at once");
        if (kind == "move") edit.change = ObjectMove{vector_of(value, "move")};
        if (kind == "rotate") edit.change = read_turn(change, json.at(kind));
        if (kind == "scale") edit.change = read_scale(value, json);
        if (kind == "remove") {
            if (!change.as_bool()) throw change.error("is false, expected true");
            edit.change = ObjectPresence{false};
            removed_[name.as_string()] = edit.frame;
        }
        if (kind == "add") {
            edit.change = ObjectPresence{true};
            edit.targets = add_object(change, json.at(kind), edit.targets);
        }
    }

    /// Copies instances under a new name, and returns where the copies will be.
    std::vector<std::uint32_t> add_object(const JsonValue& value, const Json& json,
                                          const std::vector<std::uint32_t>& originals) {
        const JsonValue name = value.at("name");
        check_keys(value, json, {"name", "translation", "rotation", "scale", "material"});
        const std::string& text = name.as_string();
        if (text.empty() || text.size() > limits::max_name_bytes)
            throw name.error("has " + std::to_string(text.size()) + " bytes, expected 1 to " +
                             std::to_string(limits::max_name_bytes));
        if (objects_.contains(text))
            throw name.error("is " + quote(text) + ", which an object is called already");
        const glm::dmat4 to_world = read_placement(value);
        const std::optional<JsonValue> material = value.find("material");
        std::vector<std::uint32_t> copies;
        const Instance first = instance(originals.front());
        for (const std::uint32_t index : originals) {
            Instance copy = instance(index);
            // Only the parts of one node: where other nodes have that name, copies would coincide.
            if (copy.to_world != first.to_world || copy.motion.node != first.motion.node) continue;
            copy.name = text;
            if (material) copy.material = look_up_one(materials_, *material, "material");
            copy.to_world = to_world;
            copy.motion = {};
            copy.may_move = true;
            copy.present = false;
            count_copy(value, copy);
            copies.push_back(static_cast<std::uint32_t>(scene_.instances.size() + added.size()));
            added.push_back(std::move(copy));
        }
        objects_[text] = copies;
        return copies;
    }

    void count_copy(const JsonValue& value, const Instance& copy) {
        const auto check = [&](std::size_t count, std::size_t most, const char* what) {
            if (count > most)
                throw value.error("brings the scene above the limit of " + std::to_string(most) +
                                  " " + what);
        };
        count(copy);
        check(scene_.instances.size() + scene_.medium_boundaries.size() + added.size() + 1,
              limits::max_instances, "placed meshes");
        check(triangles_, limits::max_triangles, "triangles");
        check(vertices_, limits::max_vertices, "placed vertices");
        if (!is_within_limits(scene_.meshes[copy.mesh], copy.to_world))
            throw value.error("is placed too far from the origin");
    }

    void read_light_edit(const JsonValue& value, const Json& json, SceneEdit& edit) const {
        check_keys(value, json, {"frame", "until", "light", "intensity", "move"});
        const std::uint32_t light = look_up_one(lights_, value.at("light"), "light");
        LightChange change;
        const std::optional<JsonValue> factor = value.find("intensity");
        const std::optional<JsonValue> move = value.find("move");
        if (!factor && !move) throw value.error("lacks a change, expected 'intensity' or 'move'");
        if (factor) change.factor = factor_of(*factor);
        if (move) change.move = vector_of(value, "move");
        if (move && scene_.lights[light].type == LightType::directional)
            throw move->error("moves a directional light, which is nowhere");
        edit.targets = {light};
        edit.change = change;
    }

    void read_material_edit(const JsonValue& value, const Json& json, SceneEdit& edit) const {
        check_keys(
            value, json,
            {"frame", "until", "material", "albedo", "emission", "emission_factor", "roughness"});
        edit.targets = {look_up_one(materials_, value.at("material"), "material")};
        MaterialChange change;
        change.albedo = colour_of(value, "albedo", 1.0, "is outside [0, 1]");
        change.emission = colour_of(value, "emission", std::numeric_limits<float>::max(),
                                    "is negative or not finite as a float");
        const std::optional<JsonValue> factor = value.find("emission_factor");
        if (factor) change.emission_factor = factor_of(*factor);
        const std::optional<JsonValue> roughness = value.find("roughness");
        if (roughness) {
            change.roughness = roughness->as_number();
            if (!(*change.roughness >= 0.0 && *change.roughness <= 1.0))
                throw roughness->error("is outside [0, 1]");
            // Of a scene that was read as diffuse nobody knows, and nothing is changed.
            if (scene_.detail == MaterialDetail::full &&
                !perceived_roughness(scene_.materials[edit.targets.front()]))
                throw roughness->error("is for a material that has none");
        }
        if (!change.albedo && !change.emission && !factor && !roughness)
            throw value.error(
                "lacks a change, expected 'albedo', 'emission', 'emission_factor' or 'roughness'");
        edit.change = change;
    }

    [[nodiscard]] const Instance& instance(std::uint32_t index) const {
        const std::size_t count = scene_.instances.size();
        return index < count ? scene_.instances[index] : added[index - count];
    }

    void count(const Instance& placed) {
        const Mesh& mesh = scene_.meshes[placed.mesh];
        triangles_ += mesh.triangles.size();
        vertices_ += mesh.positions.size();
    }

    const Scene& scene_;
    Names objects_, lights_, materials_;
    std::map<std::string, std::uint32_t> removed_;  ///< name, frame
    std::size_t targets_ = 0;
    std::size_t triangles_ = 0;  ///< placed, as `vertices_`
    std::size_t vertices_ = 0;
};

}  // namespace

EditTimeline read_scene_edits(const std::filesystem::path& file, Scene& scene) {
    return read_scene_edits(read_json_file(file, limits::max_text_file_bytes), file.string(),
                            scene);
}

EditTimeline read_scene_edits(const Json& json, const std::string& place, Scene& scene) {
    EditReader reader(scene);
    reader.read({json, place + "#"}, json);
    scene.instances.insert(scene.instances.end(), reader.added.begin(), reader.added.end());
    for (const SceneEdit& edit : reader.timeline.edits)
        if (edit.is_of_object())
            for (const std::uint32_t index : edit.targets) scene.instances[index].may_move = true;
    return std::move(reader.timeline);
}

}  // namespace weft
