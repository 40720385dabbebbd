// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_report.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/stage.h"
#include "scene/field_of_view.h"

namespace weft {
namespace {

using Json = nlohmann::json;

/// A column of a camera's transform: where it stands, or an axis of any length.
glm::dvec3 column(const Camera& camera, int i) {
    return {camera.to_world[i]};
}

/// The names that things have, each once; those that `alone` asks to be of one thing only.
template <class Things>
std::vector<std::size_t> named_once(const Things& things, bool alone) {
    // Lists that nobody can read only cost time.
    constexpr std::size_t most = 2000;
    std::map<std::string, std::size_t> uses;
    for (const auto& thing : things) ++uses[thing.name];
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < things.size() && found.size() < most; ++i) {
        std::size_t& count = uses[things[i].name];
        if (things[i].name.empty() || count == 0 || (alone && count > 1)) continue;
        count = 0;
        found.push_back(i);
    }
    return found;
}

const char* name_of_type(LightType type) {
    if (type == LightType::directional) return "directional";
    return type == LightType::spot ? "spot" : "point";
}

Json finite(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

Json estimate_report(const std::optional<ErrorEstimate>& estimate) {
    if (!estimate || !std::isfinite(estimate->value)) return {};
    return {{"value", estimate->value},
            {"low", finite(estimate->low)},
            {"high", finite(estimate->high)}};
}

}  // namespace

Json vector_report(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

glm::dvec3 centre_of(const FlatScene& scene) {
    return scene.units.centre;
}

double radius_of(const FlatScene& scene) {
    return static_cast<double>(scene.radius) / scene.units.scale;
}

Json settings_report(const ViewChoice& choice, bool paused) {
    Json compare;
    if (choice.comparison)
        compare = {{"algorithm", to_string(choice.comparison->algorithm)},
                   {"quality", to_string(choice.comparison->quality)},
                   {"seconds", choice.comparison->seconds}};
    return {{"algorithm", to_string(choice.algorithm)},
            {"quality", to_string(choice.quality)},
            {"size", {choice.size.width, choice.size.height}},
            {"exposure", choice.exposure_ev},
            {"tone", to_string(choice.tone)},
            {"paused", paused},
            {"camera", choice.camera},
            {"placed", choice.placement.view.has_value()},
            {"frame", choice.frame},
            {"samples", choice.samples.value_or(0)},
            {"overlay", choice.overlay},
            {"compare", compare},
            {"trust", choice.trust}};
}

Json camera_report(const Camera& camera, const CameraPlacement& placement, const FlatScene& scene) {
    CameraView view;
    if (placement.view) {
        view = *placement.view;
    } else {
        constexpr double least_share = 0.1;
        const glm::dvec3 forward = viewing_axis(camera);
        view.from = column(camera, 3);
        const double along = glm::dot(centre_of(scene) - view.from, forward);
        view.at = view.from + forward * std::max(along, least_share * radius_of(scene));
        view.up = glm::normalize(column(camera, 1));
    }
    return {{"from", vector_report(view.from)},
            {"at", vector_report(view.at)},
            {"up", vector_report(view.up)},
            {"fov", placement.fov.value_or(glm::degrees(camera.fov))},
            {"orthographic", camera.orthographic()}};
}

Json scene_report(const MovingScene& scene, const ViewTimeline& timeline, const ViewEdits& edits) {
    const Scene& now = scene.now();
    Json objects = Json::array();
    for (const std::size_t i : named_once(now.instances, false))
        if (now.instances[i].present) objects.push_back(now.instances[i].name);
    Json materials = Json::array();
    for (const std::size_t i : named_once(now.materials, true)) {
        const Material& material = now.materials[i];
        const std::optional<double> roughness = perceived_roughness(material);
        materials.push_back({{"name", material.name},
                             {"albedo", vector_report(glm::dvec3(diffuse_albedo(material)))},
                             {"emission", vector_report(glm::dvec3(material.emission.radiance))},
                             {"roughness", roughness ? Json(*roughness) : Json()}});
    }
    Json lights = Json::array();
    for (const std::size_t i : named_once(now.lights, true))
        lights.push_back(
            {{"name", now.lights[i].name}, {"type", name_of_type(now.lights[i].type)}});
    return {{"objects", objects},    {"materials", materials},    {"lights", lights},
            {"edits", edits.list()}, {"frames", timeline.frames}, {"frame_rate", timeline.rate}};
}

Json stages_report(const FrameStats& frame) {
    std::vector<std::pair<std::string, double>> stages;
    for (const StageStats& stage : frame.stages) {
        const std::string name(stage_name(stage.stage));
        const auto found =
            std::ranges::find_if(stages, [&](const auto& one) { return one.first == name; });
        if (found == stages.end())
            stages.emplace_back(name, stage.ms);
        else
            found->second += stage.ms;
    }
    Json json = Json::array();
    for (const auto& [name, ms] : stages) json.push_back({name, ms});
    return json;
}

Json records_report(const FrameStats& frame) {
    if (!frame.cache) return {};
    return {{"kept", frame.cache->kept},
            {"updated", frame.cache->updated},
            {"dropped", frame.cache->dropped}};
}

Json trust_report(std::uint64_t reference_samples, const std::optional<Judgement>& judgement) {
    Json trust{{"samples", reference_samples}, {"panes", Json::array()}};
    if (!judgement) return trust;
    const auto distance = [](const ImageDistance& found) {
        return Json{{"hdrflip", finite(found.hdrflip)}, {"vdp", finite(found.vdp)}};
    };
    for (const JudgedErrors& errors : judgement->images) {
        Json pane = distance(errors.distance);
        pane["pane"] = errors.pane;
        pane["samples"] = errors.samples;
        pane["relmse"] = estimate_report(errors.relmse);
        trust["panes"].push_back(std::move(pane));
    }
    trust["floor"] = distance(judgement->floor);
    trust["judged_by"] = judgement->reference_samples;
    return trust;
}

glm::dvec3 point_at(const Camera& camera, FilmSize size, const ViewPick& pick, double depth) {
    const double aspect = static_cast<double>(size.width) / size.height;
    const double across = 2.0 * (pick.x + 0.5) / size.width - 1.0;
    const double up = 1.0 - 2.0 * (pick.y + 0.5) / size.height;
    const double scale = camera.orthographic() ? half_height(camera, aspect)
                                               : depth * vertical_tangent(camera, aspect);
    const double side = camera.mirror_x ? -1.0 : 1.0;
    return column(camera, 3) + viewing_axis(camera) * depth +
           glm::normalize(column(camera, 0)) * (side * across * aspect * scale) +
           glm::normalize(column(camera, 1)) * (up * scale);
}

}  // namespace weft
