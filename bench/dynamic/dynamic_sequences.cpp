// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/dynamic/dynamic_sequences.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <numeric>
#include <utility>

#include "bench/dynamic/sequence_props.h"
#include "bench/dynamic/sequence_stage.h"
#include "scene/flat_scene.h"

namespace weft::bench {
namespace {

constexpr std::array names{"box",   "lamp", "switch",    "camera",
                           "still", "door", "furniture", "figure"};

// Of the distance from the camera to what it looks at.
constexpr double box_distance = 0.75;
constexpr double box_edge = 0.08;
constexpr double box_step = 0.01;
constexpr double flight_step = 0.004;
constexpr double longest_flight = 0.5;
constexpr double furniture_size = 0.15;
constexpr double furniture_slide = 0.08;

constexpr double degrees_a_frame = 0.25;
constexpr double frames_a_swing = 48.0;  // there and back again
constexpr float dimming = 0.97F;         // from frame to frame

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

}  // namespace

const char* to_string(Event event) {
    return names[static_cast<std::size_t>(event)];
}

std::vector<std::string> event_names() {
    return {names.begin(), names.end()};
}

std::vector<Event> events_in(const std::string& scene) {
    std::vector<Event> found{Event::box, Event::area_light, Event::switching, Event::camera,
                             Event::still};
    if (scene == "office")
        for (const Event event : {Event::door, Event::furniture}) found.push_back(event);
    if (scene == "sibenik") found.push_back(Event::figure);
    return found;
}

DynamicSequence::DynamicSequence(Scene scene, const Camera& camera, SceneProbe& probe, Event event,
                                 std::uint32_t frames)
    : first_(std::move(scene)),
      camera_(camera),
      event_(event),
      frames_(frames),
      distance_(view_distance(camera, probe)) {
    for (Instance& instance : first_.instances) instance.may_move = false;
    if (event == Event::box) add_box(camera, distance_);
    if (event == Event::door) add_door(camera, probe);
    if (event == Event::furniture) add_furniture(camera, probe);
    if (event == Event::figure) add_figure(camera, probe);
    if (event == Event::switching) choose_area_light();
    now_ = first_;
}

void DynamicSequence::add(const Mesh& mesh, const glm::vec3& colour, const Prop& prop) {
    Material material;
    material.name = mesh.name;
    material.surface = DiffuseSurface{colour};
    first_.materials.push_back(material);
    first_.meshes.push_back(mesh);
    Instance instance;
    instance.name = mesh.name;
    instance.mesh = static_cast<std::uint32_t>(first_.meshes.size() - 1);
    instance.material = static_cast<std::uint32_t>(first_.materials.size() - 1);
    instance.to_world = prop.place;
    instance.may_move = true;
    first_.instances.push_back(instance);
    props_.push_back(prop);
}

void DynamicSequence::add_box(const Camera& camera, double distance) {
    const glm::dvec3 forward = -glm::normalize(glm::dvec3(camera.to_world[2]));
    const glm::dvec3 step = box_step * distance * glm::normalize(glm::dvec3(camera.to_world[0]));
    const glm::dvec3 at =
        glm::dvec3(camera.to_world[3]) + box_distance * distance * forward - 6.0 * step;
    Prop box;
    box.place = glm::scale(glm::translate(glm::dmat4(1.0), at), glm::dvec3(box_edge * distance));
    box.slide = step;
    add(prop_box(), {0.7F, 0.5F, 0.3F}, box);
}

void DynamicSequence::add_door(const Camera& camera, SceneProbe& probe) {
    SequenceStage stage(camera, probe);
    const SequenceStage::Side side = stage.side();
    Prop door;
    // Shut, it would lie along the wall.
    door.place = stage.standing(side.foot, -stage.ahead(), 0.75 * side.height);
    door.axis = stage.up();
    const bool wall_is_right = glm::dot(side.inwards, stage.right()) < 0.0;
    // Seen from above, it opens away from its wall.
    const double sense = wall_is_right ? -1.0 : 1.0;
    door.first_turn = sense * radians(45.0);
    door.turn = sense * radians(40.0);
    add(prop_door(), {0.5F, 0.3F, 0.15F}, door);
}

void DynamicSequence::add_furniture(const Camera& camera, SceneProbe& probe) {
    SequenceStage stage(camera, probe);
    std::vector<glm::dvec3> places = stage.free_places(3);
    constexpr std::array<std::array<double, 2>, 3> spare{{{0.7, 0.0}, {0.8, -0.2}, {0.8, 0.2}}};
    while (places.size() < spare.size())
        places.push_back(stage.floor_at(spare[places.size()][0], spare[places.size()][1]));
    const std::array meshes{prop_table(), prop_chair(), prop_shelf()};
    const std::array<glm::vec3, 3> colours{
        {{0.6F, 0.4F, 0.2F}, {0.2F, 0.4F, 0.6F}, {0.7F, 0.7F, 0.6F}}};
    const std::array ways{stage.right(), stage.ahead(), -stage.right()};
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        Prop prop;
        prop.place = stage.standing(places[i], stage.right(), furniture_size * stage.depth());
        prop.slide = furniture_slide * stage.depth() * ways[i];
        prop.axis = stage.up();
        prop.turn = radians(i == 1 ? -40.0 : 30.0);
        add(meshes[i], colours[i], prop);
    }
}

void DynamicSequence::add_figure(const Camera& camera, SceneProbe& probe) {
    SequenceStage stage(camera, probe);
    Prop figure;
    const double height = std::min(1.2 * stage.eye_height(), 0.35 * stage.depth());
    figure.place = stage.standing(stage.floor_at(0.45, 0.0), stage.right(), height);
    add(prop_figure(), {0.6F, 0.45F, 0.35F}, figure);
}

void DynamicSequence::choose_area_light() {
    const FlatScene flat = flatten(first_);
    const std::size_t materials = first_.materials.size();
    std::vector<double> powers(materials + first_.lights.size(), 0.0);
    for (std::size_t i = 0; i < first_.instances.size(); ++i)
        powers[first_.instances[i].material] += flat.first_powers[i];
    for (std::size_t i = 0; i < first_.lights.size(); ++i)
        powers[materials + i] = flat.first_powers[first_.instances.size() + i];
    area_light_ =
        static_cast<std::size_t>(std::max_element(powers.begin(), powers.end()) - powers.begin());
    const double all = std::accumulate(flat.first_powers.begin(), flat.first_powers.end(), 0.0);
    // In the dark there would be nothing to compare.
    constexpr double enough = 0.01;
    area_light_dark_ = all - powers[area_light_] > enough * all ? 0.0F : 0.1F;
}

void DynamicSequence::move_props(std::uint32_t frame) {
    const double phase = 2.0 * std::numbers::pi * frame / frames_a_swing;
    const double swing = event_ == Event::box ? frame : std::sin(phase);
    const std::size_t first = now_.instances.size() - props_.size();
    for (std::size_t i = 0; i < props_.size(); ++i) {
        const Prop& prop = props_[i];
        glm::dmat4 turned = prop.place;
        if (prop.axis != glm::dvec3(0.0)) {
            const glm::dvec4 origin = std::exchange(turned[3], glm::dvec4(0.0, 0.0, 0.0, 1.0));
            turned = glm::rotate(glm::dmat4(1.0), prop.first_turn + swing * prop.turn, prop.axis) *
                     turned;
            turned[3] = origin;
        }
        turned[3] += glm::dvec4(swing * prop.slide, 0.0);
        now_.instances[first + i].to_world = turned;
    }
    // The instance has a mesh of its own: where its vertices are, is all that tells its shape.
    if (event_ == Event::figure) pose_figure(now_.meshes.back(), 2.0 * phase);
}

void DynamicSequence::dim_lights(std::uint32_t frame) {
    const float factor = std::pow(dimming, static_cast<float>(frame));
    const glm::vec3 tint(factor, factor * factor, factor * factor);
    for (std::size_t i = 0; i < now_.materials.size(); ++i)
        now_.materials[i].emission.radiance = first_.materials[i].emission.radiance * tint;
    for (std::size_t i = 0; i < now_.lights.size(); ++i)
        now_.lights[i].intensity = first_.lights[i].intensity * tint;
}

void DynamicSequence::switch_area_light(std::uint32_t frame) {
    constexpr glm::vec3 warm(1.0F, 0.6F, 0.3F);
    const std::uint32_t third = std::max(1U, frames_ / 3);
    const glm::vec3 tint = frame < third       ? glm::vec3(1.0F)
                           : frame < 2 * third ? glm::vec3(area_light_dark_)
                                               : warm;
    const std::size_t materials = now_.materials.size();
    if (area_light_ < materials)
        now_.materials[area_light_].emission.radiance =
            first_.materials[area_light_].emission.radiance * tint;
    else
        now_.lights[area_light_ - materials].intensity =
            first_.lights[area_light_ - materials].intensity * tint;
}

const Scene& DynamicSequence::at(std::uint32_t frame) {
    move_props(frame);
    if (event_ == Event::area_light) dim_lights(frame);
    if (event_ == Event::switching) switch_area_light(frame);
    return now_;
}

Camera DynamicSequence::camera_at(std::uint32_t frame) const {
    Camera camera = camera_;
    if (event_ != Event::camera) return camera;
    const double angle = radians(degrees_a_frame) * frame;
    const glm::dvec4 x = camera_.to_world[0];
    const glm::dvec4 z = camera_.to_world[2];
    camera.to_world[0] = x * std::cos(angle) - z * std::sin(angle);
    camera.to_world[2] = x * std::sin(angle) + z * std::cos(angle);
    const double way = std::min(flight_step * frame, longest_flight) * distance_;
    camera.to_world[3] -= glm::dvec4(way * glm::normalize(glm::dvec3(z)), 0.0);
    return camera;
}

}  // namespace weft::bench
